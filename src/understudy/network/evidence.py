"""Why a learned network looks as it does: what was seen, in which demonstration, when."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import NamedTuple

__all__ = ["Interval", "LinkEvidence", "Occurrence"]


class Interval(NamedTuple):
    """From the moment a goal came true to the moment it ceased to be, in seconds of the demonstration's clock."""

    start: float
    end: float

    @property
    def duration(self) -> float:
        return self.end - self.start


@dataclass(frozen=True, slots=True, kw_only=True)
class Occurrence:
    """One interval during which a behavior's goal was observed (§4.3).

    Attributes:
        demonstration: the name of the demonstration.
        interval: when the goal was true, or could be evaluated.
        values: the parameter values last observed.
        cues: the words that fell into the interval, with their times, which made it salient.
        closest_s: the moment of the closest approach, for goals that have a distance.
    """

    demonstration: str
    interval: Interval
    values: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    cues: tuple[tuple[float, str], ...] = ()
    closest_s: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkEvidence:
    """What one demonstration says about two components.

    Attributes:
        demonstration: its name.
        source: when the predecessor's goal was true.
        target: when the successor's goal was true.
        relation: Allen's relation between the two, as in Table 4.1.
        note: why the link's type is not the table's, where that is so.
    """

    demonstration: str
    source: Interval
    target: Interval
    relation: str
    note: str = ""
