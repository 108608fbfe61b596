"""What a component is doing after a tick, and the first condition that decides it."""

from typing import Any

from understudy.execution.activation import Activation
from understudy.execution.context import Told
from understudy.execution.step import Step
from understudy.execution.trace import State

__all__ = ["state_of"]


def state_of(row: int, step: Step, activation: Activation) -> Told:
    """A component's state, the first condition that decides it, and all ``also`` missing ones.

    Args:
        row: of the component.
        step: of this tick, not committed yet.
        activation: that made the step.
    """
    program, context = activation.program, activation.context
    nodes, node = program.nodes, program.nodes[row]
    if row in step.active:
        if node.scopes:
            works = any(row in program.ancestors(one) for one in step.executing)
            return (State.EXECUTING, {}) if works else (State.SEARCHING, {"reason": "parts"})
        if row in step.executing:
            return State.EXECUTING, {}
        owner = activation.locks.owner_at(row, step)
        # Who was asked had its actuators free at its turn; another one took them only afterwards.
        if owner is not None and row not in activation.locks.asked:
            return State.SEARCHING, {"reason": "locked", "by": nodes[owner].id}
        return State.SEARCHING, {"reason": "world"}
    if row in context.skipped:
        return State.SKIPPED, {}
    if not activation.scopes.enabled[node.scope]:
        return (State.ACHIEVED if context.achieved[row] else State.UNUSED), {}
    if not activation.links.in_play[row]:
        return _out_of_play(row, activation)
    if activation.links.levels[row] == 0:
        resting = node.trigger is not None and row not in context.called
        return (State.RESTING if resting else State.ACHIEVED), {}
    missing = [{"reason": arc.type.value, "for": nodes[arc.source].id} for arc in activation.links.refusals(row)]
    if row in context.inhibited:
        by: dict[str, Any] = {"by": nodes[context.inhibited[row]].id}
        return State.INHIBITED, by | ({"also": missing} if missing else {})
    if not missing:
        # Nothing of its own keeps it from acting: the network in which it stands ceases to be active.
        return State.WAITING, {"reason": "unused"}
    first, *others = missing
    return State.WAITING, first | ({"also": others} if others else {})


def _out_of_play(row: int, activation: Activation) -> Told:
    """Where there are alternatives: it may still have its turn, or does not lie on the way any more."""
    program, context = activation.program, activation.context
    scope = program.scopes[program.nodes[row].scope]
    assert scope.ways is not None
    taken = context.taken.get(scope.number, ())
    before = scope.ways.waits_for(taken, row)
    if before is not None:
        return State.WAITING, {"reason": "path", "for": program.nodes[before].id}
    since = scope.ways.passed_at(taken, row)
    return State.BYPASSED, {} if since is None else {"by": program.nodes[since].id}
