"""How far a run has come, counted from its trace alone."""

from hypothesis import given, settings

from tests.figures import nested
from understudy.execution import Context, Event, Tally
from understudy.execution.program import Program
from understudy.execution.step import NOTHING
from understudy.network import Component

from .driving import drive
from .strategies import Scenario, scenarios


def counted(program: Program, context: Context) -> tuple[set[str], set[str]]:
    """The steps and the missing ones as the context has them: the obvious reference."""
    steps, missing = set(), set()
    for node in program.nodes:
        if node.skill is None:
            continue
        around = [*reversed(list(program.ancestors(node.row))), node.row]
        if any(program.nodes[row].trigger is not None for row in around):
            continue
        in_use = True
        for row in around[:-1]:
            number = context.chosen.get(row, program.nodes[row].scopes[0])
            in_use = in_use and number != NOTHING and any(program.nodes[b].scope == number for b in around)
        if in_use:
            if any(not on_the_way(program, context, row) for row in around):
                continue
            steps.add(node.id)
            # What ran out of time and is passed over has its latch set, too, and was not achieved.
            if not any(context.achieved[row] and row not in context.skipped for row in around):
                missing.add(node.id)
    return steps, missing


def on_the_way(program: Program, context: Context, row: int) -> bool:
    """Whether it was taken, or would come next if always the first of the candidates did."""
    scope = program.scopes[program.nodes[row].scope]
    if scope.ways is None or row not in scope.ways.ids:
        return True
    way = list(context.taken.get(scope.number, ()))
    while candidates := scope.ways.candidates(tuple(way)):
        way.append(candidates[0])
    return row in way


@given(scenarios(nested=True, max_ticks=8) | scenarios(alternatives=True, max_ticks=8))
@settings(max_examples=80)
def test_the_trace_says_how_far_the_task_has_come(scenario: Scenario) -> None:
    driven = drive(scenario)
    tally = Tally(scenario.network, [event for decision in driven.decisions for event in decision.events])
    steps, missing = counted(driven.controller.program, driven.controller.context)
    assert set(tally.steps) == steps
    assert set(tally.missing) == missing


def test_steps_of_the_case_in_use_count() -> None:
    tally = Tally(nested.delivery())
    assert str(tally) == "0 of 5 steps"
    tally.add(Event(time_s=0.0, kind="achieved", component="start"))
    tally.add(Event(time_s=0.0, kind="case", component="deliver", detail={"case": "empty"}))
    tally.add(Event(time_s=1.0, kind="achieved", component="deliver/empty/at-the-box"))
    assert str(tally) == "2 of 4 steps"
    assert tally.missing == ("deliver/empty/pick-up", "home")
    tally.add(Event(time_s=2.0, kind="switch", component="deliver", detail={"to": "loaded"}))
    assert str(tally) == "1 of 5 steps"


def test_duties_are_no_steps() -> None:
    network = nested.controls()
    duties = ("look", "greet/teacher", "greet/drop")
    assert set(Tally(network).steps) == {
        path for path, part in network.walk() if isinstance(part, Component) and path not in duties
    }
