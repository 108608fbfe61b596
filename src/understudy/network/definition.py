"""A behavior network as it is written down: components, links, inhibitions (§3.3.1, §3.4). No run-time data.

A component is an abstract behavior (:class:`Component`), or a network in its place (:class:`Nab`), to any depth. Ids
are unique within their network; a component anywhere in a hierarchy is called by its *path*, ``transport/gate/track``.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from heapq import heappop, heappush
from types import MappingProxyType

from understudy.errors import NetworkError
from understudy.network.conditions import Condition, ParameterValue
from understudy.network.controls import Repeat, Switch, Timeout, Trigger, check_controls
from understudy.network.evidence import LinkEvidence, Occurrence
from understudy.network.topology import END, START, Edge, Topology, check_paths, check_ways

__all__ = [
    "Case",
    "Component",
    "Link",
    "LinkType",
    "Nab",
    "Network",
    "ParameterValue",
]


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
        until: it counts as achieved as soon as this is so, too (do-until, §4.6).
        timeout: what happens if it takes too long.
        trigger: it is a duty beside the sequence.
    """

    id: str
    behavior: str
    parameters: Mapping[str, ParameterValue] = field(default_factory=lambda: MappingProxyType({}))
    occurrences: tuple[Occurrence, ...] = ()
    until: Condition | None = None
    timeout: Timeout | None = None
    trigger: Trigger | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """One of the networks that a NAB can be.

    Attributes:
        name: unique in its NAB; empty if there is only this one.
        network: what is executed.
        when: asked when the NAB begins; None is always so.
    """

    name: str = ""
    network: "Network"
    when: Condition | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Nab:
    """A network abstract behavior: a whole network where a behavior can stand (§3.4).

    It begins with the first case whose ``when`` is so; if none is, there is nothing to do, and its goal holds.

    Attributes:
        id: unique in its network.
        cases: at least one.
        switches: between the cases while they are executed.
        repeat: its network is executed several times.
        task: the name of the task that stands here, if it came from a document of its own.
        until, timeout, trigger: as for :class:`Component`.
    """

    id: str
    cases: tuple[Case, ...]
    switches: tuple[Switch, ...] = ()
    repeat: Repeat | None = None
    task: str = ""
    until: Condition | None = None
    timeout: Timeout | None = None
    trigger: Trigger | None = None

    @classmethod
    def of(cls, id_: str, network: "Network", *, repeat: Repeat | None = None, task: str = "") -> "Nab":
        """A NAB that is one network."""
        return cls(id=id_, cases=(Case(network=network),), repeat=repeat, task=task)

    @property
    def network(self) -> "Network":
        """The network of a NAB that has only one."""
        (case,) = self.cases
        return case.network


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
        components: abstract behaviors and networks in their place, in document order, which settles every tie.
        links: at most one for each ordered pair.
        inhibitions: pairs ``(from, to)``: while the first executes, the second is inhibited (§3.2.1).
        paths: the ways through it, where there are alternatives (§5.2); empty where all components are to be done.

    Raises:
        NetworkError: two components with one id, a link to nowhere or across a NAB's border, a link twice, a cycle, a
            case that can never be reached, a condition on what is not there, a component on no path.
    """

    components: tuple[Component | Nab, ...]
    links: tuple[Link, ...] = ()
    inhibitions: tuple[tuple[str, str], ...] = ()
    paths: tuple[Edge, ...] = ()

    def __post_init__(self) -> None:
        ids: set[str] = set()
        for index, component in enumerate(self.components):
            path = f"components[{index}].id"
            if component.id in ids:
                raise NetworkError(f"the id {component.id!r} is used twice; every component needs its own", path=path)
            if "/" in component.id:
                raise NetworkError(
                    f"the id {component.id!r} has a '/' in it, which stands between the parts of a path; take another",
                    path=path,
                )
            ids.add(component.id)
        pairs: set[tuple[str, str]] = set()
        for index, link in enumerate(self.links):
            pair = link.source, link.target
            self._check_ends(ids, *pair, "links", index)
            if pair in pairs:
                raise NetworkError(
                    f"a second link from {link.source!r} to {link.target!r}; keep one of them", path=f"links[{index}]"
                )
            pairs.add(pair)
        for index, (source, target) in enumerate(self.inhibitions):
            self._check_ends(ids, source, target, "inhibitions", index)
        check_paths(self)
        _ = self.topological_order
        if self.paths:
            check_ways(self)
        for index, component in enumerate(self.components):
            check_controls(component, self, f"components[{index}]")

    def _check_ends(self, ids: Collection[str], source: str, target: str, field: str, index: int) -> None:
        for end, id_ in (("from", source), ("to", target)):
            if id_ not in ids:
                path = f"{field}[{index}].{end}"
                owner = next((path_.partition("/")[0] for path_, _ in self.walk() if id_ in _endings(path_)), None)
                if owner is not None:
                    raise NetworkError(
                        f"{id_!r} is a part of {owner!r}, and a link does not cross the border of a network; link "
                        f"{owner!r} itself, or put the link inside",
                        path=path,
                    )
                known = ", ".join(sorted(ids)) or "none"
                raise NetworkError(f"no component is called {id_!r}; there are: {known}", path=path)
        if source == target:
            raise NetworkError(f"{source!r} is linked to itself", path=f"{field}[{index}]")

    def walk(self) -> Iterator[tuple[str, Component | Nab]]:
        """Every component at every depth with its path, each NAB before its parts, in document order."""
        for component in self.components:
            yield component.id, component
            if isinstance(component, Nab):
                for case in component.cases:
                    inside = "/".join(filter(None, (component.id, case.name)))
                    for path, part in case.network.walk():
                        yield f"{inside}/{path}", part

    @cached_property
    def by_path(self) -> Mapping[str, Component | Nab]:
        """All components of the hierarchy by their paths."""
        return dict(self.walk())

    def home_of(self, path: str) -> "tuple[str, Network]":
        """What the paths in the network begin with in which a component stands, and that network.

        Raises:
            KeyError: no component has this path.
        """
        for component in self.components:
            if path == component.id:
                return "", self
            if isinstance(component, Nab):
                for case in component.cases:
                    inside = "/".join(filter(None, (component.id, case.name))) + "/"
                    if path.startswith(inside) and path[len(inside) :] in case.network.by_path:
                        prefix, network = case.network.home_of(path[len(inside) :])
                        return inside + prefix, network
        raise KeyError(path)

    @cached_property
    def flat(self) -> bool:
        """Whether every component is an abstract behavior."""
        return not any(isinstance(component, Nab) for component in self.components)

    @property
    def link_count(self) -> int:
        """Of all links at every depth (§3.7 compares it)."""
        inside = (case.network for part in self.components if isinstance(part, Nab) for case in part.cases)
        return len(self.links) + sum(network.link_count for network in inside)

    @cached_property
    def by_id(self) -> Mapping[str, Component | Nab]:
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
        """The final goals, which ``Init`` asks for (§3.3.2): nothing but a duty waits for them, and they are none.

        Where there are alternatives, any one of them ends the task.
        """
        if self.paths:
            last = self.topology.predecessors[END]
            return tuple(component.id for component in self.components if component.id in last)
        duties = {component.id for component in self.components if component.trigger is not None}
        return tuple(
            component.id
            for component in self.components
            if component.id not in duties and all(link.target in duties for link in self.outgoing[component.id])
        )

    @cached_property
    def topological_order(self) -> tuple[str, ...]:
        """Every component after its predecessors; ties in document order (semantics §5)."""
        sorter: TopologicalSorter[str] = TopologicalSorter({component.id: () for component in self.components})
        for link in self.links:
            sorter.add(link.target, link.source)
        for edge in self.paths:
            if edge.source != START and edge.target != END:
                sorter.add(edge.target, edge.source)
        rank = {component.id: index for index, component in enumerate(self.components)}
        try:
            sorter.prepare()
        except CycleError as error:
            cycle = " -> ".join(error.args[1])
            what, path = ("links and paths", "paths") if self.paths else ("links", "links")
            raise NetworkError(f"the {what} run in a circle: {cycle}; take one of them out", path=path) from None
        order: list[str] = []
        ready: list[int] = []
        while sorter.is_active():
            for id_ in sorter.get_ready():
                heappush(ready, rank[id_])
            first = self.components[heappop(ready)].id
            order.append(first)
            sorter.done(first)
        return tuple(order)

    @cached_property
    def topology(self) -> Topology:
        """The ways through it; without alternatives the only one, its topological form (§5.1)."""
        order = [id_ for id_ in self.topological_order if self.by_id[id_].trigger is None]
        return Topology(order, self.paths) if self.paths else Topology.of_chain(order, self.demonstrations)

    @cached_property
    def demonstrations(self) -> tuple[str, ...]:
        """The names of those it was learned from, by its evidence, in the order in which they appear there."""
        if self.paths:
            return self.topology.demonstrations
        seen = [one for part in self.components if isinstance(part, Component) for one in part.occurrences]
        return tuple(dict.fromkeys(one.demonstration for one in seen))


def _endings(path: str) -> Collection[str]:
    """How somebody may have meant to name the component of a path from outside."""
    inside = path.partition("/")[2]
    return (path, inside, path.rpartition("/")[2]) if inside else ()
