"""From a laser scan to upright objects that stand free: targets, legs, people (§3.5.3.2)."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from understudy.geometry import Point
from understudy.robot import Scan

__all__ = ["Cylinder", "find_cylinders"]

_JUMP = 0.18
"""Metres of range between neighbouring rays that separate an object from what is behind it."""

_MAX_WIDTH = 0.60
"""Metres; a person is narrower, a wall is not."""

_MIN_RADIUS = 0.04


@dataclass(frozen=True, slots=True, kw_only=True)
class Cylinder:
    """A free-standing object in the laser's plane.

    Attributes:
        center: of the fitted circle, metres, in the robot's frame.
        radius: metres.
        rays: how many rays met it.
        cut: the sweep ends at it, so that it reaches farther than the fit knows.
    """

    center: Point
    radius: float
    rays: int
    cut: bool = False


def find_cylinders(scan: Scan, laser_x: float) -> list[Cylinder]:
    """Groups of rays that end nearer than the rays to both sides of them.

    A wall seen at a grazing angle breaks into pieces, too, but each of those has a nearer neighbour on one side.

    Args:
        scan: the sweep.
        laser_x: how far the laser sits before the robot's origin, metres.
    """
    # Unusable rays (NaN) count as free, like those that meet nothing.
    reaches = np.fmin(scan.ranges, np.float32(scan.range_max))
    # A group ends where the range jumps; the first and the last ray of the sweep close groups, too.
    edges = (np.abs(reaches[1:] - reaches[:-1]) > _JUMP).nonzero()[0].tolist()
    ranges = reaches.tolist()
    last = len(ranges) - 1
    directions = _directions(len(ranges), scan.angle_min, scan.angle_increment)
    cylinders: list[Cylinder] = []
    next_start = 0
    for end in (*edges, last):
        start, next_start = next_start, end + 1
        nearer_than_right = start == 0 or ranges[start] < ranges[start - 1]
        nearer_than_left = end == last or ranges[end] < ranges[end + 1]
        if not (nearer_than_left and nearer_than_right) or (start == 0 and end == last):
            continue
        # A wall that runs past the robot is near at one end only: from end to end it is wide.
        (cos, sin), (end_cos, end_sin) = directions[start], directions[end]
        across = ranges[end] * end_cos - ranges[start] * cos, ranges[end] * end_sin - ranges[start] * sin
        if math.hypot(*across) > _MAX_WIDTH:
            continue
        near = min(ranges[start : end + 1])
        rays = end - start + 1
        width = near * rays * scan.angle_increment
        if near >= scan.range_max or width > _MAX_WIDTH:
            continue
        radius = max(_MIN_RADIUS, width / 2)
        bearing = scan.angle_min + (start + end) / 2 * scan.angle_increment
        # The middle rays meet the surface head-on; their mean is steadier than the nearest ray.
        third = max(1, rays // 3)
        first = start + (rays - third) // 2
        reach = sum(ranges[first : first + third]) / third + radius
        center = Point(laser_x + reach * math.cos(bearing), reach * math.sin(bearing))
        cylinders.append(Cylinder(center=center, radius=radius, rays=rays, cut=start == 0 or end == last))
    return cylinders


@lru_cache(maxsize=8)
def _directions(rays: int, angle_min: float, angle_increment: float) -> list[tuple[float, float]]:
    """Cosine and sine of the bearing of each ray of a sweep."""
    bearings = [angle_min + index * angle_increment for index in range(rays)]
    return [(math.cos(bearing), math.sin(bearing)) for bearing in bearings]
