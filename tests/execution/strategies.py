"""Hypothesis strategies: networks, the behaviors in them, and histories of a world in which tasks make progress."""

from typing import NamedTuple

from hypothesis import strategies as st

from understudy.network.definition import Component, Link, LinkType, Network

from .reference import Behaviors, RefContext, World, tick

__all__ = ["KINDS", "Scenario", "behavior_tables", "histories", "networks", "scenarios"]

KINDS = ("Approach", "Grasp", "Watch", "Shove")
"""The names of the behaviors. What each controls is drawn anew for every example."""


class Scenario(NamedTuple):
    """One example of a run: what is executed, by what, and what happens meanwhile."""

    network: Network
    behaviors: Behaviors
    history: list[World]


def _chance(percent: int) -> st.SearchStrategy[bool]:
    """True about so often; shrinks to False."""
    return st.integers(0, 99).map(lambda drawn: drawn >= 100 - percent)


@st.composite
def networks(draw: st.DrawFn, max_components: int = 8) -> Network:
    """Acyclic networks, with document order and topological order independent of each other.

    Neighbours in topological order are usually linked, so that long chains are common; opportunistic parts, several
    sinks and several roots come from the links left out.
    """
    count = draw(st.integers(1, max_components))
    components = tuple(Component(id=f"c{i}", behavior=draw(st.sampled_from(KINDS))) for i in range(count))
    order = draw(st.permutations([component.id for component in components]))
    neighbour_percent = draw(st.sampled_from((80, 40)))
    other_percent = draw(st.sampled_from((10, 30)))
    links = []
    for i, source in enumerate(order):
        for j in range(i + 1, count):
            if draw(_chance(neighbour_percent if j == i + 1 else other_percent)):
                links.append(Link(source=source, target=order[j], type=draw(st.sampled_from(LinkType))))
    rivals: list[tuple[str, str]] = []
    if draw(_chance(40)):
        pairs = [(a.id, b.id) for a in components for b in components if a is not b]
        if pairs:
            rivals = draw(st.lists(st.sampled_from(pairs), max_size=3, unique=True))
    return Network(components=components, links=tuple(links), inhibitions=tuple(rivals))


@st.composite
def behavior_tables(draw: st.DrawFn) -> Behaviors:
    """For each of `KINDS`: the wheels, the gripper, both or neither; one in five is maintaining."""
    sets = [frozenset({"wheels"}), frozenset({"gripper"}), frozenset({"wheels", "gripper"}), frozenset[str]()]
    return {kind: (draw(st.sampled_from(sets)), draw(_chance(20))) for kind in KINDS}


@st.composite
def histories(
    draw: st.DrawFn, network: Network, max_ticks: int = 12, *, behaviors: Behaviors | None = None
) -> list[World]:
    """What the percepts say, tick by tick.

    The world is no simulator, but a goal comes true more readily while its component executes than while it searches,
    and then than by itself; once true it usually stays for a while, and a maintaining one fades when it is not
    executed. To know who executes, the reference is run along. Continue is asserted only by components that executed in
    the previous tick: a primitive that does not run says nothing. Without `behaviors` all are taken to have no
    actuators and not to be maintaining, and nothing asserts Continue.
    """
    table = behaviors if behaviors is not None else {c.behavior: (frozenset[str](), False) for c in network.components}
    ids = [component.id for component in network.components]
    ticks = draw(st.integers(1, max_ticks) | st.just(max_ticks))
    by_itself = draw(st.sampled_from((4, 0, 15)))
    by_searching = max(by_itself, 20)
    effects = dict.fromkeys(ids, False)
    preconditions = dict.fromkeys(ids, True)
    context = RefContext.fresh(network)
    worlds: list[World] = []
    for _ in range(ticks):
        for c in ids:
            executing, active = c in context.executing, c in context.active
            if effects[c]:
                _, maintaining = table[network.by_id[c].behavior]
                changes = draw(_chance(35 if maintaining and not executing else 10))
            else:
                changes = draw(_chance(60 if executing else by_searching if active else by_itself))
            effects[c] ^= changes
            preconditions[c] ^= draw(_chance(10 if preconditions[c] else 50))
        continues: frozenset[str] = frozenset()
        if behaviors is not None:
            continues = frozenset(c for c in ids if c in context.executing and draw(_chance(15)))
        world = World(effects=dict(effects), preconditions=dict(preconditions), continues=continues)
        tick(network, table, context, world)
        worlds.append(world)
    return worlds


@st.composite
def scenarios(draw: st.DrawFn, max_components: int = 8, max_ticks: int = 12) -> Scenario:
    """A network, its behaviors and a history that fits both."""
    network = draw(networks(max_components=max_components))
    behaviors = draw(behavior_tables())
    return Scenario(network, behaviors, draw(histories(network, max_ticks=max_ticks, behaviors=behaviors)))
