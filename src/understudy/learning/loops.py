"""REPEAT … UNTIL in a demonstration: what is done again and again, and what ends it (§4.6).

What is shown between the two words is a round. It becomes a network in a component's place, which is begun anew after
each round (§3.6). UNTIL points at what ends the loop: of all that came to be so since REPEAT, and is so at that
word, the one that was observed last, unless HERE, TAKE or DROP made a step of it. A goal with numbers, such as
``Track``, can only be *evaluated* then (§4.3): that its target is perceived ends the loop. Any other has to hold.

The rest of the task is learned as if a round were one observation, from REPEAT to UNTIL, so Table 4.1 says what links
lead to the loop and on from it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from understudy.learning.construction import construct
from understudy.learning.instants import micros
from understudy.learning.observations import Demonstration, Instance, Observed
from understudy.learning.selection import Dropped, Selection, false_indication
from understudy.learning.settings import LearningSettings
from understudy.network import Component, Condition, Holds, Interval, Nab, Network, Possible, Repeat
from understudy.robot.cues import Cue

__all__ = ["Loop", "loops_of", "with_loops", "without_ends"]

_ROUND = "repeat"


@dataclass(frozen=True, slots=True, kw_only=True)
class Loop:
    """One REPEAT … UNTIL.

    Attributes:
        span: from the one word to the other.
        end: the observation at which UNTIL points.
    """

    span: Interval
    end: Observed

    @property
    def until(self) -> Condition:
        """What ends the loop, as execution asks it at the end of every round."""
        kind = Possible if self.end.values else Holds
        return kind(behavior=self.end.instance.behavior, parameters=dict(self.end.instance.parameters))

    def has(self, observed: Observed) -> bool:
        """Whether an observation belongs to the round: the robot was there in it, or its goal came true in it."""
        moment = observed.interval.start if observed.closest_s is None else observed.closest_s
        return micros(self.span.start) <= micros(moment) <= micros(self.span.end)


def loops_of(
    demonstration: Demonstration, selection: Selection, settings: LearningSettings
) -> tuple[tuple[Loop, ...], tuple[str, ...]]:
    """The loops that a demonstration shows; and, for the teacher, the words of which none could be made.

    Args:
        demonstration: with the words.
        selection: of its observations, each with the words that made it a step.
        settings: of the learner.
    """
    observed = [*selection.kept, *(one.observed for one in selection.dropped)]
    loops: list[Loop] = []
    notes: list[str] = []
    begun_s: float | None = None
    for time_s, cue in demonstration.cues:
        if cue is Cue.REPEAT and begun_s is None:
            begun_s = time_s
        elif cue is Cue.REPEAT:
            notes.append(
                f"A second REPEAT at {time_s:.1f} s was ignored: a loop within a loop cannot be shown. Say UNTIL first."
            )
        elif cue is Cue.UNTIL and begun_s is None:
            notes.append(f"UNTIL at {time_s:.1f} s was ignored, since no REPEAT came before it.")
        elif cue is Cue.UNTIL and begun_s is not None:
            span = Interval(begun_s, time_s)
            ends = [one for one in observed if _may_end(one, span, demonstration, settings)]
            if ends:
                loops.append(Loop(span=span, end=min(ends, key=lambda one: _lateness(one, time_s))))
            else:
                notes.append(
                    f"UNTIL at {time_s:.1f} s fell on nothing new: only steps had come to be so since REPEAT at "
                    f"{begun_s:.1f} s. Say UNTIL while the robot senses what ends it. What was shown is done once."
                )
            begun_s = None
    if begun_s is not None:
        notes.append(f"REPEAT at {begun_s:.1f} s had no UNTIL after it; what was shown is done once.")
    return tuple(loops), tuple(notes)


def _may_end(observed: Observed, span: Interval, demonstration: Demonstration, settings: LearningSettings) -> bool:
    """Whether it came to be so since REPEAT, is so at UNTIL, and was not made a step by any word."""
    grace = micros(settings.cue_grace_s)
    return (
        micros(span.start) < micros(observed.interval.start) <= micros(span.end) + grace
        and micros(observed.interval.end) + grace >= micros(span.end)
        and not any(span.start <= time_s <= span.end for time_s, _ in observed.cues)
        and not false_indication(observed, demonstration, settings)
    )


def _lateness(observed: Observed, said_s: float) -> tuple[bool, float]:
    """What was so already when UNTIL was said goes before what came a moment later; the nearest to the word first."""
    start = observed.interval.start
    return start > said_s, abs(said_s - start)


def without_ends(selection: Selection, loops: Sequence[Loop]) -> Selection:
    """A selection in which what ends a loop is no step of its round."""
    for loop in loops:
        mine = [one for one in selection.kept if _same(one, loop.end) and loop.has(one)]
        out = [*mine, *(one.observed for one in selection.dropped if _same(one.observed, loop.end))]
        reason = f"what ends the loop, by UNTIL at {loop.span.end:.1f} s"
        others = [one for one in selection.dropped if one.observed not in out]
        dropped = [*others, *(Dropped(observed=one, reason=reason) for one in out)]
        selection = replace(
            selection,
            kept=tuple(one for one in selection.kept if one not in mine),
            dropped=tuple(sorted(dropped, key=lambda one: one.observed.interval.start)),
        )
    return selection


def with_loops(
    observations: Sequence[Observed], loops: Sequence[Loop], *, demonstration: str, settings: LearningSettings
) -> tuple[Network, tuple[str, ...]]:
    """The network of a task with loops.

    Args:
        observations: all of which belong to the task, in order of appearance.
        loops: that were shown.
        demonstration: its name, for the evidence.
        settings: of the learner.

    Returns:
        The network; and, for the teacher, the loops in which nothing was shown.
    """
    bodies: dict[Interval, Network] = {}
    outside = list(observations)
    notes = []
    for loop in loops:
        body = [one for one in outside if loop.has(one)]
        if not body:
            notes.append(
                f"Nothing was shown between REPEAT at {loop.span.start:.1f} s and UNTIL at {loop.span.end:.1f} s, so "
                "there is no loop. Show one round of it between the words."
            )
            continue
        bodies[loop.span] = construct(body, demonstration=demonstration, settings=settings)
        outside = [one for one in outside if one not in body]
        outside.append(Observed(instance=Instance(_ROUND, ()), interval=loop.span))
    outside.sort(key=lambda one: one.interval.start)
    network = construct(outside, demonstration=demonstration, settings=settings)
    untils = {loop.span: loop.until for loop in loops}
    components = tuple(
        Nab.of(part.id, bodies[span], repeat=Repeat(until=untils[span]))
        if isinstance(part, Component) and (span := part.occurrences[0].interval) in bodies and part.behavior == _ROUND
        else part
        for part in network.components
    )
    return replace(network, components=components), tuple(notes)


def _same(one: Observed, other: Observed) -> bool:
    return one.instance == other.instance and one.interval == other.interval
