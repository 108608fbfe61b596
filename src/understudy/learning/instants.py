"""Moments compared in whole microseconds.

Two endpoints written as 12.05 and 12.00 differ, as binary fractions, by a little more than 0.05. In whole
microseconds they differ by 50000, and a tolerance of 0.05 s means what it says. A microsecond is also what a
double resolves in seconds since 1970, so stamps of that kind compare well, too.
"""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

__all__ = ["LATEST_S", "micros", "micros_array"]

MICROS_PER_S = 1_000_000

LATEST_S = 1e12
"""Moments lie between minus and plus this (31,700 years): microseconds then fit an int64 with room to spare."""


def micros(seconds: float) -> int:
    """A moment or a duration in whole microseconds."""
    return round(seconds * MICROS_PER_S)


def micros_array(seconds: Iterable[float]) -> NDArray[np.int64]:
    """:func:`micros` of many; the same to the last one."""
    return np.rint(np.fromiter(seconds, dtype=np.float64) * MICROS_PER_S).astype(np.int64)
