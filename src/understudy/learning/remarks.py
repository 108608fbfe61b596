"""What the robot says aloud while it is taught, so that the teacher can help it (A.5, A.6).

The teacher does not see what the robot sees. So it tells what it took note of at each word, when HERE fell on nothing,
when there was no box to take, and when it has lost its teacher. All of it rests on what it senses.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from understudy.learning.observations import Instance, Observed
from understudy.learning.observer import Observer
from understudy.learning.selection import falls_on, seen_too_far_off
from understudy.learning.settings import LearningSettings
from understudy.robot.cues import Cue

__all__ = ["Remarks"]

_POINTING = (Cue.HERE, Cue.TAKE, Cue.DROP)

_LOST_S = 2.0
"""So long without sight of the teacher, and the robot has lost it: a person who passes behind a target is hidden for
less."""

_AGAIN_S = 10.0
"""After so long it says so again."""


class Remarks:
    """Makes remarks of what happens in a demonstration: events of the kind ``remark``.

    Such an event has the sentence in ``what``, and in ``about`` one of these:

    * ``lost``: the robot does not see its teacher;
    * ``noted``: at a word it took note of the things ``noted``, named by their colors;
    * ``nothing``: there was nothing to take note of at HERE but what an earlier word had pointed at;
    * ``missed``: it did not pick up a box at TAKE.

    All but the first have the word in ``cue``. A word may come a little before what it points at, so the robot waits
    ``cue_grace_s`` before it answers.

    Args:
        settings: of the learner, by which the words will be read.
    """

    def __init__(self, settings: LearningSettings | None = None) -> None:
        self._settings = settings or LearningSettings()
        self._words: list[tuple[float, Cue]] = []
        self._noted: set[tuple[Instance, float]] = set()
        self._seen_s: float | None = None
        self._lost_s: float | None = None

    def step(
        self,
        time_s: float,
        observer: Observer,
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
            said += self._answer(time_s, *self._words.pop(0), observer.observations)
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

    def _answer(self, time_s: float, said_s: float, cue: Cue, observations: Sequence[Observed]) -> list[dict[str, Any]]:
        """What is said of a word once all has been seen that it may have pointed at."""
        settings = self._settings
        pointed = [
            one
            for one in observations
            if one.values and falls_on(said_s, one.interval, settings) and not seen_too_far_off(one, settings)
        ]
        things = [one for one in pointed if (one.instance, one.interval.start) not in self._noted]
        self._noted |= {(one.instance, one.interval.start) for one in things}
        if things:
            named = list(dict.fromkeys(_named(one.instance) for one in things))
            return [_remark(time_s, "noted", f"{cue}: I took note of {', '.join(named)}", cue=cue.value, noted=named)]
        if cue is Cue.HERE:
            return [_remark(time_s, "nothing", "HERE: I saw nothing to take note of", cue=cue.value)]
        return []


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
