"""Conditions: what a branch, a loop, a trigger, or a switch between networks asks for. No run-time data.

What they say of the world they say in the skills' own words: that a skill's goal holds, or that it could act now. So a
robot with other skills has other conditions, and nothing else needs to be taught to the execution.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

__all__ = [
    "Achieved",
    "After",
    "AllOf",
    "AnyOf",
    "Complete",
    "Condition",
    "Happened",
    "Holds",
    "Not",
    "ParameterValue",
    "Possible",
    "TimedOut",
    "atoms",
]

ParameterValue = str | float

_Parameters = Mapping[str, ParameterValue]


def _none() -> _Parameters:
    return MappingProxyType({})


@dataclass(frozen=True, slots=True, kw_only=True)
class Holds:
    """A skill's goal holds now: ``PickUp(color=orange)``, the orange box is in the gripper."""

    behavior: str
    parameters: _Parameters = field(default_factory=_none)

    def __str__(self) -> str:
        return f"{self.behavior}({_listed(self.parameters)})"


@dataclass(frozen=True, slots=True, kw_only=True)
class Possible:
    """A skill's world precondition holds now: ``Track(color=green)``, the green target is seen or remembered."""

    behavior: str
    parameters: _Parameters = field(default_factory=_none)

    def __str__(self) -> str:
        return f"possible {self.behavior}({_listed(self.parameters)})"


@dataclass(frozen=True, slots=True, kw_only=True)
class Happened:
    """An event reached the robot in this tick: from outside, or signalled by a component that timed out."""

    event: str

    def __str__(self) -> str:
        return f"event {self.event}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Achieved:
    """A component of the same network has been achieved."""

    component: str

    def __str__(self) -> str:
        return f"achieved {self.component}"


@dataclass(frozen=True, slots=True, kw_only=True)
class TimedOut:
    """A component of the same network has run out of its time, and has not been achieved since."""

    component: str

    def __str__(self) -> str:
        return f"timed out {self.component}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Complete:
    """The network at hand is complete; for switches (§3.5.2.3)."""

    def __str__(self) -> str:
        return "complete"


@dataclass(frozen=True, slots=True, kw_only=True)
class After:
    """The network at hand has been in use for so many seconds since it was last begun."""

    seconds: float

    def __str__(self) -> str:
        return f"after {self.seconds:g} s"


@dataclass(frozen=True, slots=True, kw_only=True)
class Not:
    """The other is not so."""

    of: "Condition"

    def __str__(self) -> str:
        return f"not {self.of}"


@dataclass(frozen=True, slots=True, kw_only=True)
class AllOf:
    """Every one is so."""

    of: "tuple[Condition, ...]"

    def __str__(self) -> str:
        return "(" + " and ".join(map(str, self.of)) + ")"


@dataclass(frozen=True, slots=True, kw_only=True)
class AnyOf:
    """At least one is so."""

    of: "tuple[Condition, ...]"

    def __str__(self) -> str:
        return "(" + " or ".join(map(str, self.of)) + ")"


Condition = Holds | Possible | Happened | Achieved | TimedOut | Complete | After | Not | AllOf | AnyOf


def atoms(condition: Condition) -> Iterator[Condition]:
    """The conditions of which a condition is made, without ``not``, ``all`` and ``any``."""
    match condition:
        case Not():
            yield from atoms(condition.of)
        case AllOf() | AnyOf():
            for part in condition.of:
                yield from atoms(part)
        case _:
            yield condition


def _listed(parameters: _Parameters) -> str:
    return ", ".join(f"{name}={value}" for name, value in parameters.items())
