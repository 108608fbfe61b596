"""What the robot can do: skills for tasks, and the implicit behaviors Wander, Avoid and following the teacher."""

from understudy.behaviors.avoid import Avoid, AvoidSettings
from understudy.behaviors.follow import FollowTeacher
from understudy.behaviors.motion import Motion
from understudy.behaviors.registry import ENTRY_POINT_GROUP, SkillSet, installed_skills, unknown_skill
from understudy.behaviors.skill import (
    AbstractBehavior,
    Action,
    Actuator,
    Attentive,
    Drive,
    Head,
    Instance,
    Memory,
    Parameter,
    Parameters,
    PrimitiveBehavior,
    Skill,
    Strip,
    Worded,
)
from understudy.behaviors.wander import Wander

__all__ = [
    "ENTRY_POINT_GROUP",
    "AbstractBehavior",
    "Action",
    "Actuator",
    "Attentive",
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
    "Strip",
    "Wander",
    "Worded",
    "installed_skills",
    "unknown_skill",
]
