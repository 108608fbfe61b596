"""All run-time state of a running task, in one place (semantics §3)."""

from dataclasses import dataclass, field
from random import Random
from typing import Any

from understudy.behaviors import Memory
from understudy.execution.program import Program
from understudy.execution.trace import State
from understudy.execution.ways import Way

__all__ = ["Context", "Told"]

Told = tuple[State, dict[str, Any]]
"""A component's state, the first condition that decides it, and all others that do."""


@dataclass(slots=True)
class Context:
    """What changes while a task runs. Plain data: it can be copied, saved and compared.

    Attributes:
        tick: how many ticks have been made.
        time_s: of the last one; None before the first.
        effects: for every node, the last value of its goal, the port ``Effects``.
        achieved: for every node, the latch of semantics §2.
        active: rows active in the previous tick, the port ``Active``.
        executing: rows of behaviors that executed in the previous tick, in the order in which they took their locks.
        inhibited: for every row inhibited now, the row that inhibits it.
        keep_on: rows whose primitive asserted ``Continue`` in the previous tick.
        chosen: for every NAB that has been begun, its scope; -1 if no case fits and there is nothing to do.
        begun: for every scope in use, when it was begun.
        rounds: for every NAB that repeats, how many rounds are complete.
        taken: for every scope with alternatives, the rows of the way through it so far.
        skipped: rows that ran out of time and are passed over.
        timed_out: rows that ran out of time and have not been achieved since.
        active_s: for every row with a timeout, for how long it has been active.
        called: duties that are asked for now.
        rung: duties whose condition was true in the previous tick.
        due_s: for every periodic duty, when it is called next.
        memories: what primitives remember, by row.
        wander: what ``Wander`` remembers.
        random: the only source of chance (not looked at when contexts are compared).
        told: the state of every row that the trace has told last.
        avoiding: ``Avoid`` overrode the wheels in the previous tick.
        completed: completion has been told.
    """

    effects: list[bool]
    achieved: list[bool]
    random: Random = field(compare=False)
    tick: int = 0
    time_s: float | None = None
    active: frozenset[int] = frozenset()
    executing: tuple[int, ...] = ()
    inhibited: dict[int, int] = field(default_factory=dict)
    keep_on: frozenset[int] = frozenset()
    chosen: dict[int, int] = field(default_factory=dict)
    begun: dict[int, float] = field(default_factory=dict)
    rounds: dict[int, int] = field(default_factory=dict)
    taken: dict[int, Way] = field(default_factory=dict)
    skipped: set[int] = field(default_factory=set)
    timed_out: set[int] = field(default_factory=set)
    active_s: dict[int, float] = field(default_factory=dict)
    called: set[int] = field(default_factory=set)
    rung: set[int] = field(default_factory=set)
    due_s: dict[int, float] = field(default_factory=dict)
    memories: dict[int, Memory] = field(default_factory=dict)
    wander: Memory = field(default_factory=dict)
    told: dict[int, Told] = field(default_factory=dict)
    avoiding: bool = False
    completed: bool = False

    @classmethod
    def start(cls, program: Program, seed: int = 0) -> "Context":
        """The state before the first tick: nothing achieved, nothing active."""
        count = len(program.nodes)
        return cls(effects=[False] * count, achieved=[False] * count, random=Random(seed))

    def pass_over(self, seconds: float) -> None:
        """Time has passed in which nothing was executed: the clocks do not count it, and primitives begin anew."""
        if self.time_s is not None:
            self.time_s += seconds
        self.begun = {scope: time_s + seconds for scope, time_s in self.begun.items()}
        self.due_s = {row: time_s + seconds for row, time_s in self.due_s.items()}
        self.keep_on = frozenset()
        self.memories, self.wander = {}, {}

    def forget(self, program: Program, nab: int) -> None:
        """A NAB is begun anew: what it contains has not been achieved, and has no past (semantics §3)."""
        inside = range(nab + 1, max(program.scopes[scope].end for scope in program.nodes[nab].scopes))
        scopes = {scope for row in (nab, *inside) for scope in program.nodes[row].scopes}
        for row in inside:
            self.achieved[row] = False
            if program.nodes[row].scopes:
                self.effects[row] = False
            self._forget_times(row)
            self.rounds.pop(row, None)
            self.chosen.pop(row, None)
            self.memories.pop(row, None)
        self.active -= frozenset(inside)
        self.executing = tuple(row for row in self.executing if row not in inside)
        self.keep_on -= frozenset(inside)
        for scope in scopes:
            self.begun.pop(scope, None)
            self.taken.pop(scope, None)

    def _forget_times(self, row: int) -> None:
        for rows in (self.skipped, self.timed_out, self.called, self.rung):
            rows.discard(row)
        self.active_s.pop(row, None)
        self.due_s.pop(row, None)
