"""A watch over the program itself: when it decides nothing for too long, the robot is stopped all the same."""

import threading
from collections.abc import Callable

from understudy.clock import Clock

__all__ = ["Deadman"]


class Deadman:
    """Calls ``stop`` from a thread of its own when nobody has called :meth:`alive` for too long.

    It watches from the first call on, and after each stop from the next.

    Args:
        limit_s: how long that is.
        clock: by which it is told.
        stop: what is to be done.
    """

    def __init__(self, limit_s: float, clock: Clock, stop: Callable[[], None]) -> None:
        self._limit_s, self._clock, self._stop = limit_s, clock, stop
        self._seen_s: float | None = None
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="deadman", daemon=True)
        self._thread.start()

    def alive(self) -> None:
        """The program has just decided something."""
        self._seen_s = self._clock.now()

    def rest(self) -> None:
        """Nothing is to be decided for a while: the robot stands."""
        self._seen_s = None

    def close(self) -> None:
        """Ends the watch."""
        self._over.set()
        self._thread.join()

    def _watch(self) -> None:
        # Late by a tenth of the limit at most.
        while not self._over.wait(self._limit_s / 10):
            self.look()

    def look(self) -> None:
        """Stops the robot if it is time to."""
        seen_s = self._seen_s
        if seen_s is not None and self._clock.now() - seen_s > self._limit_s:
            self._seen_s = None
            self._stop()
