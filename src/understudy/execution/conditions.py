"""Whether a condition holds in a running task."""

from collections.abc import Callable
from dataclasses import dataclass

from understudy.execution.context import Context
from understudy.execution.program import Program
from understudy.network import (
    Achieved,
    After,
    AllOf,
    AnyOf,
    Complete,
    Condition,
    Happened,
    Holds,
    Not,
    Possible,
    TimedOut,
)

__all__ = ["NOWHERE", "Outside", "holds"]


@dataclass(frozen=True, slots=True)
class Outside:
    """What a tick is told of the world, apart from the components' own goals and preconditions.

    Attributes:
        time_s: of the percepts.
        events: that arrived since the last tick.
        senses: whether a ``Holds`` or ``Possible`` is so now.
    """

    time_s: float = 0.0
    events: frozenset[str] = frozenset()
    senses: Callable[[Holds | Possible], bool] = lambda condition: False


NOWHERE = Outside()


def holds(
    condition: Condition,
    program: Program,
    context: Context,
    outside: Outside,
    *,
    scope: int,
    complete: bool = False,
) -> bool:
    """Whether a condition is so now.

    Args:
        condition: to be looked at.
        program: of the task.
        context: of the run.
        outside: the world at this tick.
        scope: the network of which it speaks.
        complete: whether that network is complete.
    """
    match condition:
        case Holds() | Possible():
            return outside.senses(condition)
        case Happened():
            return condition.event in outside.events
        case Achieved():
            return context.achieved[program.scopes[scope].ids[condition.component]]
        case TimedOut():
            return program.scopes[scope].ids[condition.component] in context.timed_out
        case After():
            begun = context.begun.get(scope)
            # In whole microseconds: 0.1 s a tick does not add up to round numbers.
            return begun is not None and round(1e6 * (outside.time_s - begun)) >= round(1e6 * condition.seconds)
        case Complete():
            return complete
        case Not():
            return not holds(condition.of, program, context, outside, scope=scope, complete=complete)
        case AllOf():
            return all(holds(part, program, context, outside, scope=scope, complete=complete) for part in condition.of)
        case AnyOf():
            return any(holds(part, program, context, outside, scope=scope, complete=complete) for part in condition.of)
