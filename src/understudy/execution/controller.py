"""One tick of a running task, from percepts to the command (semantics §3)."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

from understudy.behaviors import Action, Actuator, Motion, Skill, Wander
from understudy.execution.activation import Activation
from understudy.execution.conditions import Outside
from understudy.execution.context import Context
from understudy.execution.ports import Ports
from understudy.execution.program import Program, compile_network
from understudy.execution.states import state_of
from understudy.execution.step import NOTHING, Step
from understudy.execution.trace import Event
from understudy.network import Holds, Network, Possible
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
        stopped: the path of a component that ran out of time and ends the run; empty if none does.
    """

    command: Command
    events: tuple[Event, ...]
    step: Step
    complete: bool
    stopped: str = ""


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

    def tick(self, percepts: Percepts, events: Collection[str] = ()) -> Decision:
        """Steps 1 to 8 for one observation's percepts.

        Args:
            percepts: of the observation.
            events: what reached the robot from outside since the last tick.
        """
        context = self.context
        purposeful = self._busy()
        chosen = dict(context.chosen)

        def senses(condition: Holds | Possible) -> bool:
            skill, parameters = self.program.senses[str(condition)]
            ask = skill.abstract.goal if isinstance(condition, Holds) else skill.abstract.precondition
            return ask(percepts, parameters)

        def precondition(row: int) -> bool:
            node = self.program.nodes[row]
            return node.skill is not None and node.skill.abstract.precondition(percepts, node.parameters)

        outside = Outside(time_s=percepts.time_s, events=frozenset(events), senses=senses)
        step = self.activation.decide(self._goals(percepts), precondition, outside)
        told = [Event(time_s=percepts.time_s, kind="event", detail={"name": name}) for name in sorted(events)]
        told += self._changes(percepts.time_s, purposeful, step)
        command, overridden = self._act(percepts, step)
        self.activation.commit(step)
        told += self._beginnings(percepts.time_s, chosen, step)
        if overridden is not context.avoiding:
            told.append(Event(time_s=percepts.time_s, kind="avoid", detail={"on": overridden}))
            context.avoiding = overridden
        complete = step.complete and not context.keep_on
        if complete and not context.completed:
            told.append(Event(time_s=percepts.time_s, kind="complete"))
            context.completed = True
        stopped = self.program.nodes[step.stopped].id if step.stopped is not None else ""
        return Decision(command=command, events=tuple(told), step=step, complete=complete, stopped=stopped)

    def resume(self, context: Context) -> None:
        """Goes on from a context of the same program, saved after a tick."""
        self.context = context
        self.activation = Activation(self.program, context)

    def ports(self, path: str) -> Ports:
        """The ports of a component after the last tick (§3.2.1).

        Raises:
            KeyError: no component has this path.
        """
        context, activation = self.context, self.activation
        row = self.program.rows[path]
        incoming = self.program.incoming[row]
        return Ports(
            use_behavior=activation.scopes.enabled[self.program.nodes[row].scope],
            activ_level=activation.links.levels[row],
            inhibit=row in context.inhibited,
            preconditions={self.program.nodes[arc.source].id: activation.links.satisfied[arc.row] for arc in incoming},
            continue_=row in context.keep_on,
            active=row in context.active,
            effects=context.effects[row],
        )

    def _goals(self, percepts: Percepts) -> list[bool]:
        """What the goals of the behaviors that are used say now; of all others, what they said last."""
        nodes, effects = self.program.nodes, self.context.effects.copy()
        for row in self.activation.scopes.readable:
            node = nodes[row]
            effects[row] = node.skill.abstract.goal(percepts, node.parameters)  # type: ignore[union-attr]  # a behavior
        return effects

    def _busy(self) -> frozenset[int]:
        """Who executed in the last tick, and the NABs of which that is a part."""
        executing = self.context.executing
        if not self.program.nabs:
            return frozenset(executing)
        return frozenset(executing).union(*map(self.program.ancestors, executing))

    def _act(self, percepts: Percepts, step: Step) -> tuple[Command, bool]:
        """Step 7: the primitives of executing components, ``Wander`` when the wheels are free, ``Avoid`` over all."""
        nodes, context = self.program.nodes, self.context
        actions: list[Action] = []
        keep_on: set[int] = set()
        wheels_taken = False
        context.memories = {row: context.memories.get(row, {}) for row in step.executing}
        for row in step.executing:
            node = nodes[row]
            assert node.skill is not None
            action, context.memories[row] = node.skill.primitive.step(
                percepts, node.parameters, context.memories[row], context.random
            )
            actions.append(action)
            wheels_taken = wheels_taken or Actuator.WHEELS in node.actuators
            if action.keep_on:
                keep_on.add(row)
        if keep_on or context.keep_on:
            context.keep_on = frozenset(keep_on)
        if not wheels_taken and not step.complete:
            action, context.wander = self.wander.step(percepts, context.wander, context.random)
            actions.append(action)
        else:
            context.wander = {}
        return self.motion.command(actions, percepts)

    def _changes(self, time_s: float, purposeful: frozenset[int], step: Step) -> list[Event]:
        nodes, context = self.program.nodes, self.context
        events: list[Event] = []

        def tell(kind: str, row: int, **detail: Any) -> None:
            events.append(Event(time_s=time_s, kind=kind, component=nodes[row].id, detail=detail))

        for row in step.timed_out:
            timeout = nodes[row].timeout
            assert timeout is not None
            tell("timeout", row, then=timeout.then, **({"event": timeout.event} if timeout.event else {}))
        for row in step.changed:
            tell("goal", row, holds=context.effects[row])
        for row in step.called:
            tell("called", row)
        for row in (*step.skipped, *step.achieved):
            if choice := self._choice(row):
                tell("taken", row, **choice)
        for row in step.achieved:
            # Reached by the robot's own doing, and not just found true: the beep of A.4.
            tell("achieved", row, on_purpose=row in purposeful)
        for row in sorted(step.touched):
            state = state_of(row, step, self.activation)
            if state != context.told.get(row, (None, {})):
                context.told[row] = state
                tell("state", row, state=state[0].value, **state[1])
        return events

    def _choice(self, row: int) -> dict[str, list[str]]:
        """Where a component came next on its way, what could have come instead, and what was left out for it."""
        node = self.program.nodes[row]
        ways, taken = self.program.scopes[node.scope].ways, self.context.taken.get(node.scope, ())
        if ways is None or row not in taken:
            return {}
        way = taken[: taken.index(row)]
        found = {"instead_of": [one for one in ways.candidates(way) if one != row], "past": [*ways.passed(way)]}
        return {key: [self.program.nodes[one].id for one in rows] for key, rows in found.items() if rows}

    def _beginnings(self, time_s: float, before: Mapping[int, int], step: Step) -> list[Event]:
        """Which networks begin now, or begin anew."""
        program, context = self.program, self.context
        events = []
        fresh = {start.nab: start for start in step.begun_anew}
        for nab in program.nabs:
            node, number = program.nodes[nab], context.chosen.get(nab)
            name = program.scopes[number].name if number is not None and number != NOTHING else None
            if nab in fresh and fresh[nab].switched_to is not None:
                detail: dict[str, Any] = {"to": name}
                events.append(Event(time_s=time_s, kind="switch", component=node.id, detail=detail))
                continue
            if nab in fresh:
                detail = {"number": context.rounds[nab] + 1}
                events.append(Event(time_s=time_s, kind="round", component=node.id, detail=detail))
            several = len(node.scopes) > 1 or node.cases[0] is not None
            if several and number is not None and (nab in fresh or before.get(nab) is None):
                events.append(Event(time_s=time_s, kind="case", component=node.id, detail={"case": name}))
        return events
