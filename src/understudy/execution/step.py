"""What one tick decided, by rows of the program."""

from dataclasses import dataclass
from typing import NamedTuple

__all__ = ["NOTHING", "Start", "Step"]

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
