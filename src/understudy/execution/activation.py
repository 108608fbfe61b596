"""Which components are active: steps 2 to 6 of the tick (semantics §3), computed from what has changed.

Whether a link is satisfied, how many of a component's links are not, and a component's activation level all follow from
the context's effects, latches and last activity. They are kept up to date here from one tick to the next, so that a
tick costs what has changed plus what is active, and not what the network's size is. ``tests/execution/reference.py``
recomputes all of it from the definition; the two must agree on every network and history.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from understudy.execution.context import Context
from understudy.execution.program import Arc, Program
from understudy.network import LinkType

__all__ = ["Activation", "Step"]


@dataclass(frozen=True, slots=True)
class Step:
    """What one tick decided; rows of the program's nodes.

    Attributes:
        achieved: newly achieved in this tick, predecessors first.
        active: the port ``Active`` is true; executing or searching.
        executing: active, its world precondition holds, and its actuators are its own.
        locked: active, its world precondition holds, but a lock is another's: the row of that other.
        touched: everything whose state may differ from the last tick's.
        complete: every sink is achieved.
    """

    achieved: tuple[int, ...]
    active: frozenset[int]
    executing: tuple[int, ...]
    locked: dict[int, int]
    touched: frozenset[int]
    complete: bool


class Activation:
    """The activation of one program in one context.

    Args:
        program: the compiled network.
        context: its run-time state; the tables here are derived from it, also when it was loaded from elsewhere.
    """

    def __init__(self, program: Program, context: Context) -> None:
        self.program = program
        self.context = context
        count = len(program.nodes)
        self.levels = [0] * count
        self.unmet = [len(program.incoming[row]) for row in range(count)]
        self.satisfied = [False] * len(program.arcs)
        self._open_sinks = len(program.sinks)
        self._sinks = frozenset(program.sinks)
        self._ready: set[int] = set()
        self._touched: set[int] = set(range(count))
        self._due: list[int] = [row for row in range(count) if not self.unmet[row]]
        for sink in program.sinks:
            if context.achieved[sink]:
                self._open_sinks -= 1
            else:
                self._raise_level(sink, 1)
        for arc in program.arcs:
            self._refresh(arc)

    # -- the tick -----------------------------------------------------------------------------------------

    def decide(self, effects: Sequence[bool], precondition: Callable[[int], bool]) -> Step:
        """Steps 2 to 5 of one tick. Afterwards the tables tell why, until :meth:`commit` is called.

        Args:
            effects: for every node, whether its goal holds according to this tick's percepts.
            precondition: whether the world precondition of a node holds now; asked for active nodes only.
        """
        self._read_effects(effects)
        achieved = self._latch()
        active = self._activate()
        executing, locked = self._lock(active, precondition)
        self._touched |= self.context.active ^ active
        self._touched |= set(self.context.executing) ^ set(executing)
        return Step(achieved, active, executing, locked, frozenset(self._touched | active), not self._open_sinks)

    def _read_effects(self, effects: Sequence[bool]) -> None:
        """Step 2. An inhibited component computes nothing: its effects keep their last value (semantics §1)."""
        known, inhibited = self.context.effects, self.context.inhibited
        if effects == known:
            return
        for row, value in enumerate(effects):
            if value is not known[row] and row not in inhibited:
                known[row] = value
                self._touched.add(row)
                if self.context.achieved[row]:
                    for arc in self.program.outgoing[row]:
                        self._refresh(arc)
                elif value and not self.unmet[row]:
                    self._due.append(row)

    def _latch(self) -> tuple[int, ...]:
        """Step 3: whoever is due and has its goal is achieved, which may make others due, in the same tick."""
        context = self.context
        found: list[int] = []
        still_inhibited: list[int] = []
        while self._due:
            # One after the other as they become due; those that do so together in document order.
            round_, self._due = sorted(set(self._due)), []
            for row in round_:
                if context.achieved[row] or self.unmet[row] or not context.effects[row]:
                    continue
                if row in context.inhibited:
                    still_inhibited.append(row)
                    continue
                context.achieved[row] = True
                found.append(row)
                self._touched.add(row)
                if row in self._sinks:
                    self._open_sinks -= 1
                    self._raise_level(row, -1)
                for arc in self.program.outgoing[row]:
                    self._refresh(arc)
        self._due = still_inhibited
        return tuple(found)

    def _activate(self) -> frozenset[int]:
        """Step 5, without the locks; the levels of step 4 are up to date already."""
        inhibited = self.context.inhibited
        active = self._ready | self.context.keep_on
        return frozenset(active - inhibited.keys() if inhibited else active)

    def _lock(
        self, active: frozenset[int], precondition: Callable[[int], bool]
    ) -> tuple[tuple[int, ...], dict[int, int]]:
        """Step 5, the locks: who executed before keeps them; then the higher level; then document order.

        A maintaining behavior that is kept going for its successors takes only what all others leave free.
        """
        context, nodes = self.context, self.program.nodes
        before, achieved = frozenset(context.executing), context.achieved

        def turn(row: int) -> tuple[bool, bool, int, int]:
            return nodes[row].maintaining and achieved[row], row not in before, -self.full_level(row), row

        order = sorted(active, key=turn)
        owners: dict[str, int] = {}
        executing: list[int] = []
        locked: dict[int, int] = {}
        for row in order:
            if row not in context.keep_on and not precondition(row):
                continue
            actuators = nodes[row].actuators
            owner = next((owners[actuator] for actuator in actuators if actuator in owners), None)
            if owner is not None:
                locked[row] = owner
                continue
            for actuator in actuators:
                owners[actuator] = row
            executing.append(row)
        return tuple(executing), locked

    def commit(self, step: Step) -> None:
        """Step 6, and what the next tick needs to know of this one."""
        context, active, executing = self.context, step.active, step.executing
        self._touched = set()
        # An enabling link is not looked at while its target stays active: its satisfaction follows the activity.
        changed = context.active ^ active
        context.active = active
        for row in changed:
            for arc in self.program.incoming[row]:
                if arc.type is LinkType.ENABLING:
                    self._refresh(arc)
        inhibited = {rival: row for row in reversed(executing) for rival in self.program.rivals[row]}
        if inhibited != context.inhibited:
            freed = context.inhibited.keys() - inhibited.keys()
            self._due += freed
            self._touched |= {row for row, _ in context.inhibited.items() ^ inhibited.items()}
            context.inhibited = inhibited
        context.executing = executing
        context.tick += 1

    def refusals(self, row: int) -> list[Arc]:
        """The unsatisfied links of a node, in document order; all of them, not the first only."""
        return [arc for arc in self.program.incoming[row] if not self.satisfied[arc.row]]

    def full_level(self, row: int) -> int:
        """The activation level that the component would have if every implied ordering link were stored.

        A component not yet achieved is needed by all that come after it; one that has been achieved is needed only over
        enabling and permanent links, which are never left out. Locks go by this level, since reduced and full
        networks must behave the same (semantics §2).
        """
        return self.levels[row] if self.context.achieved[row] else self.program.followers[row]

    # -- what follows from what ---------------------------------------------------------------------------

    def _holds(self, arc: Arc) -> bool:
        """Semantics §2, the table of links."""
        context = self.context
        if not context.achieved[arc.source]:
            return False
        if arc.type is LinkType.ORDERING or context.effects[arc.source]:
            return True
        return arc.type is LinkType.ENABLING and arc.target in context.active

    def _refresh(self, arc: Arc) -> None:
        """Brings a link, and all that follows from it, up to date."""
        holds = self._holds(arc)
        if holds is self.satisfied[arc.row]:
            return
        target = arc.target
        needed = self.levels[target] > 0
        if needed:
            self._raise_level(arc.source, -self._sends(arc))
        self.satisfied[arc.row] = holds
        if needed:
            self._raise_level(arc.source, self._sends(arc))
        self.unmet[target] += -1 if holds else 1
        self._touched.add(target)
        if not self.unmet[target]:
            self._due.append(target)
        self._place(target)

    def _sends(self, arc: Arc) -> int:
        """Step 4: what a needed component sends along one of its incoming links."""
        if not self.satisfied[arc.row]:
            return 1
        return int(arc.type is LinkType.PERMANENT and self.program.nodes[arc.source].maintaining)

    def _raise_level(self, row: int, by: int) -> None:
        """Changes a level; whoever begins or ceases to be needed passes that on to its predecessors."""
        changes = [(row, by)]
        while changes:
            row, by = changes.pop()
            if not by:
                continue
            before = self.levels[row]
            after = self.levels[row] = before + by
            self._touched.add(row)
            if (before > 0) is not (after > 0):
                sign = 1 if after > 0 else -1
                changes += [(arc.source, sign * self._sends(arc)) for arc in self.program.incoming[row]]
                self._place(row)

    def _place(self, row: int) -> None:
        if self.levels[row] > 0 and not self.unmet[row]:
            self._ready.add(row)
        else:
            self._ready.discard(row)
