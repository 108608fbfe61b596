"""The ways through a task while demonstrations are added: a graph that grows (§5.1.1).

:class:`~understudy.network.Topology` is the same as a value. Here a step has a number, in the order in which it became
known; START is 0. What is known of all steps stands in arrays, level by level: the steps of a level lead to none of one
another, so that an alignment takes them all at once.
"""

from bisect import insort
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from understudy.network import END, START, Edge, Topology

__all__ = ["Level", "Ways"]

Numbers = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Level:
    """Steps that are equally far from START, on the longest way.

    Attributes:
        steps: their numbers.
        before: the numbers of all their predecessors, those of one step after those of another.
        begins: where in ``before`` those of each step begin.
    """

    steps: Numbers
    before: Numbers
    begins: Numbers


class Ways:
    """A graph with one START and one END, to which ways are added.

    Attributes:
        ids: of the steps by number; the first is START.
        order: the ids, each after what comes before it; new ones stand just before the next step that was known.
        symbols: of the steps by number.
        support: how many demonstrations show each, by number.
        predecessors: of each, by number, in the order; those of END are ``last``.
    """

    def __init__(self, topology: Topology, symbols: Mapping[str, Hashable]) -> None:
        self.ids = [START]
        self.numbers = {START: 0}
        self.order = list(topology.ids)
        self.symbols: list[Hashable] = [None]
        self.support = [0]
        self.shown_by: list[set[str]] = [set()]
        self.predecessors: list[list[int]] = [[]]
        self.last: list[int] = []
        self.depth = [0]
        self._successors: list[list[int]] = [[]]
        self._members: list[list[int]] = []
        self._levels: list[Level | None] = []  # None where it is to be made anew
        self._edges: dict[tuple[str, str], list[str]] = {}
        self._ranks: dict[str, int] | None = None
        for id_ in topology.ids:
            self._number(id_, symbols[id_])
        for id_ in (*topology.ids, END):
            for source in topology.predecessors[id_]:
                self._join(source, id_)
        for edge in topology.edges:
            self._show(edge.source, edge.target, edge.shown)

    @property
    def demonstrations(self) -> set[str]:
        """The names of all that were added."""
        return {name for source, target in self._edges for name in self._edges[source, target] if source == START}

    @property
    def is_chain(self) -> bool:
        """Whether there is only one way."""
        return len(self._edges) == len(self.ids)

    @property
    def edges(self) -> tuple[Edge, ...]:
        """All steps of the ways, in the order of what they join."""
        rank = {**self.ranks, END: len(self.ids)}
        pairs = sorted(self._edges, key=lambda pair: (rank[pair[0]], rank[pair[1]]))
        return tuple(Edge(source=a, target=b, shown=tuple(self._edges[a, b])) for a, b in pairs)

    @property
    def ranks(self) -> Mapping[str, int]:
        """The place of every id in the order; START is the first."""
        if self._ranks is None:
            self._ranks = {id_: rank for rank, id_ in enumerate((START, *self.order))}
        return self._ranks

    def together(self, one: str, other: str, *, without: Sequence[str] = ()) -> bool:
        """Whether some demonstration shows both, those left aside."""
        first, second = (self.shown_by[self.numbers[id_]] for id_ in (one, other))
        return len(first & second) > len(first.intersection(without) & second)

    def add(self, steps: Sequence[str], symbols: Mapping[str, Hashable], shown: Sequence[str]) -> None:
        """One more way.

        Args:
            steps: its ids from START to END; known ones come in the order that is known.
            symbols: of the steps that are new, at least.
            shown: the names of the demonstrations that went it.
        """
        new: list[str] = []
        for id_ in (*steps, END):
            if id_ not in self.numbers and id_ != END:
                new.append(id_)
                continue
            if new:
                place = self.order.index(id_) if id_ != END else len(self.order)
                self.order[place:place] = new
                self._ranks = None
                for one in new:
                    self._number(one, symbols[one])
                new = []
        for source, target in zip((START, *steps), (*steps, END), strict=True):
            if (source, target) not in self._edges:
                self._join(source, target)
            self._show(source, target, shown)

    def levels(self) -> list[Level]:
        """All steps but START, the nearest first."""
        for depth, steps in enumerate(self._members):
            if self._levels[depth] is None:
                before = [self.predecessors[step] for step in steps]
                counts = np.fromiter(map(len, before), np.int64, len(before))
                self._levels[depth] = Level(
                    steps=np.array(steps),
                    before=np.array([one for some in before for one in some]),
                    begins=counts.cumsum() - counts,
                )
        return [level for level in self._levels if level is not None]

    def _number(self, id_: str, symbol: Hashable) -> None:
        self.numbers[id_] = len(self.ids)
        self.ids.append(id_)
        self.symbols.append(symbol)
        self.support.append(0)
        self.shown_by.append(set())
        self.predecessors.append([])
        self._successors.append([])
        self.depth.append(0)

    def _join(self, source: str, target: str) -> None:
        self._edges[source, target] = []
        first = self.numbers[source]
        if target == END:
            insort(self.last, first, key=self._rank)
            return
        last = self.numbers[target]
        insort(self.predecessors[last], first, key=self._rank)
        self._successors[first].append(last)
        if self.depth[last]:
            self._levels[self.depth[last] - 1] = None
        waiting = [(first, last)]
        while waiting:
            before, number = waiting.pop()
            if self.depth[number] <= self.depth[before]:
                self._move(number, self.depth[before] + 1)
                waiting += [(number, after) for after in self._successors[number]]

    def _rank(self, number: int) -> int:
        return self.ranks[self.ids[number]]

    def _move(self, number: int, depth: int) -> None:
        """To a level that is farther from START."""
        if old := self.depth[number]:
            self._members[old - 1].remove(number)
            self._levels[old - 1] = None
        while len(self._members) < depth:
            self._members.append([])
            self._levels.append(None)
        self._members[depth - 1].append(number)
        self._levels[depth - 1] = None
        self.depth[number] = depth

    def _show(self, source: str, target: str, shown: Sequence[str]) -> None:
        self._edges[source, target] += shown
        if target != END:
            number = self.numbers[target]
            self.shown_by[number].update(shown)
            self.support[number] = len(self.shown_by[number])
