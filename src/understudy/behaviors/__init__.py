"""What the robot can do: skills for tasks, and the implicit behaviors Wander, Avoid and following the teacher."""

from understudy.behaviors.avoid import Avoid, AvoidSettings
from understudy.behaviors.follow import Following, FollowTeacher, FollowTrail
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
from understudy.behaviors.symbols import ANY, BOX, TARGET, Fact, Plannable, Way, read_facts
from understudy.behaviors.wander import Wander

__all__ = [
    "ANY",
    "BOX",
    "ENTRY_POINT_GROUP",
    "TARGET",
    "AbstractBehavior",
    "Action",
    "Actuator",
    "Attentive",
    "Avoid",
    "AvoidSettings",
    "Drive",
    "Fact",
    "FollowTeacher",
    "FollowTrail",
    "Following",
    "Head",
    "Instance",
    "Memory",
    "Motion",
    "Parameter",
    "Parameters",
    "Plannable",
    "PrimitiveBehavior",
    "Skill",
    "SkillSet",
    "Strip",
    "Wander",
    "Way",
    "Worded",
    "installed_skills",
    "read_facts",
    "unknown_skill",
]
