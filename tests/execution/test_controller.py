"""One tick from percepts to the command: trace, ports, wandering, completion."""

from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import replace
from random import Random
from typing import Any

from understudy.behaviors import Action, Drive, Instance, Memory, Parameter, Parameters, Skill, SkillSet
from understudy.behaviors.skill import Actuator
from understudy.execution import Controller, Decision, Event
from understudy.network import Component, Happened, Link, LinkType, Nab, Network, Trigger
from understudy.perception import Percepts
from understudy.robot import PIONEER


class Scripted:
    """A skill whose goal and precondition hold at given times, and whose primitive drives and continues at others."""

    parameters: tuple[Parameter, ...] = ()
    actuators = frozenset({Actuator.WHEELS})
    maintaining = False

    def __init__(
        self,
        name: str,
        goal: Sequence[int],
        *,
        seen: Sequence[int] | None = None,
        on: Sequence[int] = (),
        gripper: bool = False,
    ):
        self.name, self.goal_at, self.seen, self.on = name, goal, seen, on
        if gripper:
            self.actuators = frozenset({Actuator.GRIPPER})

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        return round(percepts.time_s * 10) in self.goal_at

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        return self.seen is None or round(percepts.time_s * 10) in self.seen

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        return {}

    def describe(self, parameters: Parameters) -> str:
        return self.name

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        keep_on = round(percepts.time_s * 10) in self.on
        if self.actuators == {Actuator.GRIPPER}:
            return Action(paddles="open", keep_on=keep_on), {}
        return Action(drive=Drive(linear=0.11), keep_on=keep_on), {"steps": memory.get("steps", 0) + 1}


def controller(
    *skills: Scripted,
    links: Sequence[tuple[str, str, LinkType]] = (),
    inhibitions: Sequence[tuple[str, str]] = (),
) -> Controller:
    network = Network(
        tuple(Component(id=skill.name.lower(), behavior=skill.name) for skill in skills),
        tuple(Link(source=source, target=target, type=type_) for source, target, type_ in links),
        tuple(inhibitions),
    )
    return Controller(network, SkillSet(*(Skill(skill, skill) for skill in skills)), PIONEER)


def ticks(running: Controller, count: int, start: int = 0) -> list[Decision]:
    return [running.tick(Percepts(time_s=(start + tick) / 10)) for tick in range(count)]


def told(decisions: Sequence[Decision], component: str) -> list[tuple[float, str, dict[str, Any]]]:
    return [
        (event.time_s, event.kind, dict(event.detail))
        for decision in decisions
        for event in decision.events
        if event.component == component
    ]


CHAIN = (("a", "b", LinkType.ORDERING),)


def test_every_change_of_state_is_told_once_with_its_reason() -> None:
    running = controller(Scripted("A", [2, 3]), Scripted("B", [5], seen=[3, 4, 5]), links=CHAIN)
    decisions = ticks(running, 7)
    assert told(decisions, "a") == [
        (0.0, "state", {"state": "executing"}),
        (0.2, "goal", {"holds": True}),
        (0.2, "achieved", {"on_purpose": True}),
        (0.2, "state", {"state": "achieved"}),
        (0.4, "goal", {"holds": False}),
    ]
    assert told(decisions, "b") == [
        (0.0, "state", {"state": "waiting", "reason": "ordering", "for": "a"}),
        (0.2, "state", {"state": "searching", "reason": "world"}),
        (0.3, "state", {"state": "executing"}),
        (0.5, "goal", {"holds": True}),
        (0.5, "achieved", {"on_purpose": True}),
        (0.5, "state", {"state": "achieved"}),
        (0.6, "goal", {"holds": False}),
    ]
    assert [decision.complete for decision in decisions] == [False] * 5 + [True] * 2
    assert sum(event.kind == "complete" for decision in decisions for event in decision.events) == 1


def test_a_goal_found_true_is_not_reached_on_purpose() -> None:
    running = controller(Scripted("A", range(9)))
    [decision] = ticks(running, 1)
    assert Event(time_s=0.0, kind="achieved", component="a", detail={"on_purpose": False}) in decision.events


def test_it_wanders_while_it_searches_and_stands_still_when_done() -> None:
    running = controller(Scripted("A", [3], seen=[2, 3]))
    searching, _, executing, done = ticks(running, 4)
    assert searching.command.angular != 0.0  # looking around
    assert executing.command.linear == 0.11
    assert done.command.linear == done.command.angular == 0.0


def test_a_lock_is_a_reason() -> None:
    running = controller(Scripted("A", [9]), Scripted("B", [9]))
    decisions = ticks(running, 2)
    assert told(decisions, "b") == [(0.0, "state", {"state": "searching", "reason": "locked", "by": "a"})]


def test_a_primitive_that_continues_holds_up_the_end() -> None:
    running = controller(Scripted("A", [2], on=[1, 2, 3, 4]))
    assert [decision.complete for decision in ticks(running, 7)] == [False] * 5 + [True] * 2


def test_the_ports_have_their_names() -> None:
    running = controller(Scripted("A", [1]), Scripted("B", [9]), links=(("a", "b", LinkType.PERMANENT),))
    ticks(running, 1)
    ports = running.ports("b")
    assert (ports.active, ports.activ_level, ports.preconditions) == (False, 1, {"a": False})
    ticks(running, 1, start=1)
    ports = running.ports("b")
    assert (ports.active, ports.effects, ports.inhibit, ports.preconditions) == (True, False, False, {"a": True})
    assert ports.use_behavior
    assert not ports.continue_


def test_primitives_remember_only_while_they_execute() -> None:
    running = controller(Scripted("A", [9], seen=[0, 1, 3]))
    steps = []
    for tick in range(4):
        running.tick(Percepts(time_s=tick / 10))
        steps.append(running.context.memories.get(0, {}).get("steps"))
    assert steps == [1, 2, None, 1]


def test_the_context_is_all_there_is() -> None:
    """A second controller with a copy of the context goes on exactly as the first one does."""
    skills = (Scripted("A", [4], seen=[2, 3, 4]), Scripted("B", [9], seen=[6, 7, 8, 9], on=[6]))
    first = controller(*skills, links=CHAIN)
    ticks(first, 5)
    second = controller(*skills, links=CHAIN)
    second.resume(deepcopy(first.context))
    for one, other in zip(ticks(first, 7, start=5), ticks(second, 7, start=5), strict=True):
        assert (one.command, one.events, one.complete) == (other.command, other.events, other.complete)


def test_every_refusal_is_told_not_the_first_only() -> None:
    links = (("a", "c", LinkType.ORDERING), ("b", "c", LinkType.PERMANENT))
    running = controller(Scripted("A", [9]), Scripted("B", [2]), Scripted("C", [9]), links=links)
    decisions = ticks(running, 3)
    assert told(decisions, "c") == [
        (
            0.0,
            "state",
            {"state": "waiting", "reason": "ordering", "for": "a", "also": [{"reason": "permanent", "for": "b"}]},
        ),
        (0.2, "state", {"state": "waiting", "reason": "ordering", "for": "a"}),
    ]


def test_inhibition_is_told_with_the_rival_of_the_moment() -> None:
    rivals = (("a", "c"), ("b", "c"))
    running = controller(
        Scripted("A", [2]), Scripted("B", [4], seen=[3, 4]), Scripted("C", [9], seen=[]), inhibitions=rivals
    )
    states = [(time_s, detail) for time_s, _, detail in told(ticks(running, 7), "c")]
    assert states == [
        (0.0, {"state": "searching", "reason": "locked", "by": "a"}),
        (0.1, {"state": "inhibited", "by": "a"}),
        (0.3, {"state": "searching", "reason": "locked", "by": "b"}),
        (0.4, {"state": "inhibited", "by": "b"}),
        (0.5, {"state": "searching", "reason": "world"}),
    ]


def test_steps_achieved_in_one_tick_are_told_predecessors_first() -> None:
    running = controller(Scripted("B", [1]), Scripted("A", [1]), links=CHAIN)
    _, both = ticks(running, 2)
    assert [event.component for event in both.events if event.kind == "achieved"] == ["a", "b"]


def test_disjoint_actuators_are_used_in_one_tick() -> None:
    """§3.3.2: locks still enable "the simultaneous execution of behaviors that control sets of actuators that are
    disjunct"; also across the borders of networks.
    """
    skills = (Scripted("Drive", [4]), Scripted("Open", [3], gripper=True), Scripted("Turn", [6]))
    drive, open_, turn = (Component(id=skill.name.lower(), behavior=skill.name) for skill in skills)
    network = Network((Nab.of("arm", Network((open_,))), drive, turn))
    running = Controller(network, SkillSet(*(Skill(skill, skill) for skill in skills)), PIONEER)
    decisions = ticks(running, 7)
    assert (decisions[0].command.linear, decisions[0].command.paddles) == (0.11, None)  # its parts come a tick later
    assert (decisions[1].command.linear, decisions[1].command.paddles) == (0.11, "open")
    assert told(decisions, "arm/open")[1] == (0.1, "state", {"state": "executing"})
    assert told(decisions, "turn")[:2] == [
        (0.0, "state", {"state": "searching", "reason": "locked", "by": "drive"}),  # the wheels are the first one's
        (0.4, "state", {"state": "executing"}),
    ]
    assert [decision.complete for decision in decisions] == [False] * 6 + [True]


def test_a_rival_and_one_that_continues_are_seen_in_the_trace() -> None:
    """``a`` inhibits ``b`` while it executes, and goes on when its goal is reached, since its primitive asks for it."""
    running = controller(Scripted("A", [2], on=[1, 2, 3]), Scripted("B", [6], gripper=True), inhibitions=(("a", "b"),))
    decisions = ticks(running, 7)
    assert [detail for _, kind, detail in told(decisions, "a") if kind == "state"] == [
        {"state": "executing"},
        {"state": "achieved"},
    ]
    states = [(time_s, detail) for time_s, kind, detail in told(decisions, "b") if kind == "state"]
    assert states[:3] == [
        (0.0, {"state": "executing"}),
        (0.1, {"state": "inhibited", "by": "a"}),
        (0.6, {"state": "achieved"}),
    ]


def test_a_network_continues_while_one_of_its_parts_does() -> None:
    """The last step of a subtask finishes what it began before the next subtask moves the robot."""
    skills = (Scripted("A", [3], on=[2, 3, 4]), Scripted("B", [7]))
    a, b = (Component(id=skill.name.lower(), behavior=skill.name) for skill in skills)
    network = Network(
        (Nab.of("first", Network((Nab.of("deep", Network((a,))),))), Nab.of("then", Network((b,)))),
        (Link(source="first", target="then", type=LinkType.ORDERING),),
    )
    running = Controller(network, SkillSet(*(Skill(skill, skill) for skill in skills)), PIONEER)
    decisions = ticks(running, 8)
    rows = running.program.rows
    executing = [decision.step.executing for decision in decisions]
    assert executing == [(), (), *([(rows["first/deep/a"],)] * 4), (rows["then/b"],), ()]
    assert told(decisions, "then/b")[1:3] == [
        (0.4, "state", {"state": "searching", "reason": "locked", "by": "first/deep/a"}),
        (0.6, "state", {"state": "executing"}),
    ]


def test_a_duty_that_is_called_while_it_is_still_finishing_is_done_again() -> None:
    part = Scripted("X", [3, 8], on=range(2, 7))
    duty = replace(
        Nab.of("duty", Network((Component(id="x", behavior="X"),))), trigger=Trigger(on=Happened(event="bell"))
    )
    skills = SkillSet(*(Skill(skill, skill) for skill in (Scripted("M", []), part)))
    running = Controller(Network((Component(id="main", behavior="M"), duty)), skills, PIONEER)
    decisions = [running.tick(Percepts(time_s=tick / 10), {"bell"} if tick in (1, 5) else ()) for tick in range(12)]
    assert [time_s for time_s, kind, _ in told(decisions, "duty") if kind == "achieved"] == [0.3, 0.8]
