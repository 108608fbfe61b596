"""Which links are satisfied, who is needed, and who may be active: steps 4 and 5 of the tick (semantics §3)."""

from understudy.execution.context import Context
from understudy.execution.program import Arc, Program
from understudy.network import LinkType

__all__ = ["Links"]


class Links:
    """What follows from the latches and effects of a context, kept up to date one change at a time.

    Args:
        program: the compiled network.
        context: its run-time state.

    Attributes:
        levels: for every node, the activation level.
        unmet: for every node, how many of its incoming links are not satisfied.
        satisfied: for every arc; those that do not count are.
        in_play: for every node, whether it is on the way that was taken, or may come next; all are, where there are no
            alternatives.
        ready: the nodes that are needed, and none of whose links is unmet.
        due: nodes that may be achieved now, each perhaps more than once; emptied by whoever looks at them.
        touched: nodes for which anything has changed; emptied by whoever looks at them.
        stale: ``ready`` has changed since somebody last set this to False.
        turns_stale: the order in which nodes take their locks may have changed since then.
    """

    def __init__(self, program: Program, context: Context) -> None:
        size = len(program.nodes)
        self.program = program
        self.context = context
        self.levels = [0] * size
        self.unmet = [len(program.incoming[row]) for row in range(size)]
        self.satisfied = [False] * len(program.arcs)
        self.in_play = [True] * size
        for scope in program.scopes:
            if scope.ways is not None:
                here = scope.ways.in_play(context.taken.get(scope.number, ()))
                for row in scope.ways.ids:
                    self.in_play[row] = row in here
        self.ready: set[int] = set()
        self.due: list[int] = [row for row in range(size) if not self.unmet[row]]
        self.touched: set[int] = set(range(size))
        self.stale = True
        self.turns_stale = True
        for arc in program.arcs:
            self.refresh(arc)

    def refresh(self, arc: Arc) -> None:
        """Brings a link, and all that follows from it, up to date."""
        holds_now = self._holds(arc)
        if holds_now is self.satisfied[arc.row]:
            return
        target = arc.target
        needed = self.levels[target] > 0
        if needed:
            self.raise_level(arc.source, -self._sends(arc))
        self.satisfied[arc.row] = holds_now
        if needed:
            self.raise_level(arc.source, self._sends(arc))
        self.unmet[target] += -1 if holds_now else 1
        self.touched.add(target)
        if not self.unmet[target]:
            self.due.append(target)
        self._place(target)

    def raise_level(self, row: int, by: int) -> None:
        """Changes a level; whoever begins or ceases to be needed passes that on to its predecessors."""
        changes = [(row, by)]
        while changes:
            row, by = changes.pop()
            if not by:
                continue
            before = self.levels[row]
            after = self.levels[row] = before + by
            self.touched.add(row)
            if self.context.achieved[row]:
                self.turns_stale = True
            if (before > 0) is not (after > 0):
                sign = 1 if after > 0 else -1
                changes += [(arc.source, sign * self._sends(arc)) for arc in self.program.incoming[row]]
                self._place(row)

    def refusals(self, row: int) -> list[Arc]:
        """The unsatisfied links of a node, in document order; all of them, not the first only."""
        return [arc for arc in self.program.incoming[row] if not self.satisfied[arc.row]]

    def full_level(self, row: int) -> int:
        """The activation level that the component would have if every implied ordering link were stored.

        A component not yet achieved is needed by all that come after it; one that has been achieved is needed only over
        enabling and permanent links, which are never left out. Whoever needs a NAB needs what it consists of; duties
        do not count. Locks go by this level, since reduced and full networks must behave the same (semantics §2).
        """
        program = self.program
        if not self.context.achieved[row]:
            return program.followers[row]
        nab = program.scopes[program.nodes[row].scope].nab
        asking = (arc for arc in program.outgoing[row] if self.levels[arc.target] > 0)
        level = sum(self._sends(arc) for arc in asking if program.nodes[arc.target].trigger is None)
        return level + (program.followers[nab] if nab >= 0 else 0)

    def _holds(self, arc: Arc) -> bool:
        """Semantics §2, the table of links. Nobody waits for what was passed over, or for what is out of play."""
        context = self.context
        if not (self.in_play[arc.source] and self.in_play[arc.target]):
            return True
        if not context.achieved[arc.source]:
            return False
        if arc.type is LinkType.ORDERING or context.effects[arc.source] or arc.source in context.skipped:
            return True
        return arc.type is LinkType.ENABLING and arc.target in context.active

    def _sends(self, arc: Arc) -> int:
        """Step 4: what a needed component sends along one of its incoming links."""
        if not self.satisfied[arc.row]:
            return 1
        maintaining = arc.type is LinkType.PERMANENT and self.program.nodes[arc.source].maintaining
        return int(maintaining and self.in_play[arc.source] and self.in_play[arc.target])

    def _place(self, row: int) -> None:
        ready = self.levels[row] > 0 and not self.unmet[row]
        if ready is (row in self.ready):
            return
        self.stale = True
        if ready:
            self.ready.add(row)
        else:
            self.ready.discard(row)
