"""Small tasks, a clock that steps, and a library in a folder."""

from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from itertools import count
from pathlib import Path

from understudy.library import Library
from understudy.network import Network, Task, task_text
from understudy.network.builder import build, do, in_order

__all__ = ["clock", "library_in", "text_of", "visiting"]


def clock() -> Callable[[], datetime]:
    """One second later each time that it is asked."""
    seconds = count()
    return lambda: datetime(2000, 1, 1, tzinfo=UTC) + timedelta(seconds=next(seconds))


def library_in(folder: Path, name: str = "library.db") -> Library:
    return Library(str(folder / name), now=clock())


def visiting(*colors: str) -> Network:
    """Targets, one after the other."""
    return build(in_order(*(do("Track", color=color, distance_m=0.5, angle_deg=90) for color in colors)))


def text_of(*colors: str) -> str:
    """The document of :func:`visiting`."""
    return task_text(Task.of("visiting", visiting(*colors)))
