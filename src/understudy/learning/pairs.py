"""Which pairs of observations are linked in the network that is stored: one sweep, no quadratic work (§4.4.1, step 4).

Compare every observation with every later one, as §4.4.1 says, and 10,000 of them make 50 million links, nearly all of
them ordering links that a path of others implies. Only the rest is enumerated here. Two facts make that simple. Let
``m`` be the moments that order the observations (their onsets, by default), and ``i`` come before ``j``.

*A pair is linked exactly if* ``m[j] - m[i] > slack``. With onsets that is Table 4.1: all its rows but those with equal
onsets give a link.

*So linked pairs are transitive*: if ``m[k] - m[i] > slack`` and ``m[j] - m[k] > slack``, then ``m[j] - m[i] > slack``.
An ordering link from i to j is therefore implied by a path exactly if one step k lies between them. If any does, the
last predecessor of j does, for none has a later moment. The predecessors of j are the first ``count[j]`` observations;
the last one is ``k = count[j] - 1``, its own are the first ``count[k]``. Hence no path leads from i to j exactly if
``count[k] <= i < count[j]``: the *window* of j. Outside of it only those pairs matter which are more than ordered, and
these overlap or meet: for every i they are one run of j's in the order of onset.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from understudy.learning.allen import Relation

__all__ = ["RELATIONS", "Pairs", "linked_pairs"]

RELATIONS = tuple(Relation)
"""The relations by their codes in :class:`Pairs`."""

Indices = NDArray[np.intp]
Micros = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Pairs:
    """Linked pairs of observations, sorted by source, then target. All arrays have the shape ``(pairs,)``.

    Attributes:
        source: index of the earlier observation.
        target: index of the later observation.
        relation: code of Allen's relation, an index of :data:`RELATIONS`; of the target to the source where reversed.
        reversed: the source comes first by ``moment``, but not by onset.
        implied: a path of other links leads from source to target, too, so that an ordering link would say nothing.
    """

    source: Indices
    target: Indices
    relation: NDArray[np.int8]
    reversed: NDArray[np.bool_]
    implied: NDArray[np.bool_]


def linked_pairs(start: Micros, end: Micros, moment: Micros, slack: int) -> Pairs:
    """All linked pairs, save those which are merely ordered while a path implies it.

    Time and memory grow with n log n and with the number of pairs returned. That number is what the network has to
    hold: an interval that includes a thousand others is a condition on a thousand of them.

    Args:
        start: onsets in microseconds.
        end: ends in microseconds, none before its onset.
        moment: what orders the observations, in microseconds, ascending; each within its interval.
        slack: the tolerance in microseconds.
    """
    count = np.searchsorted(moment, moment - slack, side="left")
    window_begins = np.where(count > 0, count[count - 1], 0)
    window_source, target_of_window = _runs(window_begins, count)

    onset = np.argsort(start, kind="stable")
    start_by_onset = start[onset]
    after_onset = np.searchsorted(start_by_onset, start + slack, side="right")
    after_end = np.searchsorted(start_by_onset, end + slack, side="right")
    during, overlap_source = _runs(after_onset, np.maximum(after_onset, after_end))
    overlap_target = onset[during]
    linked = moment[overlap_target] - moment[overlap_source] > slack

    # One number for each pair sorts them and takes out those that were found both ways.
    key = np.concatenate(
        (
            window_source * len(start) + target_of_window,
            overlap_source[linked] * len(start) + overlap_target[linked],
        )
    )
    source, target = np.divmod(np.unique(key), max(len(start), 1))
    swapped = start[target] - start[source] <= slack
    first = np.where(swapped & (start[target] < start[source]), target, source)
    second = source + target - first
    return Pairs(
        source=source,
        target=target,
        relation=relation_codes(start[first], end[first], start[second], end[second], slack),
        reversed=swapped,
        implied=source < window_begins[target],
    )


def relation_codes(a_start: Micros, a_end: Micros, b_start: Micros, b_end: Micros, slack: int) -> NDArray[np.int8]:
    """:func:`~understudy.learning.allen.relation` of many pairs, as indices of :data:`RELATIONS`."""
    together = b_start - a_start <= slack
    end_together = np.abs(b_end - a_end) <= slack
    a_ends_first = a_end < b_end
    cases = {
        Relation.EQUALS: together & end_together,
        Relation.STARTS: together & a_ends_first,
        Relation.STARTED_BY: together,
        Relation.BEFORE: b_start - a_end > slack,
        Relation.MEETS: a_end - b_start <= slack,
        Relation.ENDS: end_together,
        Relation.OVERLAPS: a_ends_first,
    }
    codes = [np.int8(RELATIONS.index(case)) for case in cases]
    return np.select(list(cases.values()), codes, default=np.int8(RELATIONS.index(Relation.INCLUDES)))


def _runs(begin: Indices, stop: Indices) -> tuple[Indices, Indices]:
    """All ``(index, row)`` with ``begin[row] <= index < stop[row]``."""
    length = stop - begin
    row = np.repeat(np.arange(len(begin)), length)
    before_row = np.cumsum(length) - length
    index = np.arange(len(row)) - before_row[row] + begin[row]
    return index, row
