"""What the library holds, as values."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from types import MappingProxyType
from typing import Any, Literal

from understudy.documents import parse_text
from understudy.errors import LibraryError, NetworkError
from understudy.network import Network, Task, parse_task

__all__ = ["Cause", "Entry", "Revision", "Sitting", "SittingKind", "name_and_number", "network_of", "shown_in"]

Cause = Literal["learned", "generalised", "BAD", "COME … GO", "planned", "edited by hand", "imported", "reverted"]
"""What made a revision out of the one before."""

SittingKind = Literal["demonstration", "run", "practice"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Revision:
    """One state of a task.

    Attributes:
        task: the name of the task.
        number: unique in its task; the first is 1.
        parent: the number of the revision that it was made from; None for the first.
        cause: what was done to that one.
        note: anything a person should know of it.
        made_at: when it came into the library.
        accepted: False for a proposal, which the task's name does not stand for.
        evidence: in plain data, what the cause says of it: the word and the step that it was about, the demonstrations.
        document: the text of the whole task document.
    """

    task: str
    number: int
    parent: int | None = None
    cause: str
    note: str = ""
    made_at: datetime
    accepted: bool = True
    evidence: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    document: str

    def __str__(self) -> str:
        """As it is named on the command line: ``fetch@3``."""
        return f"{self.task}@{self.number}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Sitting:
    """A demonstration, a run or a practice run of a task.

    Attributes:
        task: the name of the task.
        kind: which of the three.
        number: unique among those of its kind; the first is 1.
        name: what the recording calls itself.
        revision: that was made with a demonstration; that was executed in a run.
        made_at: when it came into the library.
        file: the SHA-256 of its recording or its document, under which the library holds that; empty without one.
        shown: of a demonstration, the task document that was learned from it alone; empty for a run.
        achieved: of a run, the paths of the steps that it achieved, in their order.
        done: whether a run was done, or DONE was said in a demonstration.
        outcome: how it ended, in words.
    """

    task: str
    kind: SittingKind
    number: int
    name: str
    revision: int
    made_at: datetime
    file: str = ""
    shown: str = ""
    achieved: tuple[str, ...] = ()
    done: bool = True
    outcome: str = ""

    def __str__(self) -> str:
        """``demonstration 2``, ``practice run 1``."""
        return f"{'practice run' if self.kind == 'practice' else self.kind} {self.number}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """A task in the list of all.

    Attributes:
        name: of the task.
        head: the number of the revision that its name stands for; None if none was accepted yet.
        revisions: how many there are.
        demonstrations, runs, practices: how many of each.
        changed_at: when the last revision was made.
    """

    name: str
    head: int | None
    revisions: int
    demonstrations: int
    runs: int
    practices: int
    changed_at: datetime


def network_of(revision: Revision) -> tuple[Task, Network]:
    """The task document of a revision and its network.

    Raises:
        NetworkError: it is none, which only another program can have brought about.
    """
    source = f"library: {revision}"
    return parse_task(parse_text(revision.document, source=source, kind=NetworkError), source=source)


def shown_in(demonstration: Sitting) -> Network:
    """What was learned from one demonstration alone.

    Raises:
        NetworkError: it is no task document, which only another program can have brought about.
    """
    source = f"library: {demonstration.task}, {demonstration}"
    return parse_task(parse_text(demonstration.shown, source=source, kind=NetworkError), source=source)[1]


def name_and_number(text: str) -> tuple[str, int | None]:
    """The name and the revision of ``fetch@3``; no revision for ``fetch`` alone.

    Raises:
        LibraryError: what stands behind the @ is no number of a revision.
    """
    name, at, number = text.rpartition("@")
    if not at:
        return text, None
    if not number.isdecimal() or int(number) < 1:
        raise LibraryError(f"{text!r}: behind the @ stands the number of a revision, as in {name or 'fetch'}@3")
    return name, int(number)
