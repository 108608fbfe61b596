"""Which observations belong to the task (§4.4.1, step 3; semantics §4).

In this order, and the first reason that applies is the one reported:

1. *False indications.* Shorter than ``min_duration_s``, or last seen farther away than ``max_distance_m``. Intervals
   that somebody annotated are no sensor readings: here they all pass. So does what the robot itself did at TAKE or
   DROP (``cue_effects``): a teacher who says DONE as soon as the box is down meant the dropping none the less.
2. *Conditions that never changed*, when ``keep_unchanging`` is off. Annotated intervals pass here, too.
3. *Saliency*, when the teacher said HERE, TAKE or DROP at all (``heed_cues``). An observation is salient when

   * one of these words falls into its interval, by ``cue_grace_s`` at most before or after it. Whatever the word:
     TAKE and DROP say "relevant" as well as what to do, so the target beside the box is salient, too. What has values,
     and so a place, must be what the word points at (:mod:`~understudy.learning.pointing`), and the teacher must not
     have taken it back (BAD); or
   * its goal is what the word brings about (``cue_effects``): TAKE comes before the robot holds the box, so the first
     words of a ``PickUp`` lie before its interval. It counts when it came no more than ``cue_delay_s`` before the onset
     and was the last of its kind to come before it. The same for DROP and ``Drop``; or
   * it is the situation from which the task starts (``standing``): the gripper was empty at START. Nobody points at
     that, and the words must not decide whether it is learned: HERE said a moment before or after the box was gripped
     would make the difference. It costs nothing to keep: a robot that starts with an empty gripper has achieved it,
     and one that holds something drops it first (§4.5.4.3).
"""

from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from understudy.learning.instants import micros
from understudy.learning.observations import Demonstration, Observed
from understudy.learning.pointing import falls_on, pointed_at, seen_too_far_off
from understudy.learning.settings import DISTANCE, LearningSettings
from understudy.robot.cues import Cue

__all__ = ["Dropped", "Selection", "false_indication", "select"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Dropped:
    """An observation that was left out, and why: ``seen for 0.8 s only``."""

    observed: Observed
    reason: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Selection:
    """The outcome of :func:`select`, both in order of appearance.

    Attributes:
        kept: with the words that make them salient.
        dropped: with reasons.
        unused_cues: words that fell on nothing which was kept.
    """

    kept: tuple[Observed, ...]
    dropped: tuple[Dropped, ...]
    unused_cues: tuple[tuple[float, Cue], ...]


def select(demonstration: Demonstration, settings: LearningSettings) -> Selection:
    """Tell the observations that belong to the task from those that do not; the rules are those of this module."""
    kept: list[Observed] = []
    dropped: list[Dropped] = []
    seen = [one for one in demonstration.observations if not _too_short(one, settings)]
    pointing = {word: pointed_at(word[0], seen, settings) for word in demonstration.pointing}
    for bare in demonstration.observations:
        observed = replace(bare, cues=_words_on(bare, demonstration, settings, pointing))
        reason = _reason_against(observed, demonstration, settings)
        if reason:
            dropped.append(Dropped(observed=observed, reason=reason))
        else:
            kept.append(observed)
    used = {cue for observed in kept for cue in observed.cues}
    taken_back = {(time, cue) for time, cue, _ in demonstration.taken_back}
    unused = tuple(cue for cue in demonstration.pointing if cue not in used | taken_back)
    return Selection(kept=tuple(kept), dropped=tuple(dropped), unused_cues=unused)


def _reason_against(observed: Observed, demonstration: Demonstration, settings: LearningSettings) -> str:
    """Why the observation is left out; empty if it is not."""
    if false := false_indication(observed, demonstration, settings):
        return false
    interval, span = observed.interval, demonstration.span
    begun_at_start = micros(interval.start) - micros(span.start) <= micros(settings.tolerance_s)
    lasted_to_the_end = micros(span.end) - micros(interval.end) <= micros(settings.tolerance_s)
    unchanging = not observed.values and begun_at_start and lasted_to_the_end and not demonstration.annotated
    if unchanging and not settings.keep_unchanging:
        return "true from the beginning to the end"
    if settings.heed_cues and demonstration.pointing and not observed.cues:
        standing = observed.instance.behavior in settings.standing and begun_at_start and not demonstration.annotated
        if not standing:
            return "no cue while it was true"
    return ""


def _too_short(observed: Observed, settings: LearningSettings) -> bool:
    return micros(observed.interval.end) - micros(observed.interval.start) < micros(settings.min_duration_s)


def false_indication(observed: Observed, demonstration: Demonstration, settings: LearningSettings) -> str:
    """Why the observation is taken for noise (§4.4.1); empty if it is not."""
    if demonstration.annotated:
        return ""
    interval = observed.interval
    done_at_a_word = any(
        observed.instance.behavior in settings.cue_effects.get(cue, ()) and time <= interval.start
        for time, cue in observed.cues
    )
    if _too_short(observed, settings) and not done_at_a_word:
        return f"seen for {interval.duration:.1f} s only (at least {settings.min_duration_s:g} s)"
    if seen_too_far_off(observed, settings):
        return f"{observed.values[DISTANCE]:.1f} m away (at most {settings.max_distance_m:g} m)"
    return ""


def _words_on(
    observed: Observed,
    demonstration: Demonstration,
    settings: LearningSettings,
    pointing: Mapping[tuple[float, Cue], Sequence[Observed]],
) -> tuple[tuple[float, Cue], ...]:
    """The words that make the observation salient, in the order of time."""
    start = micros(observed.interval.start)
    if observed.values and not demonstration.annotated:
        meant = (word for word, things in pointing.items() if any(one is observed for one in things))
        found = {word for word in meant if (*word, observed.instance) not in demonstration.taken_back}
    else:
        found = {(time, cue) for time, cue in demonstration.pointing if falls_on(time, observed.interval, settings)}
    for cue, behaviors in settings.cue_effects.items():
        if observed.instance.behavior in behaviors:
            said = sorted(time for time, word in demonstration.pointing if word == cue)
            last = bisect_right(said, start, key=micros) - 1
            if last >= 0 and start - micros(said[last]) <= micros(settings.cue_delay_s):
                found.add((said[last], cue))
    return tuple(sorted(found))
