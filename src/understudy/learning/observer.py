"""The on-line part of learning: watching the goals come true and cease to be (§4.4.1, steps 1 and 2)."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum, auto
from types import MappingProxyType
from typing import TypeVar

import numpy as np

from understudy.errors import LearningError
from understudy.learning.instants import micros
from understudy.learning.observations import SALIENT, Demonstration, History, Instance, Observed
from understudy.learning.pointing import pointed_at
from understudy.learning.settings import DISTANCE, LearningSettings
from understudy.network import Interval, ParameterValue
from understudy.robot.cues import Cue

__all__ = ["Observer"]

_KEPT = (*SALIENT, Cue.REPEAT, Cue.UNTIL)

Kind = TypeVar("Kind", bound=tuple[str, tuple[tuple[str, ParameterValue], ...]])
"""An :class:`Instance`, or the skills' own pair of behavior and discrete parameters."""


class Phase(Enum):
    WAITING = auto()
    WATCHING = auto()
    OVER = auto()


@dataclass(slots=True)
class Track:
    """An observation in the making. ``end_s`` is ``None`` as long as the goal is true."""

    instance: Instance
    start_s: float
    names: tuple[str, ...]
    end_s: float | None = None
    times: list[float] = field(default_factory=list)
    rows: list[tuple[float, ...]] = field(default_factory=list)
    closest_s: float | None = None
    closest_m: float = math.inf

    def see(self, time_s: float, values: Mapping[str, float]) -> None:
        row = tuple(float(value) for value in values.values())
        if tuple(values) != self.names or not all(map(math.isfinite, row)):
            expected = ", ".join(self.names) or "no values"
            raise LearningError(
                f"{self.instance} was evaluated to {dict(values)} at {time_s:g} s; each tick needs finite values for: "
                f"{expected}. Leave the instance out of `evaluated` when its goal cannot be evaluated"
            )
        self.end_s = None
        if not row:
            return
        self.times.append(time_s)
        self.rows.append(row)
        if (distance := values.get(DISTANCE, math.inf)) < self.closest_m:
            self.closest_s, self.closest_m = time_s, distance

    def observed(self, now_s: float) -> Observed:
        history = None
        if self.rows:
            history = History(names=self.names, times=np.array(self.times), values=np.array(self.rows))
        return Observed(
            instance=self.instance,
            interval=Interval(self.start_s, now_s if self.end_s is None else self.end_s),
            values=MappingProxyType(dict(zip(self.names, self.rows[-1], strict=True)) if self.rows else {}),
            closest_s=self.closest_s,
            closest_m=None if self.closest_s is None else self.closest_m,
            history=history,
        )


class Observer:
    """Watches one demonstration, tick by tick.

    Only what lies between START and DONE counts. A teacher's slip of the tongue never stops the robot: a word that
    cannot be meant (a second START, DONE too early) is ignored and noted. Saliency is decided afterwards, by
    :func:`~understudy.learning.select`, from the times of the words that are kept here. BAD takes back what the last
    word pointed at, one thing for each BAD, the farthest first: it does not belong to the task.

    Args:
        settings: ``merge_gap_s``, ``take_back_s``, ``begin`` and ``end`` matter here, and what words point at.
    """

    def __init__(self, settings: LearningSettings | None = None) -> None:
        self.settings = settings or LearningSettings()
        self._phase = Phase.WAITING
        self._begun_s = 0.0
        self._now_s = -math.inf
        self._tracks: list[Track] = []
        self._open: dict[Instance, Track] = {}
        self._latest: dict[Instance, Track] = {}
        self._cues: list[tuple[float, Cue]] = []
        self._taken_back: list[tuple[float, Cue, Instance]] = []
        self._notes: list[str] = []
        self._done = False

    @property
    def watching(self) -> bool:
        """Whether the demonstration is going on."""
        return self._phase is Phase.WATCHING

    @property
    def observations(self) -> tuple[Observed, ...]:
        """What was seen so far, in order of appearance; what is still true lasts until now."""
        return tuple(track.observed(self._now_s) for track in self._tracks)

    def step(self, time_s: float, evaluated: Mapping[Kind, Mapping[str, float]], cues: Iterable[Cue] = ()) -> None:
        """Take in one tick.

        Args:
            time_s: of the demonstration's clock; never less than at the step before.
            evaluated: the instances whose goal is true now, or can be evaluated now, each with the continuous
                parameter values which would make it true (``{}`` for goals without). All others are false.
            cues: the words heard since the last tick. At START's tick the goals count, at DONE's no more.

        Raises:
            LearningError: time runs backwards, or a goal's values are not finite or change their names.
        """
        if not (math.isfinite(time_s) and time_s >= self._now_s):
            raise LearningError(f"a tick at {time_s:g} s came after {self._now_s:g} s; give the ticks in order of time")
        if self._phase is not Phase.OVER:
            self._now_s = time_s
        for cue in cues:
            self._hear(time_s, cue)
        if self._phase is not Phase.WATCHING:
            return
        for instance in [instance for instance in self._open if instance not in evaluated]:
            self._open.pop(instance).end_s = time_s
        for kind, values in evaluated.items():
            instance = Instance._make(kind)
            track = self._open.get(instance) or self._begin(time_s, instance, values)
            track.see(time_s, values)

    def finish(self, time_s: float | None = None, *, name: str = "demonstration") -> Demonstration:
        """End the input, and hand over all that was observed.

        A demonstration that was cut short has no DONE. It counts up to ``time_s``, and a note says so.

        Args:
            time_s: when the input ended; by default, at the last step.
            name: of the demonstration.

        Raises:
            LearningError: START was never said, so nothing was demonstrated.
        """
        begin, end = self.settings.begin, self.settings.end
        if self._phase is Phase.WAITING:
            slip = f" {self._notes[0]}" if self._notes else ""
            raise LearningError(
                f"{name}: {begin} was never said, so nothing was demonstrated.{slip} "
                f"Say {begin}, lead the robot through the task, then say {end}"
            )
        if self._phase is Phase.WATCHING:
            if time_s is not None:
                self._now_s = max(self._now_s, time_s)
            self._notes.append(f"No {end}: the demonstration was cut short, and counts up to {self._now_s:.1f} s.")
            self._close_all()
        return Demonstration(
            name=name,
            span=Interval(self._begun_s, self._now_s),
            observations=self.observations,
            cues=tuple(self._cues),
            taken_back=tuple(self._taken_back),
            notes=tuple(self._notes),
            done=self._done,
        )

    def _hear(self, time_s: float, cue: Cue) -> None:
        begin, end = self.settings.begin, self.settings.end
        match cue, self._phase:
            case c, Phase.WAITING if c == begin:
                self._phase, self._begun_s = Phase.WATCHING, time_s
            case c, Phase.WATCHING if c == end:
                self._done = True
                self._close_all()
            case c, Phase.WATCHING if c in _KEPT:
                self._cues.append((time_s, c))
            case Cue.BAD, Phase.WATCHING:
                self._take_back(time_s)
            case c, Phase.WAITING if c == end:
                self._notes.append(f"{c} at {time_s:.1f} s came before {begin}; it was ignored.")
            case c, Phase.WATCHING if c == begin:
                self._notes.append(f"A second {c} at {time_s:.1f} s was ignored; the demonstration was going on.")
            case c, Phase.OVER if c == begin:
                self._notes.append(f"{c} at {time_s:.1f} s came after {end}; record it as a demonstration of its own.")
            case _:
                pass  # Words outside the demonstration, and those of practice, say nothing here.

    def pointed_at(self, time_s: float, cue: Cue) -> tuple[Observed, ...]:
        """What a word points at, as far as it was seen by now, the nearest first, without what was taken back."""
        things = pointed_at(time_s, self.observations, self.settings)
        return tuple(one for one in things if (time_s, cue, one.instance) not in self._taken_back)

    def _take_back(self, time_s: float) -> None:
        since = micros(time_s) - micros(self.settings.take_back_s)
        pointing = [word for word in self._cues if word[1] in SALIENT]
        recent = [word for word in pointing[-1:] if micros(word[0]) > since]
        things = [(*word, one.instance) for word in recent for one in self.pointed_at(*word)]
        if not things:
            self._notes.append(f"BAD at {time_s:.1f} s was ignored: there was nothing to take back.")
            return
        self._taken_back.append(things[-1])
        last_s, cue, instance = things[-1]
        self._notes.append(f"{instance} was taken back: {cue} at {last_s:.1f} s did not mean it.")

    def _begin(self, time_s: float, instance: Instance, values: Mapping[str, float]) -> Track:
        """A new observation, or the last one of its kind again when the gap was short (§4.4.1, ε)."""
        track = self._latest.get(instance)
        if (
            track is None
            or track.end_s is None
            or micros(time_s) - micros(track.end_s) > micros(self.settings.merge_gap_s)
        ):
            track = Track(instance, time_s, tuple(values))
            self._tracks.append(track)
        self._open[instance] = self._latest[instance] = track
        return track

    def _close_all(self) -> None:
        self._phase = Phase.OVER
        for track in self._open.values():
            track.end_s = self._now_s
        self._open.clear()
