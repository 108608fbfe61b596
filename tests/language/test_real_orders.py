"""Whatever order of achievements the tick produces is in the language, with every control there is."""

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.execution.driving import drive
from tests.execution.strategies import Scenario, scenarios
from understudy.language import Language, by_path


@settings(max_examples=60)
@given(st.one_of(scenarios(nested=True, max_ticks=20), scenarios(max_ticks=20)))
def test_an_observed_order_is_in_the_language(scenario: Scenario) -> None:
    run = drive(scenario)
    states = Language(scenario.network, spell=by_path).states
    nodes = run.controller.program.nodes
    state: int | None = states.start
    for decision in run.decisions:
        for row in decision.step.achieved:
            if nodes[row].skill is not None:
                assert state is not None
                state = states.after(state).get(nodes[row].id)
                assert state is not None, nodes[row].id
        if decision.step.complete:
            assert state is not None
            assert states.complete(state)
