"""The off-line part of learning: from observations to the task's network (§4.4.1, step 4; Table 4.1).

Every link enforces the order in which its ends were observed (§4.4.2). Ordering links that a path of others implies are
not stored; :func:`~understudy.network.expand_links` brings them back.

Where the observations are ordered by closest approach, a pair may come in one order by that and in the other by
onset: the far target, in view first, was visited last. Table 4.1 says nothing about it, since its A is the one with the
earlier onset. It gets an ordering link. That is all the demonstration shows, and it is safe: nothing is asked of the
first goal but to have been achieved. So also when both were in view from one moment on, which is just where the setting
helps. Only approaches at one moment leave a pair unlinked, as equal onsets do in the table.
"""

import math
from collections.abc import Sequence
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from understudy.learning.allen import TABLE_4_1
from understudy.learning.instants import micros, micros_array
from understudy.learning.maintenance import departure
from understudy.learning.observations import Observed
from understudy.learning.pairs import RELATIONS, linked_pairs
from understudy.learning.settings import LearningSettings
from understudy.network import Component, Link, LinkEvidence, LinkType, Network, Occurrence
from understudy.network.naming import component_ids

__all__ = ["construct"]

DECIMALS = 3
"""Learned parameters are rounded to the millimetre and the thousandth of a degree, far below what the sensors tell
apart, so that documents can be read. Occurrences keep the exact values."""

# Looked up once for each link of what may be half a million, where hashing an enum's member is felt.
TABLE_BY_CODE = tuple(TABLE_4_1[relation] for relation in RELATIONS)
NAME_BY_CODE = tuple(relation.value for relation in RELATIONS)


def construct(
    observations: Sequence[Observed], *, demonstration: str, settings: LearningSettings | None = None
) -> Network:
    """The network of a task from what was observed in one demonstration.

    Args:
        observations: all of which belong to the task, in order of appearance, which settles ties.
        demonstration: its name, for the evidence.
        settings: ``order``, ``tolerance_s`` and ``value_tolerances`` matter here.
    """
    settings = settings or LearningSettings()
    ordered = sorted(observations, key=lambda observed: micros(_moment(observed, settings)))
    ids = component_ids(observed.instance for observed in ordered)
    components = tuple(_component(id_, observed, demonstration) for id_, observed in zip(ids, ordered, strict=True))
    return Network(components=components, links=_links(ids, ordered, demonstration, settings))


def _moment(observed: Observed, settings: LearningSettings) -> float:
    """What orders the observations. A goal without a distance has no closest approach; its onset stands for it."""
    if settings.order == "closest" and observed.closest_s is not None:
        return observed.closest_s
    return observed.interval.start


def _component(id_: str, observed: Observed, demonstration: str) -> Component:
    learned = {name: round(value, DECIMALS) for name, value in observed.values.items()}
    return Component(
        id=id_,
        behavior=observed.instance.behavior,
        parameters=MappingProxyType({**dict(observed.instance.parameters), **learned}),
        occurrences=(
            Occurrence(
                demonstration=demonstration,
                interval=observed.interval,
                values=observed.values,
                cues=tuple((time, str(cue)) for time, cue in observed.cues),
                closest_s=observed.closest_s,
            ),
        ),
    )


def _links(
    ids: Sequence[str], ordered: Sequence[Observed], demonstration: str, settings: LearningSettings
) -> tuple[Link, ...]:
    moments, tolerance = micros_array(_moment(observed, settings) for observed in ordered), micros(settings.tolerance_s)
    pairs = linked_pairs(
        micros_array(observed.interval.start for observed in ordered),
        micros_array(observed.interval.end for observed in ordered),
        moments,
        tolerance,
    )
    columns = (pairs.source, pairs.target, pairs.relation, pairs.reversed, pairs.implied)
    last_achieved = _last_achieved_before(ordered, moments, tolerance)
    links = []
    for i, j, code, is_reversed, implied in zip(*(column.tolist() for column in columns), strict=True):
        source, target = ordered[i], ordered[j]
        type_, note = TABLE_BY_CODE[code], ""
        if is_reversed:
            type_, note = LinkType.ORDERING, _note_on_reversal(source, target, settings)
        elif type_ is LinkType.PERMANENT and source.history is not None:
            strayed = departure(source, target.interval, settings.value_tolerances)
            if strayed:
                type_, note = LinkType.ORDERING, f"not held all the while, so only the order is kept (§4.3): {strayed}"
        elif type_ is LinkType.ENABLING and source.history is not None and last_achieved[j] != i:
            type_ = LinkType.ORDERING
            note = f"{ids[last_achieved[j]]} was achieved after it, so that it need not hold any more (§3.3.1)"
        # A link that became an ordering link only here may be implied, too: linked_pairs knows nothing but intervals.
        if type_ is None or (implied and type_ is LinkType.ORDERING):
            continue
        evidence = LinkEvidence(
            demonstration=demonstration,
            source=source.interval,
            target=target.interval,
            relation=NAME_BY_CODE[code],
            note=note,
        )
        links.append(Link(source=ids[i], target=ids[j], type=type_, evidence=(evidence,)))
    return tuple(links)


def _last_achieved_before(ordered: Sequence[Observed], moments: NDArray[np.int64], tolerance: int) -> list[int]:
    """For every observation, which of its predecessors was achieved last; -1 where there is none.

    A goal with parameters is achieved at the end of its interval (§4.3), any other one at the beginning. An enabling
    precondition holds *immediately before* its successor becomes active (§3.3.1), which is when the last of the
    predecessors is achieved. For a goal such as "the pole is at my left" that can be asked of that last one only: asked
    of two poles at once, it would send the robot back and forth between two places for ever.
    """
    last_of_first: list[int] = [-1]
    latest = -math.inf
    for index, observed in enumerate(ordered):
        achieved = observed.interval.start if observed.history is None else observed.interval.end
        last = index if achieved >= latest else last_of_first[-1]
        latest = max(latest, achieved)
        last_of_first.append(last)
    # The predecessors are the first so many (learning.pairs says why).
    counts = np.searchsorted(moments, moments - tolerance, side="left").tolist()
    return [last_of_first[count] for count in counts]


def _note_on_reversal(source: Observed, target: Observed, settings: LearningSettings) -> str:
    first, second = _moment(source, settings), _moment(target, settings)
    return (
        f"closest approach at {first:.1f} s, then {second:.1f} s, while the onsets, {source.interval.start:.1f} s and "
        f"{target.interval.start:.1f} s, do not come in that order; so only the order is kept"
    )
