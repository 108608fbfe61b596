"""From a laser scan to upright objects that stand free: targets, legs, people (§3.5.3.2)."""

import math
from dataclasses import dataclass

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
    """

    center: Point
    radius: float
    rays: int


def find_cylinders(scan: Scan, laser_x: float) -> list[Cylinder]:
    """Groups of rays that end nearer than the rays to both sides of them.

    A wall seen at a grazing angle breaks into pieces, too, but each of those has a nearer neighbour on one side.

    Args:
        scan: the sweep.
        laser_x: how far the laser sits before the robot's origin, metres.
    """
    ranges = np.nan_to_num(scan.ranges.astype(np.float64), nan=scan.range_max, posinf=scan.range_max)
    steps = np.diff(ranges)
    # A group ends where the range jumps; the first and the last ray of the sweep close groups, too.
    edges = np.flatnonzero(np.abs(steps) > _JUMP)
    starts = [0, *(edges + 1).tolist()]
    ends = [*edges.tolist(), len(ranges) - 1]
    cylinders: list[Cylinder] = []
    for start, end in zip(starts, ends, strict=True):
        nearer_than_left = start == 0 or steps[start - 1] < 0
        nearer_than_right = end == len(ranges) - 1 or steps[end] > 0
        if not (nearer_than_left and nearer_than_right) or (start == 0 and end == len(ranges) - 1):
            continue
        near = float(ranges[start : end + 1].min())
        if near >= scan.range_max:
            continue
        rays = end - start + 1
        width = near * rays * scan.angle_increment
        if width > _MAX_WIDTH:
            continue
        radius = max(_MIN_RADIUS, width / 2)
        bearing = scan.angle_min + (start + end) / 2 * scan.angle_increment
        # The middle rays meet the surface head-on; their mean is steadier than the nearest ray.
        third = max(1, rays // 3)
        first = start + (rays - third) // 2
        reach = float(ranges[first : first + third].mean()) + radius
        cylinders.append(
            Cylinder(
                center=Point(laser_x + reach * math.cos(bearing), reach * math.sin(bearing)), radius=radius, rays=rays
            )
        )
    return cylinders
