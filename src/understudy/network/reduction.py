"""Ordering links that a path implies: taking them out, and putting them back (semantics §2).

Every satisfied link requires its source to be achieved, so links are transitive. A network and its reduced form behave
alike; the reduced one can be read. Both are made at every depth of a hierarchy.
"""

from collections.abc import Callable
from dataclasses import replace

from understudy.network.definition import Component, Link, LinkType, Network
from understudy.network.topology import END

__all__ = ["expand_links", "reduce_links"]


def reduce_links(network: Network) -> Network:
    """The network without the ordering links that a path of other links, of any type, implies.

    Where there are alternatives, none is left: the ways through the network imply every order.

    What is left out does not depend on the order in which the links are looked at: a path that implies one link never
    needs another implied one, because that, too, has its path.
    """
    rank, reached = _reached_in_steps(network)
    links = tuple(
        link
        for link in network.links
        if link.type is not LinkType.ORDERING or not reached[link.source] >> rank[link.target] & 1
    )
    return replace(_inside(network, reduce_links), links=links)


def expand_links(network: Network) -> Network:
    """The network with an ordering link for every pair that a path joins and no link does: the full set (§5.1.2, too).

    The added links follow the given ones, in document order, and carry no evidence of their own: it is the path's.
    """
    rank, reached = _reached_in_steps(network)
    direct = {(link.source, link.target) for link in network.links}
    added = tuple(
        Link(source=source.id, target=target.id, type=LinkType.ORDERING)
        for source in network.components
        for target in network.components
        if reached[source.id] >> rank[target.id] & 1 and (source.id, target.id) not in direct
    )
    return replace(_inside(network, expand_links), links=network.links + added)


def _inside(network: Network, change: Callable[[Network], Network]) -> Network:
    """The network with every network that stands in it changed."""
    if network.flat:
        return network
    components = tuple(
        part
        if isinstance(part, Component)
        else replace(part, cases=tuple(replace(case, network=change(case.network)) for case in part.cases))
        for part in network.components
    )
    return replace(network, components=components)


def _reached_in_steps(network: Network) -> tuple[dict[str, int], dict[str, int]]:
    """The rank of every component, and the ranks (one bit each) that a path of two links or more leads to from it.

    A step of the ways through the network orders what it joins without a link.
    """
    rank = {id_: index for index, id_ in enumerate(network.topological_order)}
    next_ = network.topology.successors if network.paths else {}
    in_steps: dict[str, int] = {}
    reached: dict[str, int] = {}
    for id_ in reversed(network.topological_order):
        further = near = 0
        for after in next_.get(id_, ()):
            if after != END:
                further |= 1 << rank[after] | reached[after]
        for link in network.outgoing[id_]:
            near |= 1 << rank[link.target]
            further |= reached[link.target]
        in_steps[id_] = further
        reached[id_] = near | further
    return rank, in_steps
