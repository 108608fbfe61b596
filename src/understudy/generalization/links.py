"""What the steps of a generalised task ask of each other (§5.1.2, Figure 5.6).

| X and Y | link from X to Y |
| --- | --- |
| both in one demonstration only | that demonstration's |
| in different ones | ordering, if X comes before Y |
| both in several | the least restrictive: no link, ordering, enabling, permanent, in this order |

Where there are alternatives, the ways through the task imply every order, and only what is more is stored.
"""

from collections.abc import Callable
from dataclasses import replace

from understudy.network import Link, LinkType, Network, Topology, expand_links, reduce_links

__all__ = ["least_restrictive", "merged_links"]

Pair = tuple[str, str]


def least_restrictive(one: LinkType | None, other: LinkType | None) -> LinkType | None:
    """Figure 5.6; no link is less than an ordering link."""
    if one is None or other is None:
        return None
    return min(one, other, key=lambda type_: type_.strength)


def merged_links(known: Network, added: Network, before: Topology, *, alternatives: bool) -> tuple[Link, ...]:
    """The links of a generalised task.

    Args:
        known: the task.
        added: the new demonstration's network, in which the steps that were matched have the task's ids.
        before: the ways through the task, without the new demonstration.
        alternatives: there is more than one way now.
    """
    if not alternatives:
        return _of_one_way(known, added)
    stored = {_pair(link): link for link in known.links}
    new = {_pair(link): link for link in added.links}
    in_known, in_added = _type_of(known, before), _type_of(added, None)
    links = []
    for pair in dict.fromkeys((*stored, *new)):
        if not all(id_ in added.by_id for id_ in pair):
            type_ = in_known(pair)
        elif pair in stored or _shown_together(before, pair):
            type_ = least_restrictive(in_known(pair), in_added(pair))
        else:
            type_ = in_added(pair)
        if type_ is not None and type_ is not LinkType.ORDERING:
            links.append(_link(pair, type_, stored.get(pair), new.get(pair)))
    return tuple(links)


def _of_one_way(known: Network, added: Network) -> tuple[Link, ...]:
    """All show the same steps: every pair is in all of them."""
    old = {_pair(link): link for link in expand_links(known).links}
    new = {_pair(link): link for link in expand_links(added).links}
    links = []
    for pair, link in old.items():
        type_ = least_restrictive(link.type, new[pair].type if pair in new else None)
        if type_ is not None:
            links.append(_link(pair, type_, link, new[pair]))
    return reduce_links(replace(known, links=tuple(links))).links


def _shown_together(topology: Topology, pair: Pair) -> bool:
    """Whether some demonstration shows both."""
    first, second = (topology.shown_by.get(id_, ()) for id_ in pair)
    return any(name in second for name in first)


def _type_of(network: Network, topology: Topology | None) -> Callable[[Pair], LinkType | None]:
    """What a network asks of two of its steps: by a link, or by what lies between them; by its ways, if it has some."""
    direct = {_pair(link): link.type for link in network.links}
    leads = topology.leads if topology is not None and network.paths else _leads(network)
    return lambda pair: direct.get(pair) or (LinkType.ORDERING if leads(*pair) else None)


def _leads(network: Network) -> Callable[[str, str], bool]:
    rank = {id_: index for index, id_ in enumerate(network.by_id)}
    after: dict[str, int] = {}
    for id_ in reversed(network.topological_order):
        after[id_] = 0
        for link in network.outgoing[id_]:
            after[id_] |= after[link.target] | 1 << rank[link.target]
    return lambda source, target: bool(after[source] >> rank[target] & 1)


def _link(pair: Pair, type_: LinkType, old: Link | None, new: Link | None) -> Link:
    evidence = (*(old.evidence if old else ()), *(new.evidence if new else ()))
    return Link(source=pair[0], target=pair[1], type=type_, evidence=evidence)


def _pair(link: Link) -> Pair:
    return link.source, link.target
