"""What feedback makes of a task: a step taken out, or a learned piece put in before one (§6.1, §6.2)."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from understudy.errors import NetworkError
from understudy.generalization import Symbol, symbol_of
from understudy.network import END, START, Component, Edge, Link, LinkType, Nab, Network, edited, reduce_links

__all__ = ["inserted", "without"]


def without(network: Network, path: str) -> Network:
    """A task without one of its steps: its predecessors come before its successors now (Figure 6.1).

    A network in a component's place that has no other step is taken out with it.

    Args:
        network: the task.
        path: of the step.

    Raises:
        NetworkError: there is no such step, nothing would be left without it, or a condition asks for it.
    """
    inside, home = _home(network, path)
    id_ = path[len(inside) :]
    if len(home.components) == 1:
        around = inside[:-1]
        if not around:
            raise NetworkError(f"{path!r} is the only step of the task, and nothing would be left; teach another task")
        if around not in network.by_path:
            raise NetworkError(f"{path!r} is the only step of the case {around!r}, which would be empty; take that out")
        return without(network, around)

    def change(home: Network) -> Network:
        before = [link.source for link in home.incoming[id_]]
        after = [link.target for link in home.outgoing[id_]]
        kept = [link for link in home.links if id_ not in (link.source, link.target)]
        linked = {(link.source, link.target) for link in kept}
        joined = [
            Link(source=source, target=target, type=LinkType.ORDERING)
            for source in before
            for target in after
            if (source, target) not in linked
        ]
        return Network(
            tuple(part for part in home.components if part.id != id_),
            (*kept, *joined),
            tuple(pair for pair in home.inhibitions if id_ not in pair),
            _joined(home, id_) if home.paths else (),
        )

    return reduce_links(edited(network, inside, change))


def inserted(network: Network, before: str, piece: Network) -> Network:
    """A task in which a learned piece comes before one of its steps (Figure 6.2).

    Every link that entered the step enters the piece: nothing may lead around the new steps (§5.2). What had to hold
    all the while, such as a box that is carried, has to hold during the new steps, too, and still during the old one.

    If the task has these very steps there already, and a direct way led past them, no second ones are made: the direct
    way is closed, as §5.2 has it, and they are done from now on.

    Args:
        network: the task.
        before: the path of the step; END for a piece that comes after everything else.
        piece: what was learned; its ids are changed where they are taken.

    Raises:
        NetworkError: there is no such step.
    """
    if before == END and END not in network.by_id:
        return reduce_links(_appended(network, piece))
    inside, _ = _home(network, before)
    id_ = before[len(inside) :]

    def change(home: Network) -> Network:
        known = _passed_by(home, id_, piece)
        names = known or _free_names(piece, home.by_id)
        steps = [names[one] for one in piece.topological_order]
        first = [names[part.id] for part in piece.components if not piece.incoming[part.id]]
        entering = [link for link in home.incoming[id_] if link.source not in steps]
        lasting = [link for link in entering if link.type is LinkType.PERMANENT]
        into = [
            Link(source=link.source, target=target, type=LinkType.ORDERING)
            for link in entering
            if link not in lasting
            for target in first
        ]
        through = [replace(link, target=step, evidence=()) for link in lasting for step in steps]
        moved = [link for link in entering if link not in lasting]
        old = [link for link in home.links if link not in moved]
        paths = _entered(home.paths, id_, steps)
        if known:
            linked = {(link.source, link.target) for link in old}
            added = [link for link in (*into, *through) if (link.source, link.target) not in linked]
            return replace(home, links=(*old, *added), paths=paths)
        new = tuple(replace(part, id=names[part.id]) for part in piece.components)
        within = _renamed(piece.links, names)
        out = [Link(source=names[sink], target=id_, type=LinkType.ORDERING) for sink in piece.sinks]
        where = next(index for index, part in enumerate(home.components) if part.id == id_)
        components = (*home.components[:where], *new, *home.components[where:])
        return Network(components, (*old, *into, *through, *within, *out), home.inhibitions, paths)

    return reduce_links(edited(network, inside, change))


def _appended(network: Network, piece: Network) -> Network:
    """A task with a learned piece after everything else; nothing but a duty goes on beside it."""
    names = _free_names(piece, network.by_id)
    new = tuple(replace(part, id=names[part.id]) for part in piece.components)
    first = [names[part.id] for part in piece.components if not piece.incoming[part.id]]
    into = [
        Link(source=sink, target=target, type=LinkType.ORDERING)
        for sink in (() if network.paths else network.sinks)
        for target in first
    ]
    steps = [names[one] for one in piece.topological_order]
    links = (*network.links, *into, *_renamed(piece.links, names))
    return Network((*network.components, *new), links, network.inhibitions, _entered(network.paths, END, steps))


def _passed_by(home: Network, id_: str, piece: Network) -> dict[str, str]:
    """The steps of the task that a piece shows, if they lead to this one, and a direct way leads past them.

    Returns:
        Their ids by those of the piece; none if the task has no such steps.
    """
    if not home.paths:
        return {}
    topology = home.topology
    wanted = [symbol_of(part) for part in map(piece.by_id.get, piece.topological_order) if isinstance(part, Component)]
    if len(wanted) != len(piece.components):
        return {}
    branches: list[list[str]] = [[id_]]
    for symbol in reversed(wanted):
        branches = [
            [one, *branch]
            for branch in branches
            for one in topology.predecessors[branch[0]]
            if one in topology.bypassed and _is(home.by_id[one], symbol)
        ]
    for *branch, _ in branches:
        # Who leads to the step must not itself come after what is to be put before it.
        others = [one for one in topology.predecessors[id_] if one not in branch]
        if not any(topology.leads(branch[0], one) for one in others):
            return dict(zip(piece.topological_order, branch, strict=True))
    return {}


def _is(part: Component | Nab, symbol: Symbol) -> bool:
    return isinstance(part, Component) and symbol_of(part) == symbol


def _renamed(links: Iterable[Link], names: Mapping[str, str]) -> list[Link]:
    return [replace(link, source=names[link.source], target=names[link.target]) for link in links]


def _joined(home: Network, id_: str) -> tuple[Edge, ...]:
    """The ways without a step: what came before it comes before what came after it.

    Not so past an alternative to it, which would be bypassed by that: of two ways the other one is left.
    """
    topology = home.topology
    kept = {(edge.source, edge.target): edge for edge in home.paths if id_ not in (edge.source, edge.target)}
    for first in (edge for edge in home.paths if edge.target == id_):
        candidates = topology.candidates[first.source]
        others = [one for one in candidates if one != id_] if id_ in candidates else []
        for last in (edge for edge in home.paths if edge.source == id_):
            pair = first.source, last.target
            if pair == (START, END) or any(topology.leads(one, last.target) for one in others):
                continue
            edge = kept.get(pair, Edge(source=pair[0], target=pair[1]))
            both = [name for name in first.shown if name in last.shown and name not in edge.shown]
            kept[pair] = replace(edge, shown=(*edge.shown, *both))
    return tuple(kept.values())


def _entered(paths: Iterable[Edge], id_: str, steps: Sequence[str]) -> tuple[Edge, ...]:
    """The ways with steps, one after the other, before one that they lead to: none leads around them."""
    edges: dict[tuple[str, str], Edge] = {}
    for edge in paths:
        if edge.target != id_:
            _add(edges, edge)
        elif edge.source not in steps:
            _add(edges, replace(edge, target=steps[0]))
    if not edges:
        return ()
    shown = tuple(dict.fromkeys(name for edge in edges.values() if edge.target == steps[0] for name in edge.shown))
    for source, target in pairwise((*steps, id_)):
        _add(edges, Edge(source=source, target=target, shown=shown))
    return tuple(edges.values())


def _add(edges: dict[tuple[str, str], Edge], edge: Edge) -> None:
    """One more edge, or one that is there already, shown by more demonstrations."""
    pair = edge.source, edge.target
    there = edges.get(pair, edge)
    edges[pair] = replace(there, shown=tuple(dict.fromkeys((*there.shown, *edge.shown))))


def _home(network: Network, path: str) -> tuple[str, Network]:
    try:
        return network.home_of(path)
    except KeyError:
        raise NetworkError(f"no step is called {path!r}; there are: {', '.join(network.by_path)}") from None


def _free_names(piece: Network, taken: Iterable[str]) -> dict[str, str]:
    """New ids where the old ones are taken: ``track-green-1`` becomes the next free number."""
    used, names = set(taken), {}
    for part in piece.components:
        name, stem, number = part.id, part.id.rpartition("-")[0], 1
        if not (part.id.rpartition("-")[2].isdecimal() and stem):
            stem = part.id
        while name in used:
            number += 1
            name = f"{stem}-{number}"
        used.add(name)
        names[part.id] = name
    return names
