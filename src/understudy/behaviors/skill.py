"""What a skill is: an abstract behavior that knows its goal, and a primitive behavior that reaches it (§3.2).

A skill holds no run-time data. What a primitive must remember from one tick to the next it hands back as its
memory, a plain value that the execution's context keeps.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from random import Random
from typing import Any, Literal, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from understudy.behaviors.symbols import Plannable, Way
from understudy.errors import SkillError
from understudy.geometry import Point, Pose
from understudy.perception import Attention, Percepts
from understudy.robot import Color

__all__ = [
    "AbstractBehavior",
    "Action",
    "Actuator",
    "Attentive",
    "Drive",
    "Head",
    "Instance",
    "Memory",
    "Parameter",
    "Parameters",
    "PrimitiveBehavior",
    "Skill",
    "Strip",
    "Worded",
]

Parameters = Mapping[str, Any]
"""Parameter values by name, checked and complete: colors as :class:`Color`, words as str, numbers as float."""

Memory = dict[str, Any]
"""What a primitive remembers between ticks; plain data. Empty when it starts. A primitive gives back a new one."""


class Actuator(StrEnum):
    """What a behavior may lock (§3.3.2)."""

    WHEELS = "wheels"
    GRIPPER = "gripper"


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """One parameter of a skill.

    Attributes:
        name: with its unit, ``distance_m``.
        kind: a color or a word tells instances of a behavior apart; a number is continuous.
        low, high: limits of a number.
        words: that a word can be.
        default: taken where a network gives no value; None makes the parameter obligatory.
        tolerance: how far from a number the goal still counts as reached.
    """

    name: str
    kind: Literal["color", "number", "word"]
    low: float = 0.0
    high: float = 0.0
    words: tuple[str, ...] = ()
    default: float | str | None = None
    tolerance: float = 0.0

    def check(self, skill: str, value: object) -> Color | str | float:
        """The value as the skill takes it.

        Raises:
            SkillError: not a trained color, not one of the words, or not a number within the limits.
        """
        if self.kind == "word":
            if value not in self.words:
                raise SkillError(f"{skill}: {self.name} is {value!r}; it is one of: {', '.join(self.words)}")
            return str(value)
        if self.kind == "color":
            try:
                return Color(str(value))
            except ValueError:
                colors = ", ".join(Color)
                raise SkillError(f"{skill}: {value!r} is no trained color; {self.name} is one of: {colors}") from None
        if isinstance(value, bool) or not isinstance(value, int | float) or not self.low <= value <= self.high:
            raise SkillError(f"{skill}: {self.name} is {value!r}; it is a number from {self.low:g} to {self.high:g}")
        return float(value)


class Instance(NamedTuple):
    """A behavior with its discrete parameters: what the learner tells apart (semantics §4).

    Attributes:
        behavior: the name of the skill, or any label of an interval document.
        parameters: names and values of the discrete ones, ``(("color", "green"),)``, always in the same order.
    """

    behavior: str
    parameters: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        inside = ", ".join(f"{name}={value}" for name, value in self.parameters)
        return f"{self.behavior}({inside})" if inside else self.behavior


@dataclass(frozen=True, slots=True, kw_only=True)
class Drive:
    """Speeds for the wheels as they are: m/s forward, rad/s left."""

    linear: float = 0.0
    angular: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Head:
    """Go in a direction of the robot's frame (radians, left positive) at a speed (m/s); obstacles are gone around.

    The robot turns by at most ``turn`` radians a second. It goes no farther than ``way``, metres: what stands beyond is
    not in its way.
    """

    bearing: float
    speed: float
    turn: float = 1.2
    way: float = math.inf


@dataclass(frozen=True, slots=True, kw_only=True)
class Strip:
    """A part of the floor, across which a door's leaf may stand; metres.

    Attributes:
        frame: its middle, in the robot's frame; its x axis leads through.
        half_width: along the y axis, to both sides.
        reach: along the x axis, both ways.
        shy: what stands there is gone around, and pushed only where the robot comes too near to it.
    """

    frame: Pose
    half_width: float
    reach: float
    shy: bool = False

    def holds(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which of these points of the robot's frame lie on it."""
        c, s = math.cos(self.frame.heading), math.sin(self.frame.heading)
        dx, dy = points[:, 0] - self.frame.x, points[:, 1] - self.frame.y
        inside: NDArray[np.bool_] = np.abs(c * dy - s * dx) < self.half_width
        inside &= np.abs(c * dx + s * dy) < self.reach
        return inside


@dataclass(frozen=True, slots=True, kw_only=True)
class Action:
    """What a primitive behavior asks for in one tick.

    Attributes:
        drive: for the wheels; None where the skill does not drive.
        paddles, lift: for the gripper; None leaves it as it is.
        aim: the thing that the skill approaches on purpose; ``Avoid`` does not fight that (semantics §1).
        aim_radius: its radius, metres.
        pushing: where the robot pushes away on purpose what stands in its way; ``Avoid`` does not fight that either.
        keep_on: the port ``Continue``: do not interrupt me yet (§3.2.2).
    """

    drive: Drive | Head | None = None
    paddles: Literal["open", "close"] | None = None
    lift: Literal["up", "down"] | None = None
    aim: Point | None = None
    aim_radius: float = 0.0
    pushing: Strip | None = None
    keep_on: bool = False


class AbstractBehavior(Protocol):
    """The perceptual half of a skill. It never commands anything."""

    @property
    def name(self) -> str: ...

    @property
    def parameters(self) -> tuple[Parameter, ...]: ...

    @property
    def actuators(self) -> frozenset[Actuator]:
        """What its primitive controls, and locks while it executes."""
        ...

    @property
    def maintaining(self) -> bool:
        """Its goal holds only while it acts (§4.3, Figure 4.1)."""
        ...

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        """Whether its postconditions hold now: the port ``Effects``."""
        ...

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        """Whether the world lets its primitive act now; otherwise the robot must search (semantics §1)."""
        ...

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        """For the learner: which instances' goals hold, or could hold, now.

        Returns:
            For every instance, the continuous parameter values that would make its goal true right now; empty for a
            goal without such parameters, which then simply holds (§4.3).
        """
        ...

    def describe(self, parameters: Parameters) -> str:
        """The goal in plain words, as a step of a task: ``go to the green target``."""
        ...


@runtime_checkable
class Worded(Protocol):
    """Words that an abstract behavior may have besides, for conditions that ask for it: something that is so.

    Without them, people are told the goal.
    """

    def holding(self, parameters: Parameters) -> str:
        """That its goal holds: ``the orange box is in the gripper``."""
        ...

    def possible(self, parameters: Parameters) -> str:
        """That its world precondition holds: ``the orange box is in sight or remembered``."""
        ...


@runtime_checkable
class Attentive(Protocol):
    """An abstract behavior whose goal rests on landmarks, which the robot then watches."""

    def attention(self, parameters: Parameters) -> Attention:
        """The landmarks that matter with these parameters."""
        ...


class PrimitiveBehavior(Protocol):
    """The active half of a skill: while its abstract behavior is active it computes commands."""

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        """The action for this tick, and what to remember for the next."""
        ...


@dataclass(frozen=True, slots=True)
class Skill:
    """An abstract behavior with the primitive that reaches its goal."""

    abstract: AbstractBehavior
    primitive: PrimitiveBehavior

    @property
    def name(self) -> str:
        return self.abstract.name

    @property
    def ways(self) -> tuple[Way, ...]:
        """How it can be used in a plan; none if it does not say so."""
        return self.abstract.ways if isinstance(self.abstract, Plannable) else ()

    def attention(self, parameters: Parameters) -> Attention:
        """The landmarks that matter with these parameters; none to most skills."""
        return self.abstract.attention(parameters) if isinstance(self.abstract, Attentive) else Attention()

    def complete(self, given: Mapping[str, object]) -> Parameters:
        """Checks given parameter values and adds the defaults.

        Raises:
            SkillError: an unknown name, a missing value, or a value that does not fit.
        """
        known = {parameter.name: parameter for parameter in self.abstract.parameters}
        for name in given:
            if name not in known:
                takes = ", ".join(known) or "no parameters"
                raise SkillError(f"{self.name} has no parameter {name!r}; it takes {takes}")
        values: dict[str, Color | str | float] = {}
        for name, parameter in known.items():
            value = given.get(name, parameter.default)
            if value is None:
                raise SkillError(f"{self.name} needs a value for {name!r}")
            values[name] = parameter.check(self.name, value)
        return values
