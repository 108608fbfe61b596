"""The tick against the reference interpreter, on random networks and random histories."""

from hypothesis import given, settings

from understudy.execution import Activation, Context
from understudy.network import Network

from .reference import RefOutcome, run
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
        effects = [world.effects.get(id_, False) for id_ in ids]
        step = activation.decide(effects, lambda row, world=world: world.preconditions.get(ids[row], True))
        executing = {ids[row] for row in step.executing}
        active = {ids[row] for row in step.active}
        refusals = {
            id_: {(arc.type.value, ids[arc.source]) for arc in activation.refusals(rows[id_])}
            for id_ in ids
            if id_ not in active
        }
        outcomes.append(
            RefOutcome(
                effects=dict(zip(ids, context.effects, strict=True)),
                achieved=dict(zip(ids, context.achieved, strict=True)),
                levels=dict(zip(ids, activation.levels, strict=True)),
                active=active,
                executing=executing,
                searching=active - executing,
                refusals=refusals,
                completed=step.complete,
            )
        )
        activation.commit(step)
    return outcomes


def behaved(outcome: RefOutcome) -> tuple[object, ...]:
    """What a run does, without the levels, which count stored links only."""
    return outcome.effects, outcome.achieved, outcome.active, outcome.executing, outcome.completed


@settings(max_examples=400)
@given(scenarios())
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


@settings(max_examples=400)
@given(scenarios())
def test_reduced_and_full_networks_behave_the_same(scenario: Scenario) -> None:
    reduced = execute(scenario.network, scenario)
    full = execute(closed(scenario.network), scenario)
    assert [behaved(outcome) for outcome in reduced] == [behaved(outcome) for outcome in full]


@settings(max_examples=200)
@given(scenarios())
def test_the_tables_follow_from_the_context_alone(scenario: Scenario) -> None:
    """A context taken over in mid-run gives the same activation as the one that has been kept up to date."""
    program = compiled(scenario.network, scenario.behaviors)
    context = Context.start(program)
    activation = Activation(program, context)
    ids = [node.id for node in program.nodes]
    for world in scenario.history:
        fresh = Activation(program, context)
        assert fresh.levels == activation.levels
        assert fresh.unmet == activation.unmet
        assert fresh.satisfied == activation.satisfied
        effects = [world.effects.get(id_, False) for id_ in ids]
        activation.commit(activation.decide(effects, lambda row: True))
