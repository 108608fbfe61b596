"""A plan's steps moved so that fewer of them need an order.

Which of two steps comes first is often settled by the planner alone. A visit between two errands that could be made at
any time is by its place in the plan before the one or after the other, and so before or after all that hangs on them.
The freest order of all is hard to find (Bäckström: NP-hard). So one step at a time is moved to where most freedom is
won, as long as any is; of several such moves the shortest of the first step.
"""

from collections.abc import Iterator, Sequence

from understudy.planning.deordering import PartialOrder, deordered
from understudy.planning.domain import Facts, Operator

__all__ = ["loosened"]


def loosened(plan: Sequence[Operator], start: Facts, goal: Facts) -> PartialOrder:
    """The partial order of a plan, or of one with the same steps in another order, that has less of an order.

    Args:
        plan: steps that lead from the start to the goal.
        start: what is so at first.
        goal: what shall be so at the end.

    Raises:
        ValueError: they do not lead there.
    """
    best = deordered(plan, start, goal)
    while True:
        freest = min(_moved(best, start, goal), key=_orders, default=best)
        if _orders(freest) >= _orders(best):
            return best
        best = freest


def _orders(order: PartialOrder) -> int:
    """How many pairs of steps are ordered."""
    return sum(map(len, order.before()))


def _moved(order: PartialOrder, start: Facts, goal: Facts) -> Iterator[PartialOrder]:
    """The partial orders of all plans in which one step has another place."""
    for number, step in enumerate(order.steps):
        others = order.steps[:number] + order.steps[number + 1 :]
        for _, place in sorted((abs(place - number), place) for place in range(len(order.steps))):
            try:
                yield deordered((*others[:place], step, *others[place:]), start, goal)
            except ValueError:  # there it does not find what it needs, or ends what others do
                continue
