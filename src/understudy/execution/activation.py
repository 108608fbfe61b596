"""Which components are active: steps 2 to 6 and 8 of the tick (semantics §3), computed from what has changed.

Whether a link is satisfied, how many of a component's links are not, and a component's activation level all follow from
the context. They are kept up to date here from one tick to the next, so that a tick costs what has changed plus what
must be asked, and not what the network's size is. ``tests/execution/reference.py`` recomputes all of it from the
definition; the two must agree on every network and history.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from typing import NamedTuple

import numpy as np

from understudy.execution.conditions import NOWHERE, Outside, holds
from understudy.execution.context import Context
from understudy.execution.program import Arc, Program
from understudy.network import Condition, LinkType, Trigger

__all__ = ["NOTHING", "Activation", "Start", "Step"]

NOTHING = -1
"""Instead of a scope: no case of the NAB fits, and there is nothing to do."""


class Start(NamedTuple):
    """A NAB whose network is begun anew: the scope to which it switches, or None for another round."""

    nab: int
    switched_to: int | None


@dataclass(frozen=True, slots=True)
class Step:
    """What one tick decided; rows of the program's nodes.

    Attributes:
        changed: whose goal came true or ceased to be.
        achieved: newly achieved in this tick, predecessors first.
        skipped: ran out of time, and are passed over.
        timed_out: ran out of time in this tick.
        called: duties that began to be asked for.
        active: the port ``Active`` is true; executing or searching.
        executing: behaviors that are active, whose world precondition holds, and whose actuators are their own.
        owners: who holds each actuator.
        touched: everything whose state may differ from the last tick's.
        begun_anew: NABs whose network is begun again in the next tick: another round, or a switch to another case.
        complete: every sink of the whole task is achieved.
        stopped: the row of a component that ran out of time and stops the run; None if none does.
    """

    changed: tuple[int, ...]
    achieved: tuple[int, ...]
    skipped: tuple[int, ...]
    timed_out: tuple[int, ...]
    called: tuple[int, ...]
    active: frozenset[int]
    executing: tuple[int, ...]
    owners: dict[str, int]
    touched: frozenset[int]
    begun_anew: tuple[Start, ...]
    complete: bool
    stopped: int | None


class Activation:
    """The activation of one program in one context.

    Args:
        program: the compiled network.
        context: its run-time state; the tables here are derived from it, also when it was loaded from elsewhere.
    """

    def __init__(self, program: Program, context: Context) -> None:
        self.program = program
        self.context = context
        self._locks = frozenset(actuator for node in program.nodes for actuator in node.actuators)
        self._simple = not (program.nabs or program.untils or program.timeouts or program.duties)
        self._outside = NOWHERE
        self._build()

    def _build(self) -> None:
        """All tables, from the context alone."""
        program, context = self.program, self.context
        size = len(program.nodes)
        self._known = bytearray(context.effects)
        self.levels = [0] * size
        self.unmet = [len(program.incoming[row]) for row in range(size)]
        self.satisfied = [False] * len(program.arcs)
        self.enabled = [self._is_enabled(number) for number in range(len(program.scopes))]
        self._open = [len(scope.sinks) for scope in program.scopes]
        self._sinks = frozenset(chain.from_iterable(scope.sinks for scope in program.scopes))
        self._ready: set[int] = set()
        self._touched: set[int] = set(range(size))
        self._due: list[int] = [row for row in range(size) if not self.unmet[row]]
        self._asked: frozenset[int] = frozenset()
        self._parts: tuple[list[int], ...] | None = None
        self._stale = True
        self._owners: dict[str, int] = {}
        self._read: tuple[int, ...] | None = None
        for scope in program.scopes:
            self._open[scope.number] -= sum(context.achieved[sink] for sink in scope.sinks)
            if self.enabled[scope.number]:
                self._ask(scope.number, 1)
        for arc in program.arcs:
            self._refresh(arc)

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

    # -- the tick -----------------------------------------------------------------------------------------

    def decide(self, effects: Sequence[bool], precondition: Callable[[int], bool], outside: Outside = NOWHERE) -> Step:
        """Steps 2 to 5 of one tick. Afterwards the tables tell why, until :meth:`commit` is called.

        Args:
            effects: for every node, whether its goal holds according to this tick's percepts; looked at for the
                :attr:`readable` ones only.
            precondition: whether the world precondition of a node holds now; asked for those that could execute.
            outside: time, events, and what conditions ask for.
        """
        context = self.context
        self._outside = outside
        self._changed: list[int] = []
        context.begun.setdefault(0, outside.time_s)
        out_of_time, skipped, stopped = self._run_clocks() if self.program.timeouts else ((), (), None)
        self._read_effects(effects)
        called = self._call_duties() if self.program.duties else ()
        achieved = self._latch()
        active = self._activate()
        executing, owners = self._lock(active, precondition)
        if active is not context.active:
            self._touched |= context.active ^ active
        if executing != context.executing:
            differ = set(context.executing) ^ set(executing)
            self._touched |= differ.union(*map(self.program.ancestors, differ)) if self.program.nabs else differ
        return Step(
            changed=tuple(self._changed),
            achieved=achieved,
            skipped=skipped,
            timed_out=out_of_time,
            called=called,
            active=active,
            executing=executing,
            owners=owners,
            touched=frozenset(self._touched),
            begun_anew=self._fresh_starts() if self.program.nabs else (),
            complete=not self._open[0],
            stopped=stopped,
        )

    def _run_clocks(self) -> tuple[tuple[int, ...], tuple[int, ...], int | None]:
        """Step 2: the clocks of components with a timeout that were active in the previous tick go on."""
        context, nodes = self.context, self.program.nodes
        passed = self._outside.time_s - context.time_s if context.time_s is not None else 0.0
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
                self._outside = replace(self._outside, events=self._outside.events | {timeout.event})
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
        for row in self.readable:
            until = nodes[row].until
            yield row, effects[row] or (until is not None and self._so(until, nodes[row].scope))
        for row in self.program.nabs:
            node = nodes[row]
            if self.enabled[node.scope] and not context.effects[row]:
                yield row, row in context.active and node.until is not None and self._so(node.until, node.scope)

    def _set_effect(self, row: int, value: bool) -> None:
        context = self.context
        context.effects[row] = value
        self._known[row] = value
        self._changed.append(row)
        self._touched.add(row)
        if context.achieved[row]:
            for arc in self.program.watching[row]:
                self._refresh(arc)
        elif value and not self.unmet[row]:
            self._due.append(row)

    def _call_duties(self) -> tuple[int, ...]:
        """Step 2: duties whose time has come, or whose condition has come true, are asked for."""
        context, nodes = self.context, self.program.nodes
        called: list[int] = []
        for row in self.program.duties:
            node = nodes[row]
            trigger = node.trigger
            assert trigger is not None
            if not self.enabled[node.scope]:
                continue
            if trigger.on is not None:
                rings = self._so(trigger.on, node.scope)
                calls = rings and row not in context.rung
                (context.rung.add if rings else context.rung.discard)(row)
            else:
                calls = self._is_time(row, trigger)
            if calls and row not in context.called and self._open[node.scope]:
                self._call(row)
                called.append(row)
        return tuple(called)

    def _is_time(self, row: int, trigger: Trigger) -> bool:
        """Whether a periodic duty that is not being done is to be done again."""
        context, now = self.context, self._outside.time_s
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
            context.forget(self.program, row)
            self._rebuild()
        else:
            self._raise_level(row, 1)
            self._due.append(row)

    def _rebuild(self) -> None:
        """After a part of the context was forgotten."""
        due, touched = self._due, self._touched
        self._build()
        self._due += due
        self._touched |= touched

    def _latch(self) -> tuple[int, ...]:
        """Step 3: whoever is due and has its goal is achieved, which may make others due, in the same tick."""
        context, nodes = self.context, self.program.nodes
        found: list[int] = []
        still_inhibited: list[int] = []
        while self._due or self._complete_networks():
            # One after the other as they become due; those that do so together in document order.
            round_, self._due = sorted(set(self._due)), []
            for row in round_:
                if context.achieved[row] or self.unmet[row] or not context.effects[row]:
                    continue
                node = nodes[row]
                if not self.enabled[node.scope] or (node.trigger is not None and row not in context.called):
                    continue
                if row in context.inhibited:
                    still_inhibited.append(row)
                    continue
                found.append(row)
                self._achieve(row)
        self._due = still_inhibited
        return tuple(found)

    def _achieve(self, row: int) -> None:
        """Sets the latch, and what follows from it: links, levels, the completion of the network."""
        context, node = self.context, self.program.nodes[row]
        context.achieved[row] = True
        self._touched.add(row)
        self._parts = None
        context.active_s.pop(row, None)
        if row not in context.skipped:
            context.timed_out.discard(row)
        if row in context.called:
            context.called.discard(row)
            self._raise_level(row, -1)
        if row in self._sinks:
            self._open[node.scope] -= 1
            self._raise_level(row, -1)
        for arc in self.program.outgoing[row]:
            self._refresh(arc)

    def _complete_networks(self) -> bool:
        """Step 3, once no more latches follow: of a network that is complete the duties are dropped, and its NAB's goal
        holds, unless another round or case follows. Says whether anything did.
        """
        context = self.context
        for row in sorted(context.called):
            if not self._open[self.program.nodes[row].scope]:
                context.called.discard(row)
                self._raise_level(row, -1)
        done = [nab for nab in self.program.nabs if self._is_done(nab)]
        for nab in done:
            self._set_effect(nab, True)
        return bool(self._due)

    def _is_done(self, nab: int) -> bool:
        """Whether a NAB that is used has nothing to do, or its network is complete and not begun anew."""
        context, node = self.context, self.program.nodes[nab]
        number = context.chosen.get(nab)
        if number is None or context.effects[nab] or nab in context.inhibited or not self.enabled[node.scope]:
            return False
        return number == NOTHING or (not self._open[number] and self._goes_on(nab) is None)

    def _goes_on(self, nab: int) -> Start | None:
        """What a NAB in use begins anew after this tick: the target of a switch, or another round."""
        context, node = self.context, self.program.nodes[nab]
        number = context.chosen.get(nab, NOTHING)
        if number == NOTHING or not self.enabled[number] or context.effects[nab]:
            return None
        complete = not self._open[number]
        for route in node.routes:
            if route.source == number and self._so(route.when, number, complete=complete):
                return Start(nab, route.target)
        if not complete or node.repeat is None:
            return None
        over = node.repeat.until is not None and self._so(node.repeat.until, node.scope)
        last = node.repeat.times is not None and context.rounds.get(nab, 0) + 1 >= node.repeat.times
        return None if over or last else Start(nab, None)

    def _fresh_starts(self) -> tuple[Start, ...]:
        """Everything that is begun anew after this tick; what stands inside of it is begun with it."""
        starts = {nab: start for nab in self.program.nabs if (start := self._goes_on(nab)) is not None}
        return tuple(
            start for nab, start in starts.items() if not any(one in starts for one in self.program.ancestors(nab))
        )

    def _activate(self) -> frozenset[int]:
        """Step 5, without the locks; the levels of step 4 are up to date already."""
        context = self.context
        keep_on, inhibited = context.keep_on, context.inhibited
        if not self._stale and not keep_on and not inhibited:
            return context.active
        active = self._ready.copy()
        for row in keep_on:
            # So does every NAB in which it stands: it is as good as a behavior (§3.4).
            chain = (row, *self.program.ancestors(row))
            if self.enabled[self.program.nodes[row].scope] and inhibited.keys().isdisjoint(chain):
                active.update(chain)
        if inhibited:
            active -= inhibited.keys()
        for scope in self.program.scopes[1:]:
            # Outer scopes come first: what is inside of a NAB that ceases to be active ceases, too.
            if self.enabled[scope.number] and scope.nab not in active:
                active -= set(range(scope.rows[0], scope.end))
        self._stale = bool(keep_on or inhibited)
        return context.active if active == context.active else frozenset(active)

    def _lock(
        self, active: frozenset[int], precondition: Callable[[int], bool]
    ) -> tuple[tuple[int, ...], dict[str, int]]:
        """Step 5, the locks: duties first; then who executed before; then the higher level; then document order.

        A maintaining behavior that is kept going for its successors takes only what all others leave free. Nobody is
        asked for its precondition whose actuators are another's.
        """
        context, nodes = self.context, self.program.nodes
        owners: dict[str, int] = {}
        executing: list[int] = []
        asked: list[int] = []
        for row in self._turns(active):
            actuators = nodes[row].actuators
            if actuators:
                if len(owners) == len(self._locks):
                    break
                if any(actuator in owners for actuator in actuators):
                    continue
            asked.append(row)
            if row not in context.keep_on and not precondition(row):
                continue
            for actuator in actuators:
                owners[actuator] = row
            executing.append(row)
        now_asked = frozenset(asked)
        self._touched |= now_asked
        self._touched |= self._asked - now_asked
        if owners != self._owners:
            self._touched |= active
        self._asked, self._owners = now_asked, owners
        return tuple(executing), owners

    def _turns(self, active: frozenset[int]) -> Iterator[int]:
        """The active behaviors in the order in which they take their locks; those without actuators first."""
        context, nodes = self.context, self.program.nodes
        if self._parts is None or active is not context.active:
            parts: tuple[list[int], ...] = ([], [], [], [])
            for row in active:
                node = nodes[row]
                if node.scopes:
                    continue
                yields = node.maintaining and context.achieved[row]
                parts[0 if not node.actuators else 1 if self._on_duty(row) else 3 if yields else 2].append(row)
            self._parts = tuple(sorted(part, key=self._turn) for part in parts)
            self._part_of = {row: number for number, part in enumerate(parts) for row in part}
        before = [row for row in context.executing if row in active]
        for number, part in enumerate(self._parts):
            yield from sorted((row for row in before if self._part_of[row] == number), key=self._turn)
            for row in part:
                if row not in before:
                    yield row

    def _turn(self, row: int) -> tuple[int, int]:
        return -self.full_level(row), row

    def _on_duty(self, row: int) -> bool:
        nodes = self.program.nodes
        if not self.program.duties:
            return False
        return any(nodes[one].trigger is not None for one in (row, *self.program.ancestors(row)))

    def commit(self, step: Step) -> None:
        """Steps 6 and 8, and what the next tick needs to know of this one."""
        context, active, executing = self.context, step.active, step.executing
        self._touched = set()
        if active is not context.active:
            # An enabling link is not looked at while its target stays active: its satisfaction follows the activity.
            changed = context.active ^ active
            context.active = active
            for row in sorted(changed):
                for arc in self.program.incoming[row]:
                    if arc.type is LinkType.ENABLING:
                        self._refresh(arc)
                if self.program.nodes[row].scopes:
                    self._use(row, row in active)
        if executing != context.executing or context.inhibited:
            self._inhibit(executing)
        context.executing = executing
        for start in step.begun_anew:
            self._begin_anew(start)
        context.time_s = self._outside.time_s
        context.tick += 1

    def _inhibit(self, executing: Sequence[int]) -> None:
        """Step 6: who executes inhibits its rivals from the next tick on; a NAB executes if one of its parts does."""
        context, program = self.context, self.program
        busy = sorted({one for row in executing for one in program.ancestors(row)}) if program.nabs else []
        inhibited = {rival: row for row in (*reversed(executing), *busy) for rival in program.rivals[row]}
        if inhibited != context.inhibited:
            self._due += context.inhibited.keys() - inhibited.keys()
            self._touched |= {row for row, _ in context.inhibited.items() ^ inhibited.items()}
            self._stale = True
            context.inhibited = inhibited

    def _use(self, nab: int, used: bool) -> None:
        """A NAB's ``Active`` drives the ``UseBehavior`` of its components (§3.4)."""
        context = self.context
        if used and nab not in context.chosen:
            self._choose(nab)
        number = context.chosen.get(nab, NOTHING)
        if number == NOTHING or self.enabled[number] is used:
            return
        self.enabled[number] = used
        self._read = None
        if used:
            context.begun.setdefault(number, self._outside.time_s)
            scope = self.program.scopes[number]
            self._due += [row for row in scope.rows if not self.unmet[row]]
        self._ask(number, 1 if used else -1)
        scope = self.program.scopes[number]
        self._touched |= set(range(scope.rows[0], scope.end))

    def _choose(self, nab: int) -> None:
        """A NAB begins with the first case whose condition is so."""
        node = self.program.nodes[nab]
        fits = (
            number
            for number, when in zip(node.scopes, node.cases, strict=True)
            if when is None or self._so(when, node.scope)
        )
        self.context.chosen[nab] = next(fits, NOTHING)

    def _begin_anew(self, start: Start) -> None:
        """Another round, or another case: what is inside of the NAB has not been done."""
        context, nab = self.context, start.nab
        context.forget(self.program, nab)
        if start.switched_to is None:
            context.rounds[nab] = context.rounds.get(nab, 0) + 1
            self._choose(nab)  # a branch in a loop asks its conditions anew
        else:
            context.chosen[nab] = start.switched_to
        if context.chosen[nab] != NOTHING:
            context.begun[context.chosen[nab]] = self._outside.time_s
        self._rebuild()

    def _ask(self, number: int, sign: int) -> None:
        """Step 4, ``Init``: a network that comes into use, or goes out of it, asks for its goals, or no longer."""
        context, scope = self.context, self.program.scopes[number]
        for sink in scope.sinks:
            if not context.achieved[sink]:
                self._raise_level(sink, sign)
        for duty in scope.duties:
            if duty in context.called:
                self._raise_level(duty, sign)

    # -- why ------------------------------------------------------------------------------------------------

    def refusals(self, row: int) -> list[Arc]:
        """The unsatisfied links of a node, in document order; all of them, not the first only."""
        return [arc for arc in self.program.incoming[row] if not self.satisfied[arc.row]]

    @property
    def asked(self) -> frozenset[int]:
        """The rows that were asked for their world precondition in the last tick, since their actuators were free."""
        return self._asked

    def lock_of(self, row: int, step: Step) -> int | None:
        """Who held an actuator that an active behavior needs, at its turn; None if nobody else did.

        Of several owners the one that took its locks first: others may have taken theirs after the behavior's turn.
        """
        owners = {step.owners.get(actuator) for actuator in self.program.nodes[row].actuators}
        return next((owner for owner in step.executing if owner in owners and owner != row), None)

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

    # -- what follows from what ---------------------------------------------------------------------------

    def _so(self, condition: Condition, scope: int, *, complete: bool = False) -> bool:
        return holds(condition, self.program, self.context, self._outside, scope=scope, complete=complete)

    def _holds(self, arc: Arc) -> bool:
        """Semantics §2, the table of links. Nobody waits for what was passed over."""
        context = self.context
        if not context.achieved[arc.source]:
            return False
        if arc.type is LinkType.ORDERING or context.effects[arc.source] or arc.source in context.skipped:
            return True
        return arc.type is LinkType.ENABLING and arc.target in context.active

    def _refresh(self, arc: Arc) -> None:
        """Brings a link, and all that follows from it, up to date."""
        holds_now = self._holds(arc)
        if holds_now is self.satisfied[arc.row]:
            return
        target = arc.target
        needed = self.levels[target] > 0
        if needed:
            self._raise_level(arc.source, -self._sends(arc))
        self.satisfied[arc.row] = holds_now
        if needed:
            self._raise_level(arc.source, self._sends(arc))
        self.unmet[target] += -1 if holds_now else 1
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
            if self.context.achieved[row]:
                self._parts = None
            if (before > 0) is not (after > 0):
                sign = 1 if after > 0 else -1
                changes += [(arc.source, sign * self._sends(arc)) for arc in self.program.incoming[row]]
                self._place(row)

    def _place(self, row: int) -> None:
        ready = self.levels[row] > 0 and not self.unmet[row]
        if ready is (row in self._ready):
            return
        self._stale = True
        if ready:
            self._ready.add(row)
        else:
            self._ready.discard(row)
