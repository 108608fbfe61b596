"""The tick against the reference interpreter, on random networks and random histories."""

from collections.abc import Sequence

from hypothesis import given, settings

from understudy.execution import Activation, Context, Outside, Step
from understudy.network import Network

from .reference import RefOutcome, World, run
from .strategies import Scenario, scenarios
from .support import closed, compiled


def execute(network: Network, scenario: Scenario) -> list[RefOutcome]:
    """The product's run, told in the reference's words."""
    program = compiled(network, scenario.behaviors)
    context = Context.start(program)
    activation = Activation(program, context)
    rows = {node.id: node.row for node in program.nodes}
    ids = [node.id for node in program.nodes]
    outcomes = []
    for world in scenario.history:
        context.keep_on = frozenset(rows[id_] for id_ in world.continues)
        step = decide(activation, world, ids)
        executing = {ids[row] for row in step.executing}
        active = {ids[row] for row in step.active}
        refusals = {
            id_: {(arc.type.value, ids[arc.source]) for arc in activation.links.refusals(rows[id_])}
            for id_ in ids
            if id_ not in active
        }
        leaves = {id_ for id_ in active if program.nodes[rows[id_]].skill is not None}
        outcomes.append(
            RefOutcome(
                effects=dict(zip(ids, context.effects, strict=True)),
                achieved=dict(zip(ids, context.achieved, strict=True)),
                levels=dict(zip(ids, activation.links.levels, strict=True)),
                active=active,
                executing=executing,
                searching=leaves - executing,
                refusals=refusals,
                completed=step.complete,
                stopped=ids[step.stopped] if step.stopped is not None else "",
            )
        )
        activation.commit(step)
    return outcomes


def decide(activation: Activation, world: World, ids: Sequence[str]) -> Step:
    """Steps 2 to 5 in a world of the reference."""
    return activation.decide(
        [world.effects.get(id_, False) for id_ in ids],
        lambda row: world.preconditions.get(ids[row], True),
        Outside(
            time_s=world.time_s,
            events=world.events,
            senses=lambda condition: world.senses.get(str(condition), False),
        ),
    )


def behaved(outcome: RefOutcome) -> tuple[object, ...]:
    """What a run does, without the levels, which count stored links only."""
    return outcome.effects, outcome.achieved, outcome.active, outcome.executing, outcome.completed, outcome.stopped


@settings(max_examples=400)
@given(scenarios() | scenarios(nested=True) | scenarios(alternatives=True))
def test_the_tick_agrees_with_the_reference(scenario: Scenario) -> None:
    full = closed(scenario.network)
    expected = run(full, scenario.behaviors, scenario.history)
    found = execute(full, scenario)
    for mine, theirs in zip(found, expected, strict=True):
        assert behaved(mine) == behaved(theirs)
        assert mine.levels == theirs.levels
        for id_, arcs in mine.refusals.items():
            links = {reason for reason in theirs.refusals[id_] if reason[0] in ("ordering", "enabling", "permanent")}
            assert arcs == links


@settings(max_examples=300)
@given(scenarios() | scenarios(nested=True) | scenarios(alternatives=True))
def test_reduced_and_full_networks_behave_the_same(scenario: Scenario) -> None:
    reduced = execute(scenario.network, scenario)
    full = execute(closed(scenario.network), scenario)
    assert [behaved(outcome) for outcome in reduced] == [behaved(outcome) for outcome in full]


@settings(max_examples=200)
@given(scenarios() | scenarios(nested=True) | scenarios(alternatives=True))
def test_the_tables_follow_from_the_context_alone(scenario: Scenario) -> None:
    """A context taken over in mid-run gives the same activation as the one that has been kept up to date."""
    program = compiled(scenario.network, scenario.behaviors)
    context = Context.start(program)
    activation = Activation(program, context)
    ids = [node.id for node in program.nodes]
    for world in scenario.history:
        fresh = Activation(program, context)
        assert fresh.links.levels == activation.links.levels
        assert fresh.links.unmet == activation.links.unmet
        assert fresh.links.satisfied == activation.links.satisfied
        assert fresh.scopes.enabled == activation.scopes.enabled
        assert fresh.scopes.readable == activation.scopes.readable
        context.keep_on = frozenset(program.rows[id_] for id_ in world.continues)
        activation.commit(decide(activation, world, ids))
