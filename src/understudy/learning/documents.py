"""Plain documents of observed intervals, for demonstrations that no robot made.

One looks like this, in YAML or JSON::

    understudy: intervals/1
    name: tea
    intervals:
      - {label: boil water, start: 0, end: 95.5}
      - {label: warm the pot, start: 60, end: 80}
      - {label: pour, start: 95.5, end: 104, parameters: {into: pot}}

Labels are free, and repeated ones are separate steps. Parameters that are words tell kinds of steps apart
(``pour`` into a cup, ``pour`` into a pot); numbers are taken as the values with which the step was last seen.
"""

from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field, ValidationError

from understudy.documents import Name, Part, TextOrNumber, expect_kind, first_fault, read_data
from understudy.errors import DocumentError, LearningError
from understudy.learning.instants import LATEST_S
from understudy.learning.observations import Demonstration, Instance, Observed
from understudy.network import Interval
from understudy.robot.cues import Cue

__all__ = ["IntervalsDocument", "intervals_schema", "load_intervals", "parse_intervals"]

Moment = Annotated[float, Field(ge=-LATEST_S, le=LATEST_S, allow_inf_nan=False)]
Text = Annotated[str, Field(min_length=1)]


class Entry(Part):
    model_config = ConfigDict(strict=True)


class IntervalEntry(Entry):
    """One step: ``label`` was going on from ``start`` to ``end``, in seconds."""

    label: Name
    start: Moment
    end: Moment
    parameters: dict[Text, TextOrNumber] = {}


class CueEntry(Entry):
    """One of the teacher's words, at ``time``. With HERE, TAKE or DROP, only steps that they fall on are learned;
    REPEAT and UNTIL enclose what is done again and again."""

    time: Moment
    cue: Literal["HERE", "TAKE", "DROP", "REPEAT", "UNTIL"]


class IntervalsDocument(Entry):
    """A demonstration as a list of steps with their times."""

    understudy: Literal["intervals/1"]
    name: Name
    intervals: list[IntervalEntry]
    cues: list[CueEntry] = []


def load_intervals(path: str | Path) -> Demonstration:
    """Read a document from a file: JSON if its name ends in ``.json``, YAML otherwise.

    Raises:
        DocumentError: the file cannot be read, or is no such document; the message names file and place.
        LearningError: it lists no interval.
    """
    return parse_intervals(read_data(path), source=str(path))


def parse_intervals(data: object, *, source: str = "intervals") -> Demonstration:
    """Read a document from plain data.

    Args:
        data: as a YAML or JSON reader gives it.
        source: the document's name in messages.

    Raises:
        DocumentError: it is malformed; the message names the place, ``intervals[3].end``.
        LearningError: it lists no interval.
    """
    expect_kind(data, "intervals/1", source=source)
    try:
        document = IntervalsDocument.model_validate(data)
    except ValidationError as error:
        raise first_fault(error, source) from None
    for index, entry in enumerate(document.intervals):
        if entry.end < entry.start:
            raise DocumentError(
                f"{entry.label!r} ends at {entry.end:g} s, before it begins at {entry.start:g} s; exchange them",
                source=source,
                path=f"intervals[{index}].end",
            )
    if not document.intervals:
        raise LearningError(f"{source}: there is nothing to learn from; list the steps under `intervals`")
    observations = sorted(
        (_observed(entry) for entry in document.intervals), key=lambda observed: observed.interval.start
    )
    return Demonstration(
        name=document.name,
        span=Interval(observations[0].interval.start, max(observed.interval.end for observed in observations)),
        observations=tuple(observations),
        cues=tuple(sorted((entry.time, Cue(entry.cue)) for entry in document.cues)),
        annotated=True,
    )


def intervals_schema() -> dict[str, Any]:
    """The JSON schema of the document. That an interval does not end before it begins is beyond what it can say."""
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **IntervalsDocument.model_json_schema()}


def _observed(entry: IntervalEntry) -> Observed:
    words = tuple((name, value) for name, value in entry.parameters.items() if isinstance(value, str))
    numbers = {name: float(value) for name, value in entry.parameters.items() if not isinstance(value, str)}
    return Observed(
        instance=Instance(entry.label, words),
        interval=Interval(entry.start, entry.end),
        values=MappingProxyType(numbers),
    )
