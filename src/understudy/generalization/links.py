"""What the steps of a generalised task ask of each other (§5.1.2, Figure 5.6).

| X and Y | link from X to Y |
| --- | --- |
| both in one demonstration only | that demonstration's |
| in different ones | ordering, if X comes before Y |
| both in several | the least restrictive: no link, ordering, enabling, permanent, in this order |

Where there are alternatives, the ways through the task imply every order, and only what is more is stored.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from understudy.network import Link, LinkType, Network, expand_links, reduce_links

__all__ = ["LinksOfWays", "least_restrictive", "links_of_one_way"]

Pair = tuple[str, str]


def least_restrictive(one: LinkType | None, other: LinkType | None) -> LinkType | None:
    """Figure 5.6; no link is less than an ordering link."""
    if one is None or other is None:
        return None
    return min(one, other, key=lambda type_: type_.strength)


def links_of_one_way(known: Network, added: Network) -> tuple[Link, ...]:
    """The links of a task of which all demonstrations show the same steps: every pair is in all of them.

    Args:
        known: the task.
        added: the new demonstration's network, with the task's ids.
    """
    old = {_pair(link): link for link in expand_links(known).links}
    new = {_pair(link): link for link in expand_links(added).links}
    links = []
    for pair, link in old.items():
        type_ = least_restrictive(link.type, new[pair].type if pair in new else None)
        if type_ is not None:
            links.append(_link(pair, type_, link, new[pair]))
    return reduce_links(replace(known, links=tuple(links))).links


class LinksOfWays:
    """The links of a task with alternatives, which are more than an order.

    A link that is not stored is no more than an order, and no demonstration makes it more again. So a further one
    changes only the links between steps that it shows itself.

    Args:
        links: of the task so far; if it had no alternatives yet, those that are mere orders go without saying now.
    """

    def __init__(self, links: Iterable[Link]) -> None:
        self._stored = {_pair(link): link for link in links if link.type is not LinkType.ORDERING}
        self._targets: dict[str, set[str]] = {}
        for source, target in self._stored:
            self._targets.setdefault(source, set()).add(target)

    @property
    def links(self) -> tuple[Link, ...]:
        """All of them, in the order in which they became known."""
        return tuple(self._stored.values())

    def add(
        self, added: Network, ids: Mapping[str, str], matched: frozenset[str], together: Callable[[str, str], bool]
    ) -> None:
        """The links of one more demonstration.

        Args:
            added: its network.
            ids: that its steps have in the task.
            matched: those of the task's ids that were known before.
            together: whether some demonstration before showed two of these both.
        """
        new = {(ids[link.source], ids[link.target]): link for link in added.links}
        own = {id_: one for one, id_ in ids.items()}
        leads = _leads(added)
        for source in matched:
            for target in self._targets.get(source, set()) & matched:
                pair = source, target
                link = new.get(pair)
                in_added = LinkType.ORDERING if leads(own[source], own[target]) else None
                type_ = least_restrictive(self._stored[pair].type, link.type if link else in_added)
                if type_ is None or type_ is LinkType.ORDERING:
                    del self._stored[pair]
                    self._targets[source].remove(target)
                else:
                    self._stored[pair] = _link(pair, type_, self._stored[pair], link)
        for pair, link in new.items():
            shown = matched.issuperset(pair) and link.type is not LinkType.ORDERING and together(*pair)
            if link.type is not LinkType.ORDERING and not shown:
                self._stored[pair] = replace(link, source=pair[0], target=pair[1])
                self._targets.setdefault(pair[0], set()).add(pair[1])


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
