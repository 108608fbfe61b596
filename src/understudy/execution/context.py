"""All run-time state of a running task, in one place (semantics §3)."""

from dataclasses import dataclass, field
from random import Random
from typing import Any

from understudy.behaviors import Memory
from understudy.execution.program import Program
from understudy.execution.trace import State

__all__ = ["Context", "Told"]

Told = tuple[State, dict[str, Any]]
"""A component's state, the first condition that decides it, and all others that do."""


@dataclass(slots=True)
class Context:
    """What changes while a task runs. Plain data: it can be copied, saved and compared.

    Attributes:
        tick: how many ticks have been made.
        effects: for every node, the last value of its goal, the port ``Effects``.
        achieved: for every node, the latch of semantics §2.
        active: rows active in the previous tick, the port ``Active``.
        executing: rows that executed in the previous tick, in the order in which they took their locks.
        inhibited: for every row inhibited now, the row that inhibits it.
        keep_on: rows whose primitive asserted ``Continue`` in the previous tick.
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
    active: frozenset[int] = frozenset()
    executing: tuple[int, ...] = ()
    inhibited: dict[int, int] = field(default_factory=dict)
    keep_on: frozenset[int] = frozenset()
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
