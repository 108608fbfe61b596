"""One lesson, many robots: which skills bind on a robot, and which do not, and why."""

from collections.abc import Mapping
from dataclasses import dataclass

from understudy.behaviors import Actuator, Skill
from understudy.errors import SkillError
from understudy.network import Component, Network
from understudy.robot import RobotSpec

__all__ = ["Capability", "capabilities", "check_capable", "unbound"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Capability:
    """Whether a skill binds on a robot.

    Attributes:
        skill: its name.
        missing: what the robot has not and the skill needs; empty if it binds.
    """

    skill: str
    missing: str


def capabilities(skills: Mapping[str, Skill], spec: RobotSpec) -> tuple[Capability, ...]:
    """Which skills bind on a robot, and which do not, and why: one lesson may be for many robots.

    Args:
        skills: by name.
        spec: the robot.
    """
    return tuple(
        Capability(
            skill=name,
            missing="a gripper" if Actuator.GRIPPER in skill.abstract.actuators and spec.gripper is None else "",
        )
        for name, skill in skills.items()
    )


def unbound(skills: Mapping[str, Skill], spec: RobotSpec) -> str:
    """The skills that do not bind on a robot in one line; empty if all do.

    Args:
        skills: by name.
        spec: the robot.
    """
    lacking: dict[str, list[str]] = {}
    for one in capabilities(skills, spec):
        if one.missing:
            lacking.setdefault(one.missing, []).append(one.skill)
    return "; ".join(f"{', '.join(names)}: needs {missing}" for missing, names in lacking.items())


def check_capable(network: Network, skills: Mapping[str, Skill], spec: RobotSpec) -> None:
    """Refuses a task that a robot cannot do.

    Args:
        network: the task.
        skills: by name.
        spec: the robot.

    Raises:
        SkillError: a step's skill does not bind on the robot.
    """
    asked = {part.behavior for part in network.by_path.values() if isinstance(part, Component)}
    lacking = unbound({name: skill for name, skill in skills.items() if name in asked}, spec)
    if lacking:
        raise SkillError(
            f"{spec.name} cannot do this task ({lacking}); run it on a robot that has it, or take these steps out"
        )
