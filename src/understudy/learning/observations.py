"""What a demonstration leaves behind: observed intervals with their values (§4.3, Figure 4.2)."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from understudy.behaviors import Instance
from understudy.errors import LearningError
from understudy.network import Interval
from understudy.robot.cues import Cue

__all__ = ["SALIENT", "Demonstration", "History", "Instance", "Observed"]

SALIENT = (Cue.HERE, Cue.TAKE, Cue.DROP)
"""The words that point at what is sensed."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class History:
    """The values which would have made a goal true, tick by tick (Figure 4.2, right).

    Attributes:
        names: of the values, in the order of the columns.
        times: seconds, shape ``(ticks,)``, ascending. Ticks at which the goal could not be evaluated are missing.
        values: shape ``(ticks, len(names))``.
    """

    names: tuple[str, ...]
    times: NDArray[np.float64]
    values: NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Observed:
    """A goal was true, or could be evaluated, during one interval (§4.3).

    Attributes:
        instance: whose goal.
        interval: half-open: from the tick at which the goal was first true to the tick at which it was first false.
        values: the values last observed, which are the goal values (§4.3). Empty for goals without parameters.
        closest_s: the moment of closest approach, for goals with a distance.
        closest_m: the distance then.
        cues: the words that make it salient, with their times.
        history: the values tick by tick; ``None`` where there are none, as in interval documents.

    Raises:
        LearningError: the interval ends before it begins, or the closest approach lies outside it.
    """

    instance: Instance
    interval: Interval
    values: Mapping[str, float] = field(default_factory=lambda: MappingProxyType({}))
    closest_s: float | None = None
    closest_m: float | None = None
    cues: tuple[tuple[float, Cue], ...] = ()
    history: History | None = field(default=None, compare=False, repr=False)

    def __post_init__(self) -> None:
        start, end = self.interval
        if not start <= end:
            raise LearningError(f"{self.instance} was seen from {start:g} to {end:g} s, but time runs forward only")
        if self.closest_s is not None and not start <= self.closest_s <= end:
            raise LearningError(
                f"{self.instance} was seen from {start:g} to {end:g} s, yet closest at {self.closest_s:g} s; "
                "the closest approach must lie in the interval"
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Demonstration:
    """All that was observed in one demonstration, before anything is left out.

    Attributes:
        name: under which the evidence refers to it.
        span: from START to DONE.
        observations: in order of appearance.
        cues: HERE, TAKE, DROP, REPEAT and UNTIL with their times.
        taken_back: what a word pointed at and the teacher took back, by BAD: the word, and the kind of the thing.
        annotated: somebody wrote the intervals down. Then they are no sensor readings, and none of them is taken for a
            false indication because it is short.
        notes: what the teacher should know about how it was recorded.
        done: it was ended by DONE, and not cut short.
    """

    name: str
    span: Interval
    observations: tuple[Observed, ...]
    cues: tuple[tuple[float, Cue], ...] = ()
    taken_back: tuple[tuple[float, Cue, Instance], ...] = ()
    annotated: bool = False
    notes: tuple[str, ...] = ()
    done: bool = True

    @property
    def pointing(self) -> tuple[tuple[float, Cue], ...]:
        """The words that say of what is sensed that it matters: HERE, TAKE and DROP."""
        return tuple((time_s, cue) for time_s, cue in self.cues if cue in SALIENT)
