"""Where to stand so that a target is at a distance and angle: any point of a circle around it, if there is room."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from understudy.geometry import Point, wrap_angle

__all__ = ["Stand", "choose_direction", "stand_at"]

_DIRECTIONS = np.radians(np.arange(0, 360, 10))

_ROOM = 0.52
"""Metres around a stand in which nothing may be, so that the robot can turn there: its gripper's tips reach 0.46 m."""

_TIGHT = 0.34
"""With less room than this it cannot even drive through."""

_AVERSION = 1.2
"""Metres: how much better another stand must be before the robot changes its mind."""


@dataclass(frozen=True, slots=True)
class Stand:
    """A place and the heading to take there, in the robot's frame: metres and radians."""

    place: Point
    heading: float


def stand_at(direction: float, target: Point, distance: float, bearing: float, heading: float) -> Stand:
    """The stand in a direction from the target.

    Args:
        direction: of the stand as seen from the target, in the frame of the odometry, radians.
        target: middle of the target, in the robot's frame.
        distance: from the stand to the target's middle, metres.
        bearing: at which the target is to be, radians.
        heading: of the robot in the frame of the odometry, radians.
    """
    local = direction - heading
    place = Point(target.x + distance * math.cos(local), target.y + distance * math.sin(local))
    return Stand(place, wrap_angle(local + math.pi - bearing))


def choose_direction(
    target: Point,
    radius: float,
    distance: float,
    bearing: float,
    heading: float,
    *,
    obstacles: NDArray[np.float64],
    previous: float | None = None,
    avoided: Sequence[float] = (),
) -> float:
    """The direction of the stand that takes the least driving and turning, and has room.

    Args:
        target, distance, bearing, heading: as for :func:`stand_at`.
        radius: of the target, metres.
        obstacles: in the robot's frame, shape ``(n, 2)``; those of the target itself are left out here.
        previous: the direction chosen before, which is kept unless another one is much better.
        avoided: directions of stands that could not be reached.
    """
    directions = _wrap(_DIRECTIONS - heading)
    x = target.x + distance * np.cos(directions)
    y = target.y + distance * np.sin(directions)
    away = np.hypot(x, y)
    travel = np.arctan2(y, x)
    final = _wrap(directions + math.pi - bearing)
    cost = away + 0.35 * np.abs(travel) * np.minimum(1.0, away / 0.3) + 0.70 * np.abs(_wrap(final - travel))
    # The way leads past the target itself: how near does the straight line come to its middle?
    along = (target.x * x + target.y * y) / np.maximum(away, 1e-6) ** 2
    along = np.minimum(np.maximum(along, 0.0), 1.0)
    gap = np.hypot(target.x - along * x, target.y - along * y)
    cost += gap < min(distance, radius + 0.33) - 0.02
    # Only what stands near the circle matters, and that is little of what the laser meets.
    met_x, met_y = obstacles.T
    apart = np.square(met_x - target.x) + np.square(met_y - target.y)
    others = ((apart > (radius + 0.12) ** 2) & (apart < (distance + _ROOM) ** 2)).nonzero()[0]
    if len(others):
        # One row a direction; in place, since these are the largest arrays of a tick.
        squares, across = met_x.take(others) - x[:, None], met_y.take(others) - y[:, None]
        squares *= squares
        across *= across
        squares += across
        room = np.sqrt(np.minimum.reduce(squares, axis=1))
        cost += np.where(room < _TIGHT, 10.0, np.maximum(0.0, _ROOM - room) * 8.0)
    for direction in avoided:
        cost += 3.0 * (np.abs(_wrap(_DIRECTIONS - direction)) < math.radians(35))
    if previous is not None:
        cost += _AVERSION * (np.abs(_wrap(_DIRECTIONS - previous)) >= math.radians(6))
    return wrap_angle(float(_DIRECTIONS[cost.argmin()]))


def _wrap(angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """:func:`~understudy.geometry.wrap_angle` for many."""
    wrapped: NDArray[np.float64] = (angles + math.pi) % math.tau - math.pi
    return wrapped
