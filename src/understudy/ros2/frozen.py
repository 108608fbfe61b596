"""A laser whose driver hangs may send its last sweep for ever, with new stamps."""

import math

import numpy as np
from numpy.typing import NDArray

from understudy.robot import Observation, Odometry

__all__ = ["Frozen"]

_MOVED_M = 0.08
_TURNED = math.radians(10)
"""A robot that has moved so far has other readings than before, to the last bit of some ray."""


class Frozen:
    """Notices a sweep that stays the same while the wheels turn."""

    def __init__(self) -> None:
        self._ranges: NDArray[np.float32] = np.zeros(0, np.float32)
        self._since = Odometry()

    def notices(self, observation: Observation) -> bool:
        """Whether the sweep is an old one. One that meets nothing at all may well stay the same."""
        ranges, odometry = observation.scan.ranges, observation.odometry
        if not np.array_equal(ranges, self._ranges, equal_nan=True) or not np.isfinite(ranges).any():
            self._ranges, self._since = ranges, odometry
            return False
        here, before = odometry.pose, self._since.pose
        turned = abs(math.remainder(here.heading - before.heading, math.tau))
        return here.position.distance_to(before.position) > _MOVED_M or turned > _TURNED
