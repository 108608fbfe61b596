"""One tick of a running task, from percepts to the command (semantics §3)."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from understudy.behaviors import Action, Actuator, Motion, Skill, Wander
from understudy.execution.activation import Activation, Step
from understudy.execution.context import Context, Told
from understudy.execution.ports import Ports
from understudy.execution.program import Program, compile_network
from understudy.execution.trace import Event, State
from understudy.network import Network
from understudy.perception import Percepts
from understudy.robot import Command, RobotSpec

__all__ = ["Controller", "Decision"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Decision:
    """What one tick decided.

    Attributes:
        command: for the robot.
        events: what changed.
        step: the activation, by rows of the program.
        complete: every final goal is achieved, and no primitive asks to go on.
    """

    command: Command
    events: tuple[Event, ...]
    step: Step
    complete: bool


class Controller:
    """Executes one network on one robot's percepts.

    Args:
        network: the task.
        skills: by name.
        spec: the robot's limits and outline.
        seed: of all chance: ``Wander``'s, and that of primitives which throw dice.
    """

    def __init__(self, network: Network, skills: Mapping[str, Skill], spec: RobotSpec, *, seed: int = 0) -> None:
        self.program: Program = compile_network(network, skills)
        self.context = Context.start(self.program, seed)
        self.activation = Activation(self.program, self.context)
        self.motion = Motion(spec)
        self.wander = Wander()

    def tick(self, percepts: Percepts) -> Decision:
        """Steps 1 to 8 for one observation's percepts."""
        nodes, context = self.program.nodes, self.context
        before = list(context.effects)
        purposeful = frozenset(context.executing)
        effects = [node.skill.abstract.goal(percepts, node.parameters) for node in nodes]
        step = self.activation.decide(
            effects, lambda row: nodes[row].skill.abstract.precondition(percepts, nodes[row].parameters)
        )
        events = self._changes(percepts.time_s, before, purposeful, step)
        command, overridden = self._act(percepts, step)
        self.activation.commit(step)
        if overridden is not context.avoiding:
            events.append(Event(time_s=percepts.time_s, kind="avoid", detail={"on": overridden}))
            context.avoiding = overridden
        complete = step.complete and not context.keep_on
        if complete and not context.completed:
            events.append(Event(time_s=percepts.time_s, kind="complete"))
            context.completed = True
        return Decision(command=command, events=tuple(events), step=step, complete=complete)

    def resume(self, context: Context) -> None:
        """Goes on from a context of the same program, saved after a tick."""
        self.context = context
        self.activation = Activation(self.program, context)

    def ports(self, id_: str) -> Ports:
        """The ports of a component after the last tick (§3.2.1).

        Raises:
            KeyError: no component has this id.
        """
        context, activation = self.context, self.activation
        row = self.program.rows[id_]
        incoming = self.program.incoming[row]
        return Ports(
            use_behavior=True,
            activ_level=activation.levels[row],
            inhibit=row in context.inhibited,
            preconditions={self.program.nodes[arc.source].id: activation.satisfied[arc.row] for arc in incoming},
            continue_=row in context.keep_on,
            active=row in context.active,
            effects=context.effects[row],
        )

    def _act(self, percepts: Percepts, step: Step) -> tuple[Command, bool]:
        """Step 7: the primitives of executing components, ``Wander`` when the wheels are free, ``Avoid`` over all."""
        nodes, context = self.program.nodes, self.context
        actions: list[Action] = []
        keep_on: set[int] = set()
        wheels_taken = False
        context.memories = {row: context.memories.get(row, {}) for row in step.executing}
        for row in step.executing:
            node = nodes[row]
            action, context.memories[row] = node.skill.primitive.step(
                percepts, node.parameters, context.memories[row], context.random
            )
            actions.append(action)
            wheels_taken = wheels_taken or Actuator.WHEELS in node.actuators
            if action.keep_on:
                keep_on.add(row)
        context.keep_on = frozenset(keep_on)
        if not wheels_taken and not step.complete:
            action, context.wander = self.wander.step(percepts, context.wander, context.random)
            actions.append(action)
        else:
            context.wander = {}
        return self.motion.command(actions, percepts)

    def _changes(self, time_s: float, before: list[bool], purposeful: frozenset[int], step: Step) -> list[Event]:
        nodes, context = self.program.nodes, self.context
        events: list[Event] = []
        for row, value in enumerate(context.effects):
            if value is not before[row]:
                events.append(Event(time_s=time_s, kind="goal", component=nodes[row].id, detail={"holds": value}))
        for row in step.achieved:
            # Reached by the robot's own doing, and not just found true: the beep of A.4.
            detail: dict[str, Any] = {"on_purpose": row in purposeful}
            events.append(Event(time_s=time_s, kind="achieved", component=nodes[row].id, detail=detail))
        for row in sorted(step.touched):
            state = self._state(row, step)
            if state != context.told.get(row):
                context.told[row] = state
                detail = {"state": state[0].value, **state[1]}
                events.append(Event(time_s=time_s, kind="state", component=nodes[row].id, detail=detail))
        return events

    def _state(self, row: int, step: Step) -> Told:
        """A component's state, the first condition that decides it, and all ``also`` missing ones."""
        nodes, activation = self.program.nodes, self.activation
        if row in step.active:
            if row in step.executing:
                return State.EXECUTING, {}
            if row in step.locked:
                return State.SEARCHING, {"reason": "locked", "by": nodes[step.locked[row]].id}
            return State.SEARCHING, {"reason": "world"}
        if activation.levels[row] == 0:
            return State.ACHIEVED, {}
        missing = [{"reason": arc.type.value, "for": nodes[arc.source].id} for arc in activation.refusals(row)]
        if row in self.context.inhibited:
            by: dict[str, Any] = {"by": nodes[self.context.inhibited[row]].id}
            return State.INHIBITED, by | ({"also": missing} if missing else {})
        first, *others = missing
        return State.WAITING, first | ({"also": others} if others else {})
