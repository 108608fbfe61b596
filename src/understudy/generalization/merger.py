"""Many demonstrations merged into one task (§5.1), without a new network after each.

What a further demonstration costs is its alignment, (nodes + edges) × length, and otherwise only what it shows itself.
The network is made at the end: numbers are merged once for each step, and no evidence is copied twice.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from understudy.generalization.alignment import aligned
from understudy.generalization.inputs import behaviors_of, check_demonstration
from understudy.generalization.links import LinksOfWays, links_of_one_way
from understudy.generalization.renaming import free_id, renamed, with_ids
from understudy.generalization.symbols import symbol_of
from understudy.generalization.values import parameters_after
from understudy.generalization.ways import Ways
from understudy.network import Component, Link, Network, Occurrence, Topology

__all__ = ["Added", "Merger"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Added:
    """A demonstration as it was merged.

    Attributes:
        demonstrations: its names in the task.
        demonstration: its network.
        ids: that the steps of this have in the task.
    """

    demonstrations: tuple[str, ...]
    demonstration: Network
    ids: Mapping[str, str]

    @property
    def network(self) -> Network:
        """The demonstration's network with the task's ids."""
        return with_ids(self.demonstration, self.ids)


class Merger:
    """A task to which demonstrations are added.

    Args:
        task: learned from one demonstration, or generalised over several.
        name: of it, for the evidence; used for what has no evidence of its own, such as a task that was written.

    Raises:
        LearningError: it holds more than steps and links.
    """

    def __init__(self, task: Network, *, name: str = "the task") -> None:
        self._known = dict(behaviors_of(task, name))
        self._seen: dict[str, list[Occurrence]] = {}
        self._inhibitions = task.inhibitions
        topology = ways_of(task, name)
        self._ways = Ways(topology, {id_: symbol_of(part) for id_, part in self._known.items()})
        self._names = set(topology.demonstrations)
        self._links: tuple[Link, ...] = task.links
        self._links_of_ways = LinksOfWays(task.links) if task.paths else None

    def add(self, demonstration: Network, *, name: str = "the demonstration") -> Added:
        """One more demonstration.

        Args:
            demonstration: the network that was learned from it.
            name: of it, for the evidence.

        Raises:
            LearningError: it holds more than steps and links, or has alternatives itself.
        """
        check_demonstration(demonstration, name)
        shown, demonstration = renamed(demonstration, self._names, name)
        parts = behaviors_of(demonstration, name)
        symbols = {id_: symbol_of(part) for id_, part in parts.items()}
        ids = self._matched(symbols)
        steps = [ids[id_] for id_ in parts]
        matched = frozenset(id_ for id_ in steps if id_ in self._known)
        plain = self._links_of_ways is None
        self._ways.add(steps, {ids[id_]: symbol for id_, symbol in symbols.items()}, shown)
        self._names.update(shown)
        if plain and self._ways.is_chain:
            known = Network(tuple(self._known.values()), self._links)
            self._links = links_of_one_way(known, with_ids(demonstration, ids))
        else:
            if self._links_of_ways is None:
                self._links_of_ways = LinksOfWays(self._links)
            self._links_of_ways.add(demonstration, ids, matched, lambda a, b: self._ways.together(a, b, without=shown))
        for own, part in parts.items():
            if ids[own] in self._known:
                self._seen.setdefault(ids[own], []).extend(part.occurrences)
            else:
                self._known[ids[own]] = replace(part, id=ids[own])
        return Added(demonstrations=shown, demonstration=demonstration, ids=ids)

    def network(self) -> Network:
        """The task as it is now."""
        alternatives = self._links_of_ways is not None
        return Network(
            tuple(self._component(id_) for id_ in self._ways.order),
            self._links_of_ways.links if self._links_of_ways is not None else self._links,
            self._inhibitions,
            self._ways.edges if alternatives else (),
        )

    def _matched(self, symbols: Mapping[str, object]) -> dict[str, str]:
        """For every step of the demonstration the id of the same known step, or a new one."""
        word = list(symbols)
        matches = aligned(self._ways, list(symbols.values()))
        ids = {word[match.place]: match.id for match in matches}
        taken = set(self._known)
        for id_ in word:
            if id_ not in ids:
                ids[id_] = free_id(id_, taken)
                taken.add(ids[id_])
        return ids

    def _component(self, id_: str) -> Component:
        part, added = self._known[id_], self._seen.get(id_)
        if added is None:
            return part
        return replace(
            part,
            parameters=parameters_after(part, added),
            occurrences=(*part.occurrences, *added),
        )


def ways_of(task: Network, name: str) -> Topology:
    """The ways through the task; a plain one that nobody demonstrated counts as one demonstration."""
    if task.paths or task.demonstrations:
        return task.topology
    return Topology.of_chain(task.topological_order, (name,))
