"""The keyboard beside a real robot: the teacher's words, and the emergency stop."""

import os
import select
import sys
import threading
from collections.abc import Callable
from types import TracebackType
from typing import Self

from understudy.robot import Cue

__all__ = ["KEYS_HELP", "Keyboard"]

_WORDS = {
    "s": Cue.START,
    "\r": Cue.START,
    "\n": Cue.START,
    "h": Cue.HERE,
    "t": Cue.TAKE,
    "d": Cue.DROP,
    "q": Cue.DONE,
    "b": Cue.BAD,
    "c": Cue.COME,
    "g": Cue.GO,
}
_STOP = (" ", "\x1b")
_PATIENCE_S = 0.1

KEYS_HELP = (
    "Keys: s START  h HERE  t TAKE  d DROP  q DONE  b BAD  c COME  g GO   space or escape: emergency stop   Ctrl-C: end"
)


class Keyboard:
    """Listens to single keys in a thread of its own, while the ``with`` block runs.

    Where the standard input is no terminal it does nothing.

    Args:
        say: is called with each word.
        stop: is called at the emergency stop.
    """

    def __init__(self, say: Callable[[Cue], None], stop: Callable[[], None]) -> None:
        self._say, self._stop = say, stop
        self._over = threading.Event()
        self._thread: threading.Thread | None = None
        self._restore: Callable[[], None] = lambda: None

    def press(self, key: str) -> None:
        """One key; any that means nothing is passed over."""
        if key in _STOP:
            self._stop()
        elif key.lower() in _WORDS:
            self._say(_WORDS[key.lower()])

    def __enter__(self) -> Self:
        if not sys.stdin.isatty():
            return self
        try:
            import termios  # noqa: PLC0415 - Windows has none
            import tty  # noqa: PLC0415
        except ImportError:
            return self
        descriptor = sys.stdin.fileno()
        before = termios.tcgetattr(descriptor)
        self._restore = lambda: termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
        tty.setcbreak(descriptor)  # Ctrl-C is still a signal
        print(KEYS_HELP, file=sys.stderr)
        self._thread = threading.Thread(target=self._listen, args=(descriptor,), name="keyboard", daemon=True)
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._over.set()
        if self._thread is not None:
            self._thread.join()
        self._restore()

    def _listen(self, descriptor: int) -> None:
        while not self._over.is_set():
            if select.select([descriptor], [], [], _PATIENCE_S)[0]:
                for key in os.read(descriptor, 64).decode(errors="ignore"):
                    self.press(key)
