"""What a skill needs and brings about, in words that a planner can work with (§3.3.1).

A skill's goal is a predicate over what is perceived. For a planner the same is said with *facts*, ``holding(orange)``:
a word, and what it is said of. They are declared beside the goal, and nothing in them is sensed: it is the goal that
tells a running task whether they are so.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import NamedTuple, Protocol, runtime_checkable

__all__ = ["ANY", "BOX", "TARGET", "Fact", "Plannable", "Way", "read_facts"]

BOX, TARGET = "box", "target"
"""What there is in a room; which of them there are is told by their colors."""

ANY = "*"
"""In :attr:`Way.ends`: whatever it is said of."""

_FACT = re.compile(r"\s*([A-Za-z]\w*)\s*(?:\(([^()]*)\))?\s*", re.ASCII)
_JOINT = re.compile(r",|and\b", re.IGNORECASE)


class Fact(NamedTuple):
    """Something that is so or not.

    Attributes:
        word: ``holding``; small letters.
        things: what it is said of: colors; in a declaration, names that stand for them.
    """

    word: str
    things: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.word}({', '.join(self.things)})" if self.things else self.word


@dataclass(frozen=True, slots=True, kw_only=True)
class Way:
    """One way in which a skill can be used; a skill that does more where more is so has several.

    All but ``of`` are facts with ``and`` or commas between them.

    Attributes:
        of: the names that stand in the facts, with what kind of thing each stands for: :data:`BOX` or :data:`TARGET`.
            Those of the skill's parameters that are colors are among them; others stand for anything of the kind. Two
            names may stand for one thing.
        goal: one fact, the one that the skill's own goal senses while a task is running.
        needs: must be so when it begins.
        keeps: must be so from its beginning until its goal is reached.
        gives: is so afterwards, besides the goal.
        ends: is not so afterwards; :data:`ANY` stands for everything that a fact can be said of. What the way gives is
            so all the same.
    """

    of: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    goal: str
    needs: str = ""
    keeps: str = ""
    gives: str = ""
    ends: str = ""


@runtime_checkable
class Plannable(Protocol):
    """An abstract behavior that says how it can be used in a plan. Without that, nothing can be planned with it."""

    @property
    def ways(self) -> tuple[Way, ...]: ...


def read_facts(text: str) -> tuple[Fact, ...]:
    """The facts of a text, ``holding(box) and near(target)``; none of an empty one.

    Raises:
        ValueError: it cannot be read; the message says from where on.
    """
    if not text.strip():
        return ()
    found: list[Fact] = []
    place = 0
    while True:
        match = _FACT.match(text, place)
        if match is None or match[1].lower() == "and":
            rest = text[place:].strip()
            raise ValueError(f"a fact is missing at {rest!r}" if rest else "it breaks off")
        inside = (match[2] or "").strip()
        things = tuple(thing.strip() for thing in inside.split(",")) if inside else ()
        if "" in things:
            raise ValueError(f"something is missing between the brackets of {match[0].strip()!r}")
        found.append(Fact(match[1].lower(), things))
        place = match.end()
        if place == len(text):
            return tuple(found)
        joint = _JOINT.match(text, place)
        if joint is None:
            raise ValueError(f"'and' or a comma is missing before {text[place:]!r}")
        place = joint.end()
