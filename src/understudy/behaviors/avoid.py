"""``Avoid``: no skill drives the robot into an obstacle (A.4), and going around one on the way (semantics §1).

Two parts: :func:`steer` turns "go in that direction" into speeds for the wheels, along the free direction nearest to
the wanted one; :func:`guard` has the last word and overrides any speeds that would bring the robot's outline into an
obstacle. The thing that a skill aims at is exempt from the first, and may come closer than others in the second.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from understudy.behaviors.skill import Drive, Head
from understudy.geometry import Point, wrap_angle
from understudy.robot import RobotSpec

__all__ = ["Avoid", "AvoidSettings"]

Points = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class AvoidSettings:
    """Distances in metres, times in seconds.

    Attributes:
        corridor: free room wanted on both sides of the robot's middle line while driving.
        look_ahead: how far a direction must be free.
        margin: nearest that an obstacle may come to the robot's outline.
        aim_margin: the same for the thing that a skill approaches on purpose.
        horizon: how far ahead speeds are followed before they are trusted.
    """

    corridor: float = 0.29
    look_ahead: float = 1.0
    margin: float = 0.07
    aim_margin: float = 0.05
    horizon: float = 0.9


_OFFSETS = np.radians(sorted(range(-112, 113, 7), key=lambda degrees: (abs(degrees), degrees)))
"""Directions tried beside the wanted one, nearest first."""

_TIMES = np.array([0.15, 0.35, 0.6, 0.9])

_CREEP = 0.12
"""Metres a second: slow enough to be changed at any tick."""

_STEPS = (0.05, 0.10, 0.15, 0.20, 0.25, 0.30)
"""Metres, forward and back, at which room for a turn is looked for."""


class Avoid:
    """Keeps one robot clear of obstacles. Holds no run-time state.

    Args:
        spec: the robot's outline and limits.
        settings: distances.
    """

    def __init__(self, spec: RobotSpec, settings: AvoidSettings | None = None) -> None:
        self.spec = spec
        self.settings = settings or AvoidSettings()
        front = spec.gripper.x_front if spec.gripper else spec.length / 2
        self._outline = (-spec.length / 2, front + 0.02, spec.width / 2)
        self._reach = math.hypot(self._outline[1], self._outline[2])

    def steer(self, head: Head, obstacles: Points, aim: Point | None, aim_radius: float) -> Drive:
        """Speeds that go in a direction, around what stands in the way.

        Args:
            head: wanted direction and speed.
            obstacles: robot's frame, shape ``(n, 2)``.
            aim: what is approached on purpose, or None.
            aim_radius: its radius.
        """
        reach = min(self.settings.look_ahead, head.way + self._outline[1] + self.settings.margin)
        if aim is not None:
            reach = min(reach, aim.distance)
        near = _around_robot(obstacles, reach + self.settings.corridor)
        if aim is not None:
            near = near.T.compress(~_within(near, aim, aim_radius + 0.12), axis=1).T
        bearing = self._free_bearing(head.bearing, near, reach)
        if bearing is None:
            return Drive(angular=math.copysign(min(0.6, head.turn), head.bearing))
        angular = max(-head.turn, min(head.turn, 2.0 * bearing))
        # Turn on the spot towards what lies aside; slow down in proportion before that.
        linear = head.speed * max(0.0, math.cos(min(math.pi / 2, 1.5 * abs(bearing))))
        return Drive(linear=linear, angular=angular)

    def _free_bearing(self, wanted: float, near: Points, reach: float) -> float | None:
        if not len(near):
            return wanted
        if not self._blocked(np.array([wanted]), near, reach)[0]:
            return wrap_angle(wanted)
        bearings = wanted + _OFFSETS
        free = np.flatnonzero(~self._blocked(bearings, near, reach))
        return wrap_angle(float(bearings[free[0]])) if len(free) else None

    def _blocked(self, bearings: NDArray[np.float64], near: Points, reach: float) -> NDArray[np.bool_]:
        """For each direction, whether a point lies in the corridor along it."""
        cos, sin = np.cos(bearings)[:, None], np.sin(bearings)[:, None]
        x, y = near[:, 0], near[:, 1]
        inside = np.abs(cos * y - sin * x) < self.settings.corridor
        along = cos * x + sin * y
        inside &= along > 0.05
        inside &= along < reach
        blocked: NDArray[np.bool_] = np.logical_or.reduce(inside, axis=1)
        return blocked

    def guard(self, drive: Drive, obstacles: Points, aim: Point | None, aim_radius: float) -> tuple[Drive, bool]:
        """The speeds themselves if they are safe, else the mildest change of them that is.

        Returns:
            The speeds, and whether they were overridden.
        """
        # The alternatives tried below are slow; farther points cannot matter within the horizon.
        limit = self._reach + self.settings.margin + max(0.12, abs(drive.linear)) * self.settings.horizon
        near = _around_robot(obstacles, limit)
        if not len(near):
            return drive, False
        margins = self._margins(near, aim, aim_radius)
        if self._safe(drive, near, margins):
            return drive, False
        linear, angular = drive.linear, drive.angular
        milder = [Drive(linear=0.5 * linear, angular=angular), Drive(angular=angular)]
        turn = angular if abs(angular) > 0.2 else 0.5
        others = [
            Drive(linear=-_CREEP, angular=0.5 * turn),
            Drive(linear=-_CREEP),
            Drive(linear=-_CREEP, angular=-0.5 * turn),
            Drive(linear=_CREEP),
            Drive(linear=_CREEP, angular=turn),
            Drive(linear=_CREEP, angular=-turn),
            Drive(angular=-turn),
        ]
        for choices in (milder, self._to_room_for(angular, obstacles, aim, aim_radius), others):
            for choice in choices:
                if choice != drive and (choice.linear or choice.angular) and self._safe(choice, near, margins):
                    return choice, True
        return Drive(), True

    def _to_room_for(self, angular: float, obstacles: Points, aim: Point | None, aim_radius: float) -> list[Drive]:
        """Straight on, or straight back, to the nearest place where there is room for a turn.

        Beside a target a robot cannot turn towards it: its gripper's tips would sweep into it. Whatever it tried by
        turns, it would do and undo for ever; the nearest place remains the nearest one while it goes there.
        """
        if abs(angular) < 0.2:
            return []
        near = _around_robot(obstacles, self._reach + self.settings.margin + _STEPS[-1])
        margins = self._margins(near, aim, aim_radius)
        x, y = near.T
        sides = [1.0, -1.0]
        for away in _STEPS:
            sides = [side for side in sides if (self._clearance(x - side * away, y) >= margins).all()]
            for side in sides:
                moved = x - side * away
                if self._safe(Drive(angular=angular), np.stack((moved, y), axis=1), margins):
                    return [Drive(linear=side * _CREEP)]
        return []

    def _margins(self, near: Points, aim: Point | None, aim_radius: float) -> NDArray[np.float64]:
        """How near each point may come. What is within the margin already may stay there, but not come nearer."""
        margins: NDArray[np.float64] = np.minimum(self._clearance(near[:, 0], near[:, 1]) - 0.005, self.settings.margin)
        if aim is not None:
            close = _within(near, aim, aim_radius + 0.12)
            margins[close] = np.minimum(margins[close], self.settings.aim_margin)
        return margins

    def _safe(self, drive: Drive, points: Points, margins: NDArray[np.float64]) -> bool:
        """Whether the outline, carried along by the speeds, keeps every point at its margin."""
        turns, forward = drive.angular * _TIMES, drive.linear * _TIMES
        cos, sin = np.cos(turns)[:, None], np.sin(turns)[:, None]
        x = points[:, 0] - (forward * np.cos(turns / 2))[:, None]
        y = points[:, 1] - (forward * np.sin(turns / 2))[:, None]
        return bool(np.logical_and.reduce(self._clearance(cos * x + sin * y, cos * y - sin * x) >= margins, axis=None))

    def _clearance(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        """Distance of points from the robot's outline, a rectangle; negative inside."""
        back, front, half_width = self._outline
        dx = np.maximum(back - x, x - front)
        dy = np.abs(y) - half_width
        beyond = np.hypot(np.maximum(dx, 0), np.maximum(dy, 0))
        clearance: NDArray[np.float64] = beyond + np.minimum(np.maximum(dx, dy), 0)
        return clearance


def _around_robot(points: Points, radius: float) -> Points:
    """Those near the robot's turning point, column by column in memory: x and y are always taken apart."""
    x, y = points.T
    inside = (x * x + y * y < radius * radius).nonzero()[0]
    near: Points = points.T.take(inside, axis=1).T
    return near


def _within(points: Points, center: Point, radius: float) -> NDArray[np.bool_]:
    dx, dy = points[:, 0] - center.x, points[:, 1] - center.y
    within: NDArray[np.bool_] = dx * dx + dy * dy < radius * radius
    return within
