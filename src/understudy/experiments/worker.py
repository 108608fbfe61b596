"""What Dask loads into each of our worker processes before it begins to work."""

import signal
from typing import Any

__all__ = ["dask_setup"]


def dask_setup(worker: Any) -> None:
    """Leaves Ctrl-C to the campaign, which stops its workers; by themselves they would each die with a traceback."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
