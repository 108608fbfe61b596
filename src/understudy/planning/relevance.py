"""What of a domain matters for a goal.

A room with eight boxes and eight targets has more states than any planner can look at, and a planner that looks for a
plan where there is none looks at all of them. Most of them differ in what nobody asks for. So until nothing changes:

1. A fact that neither the goal nor any operator needs is forgotten.
2. An operator that gives nothing any more is left out.
3. So is one for which another can stand in: that needs no more, gives no less, and ends no more.

What is left has a plan if, and only if, the whole has one: no step is lost but those for which another can stand in,
and since nothing needs a fact *not* to be so, no step is the worse for what more is so before it.
"""

from collections.abc import Iterable
from dataclasses import replace

from understudy.behaviors import Fact
from understudy.planning.domain import Operator

__all__ = ["relevant"]


def relevant(operators: Iterable[Operator], goal: Iterable[Fact]) -> tuple[Operator, ...]:
    """The operators that matter for a goal, in their order, with nothing in them that does not matter."""
    goal, kept = frozenset(goal), tuple(operators)
    while True:
        useful = goal.union(*(one.needs for one in kept))
        known: list[Operator] = []
        for one in kept:
            if one.gives & useful:
                known.append(replace(one, gives=one.gives & useful, ends=one.ends & useful))
        left = tuple(
            one
            for number, one in enumerate(known)
            if not any(_stands_in(other, one, first=index < number) for index, other in enumerate(known))
        )
        if left == kept:
            return kept
        kept = left


def _stands_in(other: Operator, one: Operator, *, first: bool) -> bool:
    """Whether one operator can be done in the place of another; of two that are alike, the first."""
    alike = other.needs == one.needs and other.gives == one.gives and other.ends == one.ends
    if alike:
        return first
    return other.needs <= one.needs and other.gives >= one.gives and other.ends <= one.ends
