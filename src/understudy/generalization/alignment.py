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

from understudy.generalization.ways import Ways
from understudy.network import Topology

__all__ = ["Match", "align", "aligned"]


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
    return aligned(Ways(topology, symbols), word)


def aligned(ways: Ways, word: Sequence[Hashable]) -> tuple[Match, ...]:
    """:func:`align` with ways that grow."""
    return _Table(ways, word).matches()


class _Table:
    """The rows of all nodes, level by level."""

    def __init__(self, ways: Ways, word: Sequence[Hashable]) -> None:
        self.ways, self.word = ways, word
        # One match more outweighs all support that a common subsequence can have.
        one = 1 + max(ways.support) * min(len(word), len(ways.order))
        self.worth = one + np.array(ways.support, np.int64)
        kinds = {symbol: kind for kind, symbol in enumerate(dict.fromkeys(word))}
        other = len(kinds)
        kind_of = np.array([kinds.get(symbol, other) for symbol in ways.symbols])
        in_word = np.array([kinds[symbol] for symbol in word], np.int64)
        same = np.arange(other + 1)[:, None] == in_word
        self.rows = np.zeros((len(ways.ids), len(word) + 1), np.int64)
        for level in ways.levels():
            before = np.maximum.reduceat(self.rows[level.before], level.begins, axis=0)
            # Not matched is worth nothing, and never more than the row itself, which ascends.
            matched = (before[:, :-1] + self.worth[level.steps, None]) * same[kind_of[level.steps]]
            np.maximum(before[:, 1:], matched, out=before[:, 1:])
            self.rows[level.steps] = np.maximum.accumulate(before, axis=1)

    def matches(self) -> tuple[Match, ...]:
        """One best path, read from the end."""
        ways, rows = self.ways, self.rows
        found: list[Match] = []
        length = len(self.word)
        step = self._best(ways.last, length)
        while step and length:
            value = rows[step, length]
            before = ways.predecessors[step]
            if (
                self.word[length - 1] == ways.symbols[step]
                and rows[before, length - 1].max() + self.worth[step] == value
            ):
                found.append(Match(ways.ids[step], length - 1))
                length -= 1
                step = self._best(before, length)
            elif rows[before, length].max() == value:
                step = self._best(before, length)
            else:
                length -= 1
        return tuple(reversed(found))

    def _best(self, steps: Sequence[int], length: int) -> int:
        """The step that has come farthest; of equally good ones the first in the order."""
        ranks, ids = self.ways.ranks, self.ways.ids
        return max(steps, key=lambda step: (int(self.rows[step, length]), -ranks[ids[step]]))
