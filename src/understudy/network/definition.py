"""A behavior network as it is written down: components, links, inhibitions (§3.3.1, §3.4). No run-time data."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from heapq import heappop, heappush
from types import MappingProxyType

from understudy.errors import NetworkError
from understudy.network.evidence import LinkEvidence, Occurrence

__all__ = ["Component", "Link", "LinkType", "Network", "ParameterValue"]

ParameterValue = str | float


class LinkType(StrEnum):
    """What a successor asks of its predecessor (§3.3.1), from the least to the most restrictive."""

    ORDERING = "ordering"
    """Achieved at some time before."""
    ENABLING = "enabling"
    """Achieved, and true at the moment the successor becomes active."""
    PERMANENT = "permanent"
    """Achieved, and true all the while the successor is active."""

    @property
    def strength(self) -> int:
        """0, 1, 2 from ordering to permanent (Figure 5.6)."""
        return list(LinkType).index(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Component:
    """One use of a behavior in a network.

    Attributes:
        id: unique in its network; ``track-green-1``.
        behavior: the name of the skill, ``Track``; in networks learned from plain interval documents, any label.
        parameters: the skill's parameters by name; missing ones take the skill's defaults.
        occurrences: where it was seen in demonstrations.
    """

    id: str
    behavior: str
    parameters: Mapping[str, ParameterValue] = field(default_factory=lambda: MappingProxyType({}))
    occurrences: tuple[Occurrence, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Link:
    """A precondition: ``source`` before ``target``, in the sense of ``type``."""

    source: str
    target: str
    type: LinkType
    evidence: tuple[LinkEvidence, ...] = ()


@dataclass(frozen=True)
class Network:
    """A directed acyclic graph of components. Checked when it is made; immutable afterwards.

    Attributes:
        components: in document order, which settles every tie.
        links: at most one for each ordered pair.
        inhibitions: pairs ``(from, to)``: while the first executes, the second is inhibited (§3.2.1).

    Raises:
        NetworkError: two components with one id, a link to nowhere, a link twice, a cycle.
    """

    components: tuple[Component, ...]
    links: tuple[Link, ...] = ()
    inhibitions: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        ids: set[str] = set()
        for index, component in enumerate(self.components):
            if component.id in ids:
                raise NetworkError(
                    f"the id {component.id!r} is used twice; every component needs its own",
                    path=f"components[{index}].id",
                )
            ids.add(component.id)
        pairs: set[tuple[str, str]] = set()
        for index, link in enumerate(self.links):
            pair = link.source, link.target
            _check_ends(ids, *pair, "links", index)
            if pair in pairs:
                raise NetworkError(
                    f"a second link from {link.source!r} to {link.target!r}; keep one of them", path=f"links[{index}]"
                )
            pairs.add(pair)
        for index, (source, target) in enumerate(self.inhibitions):
            _check_ends(ids, source, target, "inhibitions", index)
        _ = self.topological_order

    @cached_property
    def by_id(self) -> Mapping[str, Component]:
        """The components by their ids."""
        return {component.id: component for component in self.components}

    @cached_property
    def incoming(self) -> Mapping[str, tuple[Link, ...]]:
        """For every component, the links that end in it, in document order."""
        found: dict[str, list[Link]] = {component.id: [] for component in self.components}
        for link in self.links:
            found[link.target].append(link)
        return {id_: tuple(links) for id_, links in found.items()}

    @cached_property
    def outgoing(self) -> Mapping[str, tuple[Link, ...]]:
        """For every component, the links that begin in it, in document order."""
        found: dict[str, list[Link]] = {component.id: [] for component in self.components}
        for link in self.links:
            found[link.source].append(link)
        return {id_: tuple(links) for id_, links in found.items()}

    @cached_property
    def sinks(self) -> tuple[str, ...]:
        """The components that no link leaves: the final goals, which ``Init`` asks for (§3.3.2)."""
        return tuple(component.id for component in self.components if not self.outgoing[component.id])

    @cached_property
    def topological_order(self) -> tuple[str, ...]:
        """Every component after its predecessors; ties in document order (semantics §5)."""
        sorter: TopologicalSorter[str] = TopologicalSorter({component.id: () for component in self.components})
        for link in self.links:
            sorter.add(link.target, link.source)
        rank = {component.id: index for index, component in enumerate(self.components)}
        try:
            sorter.prepare()
        except CycleError as error:
            cycle = " -> ".join(error.args[1])
            raise NetworkError(f"the links run in a circle: {cycle}; take one of them out", path="links") from None
        order: list[str] = []
        ready: list[int] = []
        while sorter.is_active():
            for id_ in sorter.get_ready():
                heappush(ready, rank[id_])
            first = self.components[heappop(ready)].id
            order.append(first)
            sorter.done(first)
        return tuple(order)


def _check_ends(ids: Collection[str], source: str, target: str, field: str, index: int) -> None:
    for end, id_ in (("from", source), ("to", target)):
        if id_ not in ids:
            known = ", ".join(sorted(ids)) or "none"
            raise NetworkError(f"no component is called {id_!r}; there are: {known}", path=f"{field}[{index}].{end}")
    if source == target:
        raise NetworkError(f"{source!r} is linked to itself", path=f"{field}[{index}]")
