"""What stands around the robot, as points: from the laser, and where that is blind from sonars and memory."""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from understudy.perception.percepts import Thing
from understudy.robot import Observation, RobotSpec, Scan

__all__ = ["Obstacles"]

_LASER_HALF_FIELD = math.radians(85)
_NEAR = 1.0
_RIM = np.array([(math.cos(a), math.sin(a)) for a in np.radians(np.arange(0, 360, 30))])


class Obstacles:
    """The obstacles around one robot. Remembers nothing.

    Args:
        spec: where its laser and sonars sit.
    """

    def __init__(self, spec: RobotSpec) -> None:
        self._laser_x = spec.laser.x
        # Of the sonars: where the laser is blind, a mount's place and direction.
        self._blind = [
            (number, mount.x, mount.y, math.cos(mount.heading), math.sin(mount.heading))
            for number, mount in enumerate(spec.sonar_poses)
            if abs(mount.heading) > _LASER_HALF_FIELD
        ]

    def points(self, observation: Observation, targets: Sequence[Thing]) -> NDArray[np.float64]:
        """Points that something was met at, in the robot's frame, metres, shape ``(n, 2)``.

        Args:
            observation: of this moment.
            targets: those that the robot sees or remembers.
        """
        scan = _filled(observation.scan)
        directions = _directions(len(scan.ranges), scan.angle_min, scan.angle_increment)
        met = (scan.ranges < scan.range_max).nonzero()[0]  # inf is not
        # Column by column: whoever reads the points takes all x, or all y.
        columns = directions.take(met, axis=1) * scan.ranges.take(met)
        columns[0] += self._laser_x
        others = self._beside_and_behind(observation, targets)
        if others:
            columns = np.concatenate((columns, *(points.T for points in others)), axis=1)
        return columns.T

    def _beside_and_behind(self, observation: Observation, targets: Sequence[Thing]) -> list[NDArray[np.float64]]:
        """Where the laser is blind, the sonars' echoes and the remembered targets stand in for it."""
        found = [
            np.array([(thing.position.x, thing.position.y)]) + thing.radius * _RIM
            for thing in targets
            if not thing.sensed and thing.distance_m < _NEAR
        ]
        # The laser sees the front better; a sonar's far echo may come from anywhere in its cone.
        distances = observation.sonar.tolist()
        echoes = [
            (x + distances[number] * cos, y + distances[number] * sin)
            for number, x, y, cos, sin in self._blind
            if number < len(distances) and distances[number] < _NEAR
        ]
        return [*found, np.array(echoes)] if echoes else found


def _filled(scan: Scan) -> Scan:
    """The sweep with every unusable ray taking the nearer of its usable neighbours: a gap is not free space."""
    if not scan.unusable:
        return scan
    bad = np.isnan(scan.ranges)
    usable = np.flatnonzero(~bad)
    place = np.searchsorted(usable, np.flatnonzero(bad))
    before, after = usable[np.maximum(place - 1, 0)], usable[np.minimum(place, len(usable) - 1)]
    ranges = scan.ranges.copy()
    ranges[bad] = np.minimum(scan.ranges[before], scan.ranges[after])
    return replace(scan, ranges=ranges)


@lru_cache(maxsize=8)
def _directions(rays: int, angle_min: float, angle_increment: float) -> NDArray[np.float64]:
    """Unit vectors of a sweep's rays, shape ``(2, rays)``."""
    angles = angle_min + angle_increment * np.arange(rays)
    return np.stack((np.cos(angles), np.sin(angles)))
