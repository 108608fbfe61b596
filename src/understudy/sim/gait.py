"""How a person walks: smooth starts and stops, slower in turns, and around what stands in the way."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from understudy.clock import CONTROL_PERIOD_S
from understudy.geometry import Point

__all__ = ["CLEARANCE_M", "ROBOT_CLEARANCE_M", "Gait", "Obstacle"]

CLEARANCE_M = 0.05
"""What a person keeps from things that stand still."""

ROBOT_CLEARANCE_M = 0.20
"""From a robot: a person's middle stays 0.35 m away, so that the robot is never pushed."""

_ACCELERATION = 0.8
_BRAKING = 0.5
_STANDING = 0.03


@dataclass(frozen=True, slots=True)
class Obstacle:
    """The nearest point of something that must not be walked into, and the clearance to it, metres."""

    nearest: Point
    clearance: float


class Gait:
    """A walker's place and velocity.

    Args:
        at: where it stands at first.
        radius: its own, metres.
        speed: of a free walk, m/s.
    """

    def __init__(self, at: Point, radius: float, speed: float) -> None:
        self.place = at
        self.radius = radius
        self.speed = speed
        self.velocity = Point(0.0, 0.0)

    @property
    def standing(self) -> bool:
        """Whether the walker is as good as still."""
        return self.velocity.distance < _STANDING

    def toward(self, goal: Point, haste: float, obstacles: Iterable[Obstacle], *, stop_there: bool) -> None:
        """One control period of a walk to ``goal``.

        Args:
            goal: where to, in the arena's frame.
            haste: share of the walking speed, 0 to 1.
            obstacles: what is in the way.
            stop_there: come to a stand at the goal, instead of passing through.
        """
        dx, dy = goal.x - self.place.x, goal.y - self.place.y
        left = math.hypot(dx, dy)
        if left < 1e-9:
            self.at_velocity(Point(0.0, 0.0), obstacles)
            return
        speed = self.speed * haste
        if stop_there:
            speed = min(speed, math.sqrt(2 * _BRAKING * left), left / CONTROL_PERIOD_S)
        now = self.velocity.distance
        if now > _STANDING:
            cosine = (self.velocity.x * dx + self.velocity.y * dy) / (now * left)
            speed *= 0.6 + 0.4 * cosine
        self.at_velocity(Point(speed * dx / left, speed * dy / left), obstacles)

    def at_velocity(self, wanted: Point, obstacles: Iterable[Obstacle]) -> None:
        """One control period toward a wanted velocity, m/s in the arena's frame."""
        x, y = self.velocity
        change = math.hypot(wanted.x - x, wanted.y - y)
        share = min(1.0, _ACCELERATION * CONTROL_PERIOD_S / change) if change > 0.0 else 0.0
        x, y = x + share * (wanted.x - x), y + share * (wanted.y - y)
        for obstacle in obstacles:
            x, y = self._around(obstacle, x, y)
        self.velocity = Point(x, y)
        self.place = Point(self.place.x + x * CONTROL_PERIOD_S, self.place.y + y * CONTROL_PERIOD_S)

    def _around(self, obstacle: Obstacle, x: float, y: float) -> tuple[float, float]:
        nx, ny = self.place.x - obstacle.nearest.x, self.place.y - obstacle.nearest.y
        away = math.hypot(nx, ny)
        if away < 1e-9:
            return x, y
        nx, ny = nx / away, ny / away
        approach = -(x * nx + y * ny)
        room = away - self.radius - obstacle.clearance
        excess = approach - max(0.0, room) / CONTROL_PERIOD_S
        if excess <= 0.0:
            return x, y
        # Without the part that would lead into it; a head-on walker sidesteps to the left.
        x, y = x + excess * nx, y + excess * ny
        if math.hypot(x, y) < 0.3 * approach:
            x, y = x - 0.5 * approach * ny, y + 0.5 * approach * nx
        return x, y
