"""Execution over alternatives against the paths themselves, enumerated one by one (§5.3)."""

from collections.abc import Iterator

from hypothesis import given, settings

from understudy.execution import Activation, Context
from understudy.network import END, START, Component, Edge, Link, LinkType, Network

from .reference import World
from .strategies import Scenario, scenarios
from .support import compiled
from .test_activation import decide

Path = tuple[str, ...]


def all_paths(network: Network, begin: str = START) -> Iterator[Path]:
    for edge in network.paths:
        if edge.source == begin:
            if edge.target == END:
                yield (END,)
            else:
                yield from ((edge.target, *rest) for rest in all_paths(network, edge.target))


def executable(network: Network) -> list[Path]:
    """The paths that no direct way leads past: nowhere could one have gone on with what comes later than the next."""
    paths = list(all_paths(network))

    def comes_after(first: str, last: str) -> bool:
        return any(first in path and last in path[path.index(first) + 1 :] for path in paths)

    def stands(path: Path) -> bool:
        for place, next_ in enumerate(path):
            before = path[place - 1] if place else START
            others = [edge.target for edge in network.paths if edge.source == before]
            if any(comes_after(next_, other) for other in others):
                return False
        return True

    return [path for path in paths if stands(path)]


@settings(max_examples=200)
@given(scenarios(max_components=6, alternatives=True))
def test_preconditions_are_a_disjunction_over_paths_of_conjunctions_over_their_nodes(scenario: Scenario) -> None:
    network = scenario.network
    paths = executable(network)
    program = compiled(network, scenario.behaviors)
    context = Context.start(program)
    activation = Activation(program, context)
    ids = [node.id for node in program.nodes]
    types = {(link.source, link.target): link.type for link in network.links}

    def satisfied(source: str, target: str, was_active: bool) -> bool:
        row = program.rows[source]
        type_ = types.get((source, target), LinkType.ORDERING)
        lasting = type_ is LinkType.ORDERING or context.effects[row] or (type_ is LinkType.ENABLING and was_active)
        return context.achieved[row] and lasting

    for world in scenario.history:
        before = context.active
        step = decide(activation, world, ids)
        way = tuple(ids[row] for row in context.taken.get(0, ()))
        open_ = [path for path in paths if path[: len(way)] == way]
        assert open_, "the way that was taken is no executable path"
        assert set(way) == {id_ for id_ in ids if context.achieved[program.rows[id_]]}
        assert step.complete == ((*way, END) in open_)
        next_ = {path[len(way)] for path in open_}
        for id_ in ids:
            row = program.rows[id_]
            active = row in step.active and row not in context.keep_on
            met = any(
                all(satisfied(one, id_, row in before) for one in path[: path.index(id_)])
                for path in paths
                if id_ in path
            )
            assert met or not active, f"{id_} is active, and on no path all before it is as it must be"
            if row not in context.inhibited and id_ in next_:
                assert (row in step.active) >= met, f"{id_} may come next, and is not active"
            assert not active or id_ in next_ or id_ in way
        activation.commit(step)


def edges(text: str) -> tuple[Edge, ...]:
    return tuple(Edge(source=a, target=b) for a, b in (pair.split() for pair in text.split(",")))


def run(network: Network, *worlds: set[str]) -> tuple[list[set[str]], Context]:
    """Who is active in each of these worlds, given by the goals that hold in them."""
    program = compiled(network, {"A": (frozenset({"wheels"}), False)})
    context = Context.start(program)
    activation = Activation(program, context)
    ids = [node.id for node in program.nodes]
    active = []
    for true in worlds:
        step = decide(activation, World(effects=dict.fromkeys(true, True)), ids)
        active.append({ids[row] for row in step.active})
        activation.commit(step)
    return active, context


def network(ways: str, *links: tuple[str, str, LinkType]) -> Network:
    paths = edges(ways)
    ids = dict.fromkeys(edge.source for edge in paths if edge.source != START)
    return Network(
        tuple(Component(id=id_, behavior="A") for id_ in ids),
        tuple(Link(source=source, target=target, type=type_) for source, target, type_ in links),
        paths=paths,
    )


FIGURE_5_7 = "START a, a c, c b, a b, b f, f d, f e, d END, e END"


def test_the_direct_way_wins_and_the_first_achieved_of_several_is_the_choice() -> None:
    active, context = run(network(FIGURE_5_7), set(), {"a", "c"}, {"c", "b"}, {"f"}, set(), {"e"}, {"d"})
    assert active == [{"a"}, {"b"}, {"f"}, {"d", "e"}, {"d", "e"}, set(), set()]
    assert context.taken == {0: (0, 2, 3, 5)}


def test_of_two_at_once_the_first_in_the_document_is_taken() -> None:
    _, context = run(network("START a, START b, a END, b END"), {"a", "b"})
    assert context.taken == {0: (0,)}
    # Also of two that come to be candidates in the same tick, one of them written before what leads to them.
    task = Network(
        tuple(Component(id=id_, behavior="A") for id_ in "cab"), paths=edges("START a, a b, a c, b END, c END")
    )
    _, context = run(task, {"a", "b", "c"})
    assert context.taken == {0: (1, 0)}


def test_a_broken_condition_leads_back_along_the_way_that_was_taken() -> None:
    task = network(
        "START a, START b, a c, b c, c d, d END",
        ("a", "d", LinkType.PERMANENT), ("b", "d", LinkType.PERMANENT), ("a", "c", LinkType.ENABLING),
    )  # fmt: skip
    by_a, _ = run(task, set(), {"a"}, {"a", "c"}, {"c"}, {"a"}, {"a", "d"})
    assert by_a == [{"a", "b"}, {"c"}, {"d"}, {"a"}, {"d"}, set()]
    by_b, context = run(task, {"b"}, {"c", "b"}, {"c"}, {"b"}, {"b", "d"})
    assert by_b == [{"c"}, {"d"}, {"b"}, {"d"}, set()]
    assert not context.achieved[0]  # nothing is asked of the way that was not taken


def test_the_world_may_jump_forward_along_a_way() -> None:
    active, context = run(network(FIGURE_5_7), {"a", "b", "f", "e", "c"})
    assert active == [set()]
    assert context.taken == {0: (0, 2, 3, 5)}


def test_end_may_lie_beside_other_steps() -> None:
    active, _ = run(network("START a, a b, b END, a END"), {"a"}, {"b"})
    assert active == [set(), set()]
