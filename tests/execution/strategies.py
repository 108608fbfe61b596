"""Hypothesis strategies: networks, the behaviors in them, and histories of a world in which tasks make progress."""

from typing import NamedTuple

from hypothesis import strategies as st

from understudy.network import (
    END,
    START,
    Achieved,
    After,
    AllOf,
    AnyOf,
    Case,
    Complete,
    Component,
    Condition,
    Edge,
    Happened,
    Holds,
    Link,
    LinkType,
    Nab,
    Network,
    Not,
    Possible,
    Repeat,
    Switch,
    TimedOut,
    Timeout,
    Topology,
    Trigger,
)

from .reference import Behaviors, RefContext, World, tick

__all__ = [
    "KINDS",
    "SENSES",
    "Scenario",
    "behavior_tables",
    "hierarchies",
    "histories",
    "networks",
    "scenarios",
    "with_alternatives",
]

KINDS = ("Approach", "Grasp", "Watch", "Shove")
"""The names of the behaviors. What each controls is drawn anew for every example."""


SENSES = ("Light", "Dark")
"""Skills that only conditions ask for."""

EVENTS = ("bell", "late")
TICK_S = 0.5


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


def _conditions(ids: list[str], timed: list[str], *, switching: bool = False) -> st.SearchStrategy[Condition]:
    """Conditions that may be asked in a network with these components, and these among them with a timeout."""
    simple: list[st.SearchStrategy[Condition]] = [
        st.sampled_from(SENSES).map(lambda name: Holds(behavior=name)),
        st.sampled_from(SENSES).map(lambda name: Possible(behavior=name)),
        st.sampled_from(EVENTS).map(lambda name: Happened(event=name)),
        st.sampled_from(ids).map(lambda id_: Achieved(component=id_)),
        st.integers(0, 6).map(lambda count: After(seconds=count * TICK_S)),
    ]
    if timed:
        simple.append(st.sampled_from(timed).map(lambda id_: TimedOut(component=id_)))
    if switching:
        simple += [st.just(Complete())] * 2
    return st.recursive(
        st.one_of(simple),
        lambda inner: st.one_of(
            inner.map(lambda of: Not(of=of)),
            st.lists(inner, min_size=1, max_size=2).map(lambda of: AllOf(of=tuple(of))),
            st.lists(inner, min_size=1, max_size=2).map(lambda of: AnyOf(of=tuple(of))),
        ),
        max_leaves=3,
    )


@st.composite
def hierarchies(draw: st.DrawFn, depth: int = 2) -> Network:
    """Networks in networks, with every control structure."""
    flat = draw(networks(max_components=5 if depth == 2 else 3))
    ids = [component.id for component in flat.components]
    waited_for = {link.source for link in flat.links}
    timeouts: dict[str, Timeout] = {}
    for id_ in ids:
        if draw(_chance(20)):
            then = draw(st.sampled_from(("skip", "stop", "signal")))
            event = "late" if then == "signal" else ""
            timeouts[id_] = Timeout(seconds=draw(st.integers(1, 5)) * TICK_S, then=then, event=event)
    conditions = _conditions(ids, list(timeouts))
    components: list[Component | Nab] = []
    free = [id_ for id_ in ids if id_ not in waited_for]
    for component in flat.components:
        id_ = component.id
        until = draw(conditions) if draw(_chance(10)) else None
        trigger = None
        if id_ not in waited_for and len(free) > 1 and draw(_chance(30)):
            free.remove(id_)
            periodic = draw(st.booleans())
            trigger = Trigger(every_s=draw(st.integers(1, 4)) * TICK_S) if periodic else Trigger(on=draw(conditions))
        if depth and draw(_chance(40)):
            components.append(draw(_nabs(id_, depth - 1, conditions, until, timeouts.get(id_), trigger)))
        else:
            components.append(
                Component(id=id_, behavior=component.behavior, until=until, timeout=timeouts.get(id_), trigger=trigger)
            )
    network = Network(tuple(components), flat.links, flat.inhibitions)
    return draw(with_alternatives(network)) if draw(_chance(25)) else network


@st.composite
def with_alternatives(draw: st.DrawFn, network: Network) -> Network:
    """The same components on ways from START to END, with those of their links for which a way is there."""
    ids = [id_ for id_ in network.topological_order if network.by_id[id_].trigger is None]
    stops = [START, *ids, END]
    steps: dict[tuple[str, str], None] = {}
    for place in range(1, len(stops) - 1):
        near = max(0, place - 3)
        steps[stops[draw(st.integers(near, place - 1))], stops[place]] = None
        steps[stops[place], stops[draw(st.integers(place + 1, min(place + 3, len(stops) - 1)))]] = None
    for first in range(len(ids)):
        if draw(_chance(20)):
            last = draw(st.integers(first + 1, len(stops) - 1))
            if (first, last) != (0, len(stops) - 1):
                steps[stops[first], stops[last]] = None
    edges = tuple(Edge(source=source, target=target) for source, target in draw(st.permutations(list(steps))))
    topology = Topology(ids, edges)
    links = tuple(
        link
        for link in network.links
        if link.target in ids and link.source in ids and topology.leads(link.source, link.target)
    )
    return Network(network.components, links, network.inhibitions, edges)


@st.composite
def _nabs(
    draw: st.DrawFn,
    id_: str,
    depth: int,
    conditions: st.SearchStrategy[Condition],
    until: Condition | None,
    timeout: Timeout | None,
    trigger: Trigger | None,
) -> Nab:
    inner = [draw(hierarchies(depth)) for _ in range(draw(st.sampled_from((1, 1, 2))))]
    cases = [
        Case(name=f"k{index}" if len(inner) > 1 else "", network=network, when=draw(conditions | st.none()))
        for index, network in enumerate(inner)
    ]
    # A case that an earlier one makes unreachable is refused: the first asks, and the switches lead everywhere.
    switches: list[Switch] = []
    if len(cases) > 1:
        if cases[0].when is None or draw(st.booleans()):
            for source, target in ((0, 1), (1, 0)):
                ids = [component.id for component in inner[source].components]
                timed = [component.id for component in inner[source].components if component.timeout]
                when = draw(_conditions(ids, timed, switching=True))
                switches.append(Switch(source=cases[source].name, target=cases[target].name, when=when))
        elif cases[1].when == cases[0].when:
            cases[1] = Case(name="k1", network=inner[1])
    repeat = None
    if draw(_chance(40)):
        ending = draw(conditions) if draw(st.booleans()) else None
        repeat = Repeat(times=draw(st.integers(1, 3) | st.none()), until=ending)
    return Nab(
        id=id_,
        cases=tuple(cases),
        switches=tuple(switches),
        repeat=repeat,
        until=until,
        timeout=timeout,
        trigger=trigger,
    )


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
    parts = {path: part for path, part in network.walk() if isinstance(part, Component)}
    table = behaviors if behaviors is not None else {c.behavior: (frozenset[str](), False) for c in parts.values()}
    ids = list(parts)
    ticks = draw(st.integers(1, max_ticks) | st.just(max_ticks))
    by_itself = draw(st.sampled_from((4, 0, 15)))
    by_searching = max(by_itself, 20)
    effects = dict.fromkeys(ids, False)
    preconditions = dict.fromkeys(ids, True)
    senses = {f"{prefix}{name}()": False for name in SENSES for prefix in ("", "possible ")}
    context = RefContext.fresh(network)
    worlds: list[World] = []
    for number in range(ticks):
        for c in ids:
            executing, active = c in context.executing, c in context.active
            if effects[c]:
                _, maintaining = table[parts[c].behavior]
                changes = draw(_chance(35 if maintaining and not executing else 10))
            else:
                changes = draw(_chance(60 if executing else by_searching if active else by_itself))
            effects[c] ^= changes
            preconditions[c] ^= draw(_chance(10 if preconditions[c] else 50))
        continues: frozenset[str] = frozenset()
        if behaviors is not None:
            continues = frozenset(c for c in ids if c in context.executing and draw(_chance(15)))
        events = frozenset[str]()
        if not network.flat or any(c.trigger or c.until or c.timeout for c in network.components):
            for text in senses:
                senses[text] ^= draw(_chance(25))
            events = frozenset({"bell"}) if draw(_chance(20)) else events
        world = World(
            effects=dict(effects),
            preconditions=dict(preconditions),
            continues=continues,
            time_s=number * TICK_S,
            events=events,
            senses=dict(senses),
        )
        tick(network, table, context, world)
        worlds.append(world)
    return worlds


@st.composite
def scenarios(
    draw: st.DrawFn, max_components: int = 8, max_ticks: int = 12, *, nested: bool = False, alternatives: bool = False
) -> Scenario:
    """A network, its behaviors and a history that fits both."""
    network = draw(hierarchies() if nested else networks(max_components=max_components))
    if alternatives:
        network = draw(with_alternatives(network))
    behaviors = draw(behavior_tables())
    return Scenario(network, behaviors, draw(histories(network, max_ticks=max_ticks, behaviors=behaviors)))
