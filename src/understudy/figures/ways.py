"""Alternatives as they are told and drawn: what comes next, what is bypassed, who has shown it (§5.2)."""

from collections.abc import Collection
from dataclasses import replace

from understudy.network import END, START, Link, LinkType, Network

__all__ = ["always_before", "is_bypassed", "shown_in_words", "with_ways"]


def is_bypassed(network: Network, id_: str) -> bool:
    """Whether a component is never done, since a direct way leads past it."""
    return bool(network.paths) and id_ in network.topology.bypassed


def shown_in_words(network: Network, id_: str, *, names: bool = False) -> str:
    """``shown in 2 of 3 demonstrations``; nothing of what all have shown, or nobody.

    Args:
        network: with alternatives.
        id_: of a component on its ways.
        names: tell which demonstrations.
    """
    topology = network.topology
    shown, count = topology.shown_by[id_], len(topology.demonstrations)
    if len(shown) == count:
        return ""
    return f"shown in {len(shown)} of {count} demonstrations" + (f": {', '.join(shown)}" if names and shown else "")


def always_before(network: Network, source: str, target: str) -> bool:
    """Whether a robot that comes to the second component has always done the first one before."""
    seen: set[str] = {source}
    ahead = [START]
    while ahead:
        for id_ in network.topology.candidates[ahead.pop()]:
            if id_ == target:
                return False
            if id_ not in seen:
                seen.add(id_)
                ahead.append(id_)
    return True


def with_ways(network: Network) -> Network:
    """The same as a plain network, for drawing: every step of the ways that has no link is an ordering link."""
    if not network.paths:
        return network
    linked: Collection[tuple[str, str]] = {(link.source, link.target) for link in network.links}
    steps = tuple(
        Link(source=edge.source, target=edge.target, type=LinkType.ORDERING)
        for edge in network.paths
        if edge.source != START and edge.target != END and (edge.source, edge.target) not in linked
    )
    return replace(network, links=(*network.links, *steps), paths=())
