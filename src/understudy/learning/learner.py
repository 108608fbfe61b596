"""The one door to learning: a demonstration goes in, a lesson comes out (§4.4)."""

from collections.abc import Iterator
from dataclasses import dataclass

from understudy.errors import LearningError
from understudy.learning.loops import loops_of, with_loops, without_ends
from understudy.learning.observations import Demonstration, Observed
from understudy.learning.selection import Dropped, Selection, select
from understudy.learning.settings import LearningSettings
from understudy.network import Network

__all__ = ["Lesson", "learn"]

REASONS_SHOWN = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class Lesson:
    """What was learned from one demonstration, and what was made of everything that was seen.

    Attributes:
        demonstration: its name.
        network: the task, without ordering links that others imply.
        kept: the observations it was made from, in order of appearance.
        dropped: those that were left out, each with its reason.
        notes: what the teacher should know: words that were ignored, words that fell on nothing.
    """

    demonstration: str
    network: Network
    kept: tuple[Observed, ...]
    dropped: tuple[Dropped, ...]
    notes: tuple[str, ...]


def learn(demonstration: Demonstration, settings: LearningSettings | None = None) -> Lesson:
    """Learn a task from one demonstration.

    Args:
        demonstration: from :meth:`Observer.finish`, or from a document of intervals.
        settings: of the learner.

    Raises:
        LearningError: nothing was observed, or nothing is left of it; the message says what to do.
    """
    settings = settings or LearningSettings()
    if not demonstration.observations:
        raise LearningError(
            f"{demonstration.name}: no skill's goal came true in the {demonstration.span.duration:.1f} s from "
            f"{settings.begin} to {settings.end}. Lead the robot close to the targets, and stay there for at least "
            f"{settings.min_duration_s:g} s"
        )
    selection = select(demonstration, settings)
    loops, slips = loops_of(demonstration, selection, settings)
    selection = without_ends(selection, loops)
    if not selection.kept:
        raise LearningError(_nothing_left(demonstration, selection))
    network, empty = with_loops(selection.kept, loops, demonstration=demonstration.name, settings=settings)
    return Lesson(
        demonstration=demonstration.name,
        network=network,
        kept=selection.kept,
        dropped=selection.dropped,
        notes=(
            *demonstration.notes,
            *slips,
            *empty,
            *_words_without_effect(demonstration, selection, settings),
            *(f"{cue} at {time:.1f} s fell on nothing that was kept." for time, cue in selection.unused_cues),
        ),
    )


def _words_without_effect(
    demonstration: Demonstration, selection: Selection, settings: LearningSettings
) -> Iterator[str]:
    """TAKE and DROP that brought nothing about: the teacher believes that a step was shown, and it was not."""
    for time_s, cue in demonstration.cues:
        behaviors = settings.cue_effects.get(cue, frozenset())
        if behaviors and not any(
            observed.instance.behavior in behaviors
            and (time_s, cue) in observed.cues
            and observed.interval.start >= time_s
            for observed in selection.kept
        ):
            yield f"{cue} was said at {time_s:.1f} s, but no {' or '.join(sorted(behaviors))} came of it."


def _nothing_left(demonstration: Demonstration, selection: Selection) -> str:
    reasons = [f"{item.observed.instance}: {item.reason}" for item in selection.dropped[:REASONS_SHOWN]]
    if len(selection.dropped) > REASONS_SHOWN:
        reasons.append("…")
    return (
        f"{demonstration.name}: every observation was left out, and nothing remains to learn ({'; '.join(reasons)}). "
        + (
            "Let the cues fall on the steps that matter, or leave them out"
            if demonstration.annotated
            else "Stay close to each target for a while, and say HERE while the robot is there"
        )
    )
