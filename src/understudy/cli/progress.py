"""Progress on stderr, for whatever takes longer than a second; silent when nobody watches."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

__all__ = ["Progress", "progress"]


class Progress(Protocol):
    """Says how far the work has come."""

    def __call__(self, now: float, what: str) -> None: ...


@contextmanager
def progress(title: str, total: float | None = None, *, unit: str = "s of simulated time") -> Iterator[Progress]:
    """A progress line while the block runs.

    Args:
        title: what is being done.
        total: where it ends, in the units of ``now``; None if nobody knows.
        unit: what is counted.
    """
    if not sys.stderr.isatty():
        yield lambda now, what: None
        return
    from rich.console import Console  # noqa: PLC0415 - slow, and needed here only
    from rich.progress import BarColumn, SpinnerColumn, TextColumn  # noqa: PLC0415
    from rich.progress import Progress as Bar  # noqa: PLC0415

    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.completed:.0f} " + unit + "  {task.fields[what]}"),
    )
    with Bar(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(title, total=total, what="")
        yield lambda now, what: bar.update(task, completed=now, what=what)
