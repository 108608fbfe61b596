"""What can be said of a condition when only the achievements so far are known: so, not so, or either."""

from collections.abc import Callable

from understudy.network import Achieved, AllOf, AnyOf, Complete, Condition, Not, TimedOut

__all__ = ["Known", "truth"]

Known = Callable[[Condition], bool | None]
"""Whether an atom of conditions is so; None if the achievements so far do not say it."""


def truth(condition: Condition, known: Known) -> bool | None:
    """Whether a condition is so; None if it depends on what the world, the clock, or somebody outside says.

    What it depends on is taken to be independent: nothing is concluded from the same thing being asked twice.
    """
    match condition:
        case Not():
            of = truth(condition.of, known)
            return None if of is None else not of
        case AllOf() | AnyOf():
            settles = isinstance(condition, AnyOf)
            parts = [truth(part, known) for part in condition.of]
            return settles if settles in parts else None if None in parts else not settles
        case Achieved() | TimedOut() | Complete():
            return known(condition)
        case _:
            return None
