"""Which components are active: steps 2 to 6 and 8 of the tick (semantics §3), computed from what has changed.

What follows from the context is kept up to date from one tick to the next (:class:`Links`, :class:`Locks`,
:class:`Scopes`), so that a tick costs what has changed plus what must be asked, and not what the network's size is.
``tests/execution/reference.py`` recomputes all of it from the definition; the two must agree on every network and
history.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np

from understudy.execution.conditions import NOWHERE, Outside
from understudy.execution.context import Context
from understudy.execution.links import Links
from understudy.execution.locks import Locks
from understudy.execution.program import Program
from understudy.execution.scopes import Scopes
from understudy.execution.step import Step
from understudy.network import LinkType, Trigger

__all__ = ["Activation"]


class Activation:
    """The activation of one program in one context.

    Args:
        program: the compiled network.
        context: its run-time state; the tables here are derived from it, also when it was loaded from elsewhere.
    """

    def __init__(self, program: Program, context: Context) -> None:
        self.program = program
        self.context = context
        self._simple = not (program.nabs or program.untils or program.timeouts or program.duties)
        self._derive(NOWHERE)

    def _derive(self, outside: Outside) -> None:
        """All tables, from the context alone."""
        program, context = self.program, self.context
        self.links = Links(program, context)
        self.locks = Locks(program, context, self.links)
        self.scopes = Scopes(program, context, self.links, outside)
        self._known = bytearray(context.effects)

    def decide(self, effects: Sequence[bool], precondition: Callable[[int], bool], outside: Outside = NOWHERE) -> Step:
        """Steps 2 to 5 of one tick. Afterwards the tables tell why, until :meth:`commit` is called.

        Args:
            effects: for every node, whether its goal holds according to this tick's percepts; looked at for the
                :attr:`Scopes.readable` ones only.
            precondition: whether the world precondition of a node holds now; asked for those that could execute.
            outside: time, events, and what conditions ask for.
        """
        context = self.context
        self.scopes.outside = outside
        self._changed: list[int] = []
        context.begun.setdefault(0, outside.time_s)
        out_of_time, skipped, stopped = self._run_clocks() if self.program.timeouts else ((), (), None)
        self._read_effects(effects)
        called = self._call_duties() if self.program.duties else ()
        achieved = self._latch()
        active = self._activate()
        executing, owners = self.locks.give(active, precondition)
        if active is not context.active:
            self.links.touched |= context.active ^ active
        if executing != context.executing:
            differ = set(context.executing) ^ set(executing)
            self.links.touched |= differ.union(*map(self.program.ancestors, differ)) if self.program.nabs else differ
        return Step(
            changed=tuple(self._changed),
            achieved=achieved,
            skipped=skipped,
            timed_out=out_of_time,
            called=called,
            active=active,
            executing=executing,
            owners=owners,
            touched=frozenset(self.links.touched),
            begun_anew=self.scopes.fresh_starts() if self.program.nabs else (),
            complete=not self.scopes.open[0],
            stopped=stopped,
        )

    def _run_clocks(self) -> tuple[tuple[int, ...], tuple[int, ...], int | None]:
        """Step 2: the clocks of components with a timeout that were active in the previous tick go on."""
        context, nodes = self.context, self.program.nodes
        passed = self.scopes.outside.time_s - context.time_s if context.time_s is not None else 0.0
        out: list[int] = []
        skipped: list[int] = []
        stopped: int | None = None
        for row in self.program.timeouts:
            if row not in context.active or context.achieved[row]:
                continue
            timeout = nodes[row].timeout
            assert timeout is not None
            context.active_s[row] = context.active_s.get(row, 0.0) + passed
            if round(1e6 * context.active_s[row]) < round(1e6 * timeout.seconds):
                continue
            context.active_s[row] = 0.0
            context.timed_out.add(row)
            out.append(row)
            if timeout.then == "signal":
                self.scopes.outside = replace(self.scopes.outside, events=self.scopes.outside.events | {timeout.event})
            elif timeout.then == "stop":
                stopped = row if stopped is None else stopped
            else:
                skipped.append(row)
                context.skipped.add(row)
                self._achieve(row)
        return tuple(out), tuple(skipped), stopped

    def _read_effects(self, effects: Sequence[bool]) -> None:
        """Step 2. Who is disabled or inhibited computes nothing: its effects keep their last value (semantics §1)."""
        known, inhibited = self.context.effects, self.context.inhibited
        if self._simple:
            if effects == known:
                return
            # As bytes, since a thousand of them are compared in the time of a handful of Python's own steps.
            differ = np.frombuffer(bytes(effects), np.uint8) != np.frombuffer(self._known, np.uint8)
            changed = [row for row in np.flatnonzero(differ).tolist() if row not in inhibited]
        else:
            values = self._effects_now(effects)
            changed = [row for row, value in values if value is not known[row] and row not in inhibited]
        for row in changed:
            self._set_effect(row, not known[row])

    def _effects_now(self, effects: Sequence[bool]) -> Iterator[tuple[int, bool]]:
        """The goals of behaviors and networks that are used, where those that are done early count as reached."""
        context, nodes = self.context, self.program.nodes
        for row in self.scopes.readable:
            until = nodes[row].until
            yield row, effects[row] or (until is not None and self.scopes.so(until, nodes[row].scope))
        for row in self.program.nabs:
            node = nodes[row]
            if self.scopes.enabled[node.scope] and not context.effects[row]:
                yield row, row in context.active and node.until is not None and self.scopes.so(node.until, node.scope)

    def _set_effect(self, row: int, value: bool) -> None:
        context = self.context
        context.effects[row] = value
        self._known[row] = value
        self._changed.append(row)
        self.links.touched.add(row)
        if context.achieved[row]:
            for arc in self.program.watching[row]:
                self.links.refresh(arc)
        elif value and not self.links.unmet[row]:
            self.links.due.append(row)

    def _call_duties(self) -> tuple[int, ...]:
        """Step 2: duties whose time has come, or whose condition has come true, are asked for."""
        context, nodes = self.context, self.program.nodes
        called: list[int] = []
        for row in self.program.duties:
            node = nodes[row]
            trigger = node.trigger
            assert trigger is not None
            if not self.scopes.enabled[node.scope]:
                continue
            if trigger.on is not None:
                rings = self.scopes.so(trigger.on, node.scope)
                calls = rings and row not in context.rung
                (context.rung.add if rings else context.rung.discard)(row)
            else:
                calls = self._is_time(row, trigger)
            if calls and row not in context.called and self.scopes.open[node.scope]:
                self._call(row)
                called.append(row)
        return tuple(called)

    def _is_time(self, row: int, trigger: Trigger) -> bool:
        """Whether a periodic duty that is not being done is to be done again."""
        context, now = self.context, self.scopes.outside.time_s
        if row in context.called or trigger.every_s is None:
            return False
        if row not in context.due_s:
            context.due_s[row] = now + trigger.every_s
        return round(1e6 * now) >= round(1e6 * context.due_s[row])

    def _call(self, row: int) -> None:
        """A duty is asked for: what it achieved when it was called before does not count."""
        context = self.context
        context.called.add(row)
        context.due_s.pop(row, None)
        context.skipped.discard(row)
        context.timed_out.discard(row)
        context.active_s.pop(row, None)
        context.achieved[row] = False
        if self.program.nodes[row].scopes:
            context.effects[row] = False
            context.rounds.pop(row, None)
            context.chosen.pop(row, None)
            context.active -= {row}  # what Continue may have kept going belongs to the call before
            context.forget(self.program, row)
            self._derive_again()
        else:
            self.links.raise_level(row, 1)
            self.links.due.append(row)

    def _derive_again(self) -> None:
        """After a part of the context was forgotten, or another way was taken."""
        due = self.links.due
        self._derive(self.scopes.outside)
        self.links.due += due

    def _latch(self) -> tuple[int, ...]:
        """Step 3: whoever is due and has its goal is achieved, which may make others due, in the same tick."""
        context = self.context
        found: list[int] = []
        still_inhibited: list[int] = []
        while self.links.due or self._complete_networks():
            # One after the other as they become due; those that do so together in document order.
            round_, self.links.due = sorted(set(self.links.due)), []
            for row in [row for row in round_ if self._is_due(row)]:
                if row in context.inhibited:
                    still_inhibited.append(row)
                elif self._is_due(row):  # an alternative to it may have been taken meanwhile
                    found.append(row)
                    self._achieve(row)
        self.links.due = still_inhibited
        return tuple(found)

    def _is_due(self, row: int) -> bool:
        """Whether a component that has not been achieved is to be, if nothing inhibits it."""
        context, node = self.context, self.program.nodes[row]
        if context.achieved[row] or self.links.unmet[row] or not context.effects[row] or not self.links.in_play[row]:
            return False
        return self.scopes.enabled[node.scope] and (node.trigger is None or row in context.called)

    def _achieve(self, row: int) -> None:
        """Sets the latch, and what follows from it: links, levels, the completion of the network."""
        context = self.context
        context.achieved[row] = True
        self.links.touched.add(row)
        self.links.turns_stale = True
        context.active_s.pop(row, None)
        if row not in context.skipped:
            context.timed_out.discard(row)
        if row in context.called:
            context.called.discard(row)
            self.links.raise_level(row, -1)
        node = self.program.nodes[row]
        if self.program.scopes[node.scope].ways is not None and node.trigger is None:
            # It is taken, and others come into play or go out of it; that happens once a step, so all is derived again.
            context.taken[node.scope] = (*context.taken.get(node.scope, ()), row)
            self._derive_again()
            return
        self.scopes.achieve(row)
        for arc in self.program.outgoing[row]:
            self.links.refresh(arc)

    def _complete_networks(self) -> bool:
        """Step 3, once no more latches follow: of a network that is complete the duties are dropped, and its NAB's goal
        holds, unless another round or case follows. Says whether anything did.
        """
        context = self.context
        for row in sorted(context.called):
            if not self.scopes.open[self.program.nodes[row].scope]:
                context.called.discard(row)
                self.links.raise_level(row, -1)
        done = [nab for nab in self.program.nabs if self.scopes.is_done(nab)]
        for nab in done:
            self._set_effect(nab, True)
        return bool(self.links.due)

    def _activate(self) -> frozenset[int]:
        """Step 5, without the locks; the levels of step 4 are up to date already."""
        context = self.context
        keep_on, inhibited = context.keep_on, context.inhibited
        if not self.links.stale and not keep_on and not inhibited:
            return context.active
        active = self.links.ready.copy()
        for row in keep_on:
            # So does every NAB in which it stands: it is as good as a behavior (§3.4).
            chain = (row, *self.program.ancestors(row))
            if self.scopes.enabled[self.program.nodes[row].scope] and inhibited.keys().isdisjoint(chain):
                active.update(chain)
        if inhibited:
            active -= inhibited.keys()
        for scope in self.program.scopes[1:]:
            # Outer scopes come first: what is inside of a NAB that ceases to be active ceases, too.
            if self.scopes.enabled[scope.number] and scope.nab not in active:
                active -= set(range(scope.rows[0], scope.end))
        self.links.stale = bool(keep_on or inhibited)
        return context.active if active == context.active else frozenset(active)

    def commit(self, step: Step) -> None:
        """Steps 6 and 8, and what the next tick needs to know of this one."""
        context, active, executing = self.context, step.active, step.executing
        self.links.touched = set()
        if active is not context.active:
            # An enabling link is not looked at while its target stays active: its satisfaction follows the activity.
            changed = context.active ^ active
            context.active = active
            for row in sorted(changed):
                for arc in self.program.incoming[row]:
                    if arc.type is LinkType.ENABLING:
                        self.links.refresh(arc)
                if self.program.nodes[row].scopes:
                    self.scopes.use(row, row in active)
        if executing != context.executing or context.inhibited:
            self._inhibit(executing)
        context.executing = executing
        for start in step.begun_anew:
            self.scopes.begin_anew(start)
        if step.begun_anew:
            self._derive_again()
        context.time_s = self.scopes.outside.time_s
        context.tick += 1

    def _inhibit(self, executing: Sequence[int]) -> None:
        """Step 6: who executes inhibits its rivals from the next tick on; a NAB executes if one of its parts does."""
        context, program = self.context, self.program
        busy = sorted({one for row in executing for one in program.ancestors(row)}) if program.nabs else []
        inhibited = {rival: row for row in (*reversed(executing), *busy) for rival in program.rivals[row]}
        if inhibited != context.inhibited:
            self.links.due += context.inhibited.keys() - inhibited.keys()
            self.links.touched |= {row for row, _ in context.inhibited.items() ^ inhibited.items()}
            self.links.stale = True
            context.inhibited = inhibited
