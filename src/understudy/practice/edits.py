"""What feedback makes of a task: a step taken out, or a learned piece put in before one (§6.1, §6.2)."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

from understudy.errors import NetworkError
from understudy.network import END, START, Edge, Link, LinkType, Network, edited, reduce_links

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

    Args:
        network: the task.
        before: the path of the step.
        piece: what was learned; its ids are changed where they are taken.

    Raises:
        NetworkError: there is no such step.
    """
    inside, _ = _home(network, before)
    id_ = before[len(inside) :]

    def change(home: Network) -> Network:
        names = _free_names(piece, home.by_id)
        new = [replace(part, id=names[part.id]) for part in piece.components]
        within = [replace(link, source=names[link.source], target=names[link.target]) for link in piece.links]
        first = [names[part.id] for part in piece.components if not piece.incoming[part.id]]
        entering = home.incoming[id_]
        lasting = [link for link in entering if link.type is LinkType.PERMANENT]
        into = [
            Link(source=link.source, target=target, type=LinkType.ORDERING)
            for link in entering
            if link not in lasting
            for target in first
        ]
        through = [replace(link, target=part.id, evidence=()) for link in lasting for part in new]
        out = [Link(source=names[sink], target=id_, type=LinkType.ORDERING) for sink in piece.sinks]
        old = [link for link in home.links if link.target != id_ or link in lasting]
        where = next(index for index, part in enumerate(home.components) if part.id == id_)
        components = (*home.components[:where], *new, *home.components[where:])
        steps = [names[one] for one in piece.topological_order]
        return Network(
            components, (*old, *into, *through, *within, *out), home.inhibitions, _entered(home.paths, id_, steps)
        )

    return reduce_links(edited(network, inside, change))


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
    """The ways with new steps, one after the other, before one that they lead to: none leads around the new ones."""
    edges = tuple(replace(edge, target=steps[0]) if edge.target == id_ else edge for edge in paths)
    if not edges:
        return ()
    shown = tuple(dict.fromkeys(name for edge in edges if edge.target == steps[0] for name in edge.shown))
    return (*edges, *(Edge(source=a, target=b, shown=shown) for a, b in pairwise((*steps, id_))))


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
