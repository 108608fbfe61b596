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
        most = one * (1 + min(len(word), len(ways.order)))
        number = np.int32 if most <= np.iinfo(np.int32).max else np.int64
        self.worth = one + np.array(ways.support, number)
        kinds = {symbol: kind for kind, symbol in enumerate(dict.fromkeys(word))}
        other = len(kinds)
        kind_of = np.array([kinds.get(symbol, other) for symbol in ways.symbols])
        same = np.arange(other + 1)[:, None] == np.array([kinds[symbol] for symbol in word], np.int64)
        levels = ways.levels()
        # The rows of a level stand together.
        self.row = np.zeros(len(ways.ids), np.int64)
        steps = np.concatenate([level.steps for level in levels])
        self.row[steps] = np.arange(1, len(ways.ids))
        gain = self.worth[steps, None] * same[kind_of[steps]]
        before = self.row[np.concatenate([level.before for level in levels])]
        self.rows = np.zeros((len(ways.ids), len(word) + 1), number)
        edge = place = 0
        for level in levels:
            edges, places = edge + len(level.before), place + len(level.steps)
            best = self.rows[before[edge:edges]]
            if edges - edge > places - place:
                best = np.maximum.reduceat(best, level.begins, axis=0)
            # What does not match gains nothing, and is no more than the row itself, which ascends.
            np.maximum(best[:, 1:], best[:, :-1] + gain[place:places], out=best[:, 1:])
            np.maximum.accumulate(best, axis=1, out=self.rows[place + 1 : places + 1])
            edge, place = edges, places

    def matches(self) -> tuple[Match, ...]:
        """One best path, read from the end."""
        ways = self.ways
        found: list[Match] = []
        length = len(self.word)
        step = self._best(ways.last, length)
        while step and length:
            value, before = self.rows[self.row[step], length], ways.predecessors[step]
            if self.word[length - 1] == ways.symbols[step]:
                last = self._best(before, length - 1)
                if self.rows[self.row[last], length - 1] + self.worth[step] == value:
                    found.append(Match(ways.ids[step], length - 1))
                    step, length = last, length - 1
                    continue
            without = self._best(before, length)
            if self.rows[self.row[without], length] == value:
                step = without
            else:
                length -= 1
        return tuple(reversed(found))

    def _best(self, steps: Sequence[int], length: int) -> int:
        """The step that has come farthest; of equally good ones the first."""
        if len(steps) == 1:
            return steps[0]
        return steps[int(self.rows[self.row[steps], length].argmax())]
