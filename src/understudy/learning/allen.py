"""How two observed intervals lie to each other, and what that says about a task (§4.4.2, Table 4.1)."""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

from understudy.clock import CONTROL_PERIOD_S
from understudy.learning.instants import micros
from understudy.network import Interval, LinkType

__all__ = ["HALF_A_TICK_S", "TABLE_4_1", "Relation", "relation"]

HALF_A_TICK_S = CONTROL_PERIOD_S / 2
"""Endpoints this close are one moment: the robot looks at the world once a tick (semantics §4)."""


class Relation(StrEnum):
    """The relation of A to B, A being the one that begins first (Figure 4.4)."""

    STARTS = "starts"
    """Both begin at one moment, and A ends first."""
    STARTED_BY = "started-by"
    """Both begin at one moment, and B ends first."""
    EQUALS = "equals"
    """Both begin at one moment and end at one moment."""
    BEFORE = "before"
    """A ends before B begins."""
    MEETS = "meets"
    """A ends at the moment at which B begins."""
    OVERLAPS = "overlaps"
    """B begins during A and outlasts it."""
    ENDS = "ends"
    """B begins during A, and both end at one moment."""
    INCLUDES = "includes"
    """B begins and ends during A."""


TABLE_4_1: Mapping[Relation, LinkType | None] = MappingProxyType(
    {
        Relation.BEFORE: LinkType.ORDERING,
        Relation.MEETS: LinkType.ENABLING,
        Relation.OVERLAPS: LinkType.ENABLING,
        Relation.STARTS: None,
        Relation.STARTED_BY: None,
        Relation.INCLUDES: LinkType.PERMANENT,
        Relation.ENDS: LinkType.PERMANENT,
        Relation.EQUALS: None,
    }
)
"""The link from A to B. The table wins over the pseudo-code of §4.4.1, which differs in three rows (semantics §4)."""


def relation(a: Interval, b: Interval, tolerance: float = HALF_A_TICK_S) -> Relation:
    """The one relation of ``a`` to ``b`` (Figure 4.4).

    There is always exactly one, also with a tolerance and for intervals of no length: the onsets are compared first,
    then a's end with b's onset, then the ends.

    Args:
        a: the interval with the earlier onset; within the tolerance of ``b``'s onset either may come first.
        b: the other interval.
        tolerance: endpoints that differ by no more than this, in seconds, are one moment.

    Raises:
        ValueError: ``a`` begins after ``b``, by more than the tolerance.
    """
    slack = micros(tolerance)
    a_start, a_end, b_start, b_end = (micros(moment) for moment in (*a, *b))
    if a_start - b_start > slack:
        raise ValueError(f"a begins at {a.start:g} s, after b at {b.start:g} s; give the earlier one first")
    ends_differ = abs(b_end - a_end) > slack
    if b_start - a_start <= slack:
        if not ends_differ:
            return Relation.EQUALS
        return Relation.STARTS if a_end < b_end else Relation.STARTED_BY
    if b_start - a_end > slack:
        return Relation.BEFORE
    if a_end - b_start <= slack:
        return Relation.MEETS
    if not ends_differ:
        return Relation.ENDS
    return Relation.OVERLAPS if a_end < b_end else Relation.INCLUDES
