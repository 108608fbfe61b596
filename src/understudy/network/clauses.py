"""Conditions as they are said in Python, where a step is meant by the step itself and has no id yet."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from understudy.behaviors import Skill
from understudy.errors import NetworkError
from understudy.network.conditions import (
    Achieved,
    After,
    AllOf,
    AnyOf,
    Complete,
    Condition,
    Happened,
    Holds,
    Not,
    ParameterValue,
    Possible,
    TimedOut,
)

__all__ = [
    "Clause",
    "achieved",
    "after",
    "all_of",
    "any_of",
    "complete",
    "event",
    "given_behavior",
    "holds",
    "not_",
    "possible",
    "settled",
    "timed_out",
]


@dataclass(frozen=True, slots=True)
class Clause:
    """A condition of which the steps are to be named.

    Attributes:
        kind: which.
        of: what it is about: a step or its id, or other clauses.
    """

    kind: type[Achieved] | type[TimedOut] | type[Not] | type[AllOf] | type[AnyOf]
    of: tuple[Any, ...]


def holds(behavior: str | Skill, /, **parameters: ParameterValue) -> Condition:
    """A skill's goal holds now: ``holds("PickUp", color="orange")``."""
    name, values = given_behavior(behavior, parameters)
    return Holds(behavior=name, parameters=values)


def possible(behavior: str | Skill, /, **parameters: ParameterValue) -> Condition:
    """A skill could act now: ``possible("Track", color="green")``, the green target is in sight or remembered."""
    name, values = given_behavior(behavior, parameters)
    return Possible(behavior=name, parameters=values)


def event(name: str) -> Condition:
    """An event of this name reaches the robot, or a step that ran out of time signals it."""
    if not isinstance(name, str) or not name:
        raise NetworkError(f"an event needs a name, given {name!r}")
    return Happened(event=name)


def achieved(step: object) -> Clause:
    """A step of the same network is achieved; also by its id."""
    return Clause(Achieved, (step,))


def timed_out(step: object) -> Clause:
    """A step of the same network has run out of its time, and has not been achieved since; also by its id."""
    return Clause(TimedOut, (step,))


def after(seconds: float) -> Condition:
    """The network has been in use for so many seconds."""
    return After(seconds=seconds)


def complete() -> Condition:
    """The case at hand is complete; for switches only."""
    return Complete()


def not_(of: Clause | Condition) -> Clause:
    """The other is not so."""
    return Clause(Not, (of,))


def all_of(*of: Clause | Condition) -> Clause:
    """Every one is so."""
    return Clause(AllOf, of)


def any_of(*of: Clause | Condition) -> Clause:
    """At least one is so."""
    return Clause(AnyOf, of)


def settled(clause: Clause | Condition, id_of: Callable[[Any], str]) -> Condition:
    """The condition of the definition.

    Args:
        clause: as it was said.
        id_of: a step's id in the network of which the clause speaks; raises NetworkError if it is not in there.
    """
    if not isinstance(clause, Clause):
        if not isinstance(clause, Condition):
            raise NetworkError(f"a condition is needed here, such as holds(...) or event(...), given {clause!r:.60}")
        return clause
    if clause.kind is Achieved or clause.kind is TimedOut:
        return clause.kind(component=id_of(clause.of[0]))
    inside = tuple(settled(part, id_of) for part in clause.of)
    if clause.kind is Not:
        return Not(of=inside[0])
    return AllOf(of=inside) if clause.kind is AllOf else AnyOf(of=inside)


def given_behavior(behavior: str | Skill, parameters: Mapping[str, object]) -> tuple[str, Mapping[str, ParameterValue]]:
    """A behavior's name and its parameters as the definition has them.

    Raises:
        NetworkError: neither text nor a skill, or a parameter that is neither text nor a number.
        SkillError: the skill does not take these parameters.
    """
    if isinstance(behavior, Skill):
        behavior.complete(parameters)
        behavior = behavior.name
    if not isinstance(behavior, str) or not behavior:
        raise NetworkError(f"a behavior is a skill, or the name of one, given {behavior!r:.60}")
    return behavior, MappingProxyType(dict(_values(behavior, parameters)))


def _values(behavior: str, parameters: Mapping[str, object]) -> Iterator[tuple[str, ParameterValue]]:
    for name, value in parameters.items():
        if isinstance(value, bool) or not isinstance(value, str | int | float):
            raise NetworkError(f"{behavior}: {name} must be text or a number, given {value!r:.60}")
        yield name, str(value) if isinstance(value, str) else value
