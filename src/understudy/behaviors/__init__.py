"""What the robot can do: skills for tasks, and the implicit behaviors Wander, Avoid and following the teacher."""

from understudy.behaviors.avoid import Avoid, AvoidSettings
from understudy.behaviors.follow import FollowTeacher
from understudy.behaviors.motion import Motion
from understudy.behaviors.registry import ENTRY_POINT_GROUP, SkillSet, installed_skills, unknown_skill
from understudy.behaviors.skill import (
    AbstractBehavior,
    Action,
    Actuator,
    Drive,
    Head,
    Instance,
    Memory,
    Parameter,
    Parameters,
    PrimitiveBehavior,
    Skill,
    Worded,
)
from understudy.behaviors.wander import Wander

__all__ = [
    "ENTRY_POINT_GROUP",
    "AbstractBehavior",
    "Action",
    "Actuator",
    "Avoid",
    "AvoidSettings",
    "Drive",
    "FollowTeacher",
    "Head",
    "Instance",
    "Memory",
    "Motion",
    "Parameter",
    "Parameters",
    "PrimitiveBehavior",
    "Skill",
    "SkillSet",
    "Wander",
    "Worded",
    "installed_skills",
    "unknown_skill",
]
