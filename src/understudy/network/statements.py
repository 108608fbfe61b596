"""What a network written in Python consists of: steps and parts, what is asked of them, and statements about them."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields

from understudy.errors import NetworkError
from understudy.network.clauses import Clause
from understudy.network.conditions import Condition, ParameterValue
from understudy.network.controls import Timeout, check_timeout
from understudy.network.definition import LinkType, Network

__all__ = [
    "Again",
    "Controls",
    "Item",
    "Part",
    "PartCase",
    "PartSwitch",
    "Statement",
    "Step",
    "Stored",
    "called",
    "every",
    "named",
    "repeat",
    "statement",
    "together",
    "until",
    "whenever",
    "within",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Again:
    """A loop, see :func:`repeat`."""

    times: int | None = None
    until: Clause | Condition | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Controls:
    """What is asked of a step or a part besides its goal; made by :func:`within`, :func:`every` and the like."""

    id: str | None = None
    name: str | None = None
    until: Clause | Condition | None = None
    timeout: Timeout | None = None
    trigger: float | Clause | Condition | None = None
    repeat: Again | None = None

    @classmethod
    def all_of(cls, controls: Iterable["Controls"], whose: str) -> "Controls":
        """Several as one.

        Raises:
            NetworkError: one thing is said twice.
        """
        said: dict[str, object] = {}
        for control in controls:
            if not isinstance(control, Controls):
                raise NetworkError(
                    f"{whose}: {control!r:.60} says nothing of a step; within(...), until(...), every(...) do, and "
                    "parameters are given by their names"
                )
            for field in fields(cls):
                value = getattr(control, field.name)
                if value is None:
                    continue
                if field.name in said:
                    raise NetworkError(f"{whose} has a second {field.name}; keep one of them")
                said[field.name] = value
        return cls(**said)  # type: ignore[arg-type]  # each is the field's own value


def named(id_: str) -> Controls:
    """The id of a step, instead of the one that it would get by itself."""
    if not isinstance(id_, str) or not id_ or "/" in id_:
        raise NetworkError(f"an id is text without '/', given {id_!r:.60}")
    return Controls(id=id_)


def called(name: str) -> Controls:
    """What a part is called in pictures and words, instead of its id."""
    return Controls(name=name)


def until(condition: Clause | Condition) -> Controls:
    """It counts as achieved as soon as this is so, too."""
    return Controls(until=condition)


def within(seconds: float, *, skip: bool = False, signal: str = "") -> Controls:
    """Its time. When that is over the run ends, not done; or it is skipped; or it signals an event, and tries on."""
    if skip and signal:
        raise NetworkError("what is skipped signals nothing; say skip=True or signal=..., not both")
    timeout = Timeout(seconds=seconds, then="signal" if signal else "skip" if skip else "stop", event=signal)
    check_timeout(timeout, "within")
    return Controls(timeout=timeout)


def every(seconds: float) -> Controls:
    """A duty beside the sequence, called every so many seconds."""
    if not (math.isfinite(seconds) and seconds > 0):
        raise NetworkError(f"a duty is called every so many seconds, a positive number, given {seconds!r}")
    return Controls(trigger=float(seconds))


def whenever(condition: Clause | Condition) -> Controls:
    """A duty beside the sequence, called each time when this comes true."""
    return Controls(trigger=condition)


def repeat(times: int | None = None, *, until: Clause | Condition | None = None) -> Controls:
    """A part is done so many times, or until this is so at the end of a round; without either, without end."""
    if times is not None and (isinstance(times, bool) or not isinstance(times, int) or times < 1):
        raise NetworkError(f"a loop runs at least once, a whole number of times, given {times!r}")
    return Controls(repeat=Again(times=times, until=until))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class Step:
    """One use of a behavior. Wherever the same object stands, the same step is meant."""

    behavior: str
    parameters: Mapping[str, ParameterValue]
    controls: Controls

    def __str__(self) -> str:
        words = ", ".join(value for value in self.parameters.values() if isinstance(value, str))
        return f"{self.behavior}({words})" if words else self.behavior

    def __repr__(self) -> str:
        given = (repr(self.behavior), *(f"{name}={value!r}" for name, value in self.parameters.items()))
        return f"do({', '.join(given)})"


@dataclass(frozen=True, slots=True, kw_only=True)
class Stored:
    """A task that was read from its document."""

    name: str
    network: Network


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class PartCase:
    """One of the networks that a part can be, with the ids of its steps."""

    name: str
    network: Network
    ids: Mapping["Item", str]
    when: Clause | Condition | None

    def __repr__(self) -> str:
        return f"case({self.name!r}, …)"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PartSwitch:
    """From one case to another, see :func:`~understudy.network.builder.switch`."""

    source: str
    target: str
    when: Clause | Condition


@dataclass(frozen=True, slots=True, kw_only=True, eq=False, repr=False)
class Part:
    """A network in a step's place. Wherever the same object stands, the same part is meant."""

    id: str
    cases: tuple[PartCase, ...]
    switches: tuple[PartSwitch, ...]
    controls: Controls

    def __str__(self) -> str:
        return self.id

    def __repr__(self) -> str:
        return f"part({self.id!r}, …)"

    @property
    def inside(self) -> frozenset["Item"]:
        """All that stands in it, at every depth."""
        own = frozenset(item for case in self.cases for item in case.ids)
        return own.union(*(item.inside for item in own if isinstance(item, Part)))


Item = Step | Part


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Statement:
    """Steps, and what they ask of each other.

    Attributes:
        items: in order of appearance, each once.
        links: with their types.
        rivals: who keeps whom still.
    """

    items: tuple[Item, ...]
    links: tuple[tuple[Item, Item, LinkType], ...] = ()
    rivals: tuple[tuple[Item, Item], ...] = ()

    def without(self, others: Iterable[Item]) -> "Statement":
        """What it says of all but these."""
        left = [item for item in self.items if item not in set(others)]
        links = tuple(link for link in self.links if link[0] in left and link[1] in left)
        return Statement(items=tuple(left), links=links)

    @property
    def first(self) -> tuple[Item, ...]:
        """The steps that wait for no other one of these."""
        waiting = {target for _, target, _ in self.links}
        return tuple(item for item in self.items if item not in waiting)

    @property
    def last(self) -> tuple[Item, ...]:
        """The steps for which no other one of these waits."""
        waited_for = {source for source, _, _ in self.links}
        return tuple(item for item in self.items if item not in waited_for)


def statement(said: object, where: str) -> Statement:
    """A step, a part or a statement as a statement.

    Args:
        said: what was given.
        where: in which call, for messages.

    Raises:
        NetworkError: it is none of them.
    """
    if isinstance(said, Statement):
        return said
    if isinstance(said, Step | Part):
        return Statement(items=(said,))
    hint = ""
    if isinstance(said, str):
        hint = f"; a step is do({said!r}, ...), and its own object stands for it wherever it is meant again"
    elif isinstance(said, list | tuple):
        hint = "; give them one by one, or with a star before the list"
    elif isinstance(said, Controls | PartCase | PartSwitch):
        hint = "; that belongs into part(...) or choose(...)"
    elif isinstance(said, Network | Stored):
        hint = '; a network as a whole is a part: part("name", ...)'
    raise NetworkError(f"{where} takes steps, parts, and what is said of them, given {said!r:.60}{hint}")


def together(said: Iterable[object], where: str) -> Statement:
    """Several statements as one; of two links between the same steps the more restrictive one counts.

    Raises:
        NetworkError: nothing is said, or something is none.
    """
    items: dict[Item, None] = {}
    links: dict[tuple[Item, Item], LinkType] = {}
    rivals: dict[tuple[Item, Item], None] = {}
    for one in (statement(one, where) for one in said):
        items |= dict.fromkeys(one.items)
        rivals |= dict.fromkeys(one.rivals)
        for source, target, type_ in one.links:
            links[source, target] = max(links.get((source, target), type_), type_, key=lambda kind: kind.strength)
    if not items:
        raise NetworkError(f"{where} takes at least one step")
    return Statement(
        items=tuple(items),
        links=tuple((source, target, type_) for (source, target), type_ in links.items()),
        rivals=tuple(rivals),
    )
