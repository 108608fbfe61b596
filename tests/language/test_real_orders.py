"""Whatever order of achievements the tick produces is in the language, with every control there is."""

from hypothesis import given, settings
from hypothesis import strategies as st

from tests.execution.driving import Driven, drive
from tests.execution.reference import World
from tests.execution.strategies import Scenario, scenarios
from understudy.language import Language, by_path
from understudy.network import Happened, Network
from understudy.network.builder import build, do, every, in_order, named, part, until, within

NOTHING = frozenset[str]()


def achieved(run: Driven) -> list[str]:
    nodes = run.controller.program.nodes
    rows = (row for decision in run.decisions for row in decision.step.achieved)
    return [nodes[row].id for row in rows if nodes[row].skill is not None]


@settings(max_examples=60)
@given(
    st.one_of(scenarios(nested=True, max_ticks=16), scenarios(max_ticks=16), scenarios(alternatives=True, max_ticks=16))
)
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


def played(network: Network, *worlds: World) -> tuple[str, ...]:
    """What is achieved in a history that the reader can follow; each of the words must be in the language."""
    behaviors = {"A": (NOTHING, False), "B": (NOTHING, False), "C": (NOTHING, False)}
    word = tuple(achieved(drive(Scenario(network, behaviors, list(worlds)))))
    assert word in Language(network, spell=by_path)
    return word


def test_a_part_that_is_passed_over_may_achieve_something_in_that_very_tick() -> None:
    rest = do("C", named("c"))
    some = part("some", do("A", named("a")), within(0.5, skip=True))
    network = build(rest, in_order(some, rest))
    both = {"some/a": True, "c": True}
    assert played(network, World(time_s=0), World(time_s=0.5, effects=both)) == ("c", "some/a")


def test_a_part_that_is_cut_short_may_finish_what_it_was_at() -> None:
    some = part("some", do("A", named("a")), until(Happened(event="e")))
    network = build(in_order(some, do("C", named("c"))))
    word = played(
        network,
        World(time_s=0),
        World(time_s=1),
        World(time_s=2, events=frozenset({"e"}), effects={"c": True}, continues=frozenset({"some/a"})),
        World(time_s=3, effects={"some/a": True}),
    )
    assert word == ("c", "some/a")


def test_a_duty_may_be_done_in_the_tick_that_completes_the_task() -> None:
    network = build(do("A", named("a")), do("B", named("b"), every(1)))
    both = {"a": True, "b": True}
    assert played(network, World(time_s=0), World(time_s=1, effects=both)) == ("a", "b")
    assert ("a", "b", "b") not in Language(network, spell=by_path)
