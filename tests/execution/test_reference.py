"""The reference itself, against scenarios taken from the semantics and against what must hold in every run."""

from collections.abc import Mapping

from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from understudy.network.definition import Component, Link, LinkType, Network

from .reference import Behaviors, RefContext, RefOutcome, World, run, tick
from .strategies import KINDS, Scenario, histories, networks, scenarios

WHEELS = frozenset({"wheels"})
GRIPPER = frozenset({"gripper"})
NONE = frozenset[str]()

BEHAVIORS: Behaviors = {
    "Go": (WHEELS, False),
    "Grip": (GRIPPER, False),
    "Fetch": (WHEELS | GRIPPER, False),
    "Look": (NONE, False),
    "Hold": (GRIPPER, True),
    "FollowWall": (WHEELS, True),
}

ORDERING, ENABLING, PERMANENT = LinkType.ORDERING, LinkType.ENABLING, LinkType.PERMANENT


def network(
    components: Mapping[str, str], *links: tuple[str, str, LinkType], inhibitions: tuple[tuple[str, str], ...] = ()
) -> Network:
    return Network(
        components=tuple(Component(id=c, behavior=behavior) for c, behavior in components.items()),
        links=tuple(Link(source=source, target=target, type=type_) for source, target, type_ in links),
        inhibitions=inhibitions,
    )


def world(*true: str, unmet: tuple[str, ...] = (), continues: tuple[str, ...] = ()) -> World:
    """A world in which the effects of just these are true, and the world preconditions of all but these hold."""
    return World(
        effects=dict.fromkeys(true, True),
        preconditions=dict.fromkeys(unmet, False),
        continues=frozenset(continues),
    )


def achieved(outcome: RefOutcome) -> set[str]:
    return {c for c, value in outcome.achieved.items() if value}


CHAIN = network({"a": "Go", "b": "Go", "c": "Go"}, ("a", "b", ORDERING), ("b", "c", ORDERING))


def test_a_chain_of_ordering_runs_one_after_the_other() -> None:
    outcomes = run(CHAIN, BEHAVIORS, [world(), world("a"), world(), world("b"), world("c")])
    assert [o.executing for o in outcomes] == [{"a"}, {"b"}, {"b"}, {"c"}, set()]
    assert [o.completed for o in outcomes] == [False, False, False, False, True]
    assert outcomes[0].levels == {"a": 1, "b": 1, "c": 1}
    assert outcomes[0].refusals == {"b": {("ordering", "a")}, "c": {("ordering", "b")}}
    assert outcomes[2].levels == {"a": 0, "b": 1, "c": 1}  # ordering: achieved once is enough
    assert outcomes[2].refusals["a"] == {("level",)}
    assert outcomes[4].refusals == {"a": {("level",)}, "b": {("level",)}, "c": {("level",)}}


def test_the_level_counts_the_successors_that_need_it() -> None:
    fan = network(
        {"a": "Go", "b": "Go", "c": "Go", "d": "Go"},
        ("a", "b", ORDERING), ("a", "c", PERMANENT), ("a", "d", ORDERING), ("c", "d", ENABLING),
    )  # fmt: skip
    before, after = run(fan, BEHAVIORS, [world(), world("a", "b")])
    assert before.levels == {"a": 3, "b": 1, "c": 1, "d": 1}
    assert after.levels == {"a": 0, "b": 0, "c": 1, "d": 1}
    tree = network({"a": "Go", "b": "Go", "c": "Go", "d": "Go"}, *((p, c, ORDERING) for p, c in ("ab", "bc", "bd")))
    (only,) = run(tree, BEHAVIORS, [world()])
    assert only.levels == {"a": 1, "b": 2, "c": 1, "d": 1}  # 1 is sent, whatever the level of the sender


def test_an_incidental_visit_to_a_later_target_does_not_count() -> None:
    outcomes = run(CHAIN, BEHAVIORS, [world("b", "c"), world("a"), world()])
    assert [achieved(o) for o in outcomes] == [set(), {"a"}, {"a"}]
    assert outcomes[2].executing == {"b"}


def test_every_type_of_link_asks_for_achievement_in_turn() -> None:
    for type_ in LinkType:
        chain = network({"a": "Go", "b": "Go", "c": "Go"}, ("a", "b", ORDERING), ("b", "c", type_))
        (only,) = run(chain, BEHAVIORS, [world("b", "c")])
        assert achieved(only) == set()
        assert only.refusals["c"] == {(type_.value, "b")}


def test_a_goal_the_world_achieves_in_its_turn_counts() -> None:
    outcomes = run(CHAIN, BEHAVIORS, [world(), world("a", "b"), world("c")])
    assert [achieved(o) for o in outcomes] == [set(), {"a", "b"}, {"a", "b", "c"}]
    assert [o.executing for o in outcomes] == [{"a"}, {"c"}, set()]


def test_several_steps_jump_forward_in_one_tick_whatever_the_document_order() -> None:
    backwards = network({"c": "Go", "b": "Go", "a": "Go"}, ("a", "b", ENABLING), ("b", "c", PERMANENT))
    (only,) = run(backwards, BEHAVIORS, [world("a", "b", "c")])
    assert achieved(only) == {"a", "b", "c"}
    assert only.completed
    assert only.active == set()


SLALOM = network({"pole-1": "Go", "pole-2": "Go"}, ("pole-1", "pole-2", ENABLING))


def test_slalom_does_not_turn_back_to_the_pole_it_left() -> None:
    outcomes = run(
        SLALOM,
        BEHAVIORS,
        [world(), world("pole-1", unmet=("pole-2",)), world(unmet=("pole-2",)), world(), world("pole-2")],
    )
    assert [o.active for o in outcomes] == [{"pole-1"}, {"pole-2"}, {"pole-2"}, {"pole-2"}, set()]
    assert [o.searching for o in outcomes] == [set(), {"pole-2"}, {"pole-2"}, set(), set()]
    assert [o.levels["pole-1"] for o in outcomes] == [1, 0, 0, 0, 0]
    assert outcomes[4].completed  # its turn still: achieved although pole-1 is out of sight


def test_enabling_is_looked_at_when_the_component_becomes_active() -> None:
    either = network({"a": "Go", "b": "Go", "c": "Go"}, ("a", "c", ENABLING), ("b", "c", ORDERING))
    outcomes = run(either, BEHAVIORS, [world("a"), world("b"), world("a", "c")])
    assert outcomes[1].refusals["c"] == {("enabling", "a")}  # achieved, but lost before c could begin
    assert outcomes[1].active == {"a"}  # so a is to be done again
    assert outcomes[2].completed


def test_enabling_lost_before_its_turn_does_not_let_the_goal_count() -> None:
    either = network({"a": "Go", "b": "Go", "c": "Go"}, ("a", "c", ENABLING), ("b", "c", ORDERING))
    outcomes = run(either, BEHAVIORS, [world("a"), world("b", "c")])
    assert achieved(outcomes[1]) == {"a", "b"}


def test_a_broken_permanent_condition_sends_the_run_back_and_then_on_again() -> None:
    carry = network({"pick": "Grip", "go": "Go"}, ("pick", "go", PERMANENT))
    outcomes = run(carry, BEHAVIORS, [world(), world("pick"), world(), world("pick"), world("pick", "go")])
    assert [o.executing for o in outcomes] == [{"pick"}, {"go"}, {"pick"}, {"go"}, set()]
    assert outcomes[2].refusals == {"go": {("permanent", "pick")}}
    assert achieved(outcomes[2]) == {"pick"}
    assert outcomes[4].completed


def test_a_goal_reached_while_the_permanent_condition_is_broken_does_not_count() -> None:
    carry = network({"pick": "Grip", "go": "Go"}, ("pick", "go", PERMANENT))
    outcomes = run(carry, BEHAVIORS, [world("pick"), world("go")])
    assert achieved(outcomes[1]) == {"pick"}
    assert not outcomes[1].completed


def test_every_reason_is_recorded() -> None:
    three = network(
        {"o": "Look", "e": "Look", "p": "Look", "rival": "Look", "c": "Look", "d": "Look"},
        ("o", "c", ORDERING), ("e", "c", ENABLING), ("p", "c", PERMANENT), ("c", "d", ORDERING),
        inhibitions=(("rival", "c"),),
    )  # fmt: skip
    outcomes = run(three, BEHAVIORS, [world(), world()])
    wants = {("ordering", "o"), ("enabling", "e"), ("permanent", "p")}
    assert outcomes[0].refusals == {"c": wants, "d": {("ordering", "c")}}
    assert outcomes[1].refusals == {"c": wants | {("inhibited", "rival")}, "d": {("ordering", "c")}}


OPEN = network({"a": "Go", "b": "Go", "c": "Grip"})


def test_unordered_components_search_together_and_the_first_in_view_takes_the_wheels() -> None:
    outcomes = run(
        OPEN,
        BEHAVIORS,
        [world("c", unmet=("a", "b")), world("c", unmet=("a",)), world("c"), world("b", "c"), world("a", "c")],
    )
    assert [o.searching for o in outcomes] == [{"a", "b"}, {"a"}, {"a"}, set(), set()]
    assert [o.executing for o in outcomes] == [set(), {"b"}, {"b"}, {"a"}, set()]
    assert outcomes[0].refusals["a"] == {("precondition",)}
    assert outcomes[2].refusals["a"] == {("locked", "b", "wheels")}  # b executed before and keeps them
    assert outcomes[4].completed


def test_disjoint_actuators_execute_together() -> None:
    (only,) = run(OPEN, BEHAVIORS, [world()])
    assert only.executing == {"a", "c"}
    assert only.refusals == {"b": {("locked", "a", "wheels")}}  # a comes first in the document


def test_the_higher_level_takes_the_lock_before_document_order() -> None:
    needed = network({"a": "Go", "b": "Go", "x": "Look", "y": "Look"}, ("b", "x", ORDERING), ("b", "y", ORDERING))
    (only,) = run(needed, BEHAVIORS, [world()])
    assert only.levels["b"] == 2
    assert only.executing == {"b"}


def test_who_searches_keeps_no_lock() -> None:
    outcomes = run(OPEN, BEHAVIORS, [world(), world(unmet=("a",)), world()])
    assert [o.executing - {"c"} for o in outcomes] == [{"a"}, {"b"}, {"b"}]


def test_actuators_are_taken_all_or_none() -> None:
    both = network({"a": "Go", "both": "Fetch", "c": "Grip"})
    outcomes = run(both, BEHAVIORS, [world(), world("a", "c"), world("c")])
    assert outcomes[0].executing == {"a", "c"}  # the gripper was free, but "both" did not take it alone
    assert outcomes[0].refusals["both"] == {("locked", "a", "wheels")}
    assert outcomes[1].executing == {"both"}


def test_inhibition_works_from_the_next_tick_on() -> None:
    rivals = network({"a": "Go", "b": "Grip"}, inhibitions=(("a", "b"),))
    outcomes = run(rivals, BEHAVIORS, [world(), world("b"), world("a"), world("b"), world("b")])
    assert outcomes[0].executing == {"a", "b"}
    assert outcomes[1].executing == {"a"}
    assert outcomes[1].refusals == {"b": {("inhibited", "a")}}
    assert not outcomes[1].effects["b"]  # computes nothing: keeps its last value
    assert achieved(outcomes[2]) == {"a"}  # a is done; b is inhibited once more because a executed in tick 2
    assert outcomes[2].active == set()
    assert achieved(outcomes[3]) == {"a", "b"}
    assert outcomes[3].completed


def test_an_inhibited_component_is_read_with_its_last_effects() -> None:
    carry = network({"a": "Look", "pick": "Grip", "go": "Go"}, ("pick", "go", PERMANENT), inhibitions=(("a", "pick"),))
    outcomes = run(carry, BEHAVIORS, [world("pick"), world()])
    assert outcomes[1].effects["pick"]
    assert outcomes[1].executing == {"a", "go"}


def test_an_inhibited_component_achieves_nothing() -> None:
    rivals = network({"a": "Go", "b": "Grip", "r": "Look"}, ("a", "b", ORDERING), inhibitions=(("r", "b"),))
    outcomes = run(rivals, BEHAVIORS, [world("b"), world("a", "b", "r"), world("a", "b", "r")])
    assert outcomes[1].effects["b"]
    assert [achieved(o) for o in outcomes] == [set(), {"a", "r"}, {"a", "b", "r"}]


def test_an_inhibited_component_still_asks_for_its_preparation() -> None:
    """Reading 6, pinned."""
    rivals = network({"a": "Grip", "b": "Go", "r": "Look"}, ("a", "b", ORDERING), inhibitions=(("r", "b"),))
    outcomes = run(rivals, BEHAVIORS, [world(), world()])
    assert outcomes[1].refusals == {"b": {("ordering", "a"), ("inhibited", "r")}}
    assert outcomes[1].levels == {"a": 1, "b": 1, "r": 1}
    assert outcomes[1].executing == {"a", "r"}


def test_who_is_stopped_is_asked_for_its_enabling_links_from_the_next_tick_on() -> None:
    """Reading 3, pinned."""
    both = network({"e": "Look", "p": "Look", "c": "Go"}, ("e", "c", ENABLING), ("p", "c", PERMANENT))
    outcomes = run(both, BEHAVIORS, [world("e", "p"), world("p"), world(), world()])
    assert [o.active for o in outcomes] == [{"c"}, {"c"}, {"p"}, {"e", "p"}]
    assert outcomes[2].refusals["c"] == {("permanent", "p")}
    assert outcomes[3].refusals["c"] == {("permanent", "p"), ("enabling", "e")}


def test_only_execution_inhibits() -> None:
    rivals = network({"a": "Go", "b": "Grip"}, inhibitions=(("a", "b"),))
    outcomes = run(rivals, BEHAVIORS, [world(unmet=("a",)), world(unmet=("a",))])
    assert outcomes[1].searching == {"a"}
    assert outcomes[1].executing == {"b"}


def test_continue_keeps_a_component_active_although_nobody_needs_it() -> None:
    chain = network({"a": "Go", "b": "Go"}, ("a", "b", ORDERING))
    outcomes = run(chain, BEHAVIORS, [world(), world("a", continues=("a",)), world("a")])
    assert outcomes[1].levels["a"] == 0
    assert outcomes[1].active == {"a", "b"}
    assert outcomes[1].executing == {"a"}  # and it keeps the wheels
    assert outcomes[1].refusals == {"b": {("locked", "a", "wheels")}}
    assert outcomes[2].executing == {"b"}


def test_continue_outlives_a_broken_permanent_condition_but_not_inhibition() -> None:
    carry = network(
        {"pick": "Look", "go": "Go", "rival": "Grip"}, ("pick", "go", PERMANENT), inhibitions=(("rival", "go"),)
    )
    outcomes = run(
        carry,
        BEHAVIORS,
        [world("pick", unmet=("rival",)), world(continues=("go",)), world("pick", continues=("go",))],
    )
    assert outcomes[0].executing == {"go"}
    assert outcomes[1].executing == {"go", "pick", "rival"}
    assert outcomes[2].refusals["go"] == {("inhibited", "rival")}


def test_a_maintaining_behavior_is_kept_going_while_its_successor_works() -> None:
    hold = network({"hold": "Hold", "go": "Go"}, ("hold", "go", PERMANENT))
    pick = network({"hold": "Grip", "go": "Go"}, ("hold", "go", PERMANENT))
    history = [world(), world("hold"), world("hold"), world("hold", "go")]
    kept = run(hold, BEHAVIORS, history)
    assert [o.executing for o in kept] == [{"hold"}, {"hold", "go"}, {"hold", "go"}, set()]
    assert [o.levels["hold"] for o in kept] == [1, 1, 1, 0]
    assert [o.executing for o in run(pick, BEHAVIORS, history)] == [{"hold"}, {"go"}, {"go"}, set()]


def test_maintaining_counts_over_permanent_links_only() -> None:
    for type_ in (ORDERING, ENABLING):
        outcomes = run(network({"hold": "Hold", "go": "Go"}, ("hold", "go", type_)), BEHAVIORS, [world("hold")] * 2)
        assert [o.levels["hold"] for o in outcomes] == [0, 0]


def test_completion_needs_every_sink_and_lasts() -> None:
    outcomes = run(OPEN, BEHAVIORS, [world("a", "c"), world("b"), world(), world()])
    assert [o.completed for o in outcomes] == [False, True, True, True]
    assert [o.active for o in outcomes] == [{"b"}, set(), set(), set()]
    assert outcomes[3].refusals == {c: {("level",)} for c in "abc"}


def test_a_context_can_be_carried_from_tick_to_tick() -> None:
    context = RefContext.fresh(CHAIN)
    first = tick(CHAIN, BEHAVIORS, context, world("a"))
    assert (context.active, context.executing, context.inhibited, context.complete) == ({"b"}, {"b"}, set(), False)
    first.active.clear()  # the outcome is no window on the context
    assert context.active == {"b"}


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(scenarios())
def test_what_holds_in_every_run(scenario: Scenario) -> None:
    components = {component.id: component for component in scenario.network.components}
    outcomes = run(*scenario)
    previous: RefOutcome | None = None
    for outcome, now in zip(outcomes, scenario.history, strict=True):
        assert outcome.executing <= outcome.active
        assert outcome.searching == outcome.active - outcome.executing
        assert outcome.refusals.keys() == components.keys() - outcome.executing
        assert all(outcome.refusals.values())
        actuators = [a for c in outcome.executing for a in scenario.behaviors[components[c].behavior][0]]
        assert len(actuators) == len(set(actuators))
        if previous is not None:
            assert achieved(previous) <= achieved(outcome)
            assert outcome.completed or not previous.completed
            # Only who continues outlives completion (Reading 17).
            assert not previous.completed or outcome.active <= now.continues
            for by, of in scenario.network.inhibitions:
                assert not (by in previous.executing and of in outcome.active)
        for link in scenario.network.links:  # "requiring achieved(p) everywhere makes links transitive"
            assert outcome.achieved[link.source] or not outcome.achieved[link.target]
            assert outcome.achieved[link.source] or link.target not in outcome.active
        previous = outcome


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(scenarios())
def test_the_same_percepts_give_the_same_run(scenario: Scenario) -> None:
    assert run(*scenario) == run(*scenario)


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much])
@given(st.data())
def test_implied_ordering_links_change_nothing_but_levels(data: st.DataObject) -> None:
    """Reduced and full networks behave identically (semantics §2) as long as nothing is locked.

    The restriction is needed: an implied link still adds 1 to a level, and the level orders the locks.
    """
    full = data.draw(networks())
    paths = {c.id: {link.target for link in full.links if link.source == c.id} for c in full.components}
    for c in reversed(full.topological_order):
        paths[c] |= {further for successor in paths[c] for further in paths[successor]}
    linked = {(link.source, link.target) for link in full.links}
    implied = [(p, c) for p in paths for c in sorted(paths[p]) if (p, c) not in linked]
    assume(implied)
    added = data.draw(st.lists(st.sampled_from(implied), min_size=1, unique=True))
    reduced, full = full, Network(
        components=full.components,
        links=(*full.links, *(Link(source=p, target=c, type=ORDERING) for p, c in added)),
        inhibitions=full.inhibitions,
    )  # fmt: skip
    free: Behaviors = {kind: (NONE, kind == KINDS[0]) for kind in KINDS}
    history = data.draw(histories(reduced, behaviors=free))
    for short, long in zip(run(reduced, free, history), run(full, free, history), strict=True):
        assert (short.effects, short.achieved, short.completed) == (long.effects, long.achieved, long.completed)
        assert (short.active, short.executing) == (long.active, long.executing)
        assert all((short.levels[c] > 0) == (long.levels[c] > 0) for c in short.levels)


def test_an_implied_ordering_link_can_decide_a_lock() -> None:
    """Why the product counts levels over the full set of links: over the stored ones the two would differ here."""
    links = (("b", "c", ORDERING), ("c", "d", ORDERING))
    kinds = {"a": "Go", "b": "Go", "c": "Go", "d": "Go"}
    (reduced,) = run(network(kinds, *links), BEHAVIORS, [world()])
    (full,) = run(network(kinds, *links, ("b", "d", ORDERING)), BEHAVIORS, [world()])
    assert reduced.executing == {"a"}
    assert full.executing == {"b"}


def test_a_maintaining_behavior_leaves_the_actuators_to_its_successor() -> None:
    """Reading 13: it acts on what its successor leaves free, and the wheels are not."""
    wall = network({"wall": "FollowWall", "go": "Go"}, ("wall", "go", PERMANENT))
    outcomes = run(wall, BEHAVIORS, [world("wall")] * 3)
    assert [o.executing for o in outcomes] == [{"go"}] * 3
    assert outcomes[2].refusals == {"wall": {("locked", "go", "wheels")}}


def test_components_that_inhibit_each_other_alternate() -> None:
    """Reading 16, pinned."""
    rivals = network({"a": "Go", "b": "Grip"}, inhibitions=(("a", "b"), ("b", "a")))
    outcomes = run(rivals, BEHAVIORS, [world()] * 4)
    assert [o.executing for o in outcomes] == [{"a", "b"}, set(), {"a", "b"}, set()]


def test_continue_bridges_a_lost_percept() -> None:
    """Reading 10: Continue is there for the transience of sensory data (§3.2.2)."""
    (_, second) = run(network({"a": "Go"}), BEHAVIORS, [world(), world(unmet=("a",), continues=("a",))])
    assert second.executing == {"a"}


def test_an_empty_network_is_complete_at_once() -> None:
    (only,) = run(Network(components=()), BEHAVIORS, [world()])
    assert only.completed
