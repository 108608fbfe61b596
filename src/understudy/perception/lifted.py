"""Whether somebody lifted the robot and put it down elsewhere: the laser sees another room than a moment ago."""

import math

import numpy as np

from understudy.robot import Scan

__all__ = ["put_elsewhere"]

_APART_M = 0.2
"""In a tenth of a second the robot itself drives 5 cm."""

_SHARE = 0.4
"""Of the rays; a person who walks by, or a door that swings, changes fewer."""


def put_elsewhere(before: Scan, now: Scan, turned: float) -> bool:
    """Whether two sweeps, one after the other, cannot be of the same place.

    Args:
        before: the earlier one.
        now: the later one.
        turned: how far the robot turned in between by its wheels, radians, left positive.
    """
    rays = len(now.ranges)
    shift = round(turned / now.angle_increment)
    if len(before.ranges) != rays or abs(shift) > rays // 2:
        return False
    # What was seen at one ray is seen ``shift`` rays further to the right now.
    first, last = max(0, -shift), rays - max(0, shift)
    earlier = np.fmin(before.ranges[first + shift : last + shift], before.range_max)
    later = np.fmin(now.ranges[first:last], now.range_max)
    # Where the range jumps a ray may fall to this or that side of the edge.
    apart = np.abs(later - earlier)
    apart[1:] = np.minimum(apart[1:], np.abs(later[1:] - earlier[:-1]))
    apart[:-1] = np.minimum(apart[:-1], np.abs(later[:-1] - earlier[1:]))
    return math.isfinite(turned) and float((apart > _APART_M).mean()) > _SHARE
