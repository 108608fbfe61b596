"""The injected clock: nothing in Understudy reads the computer's time by itself."""

import time
from typing import Protocol

__all__ = ["CONTROL_PERIOD_S", "CONTROL_RATE_HZ", "Clock", "SteppedClock", "WallClock"]

CONTROL_RATE_HZ = 10
"""The rate of the tick (semantics §3): fast enough for 0.5 m/s, slow enough for a camera."""

CONTROL_PERIOD_S = 1 / CONTROL_RATE_HZ


class Clock(Protocol):
    """Tells the time in seconds since the run began."""

    def now(self) -> float: ...


class SteppedClock:
    """A clock that counts control periods: simulated time, exact and repeatable."""

    def __init__(self, period_s: float = CONTROL_PERIOD_S) -> None:
        self.period_s = period_s
        self.steps = 0

    def now(self) -> float:
        return round(self.steps * self.period_s, 9)

    def advance(self) -> None:
        self.steps += 1


class WallClock:
    """Seconds since this clock was made, from the computer's monotonic clock."""

    def __init__(self) -> None:
        self._start = time.monotonic()

    def now(self) -> float:
        return time.monotonic() - self._start
