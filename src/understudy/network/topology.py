"""The ways through a task: a directed acyclic graph with one START and one END (§5.1.1, §5.2).

A task that was shown in several ways has alternatives. Every path from START to END is then a way in which it may be
done, and every demonstration is one of them. A plain network has one way only: its topological form.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from understudy.errors import NetworkError

if TYPE_CHECKING:
    from understudy.network.definition import Network

__all__ = ["END", "START", "Edge", "Topology", "check_paths", "check_ways"]

START, END = "START", "END"
"""The two ends of every path; no component is called so where there are alternatives."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Edge:
    """One step of the ways through a task: ``target`` may come next after ``source``.

    Attributes:
        source: the id of a component, or START.
        target: the id of a component, or END.
        shown: the demonstrations that went this way.
    """

    source: str
    target: str
    shown: tuple[str, ...] = ()


class Topology:
    """The ways through one network.

    Args:
        ids: of the components on the ways, every one after its predecessors; their order settles every tie.
        edges: between them, from START and to END.
    """

    def __init__(self, ids: Sequence[str], edges: Iterable[Edge]) -> None:
        self.ids = tuple(ids)
        self.edges = tuple(edges)
        self._rank = rank = {id_: index for index, id_ in enumerate((START, *ids, END))}
        ahead: dict[str, list[str]] = {id_: [] for id_ in rank}
        behind: dict[str, list[str]] = {id_: [] for id_ in rank}
        for edge in self.edges:
            ahead[edge.source].append(edge.target)
            behind[edge.target].append(edge.source)
        self.successors: Mapping[str, tuple[str, ...]] = {
            id_: tuple(sorted(next_, key=rank.__getitem__)) for id_, next_ in ahead.items()
        }
        self.predecessors: Mapping[str, tuple[str, ...]] = {
            id_: tuple(sorted(last, key=rank.__getitem__)) for id_, last in behind.items()
        }

    @classmethod
    def of_chain(cls, ids: Sequence[str], shown: tuple[str, ...] = ()) -> "Topology":
        """The only way through a plain network."""
        ends = (START, *ids), (*ids, END)
        return cls(ids, (Edge(source=a, target=b, shown=shown) for a, b in zip(*ends, strict=True)))

    @property
    def is_chain(self) -> bool:
        """Whether there is only one way."""
        return all(len(next_) == 1 for id_, next_ in self.successors.items() if id_ != END)

    def leads(self, source: str, target: str) -> bool:
        """Whether some path leads from one to another; START and END count, too."""
        return bool(self._after[source] >> self._rank[target] & 1)

    def goes(self, source: str, target: str) -> bool:
        """Whether a robot that has just done one may come to do the other: by candidates alone."""
        return bool(self._ahead[source] >> self._rank[target] & 1)

    @cached_property
    def candidates(self) -> Mapping[str, tuple[str, ...]]:
        """What may be done next after every component, and after START.

        Of the successors those from which another one can be reached are left out: the direct way wins, and what it
        leads past is never done (§5.2). So END is the only candidate wherever it is one.
        """
        return {
            id_: tuple(one for one in next_ if not any(self.leads(one, other) for other in next_))
            for id_, next_ in self.successors.items()
        }

    @property
    def bypassed(self) -> tuple[str, ...]:
        """The components that are never done, since a direct way leads past them."""
        return tuple(id_ for id_ in self.ids if not self.goes(START, id_))

    @cached_property
    def shown_by(self) -> Mapping[str, tuple[str, ...]]:
        """For every component, the demonstrations that show it."""
        rank = {name: index for index, name in enumerate(self.demonstrations)}
        found: dict[str, set[str]] = {id_: set() for id_ in (*self.ids, END)}
        for edge in self.edges:
            found[edge.target].update(edge.shown)
        return {id_: tuple(sorted(shown, key=rank.__getitem__)) for id_, shown in found.items()}

    @cached_property
    def demonstrations(self) -> tuple[str, ...]:
        """All that the ways come from, each of which is one way from START to END."""
        return tuple(dict.fromkeys(name for edge in self.edges for name in edge.shown))

    def bypassed_by(self, id_: str) -> tuple[str, ...]:
        """The demonstrations that went past a component."""
        return tuple(name for name in self.demonstrations if name not in self.shown_by[id_])

    @cached_property
    def _after(self) -> Mapping[str, int]:
        return self._reached(self.successors)

    @cached_property
    def _ahead(self) -> Mapping[str, int]:
        return self._reached(self.candidates)

    def _reached(self, next_: Mapping[str, tuple[str, ...]]) -> Mapping[str, int]:
        """All that follows, one bit each: sets of thousands of thousands would take a gigabyte."""
        found = {END: 0}
        for id_ in (*reversed(self.ids), START):
            found[id_] = 0
            for one in next_[id_]:
                found[id_] |= found[one] | 1 << self._rank[one]
        return found


def check_paths(network: "Network") -> None:
    """Refuses paths that cannot be the ways through a network; one without paths passes.

    Raises:
        NetworkError: with the place and what would be valid.
    """
    ids = [component.id for component in network.components if component.trigger is None]
    seen: set[tuple[str, str]] = set()
    for index, edge in enumerate(network.paths):
        for key, id_, terminal, other in (("from", edge.source, START, END), ("to", edge.target, END, START)):
            if id_ not in ids and id_ != terminal:
                raise NetworkError(_no_end(id_, key, terminal, other, ids, network), path=f"paths[{index}].{key}")
        if (edge.source, edge.target) in seen:
            raise NetworkError(
                f"a second step from {edge.source!r} to {edge.target!r}; keep one of them", path=f"paths[{index}]"
            )
        if (edge.source, edge.target) == (START, END):
            raise NetworkError("a way from START to END leads past every step; take it out", path=f"paths[{index}]")
        seen.add((edge.source, edge.target))


def check_ways(network: "Network") -> None:
    """Refuses components and links which the paths of a network, that are good in themselves, leave without meaning.

    Raises:
        NetworkError: with the place and what would be valid.
    """
    topology = network.topology
    for index, component in enumerate(network.components):
        if component.id in (START, END):
            raise NetworkError(
                f"{component.id} is where all paths {'begin' if component.id == START else 'end'}; take another id",
                path=f"components[{index}].id",
            )
        if component.trigger is None and not (
            topology.leads(START, component.id) and topology.leads(component.id, END)
        ):
            raise NetworkError(
                f"no path from START to END leads through {component.id!r}; add one under paths, or take it out",
                path=f"components[{index}].id",
            )
    for index, link in enumerate(network.links):
        if network.by_id[link.target].trigger is not None:
            raise NetworkError(
                f"{link.target!r} is a duty beside alternatives, and cannot wait for a step that may be passed by; "
                "take the link out",
                path=f"links[{index}]",
            )
        if not topology.leads(link.source, link.target):
            raise NetworkError(
                f"no path leads from {link.source!r} to {link.target!r}, so that nothing would ever ask for this link; "
                "take it out, or add a path",
                path=f"links[{index}]",
            )


def _no_end(id_: str, key: str, terminal: str, other: str, ids: Sequence[str], network: "Network") -> str:
    if id_ == other:
        ends = "no path leads on from END" if key == "from" else "no path leads back to START"
        return f"{ends}; name a component or {terminal}"
    if id_ in network.by_id:
        return f"{id_!r} is a duty beside the sequence, and no path leads through it; take the step out, or the trigger"
    return f"no component is called {id_!r}; there are: {', '.join([terminal, *sorted(ids)])}"
