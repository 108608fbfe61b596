"""The alternatives of one network while it is executed (§5.2, §5.3): what may come next, and what is out of play.

A run keeps the way that it has taken. In play are the components on it, which are achieved, and the candidates: those
that may come next. The robot is after all candidates at once; the first one that is achieved is taken, and the others
go out of play. Only links between components in play count. So a candidate's preconditions are its links from every
component on the way, and if one of them breaks, activation goes back along the way to what must be done again.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from understudy.network import END, START, Topology

__all__ = ["Way", "Ways"]

Way = tuple[int, ...]
"""The rows of the components taken, one after the other."""


@dataclass(frozen=True, slots=True)
class Ways:
    """The ways through one network. No run-time data.

    Attributes:
        topology: of the definition.
        rows: of the components on the ways, by id.
        ids: the other way round.
    """

    topology: Topology
    rows: Mapping[str, int]
    ids: Mapping[int, str]

    @classmethod
    def of(cls, topology: Topology, rows: Mapping[str, int]) -> "Ways":
        """The ways of a network whose components have these rows."""
        on_ways = {id_: rows[id_] for id_ in topology.ids}
        return cls(topology, on_ways, {row: id_ for id_, row in on_ways.items()})

    def candidates(self, taken: Way) -> tuple[int, ...]:
        """What may come next; nothing once END is reached."""
        return tuple(self.rows[id_] for id_ in self.topology.candidates[self._last(taken)] if id_ != END)

    def passed(self, taken: Way) -> tuple[int, ...]:
        """What could come next if no direct way led past it."""
        after, candidates = self.topology.successors[self._last(taken)], self.topology.candidates[self._last(taken)]
        return tuple(self.rows[id_] for id_ in after if id_ not in candidates)

    def in_play(self, taken: Way) -> frozenset[int]:
        """What is on the way or may come next."""
        return frozenset((*taken, *self.candidates(taken)))

    def waits_for(self, taken: Way, row: int) -> int | None:
        """What comes just before a component that is out of play, on a way that is still open; None if none is."""
        last, wanted = self._last(taken), self.ids[row]
        for id_ in self.topology.predecessors[wanted]:
            if wanted in self.topology.candidates[id_] and self.topology.goes(last, id_):
                return self.rows[id_]
        return None

    def passed_at(self, taken: Way, row: int) -> int | None:
        """The component since which another one is out of reach; None if no robot ever comes to it."""
        reachable = self.topology.goes(START, self.ids[row])
        for one in taken:
            if reachable and not self.topology.goes(self.ids[one], self.ids[row]):
                return one
        return None

    def _last(self, taken: Way) -> str:
        return self.ids[taken[-1]] if taken else START
