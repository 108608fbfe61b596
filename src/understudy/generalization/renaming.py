"""Names and ids that are taken already: a new demonstration gets others."""

import re
from collections.abc import Collection, Mapping
from dataclasses import replace

from understudy.network import Component, Network

__all__ = ["free_id", "renamed", "with_ids"]


def renamed(network: Network, taken: Collection[str], name: str) -> tuple[tuple[str, ...], Network]:
    """The names of the new demonstration, none of which is taken, and its network with them in its evidence."""
    names: dict[str, str] = {}
    for given in network.demonstrations or (name,):
        number, names[given] = 1, given
        while names[given] in taken or list(names.values()).count(names[given]) > 1:
            number += 1
            names[given] = f"{given} ({number})"
    if all(name == given for given, name in names.items()):
        return tuple(names), network
    components = tuple(
        replace(
            part,
            occurrences=tuple(replace(one, demonstration=names[one.demonstration]) for one in part.occurrences),
        )
        for part in network.components
        if isinstance(part, Component)
    )
    links = tuple(
        replace(
            link,
            evidence=tuple(
                replace(one, demonstration=names.get(one.demonstration, one.demonstration)) for one in link.evidence
            ),
        )
        for link in network.links
    )
    return tuple(names.values()), replace(network, components=components, links=links)


def free_id(id_: str, taken: Collection[str]) -> str:
    """An id for a new step: its own, or the same with the next number."""
    stem, number = re.sub(r"-\d+$", "", id_), 1
    while id_ in taken:
        number += 1
        id_ = f"{stem}-{number}"
    return id_


def with_ids(network: Network, ids: Mapping[str, str]) -> Network:
    """A network of behaviors and links with other ids."""
    return Network(
        tuple(replace(part, id=ids[part.id]) for part in network.components),
        tuple(replace(link, source=ids[link.source], target=ids[link.target]) for link in network.links),
    )
