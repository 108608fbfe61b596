"""Which steps of a new demonstration are steps that are known already (§5.1.1).

The known task is a directed acyclic graph, the demonstration a word. Of all paths from START to END the one counts that
has the longest common subsequence with the word. There may be exponentially many, but none is ever walked: the row of
a node holds, for every prefix of the word, the best that any path to that node can do, and it follows from the rows of
the nodes before it. That is the table of Figure 5.1(b) with the greatest of several rows in the place of the row above.
Time and memory grow with (nodes + edges) × length of the word.

Ties are broken in this order, and so the same way every time:

1. Of the longest common subsequences, the one whose nodes have been shown most often: a step that all demonstrations
   share is not given up for one that a single one of them has.
2. Read from the end, as Figure 5.1(b) is: the last symbol that can match does; else the graph is followed back, to the
   first of equally good predecessors; else a symbol of the word is left out.
"""

from collections.abc import Hashable, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from understudy.network import END, START, Topology

__all__ = ["Match", "align"]

Row = NDArray[np.int64]


class Match(NamedTuple):
    """A node of the graph and the place of the same symbol in the word."""

    id: str
    place: int


def align(topology: Topology, symbols: Mapping[str, Hashable], word: Sequence[Hashable]) -> tuple[Match, ...]:
    """The longest common subsequence of a word and any path of a topology.

    Args:
        topology: what is known.
        symbols: of its nodes, by id.
        word: the symbols of the new demonstration.

    Returns:
        The matches from the beginning to the end.
    """
    table = _Table(topology, symbols, word)
    return table.matches()


class _Table:
    """The rows of all nodes, in topological order."""

    def __init__(self, topology: Topology, symbols: Mapping[str, Hashable], word: Sequence[Hashable]) -> None:
        self.topology, self.symbols, self.word = topology, symbols, word
        shown = {id_: len(topology.shown_by[id_]) for id_ in topology.ids}
        # One match more outweighs all support that a common subsequence can have.
        one = 1 + max(shown.values(), default=0) * min(len(word), len(topology.ids))
        self.worth = {id_: one + times for id_, times in shown.items()}
        places: dict[Hashable, list[int]] = {}
        for place, symbol in enumerate(word):
            places.setdefault(symbol, []).append(place)
        self.rows: dict[str, Row] = {START: np.zeros(len(word) + 1, np.int64)}
        for id_ in topology.ids:
            before = self.before(id_)
            row = before.copy()
            if here := places.get(symbols[id_]):
                at = np.array(here)
                row[at + 1] = np.maximum(before[at + 1], before[at] + self.worth[id_])
            self.rows[id_] = np.maximum.accumulate(row)

    def before(self, id_: str) -> Row:
        """The best that any path to a node can do without it."""
        first, *others = (self.rows[one] for one in self.topology.predecessors[id_])
        return np.maximum.reduce([first, *others]) if others else first

    def matches(self) -> tuple[Match, ...]:
        """One best path, read from the end."""
        found: list[Match] = []
        id_, length = self._best(END, len(self.word)), len(self.word)
        while id_ != START and length:
            before = self.before(id_)
            value = self.rows[id_][length]
            if self.word[length - 1] == self.symbols[id_] and before[length - 1] + self.worth[id_] == value:
                found.append(Match(id_, length - 1))
                length -= 1
                id_ = self._best(id_, length)
            elif before[length] == value:
                id_ = self._best(id_, length)
            else:
                length -= 1
        return tuple(reversed(found))

    def _best(self, id_: str, length: int) -> str:
        """The predecessor that has come farthest; the first of equally good ones."""
        return max(self.topology.predecessors[id_], key=lambda one: int(self.rows[one][length]))
