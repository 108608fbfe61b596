"""Which networks of the hierarchy are in use, and which are complete: cases, switches and loops (§3.4, §3.6)."""

from itertools import chain

from understudy.execution.conditions import NOWHERE, Outside, holds
from understudy.execution.context import Context
from understudy.execution.links import Links
from understudy.execution.program import Program, Scope
from understudy.execution.step import NOTHING, Start
from understudy.network import Condition

__all__ = ["Scopes"]


class Scopes:
    """The networks of one program in one context: the whole task, and every case of every NAB.

    Args:
        program: the compiled network.
        context: its run-time state.
        links: derived from the same context; a network in use asks for its goals there.
        outside: the world at this tick.

    Attributes:
        enabled: for every scope, the port ``UseBehavior`` of its components.
        open: for every scope, how many of the goals that it asks for are not achieved; none if it is complete.
        outside: the world at this tick; of all that conditions ask for.
    """

    def __init__(self, program: Program, context: Context, links: Links, outside: Outside = NOWHERE) -> None:
        self.program = program
        self.context = context
        self.links = links
        self.outside = outside
        self.enabled = [self._is_enabled(number) for number in range(len(program.scopes))]
        self.open = [sum(not context.achieved[row] for row in self._wanted(scope)) for scope in program.scopes]
        self._sinks = frozenset(chain.from_iterable(scope.sinks for scope in program.scopes if scope.ways is None))
        self._read: tuple[int, ...] | None = None
        for number, enabled in enumerate(self.enabled):
            if enabled:
                self._ask(number, 1)

    def _is_enabled(self, number: int) -> bool:
        nab = self.program.scopes[number].nab
        return nab < 0 or (nab in self.context.active and self.context.chosen.get(nab) == number)

    @property
    def readable(self) -> tuple[int, ...]:
        """The rows of the behaviors that are used: those whose goals are to be read in the next tick."""
        if self._read is None:
            nodes = self.program.nodes
            self._read = tuple(node.row for node in nodes if node.skill is not None and self.enabled[node.scope])
        return self._read

    def _wanted(self, scope: Scope) -> tuple[int, ...]:
        return scope.wanted(self.context.taken.get(scope.number, ()))

    def so(self, condition: Condition, scope: int, *, complete: bool = False) -> bool:
        """Whether a condition that is stated in a network is so now."""
        return holds(condition, self.program, self.context, self.outside, scope=scope, complete=complete)

    def achieve(self, row: int) -> None:
        """A component was achieved: its network asks for it no longer."""
        if row in self._sinks:
            self.open[self.program.nodes[row].scope] -= 1
            self.links.raise_level(row, -1)

    def is_done(self, nab: int) -> bool:
        """Whether a NAB that is used has nothing to do, or its network is complete and not begun anew."""
        context, node = self.context, self.program.nodes[nab]
        number = context.chosen.get(nab)
        if number is None or context.effects[nab] or nab in context.inhibited or not self.enabled[node.scope]:
            return False
        return number == NOTHING or (not self.open[number] and self._goes_on(nab) is None)

    def fresh_starts(self) -> tuple[Start, ...]:
        """Everything that is begun anew after this tick; what stands inside of it is begun with it."""
        starts = {nab: start for nab in self.program.nabs if (start := self._goes_on(nab)) is not None}
        return tuple(
            start for nab, start in starts.items() if not any(one in starts for one in self.program.ancestors(nab))
        )

    def use(self, nab: int, used: bool) -> None:
        """A NAB's ``Active`` drives the ``UseBehavior`` of its components (§3.4)."""
        context, links = self.context, self.links
        if used and nab not in context.chosen:
            self._choose(nab)
        number = context.chosen.get(nab, NOTHING)
        if number == NOTHING or self.enabled[number] is used:
            return
        self.enabled[number] = used
        self._read = None
        scope = self.program.scopes[number]
        if used:
            context.begun.setdefault(number, self.outside.time_s)
            links.due += [row for row in scope.rows if not links.unmet[row]]
        self._ask(number, 1 if used else -1)
        links.touched |= set(range(scope.rows[0], scope.end))

    def begin_anew(self, start: Start) -> None:
        """Another round, or another case: what is inside of the NAB has not been done.

        Only the context is changed: whatever was derived from it has to be derived again.
        """
        context, nab = self.context, start.nab
        context.forget(self.program, nab)
        if start.switched_to is None:
            context.rounds[nab] = context.rounds.get(nab, 0) + 1
            self._choose(nab)  # a branch in a loop asks its conditions anew
        else:
            context.chosen[nab] = start.switched_to
        if context.chosen[nab] != NOTHING:
            context.begun[context.chosen[nab]] = self.outside.time_s

    def _goes_on(self, nab: int) -> Start | None:
        """What a NAB in use begins anew after this tick: the target of a switch, or another round."""
        context, node = self.context, self.program.nodes[nab]
        number = context.chosen.get(nab, NOTHING)
        if number == NOTHING or not self.enabled[number] or context.effects[nab]:
            return None
        complete = not self.open[number]
        for route in node.routes:
            if route.source == number and self.so(route.when, number, complete=complete):
                return Start(nab, route.target)
        if not complete or node.repeat is None:
            return None
        over = node.repeat.until is not None and self.so(node.repeat.until, node.scope)
        last = node.repeat.times is not None and context.rounds.get(nab, 0) + 1 >= node.repeat.times
        return None if over or last else Start(nab, None)

    def _choose(self, nab: int) -> None:
        """A NAB begins with the first case whose condition is so."""
        node = self.program.nodes[nab]
        fits = (
            number
            for number, when in zip(node.scopes, node.cases, strict=True)
            if when is None or self.so(when, node.scope)
        )
        self.context.chosen[nab] = next(fits, NOTHING)

    def _ask(self, number: int, sign: int) -> None:
        """Step 4, ``Init``: a network that comes into use, or goes out of it, asks for its goals, or no longer."""
        context, scope = self.context, self.program.scopes[number]
        for row in self._wanted(scope):
            if not context.achieved[row]:
                self.links.raise_level(row, sign)
        for duty in scope.duties:
            if duty in context.called:
                self.links.raise_level(duty, sign)
