"""Why a component is active or not: read from the trace, and true of the run."""

from dataclasses import replace

import pytest
from hypothesis import given, settings

from understudy.behaviors import Skill, SkillSet
from understudy.errors import UnderstudyError
from understudy.execution import Controller, Event, Explanation, History, State, explain
from understudy.network import Component, Edge, Link, LinkType, Nab, Network, Repeat
from understudy.robot import PIONEER

from .driving import controller_of, percepts_of
from .reference import RefContext, tick
from .strategies import Scenario, scenarios
from .support import closed
from .test_controller import Scripted, controller, ticks


@settings(max_examples=150)
@given(scenarios() | scenarios(nested=True) | scenarios(alternatives=True))
def test_what_the_trace_tells_is_what_the_context_holds(scenario: Scenario) -> None:
    running = controller_of(scenario)
    history = History(running.program.network)
    for number, world in enumerate(scenario.history):
        told = running.tick(percepts_of(scenario, number), world.events)
        for event in told.events:
            history.add(event)
        for node in running.program.nodes:
            assert history.holds(node.id, world.time_s) == running.context.effects[node.row], node.id
            achieved = history.achieved_s(node.id, world.time_s) is not None
            assert achieved == running.context.achieved[node.row], node.id


@settings(max_examples=150)
@given(scenarios() | scenarios(nested=True) | scenarios(alternatives=True))
def test_the_reasons_are_those_of_the_definition(scenario: Scenario) -> None:
    """Active or not, executing or not, and the first reason are what the reference interpreter says, at every tick."""
    running = controller_of(scenario)
    history = History(running.program.network)
    full = closed(scenario.network)
    reference = RefContext.fresh(full)
    for number, world in enumerate(scenario.history):
        for event in running.tick(percepts_of(scenario, number), world.events).events:
            history.add(event)
        # A primitive that did not run says nothing.
        spoken = replace(world, continues=world.continues & reference.executing)
        outcome = tick(full, scenario.behaviors, reference, spoken)
        for path, part in scenario.network.walk():
            found = explain(history, path, world.time_s)
            assert found.active == (path in outcome.active), path
            assert 0 <= found.since_s <= world.time_s
            if isinstance(part, Component):
                assert (found.state is State.EXECUTING) == (path in outcome.executing), path
            if found.state is State.EXECUTING:
                assert not found.missing
            elif found.missing[0].kind in ("ordering", "enabling", "permanent"):
                kinds = {(reason[0], reason[1]) for reason in outcome.refusals[path] if len(reason) > 1}
                assert {(one.kind, one.component) for one in found.missing} <= kinds
            elif found.missing[0].kind in ("locked", "inhibited"):
                kind, other = found.missing[0].kind, found.missing[0].component
                known = {reason[1] for reason in outcome.refusals[path] if reason[0] == kind}
                # A rival that was begun anew meanwhile the reference has forgotten; the definition has not.
                assert other in (known if known != {""} else rivals_of(scenario.network, path)), path
            elif not found.active:
                out = found.missing[0].kind in ("path", "bypassed")
                # In the tick in which the network around it ceases to be used, either is told.
                refused = outcome.refusals[path]
                assert ("path",) in refused if out else ("path",) not in refused or ("unused",) in refused


def rivals_of(network: Network, path: str) -> set[str]:
    """The components that inhibit one while they execute, by the definition."""
    prefix = path[: path.rfind("/") + 1]
    inside = network
    *around, id_ = path.split("/")
    while around:
        nab = inside.by_id[around.pop(0)]
        assert isinstance(nab, Nab)
        name = around.pop(0) if len(nab.cases) > 1 or nab.cases[0].name else ""
        inside = next(case.network for case in nab.cases if case.name == name)
    return {prefix + by for by, of in inside.inhibitions if of == id_}


@settings(max_examples=100)
@given(scenarios(nested=True))
def test_a_later_question_does_not_change_an_earlier_answer(scenario: Scenario) -> None:
    """Live or from the recording: what is told of a moment is the same."""
    running = controller_of(scenario)
    live, events, answers = History(running.program.network), [], []
    for number, world in enumerate(scenario.history):
        for event in running.tick(percepts_of(scenario, number), world.events).events:
            live.add(event)
            events.append(event.as_record())
        answers += [(path, world.time_s, explain(live, path, world.time_s)) for path, _ in scenario.network.walk()]
    recorded = History(scenario.network, map(Event.from_record, events))
    for path, time_s, answer in answers:
        assert explain(recorded, path, time_s) == answer


def history_of(running: Controller, count: int) -> History:
    decisions = ticks(running, count)
    return History(running.program.network, [event for decision in decisions for event in decision.events])


def reasons(found: Explanation) -> list[tuple[str, str, str]]:
    return [(one.kind, one.component, one.lacks) for one in found.missing]


PERMANENT = (("a", "b", LinkType.PERMANENT),)


def test_it_tells_since_when_and_by_what_event() -> None:
    running = controller(Scripted("A", [2, 3, 4, 7]), Scripted("B", [], seen=[3, 4, 7, 8]), links=PERMANENT)
    history = history_of(running, 9)

    waiting = explain(history, "b", 0.1)
    assert (waiting.active, reasons(waiting)) == (False, [("permanent", "a", "achieved")])
    assert (waiting.since_s, waiting.cause.kind) == (0.0, "began")
    assert [one.component for one in waiting.chain()] == ["b", "a"]

    searching = explain(history, "b", 0.2)
    assert (searching.active, reasons(searching)) == (True, [("world", "", "")])
    assert (searching.cause.kind, searching.cause.component, searching.cause.time_s) == ("achieved", "a", 0.2)

    executing = explain(history, "b", 0.4)
    assert (executing.state, reasons(executing), executing.cause.kind) == (State.EXECUTING, [], "came")

    back = explain(history, "b", 0.6)
    assert (back.active, reasons(back)) == (False, [("permanent", "a", "hold")])
    assert (back.since_s, back.cause.kind, back.cause.component) == (0.5, "lost", "a")
    assert back.because is not None
    assert (back.because.component, back.because.state) == ("a", State.EXECUTING)
    assert (back.because.cause.kind, back.because.cause.component) == ("lost", "a")

    again = explain(history, "b", 0.7)
    assert (again.cause.kind, again.cause.component) == ("reached", "a")


def test_a_lock_is_explained_by_who_has_it() -> None:
    running = controller(Scripted("A", [3]), Scripted("B", []))
    history = history_of(running, 5)
    held = explain(history, "b", 0.2)
    assert reasons(held) == [("locked", "a", "")]
    assert held.because is not None
    assert held.because.state is State.EXECUTING
    freed = explain(history, "b", 0.4)
    assert (freed.state, freed.cause.kind, freed.cause.component) == (State.EXECUTING, "freed", "a")


def test_a_rival_is_named_and_so_is_its_end() -> None:
    running = controller(Scripted("A", [3]), Scripted("B", []), inhibitions=(("a", "b"),))
    history = history_of(running, 6)
    held = explain(history, "b", 0.2)
    assert (reasons(held), held.cause.kind) == ([("inhibited", "a", "")], "inhibited")
    assert explain(history, "b", 0.5).cause.kind == "released"


def test_a_part_of_what_is_not_in_use_hangs_on_its_network() -> None:
    inner = Network((Component(id="x", behavior="B"),))
    network = Network(
        (Component(id="a", behavior="A"), Nab.of("part", inner, repeat=Repeat(times=2))),
        (Link(source="a", target="part", type=LinkType.ORDERING),),
    )

    a, b = Scripted("A", [2]), Scripted("B", [5, 8])
    running = Controller(network, SkillSet(Skill(a, a), Skill(b, b)), PIONEER)
    history = history_of(running, 10)
    unused = explain(history, "part/x", 0.1)
    assert reasons(unused) == [("unused", "part", "")]
    assert [one.component for one in unused.chain()] == ["part/x", "part", "a"]
    assert explain(history, "part/x", 0.4).cause.kind == "begun"
    # Achieved in the first round, and not any more in the second.
    assert history.achieved_s("part/x", 0.5) is None
    assert history.achieved_s("part/x", 0.9) == 0.8
    assert history.achieved_s("part", 0.9) == 0.8


WAYS = tuple(
    Edge(source=source, target=target)
    for source, target in (("START", "a"), ("START", "b"), ("a", "c"), ("c", "d"), ("a", "d"), ("b", "d"), ("d", "END"))
)


def test_what_is_out_of_play_says_what_comes_first_or_what_was_taken() -> None:
    skills = [Scripted("A", [2]), Scripted("B", [], seen=[]), Scripted("C", [9]), Scripted("D", [5])]
    network = Network(tuple(Component(id=skill.name.lower(), behavior=skill.name) for skill in skills), paths=WAYS)
    running = Controller(network, SkillSet(*(Skill(skill, skill) for skill in skills)), PIONEER)
    history = history_of(running, 7)
    assert reasons(explain(history, "d", 0.1)) == [("path", "a", "achieved")]
    assert reasons(explain(history, "b", 0.1)) == [("locked", "a", "")]
    never = explain(history, "c", 0.1)
    assert (never.state, reasons(never), never.cause.kind) == (State.BYPASSED, [("bypassed", "", "")], "began")
    other = explain(history, "b", 0.4)
    assert reasons(other) == [("bypassed", "a", "")]
    assert (other.since_s, other.cause.kind, other.cause.component) == (0.2, "taken", "a")
    due = explain(history, "d", 0.3)
    assert (due.state, due.cause.kind, due.cause.component) == (State.EXECUTING, "achieved", "a")
    told = [(event.component, dict(event.detail)) for event in history.events if event.kind == "taken"]
    assert told == [("a", {"instead_of": ["b"]}), ("d", {"past": ["c"]})]
    assert "complete" in [event.kind for event in history.events]


def test_unknown_components_and_moments_are_refused() -> None:
    history = history_of(controller(Scripted("A", [1])), 2)
    with pytest.raises(UnderstudyError, match=r"'z'.*there are: a"):
        explain(history, "z", 0.0)
    with pytest.raises(UnderstudyError, match="begins at 0 s"):
        explain(history, "a", -1.0)
    with pytest.raises(UnderstudyError, match="trace is empty"):
        explain(History(history.network), "a", 0.0)
