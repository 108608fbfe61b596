"""What the robot says aloud while it is taught, so that the teacher can help it (A.5, A.6).

The teacher does not see what the robot sees. So it tells what it took note of at each word, when HERE fell on nothing,
when there was no box to take, when it has lost its teacher; and it asks about what it passed closely without a word.
All of it rests on what it senses.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from typing import Any

from understudy.learning.observations import Instance
from understudy.learning.observer import Observer
from understudy.learning.settings import LearningSettings
from understudy.robot.cues import Cue

__all__ = ["Remarks"]

_POINTING = (Cue.HERE, Cue.TAKE, Cue.DROP)

_LOST_S = 2.0
"""So long without sight of the teacher, and the robot has lost it: a person who passes behind a target is hidden for
less."""

_CLOSE_BY_M = 1.0
"""Nearer than this, the robot has passed a thing as closely as if it had been led there."""

_GONE_S = 0.3
"""So long out of sight, and it has been passed; shorter, and the senses have only missed it."""

_AGAIN_S = 10.0
"""After so long it says so again."""


class Remarks:
    """Makes remarks of what happens in a demonstration: events of the kind ``remark``.

    Such an event has the sentence in ``what``, and in ``about`` one of these:

    * ``lost``: the robot does not see its teacher;
    * ``noted``: at a word it took note of the things ``noted``, named by their colors, the nearest first;
    * ``nothing``: there was nothing to take note of at HERE;
    * ``passed``: it went close by the thing ``noted``, and no word pointed at it;
    * ``missed``: it did not pick up a box at TAKE.

    Those about a word have it in ``cue``. A word may come a little before what it points at, so the robot waits
    ``cue_grace_s`` before it answers. ``BAD`` takes back what was named last (:class:`~understudy.learning.Observer`).

    Args:
        settings: of the learner, by which the words will be read.
    """

    def __init__(self, settings: LearningSettings | None = None) -> None:
        self._settings = settings or LearningSettings()
        self._words: list[tuple[float, Cue]] = []
        self._noted: dict[Instance, float] = {}  # when each kind of thing was last taken note of
        self._unseen: dict[Instance, float] = {}  # since when things are out of sight that were in it
        self._evaluated: Set[Instance] = frozenset()
        self._seen_s: float | None = None
        self._lost_s: float | None = None

    def step(
        self,
        time_s: float,
        observer: Observer,
        evaluated: Iterable[Instance],
        cues: Iterable[Cue],
        *,
        looking: bool,
        in_view: bool,
        news: Sequence[Mapping[str, Any]] = (),
    ) -> list[dict[str, Any]]:
        """The remarks of one tick.

        Args:
            time_s: of the tick.
            observer: of the demonstration; it has taken in this tick.
            evaluated: what it could evaluate.
            cues: heard in it.
            looking: the robot follows its teacher, and so looks for it.
            in_view: it sees the teacher.
            news: what else happened: the events of the :class:`~understudy.learning.Apprentice`.
        """
        if not observer.watching:
            return []
        said = [_remark(time_s, "missed", sentence, cue=Cue.TAKE.value) for sentence in _of_boxes(news)]
        if self._has_lost_teacher(time_s, looking=looking, in_view=in_view):
            said.append(_remark(time_s, "lost", "I have lost you"))
        self._words += [(time_s, cue) for cue in cues if cue in _POINTING]
        while self._words and time_s - self._words[0][0] >= self._settings.cue_grace_s - 1e-9:
            said += self._answer(time_s, *self._words.pop(0), observer)
        said += self._passed(time_s, observer, frozenset(map(Instance._make, evaluated)))
        return said

    def _has_lost_teacher(self, time_s: float, *, looking: bool, in_view: bool) -> bool:
        """Whether that is to be said now."""
        if in_view or not looking or self._seen_s is None:
            self._seen_s, self._lost_s = time_s, None
        last_s = self._lost_s if self._lost_s is not None else self._seen_s + _LOST_S - _AGAIN_S
        if time_s - last_s < _AGAIN_S - 1e-9:
            return False
        self._lost_s = time_s
        return True

    def _answer(self, time_s: float, said_s: float, cue: Cue, observer: Observer) -> list[dict[str, Any]]:
        """What is said of a word once all has been seen that it may have pointed at."""
        things = observer.pointed_at(said_s, cue)
        self._noted.update((one.instance, said_s) for one in things)
        if things:
            named = list(dict.fromkeys(_named(one.instance) for one in things))
            return [_remark(time_s, "noted", f"{cue}: I took note of {', '.join(named)}", cue=cue.value, noted=named)]
        if cue is Cue.HERE:
            return [_remark(time_s, "nothing", "HERE: I saw nothing to take note of", cue=cue.value)]
        return []

    def _passed(self, time_s: float, observer: Observer, evaluated: Set[Instance]) -> list[dict[str, Any]]:
        """What is asked about things that have just gone out of sight."""
        self._unseen.update((instance, time_s) for instance in self._evaluated - evaluated)
        self._evaluated = evaluated
        gone = [one for one, since_s in self._unseen.items() if time_s - since_s >= _GONE_S - 1e-9]
        self._unseen = {one: since for one, since in self._unseen.items() if one not in evaluated and one not in gone}
        asked = []
        for instance in gone:
            if instance in evaluated:
                continue
            seen = [one for one in observer.observations if one.instance == instance][-1]
            ignored = self._noted.get(instance, -math.inf) < seen.interval.start - self._settings.cue_grace_s
            long_enough = seen.interval.duration >= self._settings.min_duration_s
            if ignored and long_enough and seen.closest_m is not None and seen.closest_m <= _CLOSE_BY_M:
                name = _named(instance)
                asked.append(_remark(time_s, "passed", f"Does {name} belong to it? Then say HERE", noted=[name]))
        return asked


def _remark(time_s: float, about: str, what: str, **details: Any) -> dict[str, Any]:
    return {"time_s": time_s, "kind": "remark", "about": about, "what": what, **details}


def _of_boxes(news: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """What is to be said of an errand that brought no box."""
    for event in news:
        if event["kind"] == "missed":
            yield "TAKE: I see no box"
        elif event["kind"] == "errand-failed" and event["skill"] == "PickUp":
            yield "TAKE: I could not pick up the box"


def _named(instance: Instance) -> str:
    """A thing as one speaks of it: by its color."""
    return ", ".join(str(value) for _, value in instance.parameters) or instance.behavior
