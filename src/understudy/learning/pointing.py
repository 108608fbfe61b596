"""What a word of the teacher's points at (§4.2): the things that the robot had before it then."""

from collections.abc import Iterable, Sequence

import numpy as np

from understudy.learning.instants import micros
from understudy.learning.observations import Observed
from understudy.learning.settings import DISTANCE, LearningSettings
from understudy.network import Interval

__all__ = ["falls_on", "pointed_at", "seen_too_far_off"]


def falls_on(time_s: float, interval: Interval, settings: LearningSettings) -> bool:
    """Whether a word falls into an interval, or at most ``cue_grace_s`` before or after it."""
    start, end = (micros(moment) for moment in interval)
    grace = micros(settings.cue_grace_s)
    return start - grace <= micros(time_s) <= end + grace


def seen_too_far_off(observed: Observed, settings: LearningSettings) -> bool:
    """Whether what was observed was last seen farther away than what was visited."""
    return observed.values.get(DISTANCE, 0.0) > settings.max_distance_m


def pointed_at(time_s: float, observations: Iterable[Observed], settings: LearningSettings) -> Sequence[Observed]:
    """The things that a word points at, the nearest at that moment first.

    People speak late rather than early, but what was before the robot a moment ago is not meant if something is before
    it now. So a word points at all that is observed when it falls, or comes into view within ``cue_grace_s``; if there
    is nothing of that, at what was observed within ``cue_grace_s`` before.

    Args:
        time_s: of the word.
        observations: of which those with values are things that one can point at.
        settings: of the learner.
    """
    near = [
        one
        for one in observations
        if one.values and falls_on(time_s, one.interval, settings) and not seen_too_far_off(one, settings)
    ]
    now = [one for one in near if micros(time_s) <= micros(one.interval.end)]
    return sorted(now or near, key=lambda one: _distance_at(time_s, one))


def _distance_at(time_s: float, observed: Observed) -> float:
    """How far away it was at a moment, or at the nearest one at which it was observed."""
    history = observed.history
    if history is None or DISTANCE not in history.names:
        return observed.values.get(DISTANCE, 0.0)
    index = min(int(np.searchsorted(history.times, time_s)), len(history.times) - 1)
    return float(history.values[index, history.names.index(DISTANCE)])
