"""A network with one thing changed; the given one stays as it is."""

from collections.abc import Callable
from dataclasses import replace

from understudy.errors import NetworkError
from understudy.network.definition import Case, LinkType, Nab, Network
from understudy.network.reduction import expand_links, reduce_links

__all__ = ["edited", "relinked"]


def edited(network: Network, inside: str, change: Callable[[Network], Network]) -> Network:
    """A task in which one network of its hierarchy is changed.

    Args:
        network: the task.
        inside: what the paths of that network's components begin with, as :meth:`Network.home_of` tells it; empty for
            the task itself.
        change: from that network to the one in its place.

    Raises:
        KeyError: no network stands there.
        NetworkError: the changed network is none, or does not fit where it stands.
    """
    if not inside:
        return change(network)
    for index, part in enumerate(network.components):
        if not isinstance(part, Nab):
            continue
        for number, case in enumerate(part.cases):
            begins = "/".join(filter(None, (part.id, case.name))) + "/"
            if inside.startswith(begins):
                inner: Case = replace(case, network=edited(case.network, inside[len(begins) :], change))
                cases = (*part.cases[:number], inner, *part.cases[number + 1 :])
                components = (*network.components[:index], replace(part, cases=cases), *network.components[index + 1 :])
                return replace(network, components=components)
    raise KeyError(inside)


def relinked(network: Network, source: str, target: str, type_: LinkType | None) -> Network:
    """A task in which one link has another type, or is taken out; of all its links, those that a path implies included.

    So nothing else changes with it: who came before whom over the link still does, if only in order.

    Args:
        network: the task.
        source: the path of the component from which the link leads.
        target: that of the component to which it leads.
        type_: the link's new type; None takes it out.

    Raises:
        NetworkError: there is no such link.
    """
    full = expand_links(network)
    if target not in full.by_path:
        raise NetworkError(f"no component is called {target!r}; there are: {', '.join(full.by_path)}")
    inside, home = full.home_of(target)
    incoming = home.incoming[target[len(inside) :]]
    if source not in [inside + link.source for link in incoming]:
        known = ", ".join(f"{inside}{link.source} -> {target}" for link in incoming)
        raise NetworkError(f"there is no link {source} -> {target}; to {target} lead: {known or 'none'}")
    pair = source[len(inside) :], target[len(inside) :]

    def change(network: Network) -> Network:
        (link,) = (link for link in network.links if (link.source, link.target) == pair)
        where = network.links.index(link)
        instead = () if type_ is None else (replace(link, type=type_, evidence=()),)
        return replace(network, links=(*network.links[:where], *instead, *network.links[where + 1 :]))

    return reduce_links(edited(full, inside, change))
