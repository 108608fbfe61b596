"""Planar geometry in metres and radians, axes as in REP 103: x forward, y left, angles counter-clockwise."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

__all__ = ["Point", "Pose", "angle_to_bearing", "bearing_to_angle", "wrap_angle"]


def wrap_angle(angle: float) -> float:
    """The same angle in (-π, π]."""
    wrapped = math.remainder(angle, math.tau)
    return math.pi if wrapped == -math.pi else wrapped


def bearing_to_angle(bearing: float) -> float:
    """A bearing (radians, 0 ahead, left positive) as the skills' angle in degrees.

    The skills count as the laser does (§3.5.3.2): 0° to the robot's right, 90° ahead, 180° left.
    """
    return math.degrees(bearing) + 90.0


def angle_to_bearing(angle_deg: float) -> float:
    """The inverse of :func:`bearing_to_angle`."""
    return math.radians(angle_deg - 90.0)


class Point(NamedTuple):
    """A point in metres; the name of the variable says in which frame."""

    x: float
    y: float

    @property
    def distance(self) -> float:
        """From the frame's origin, in metres."""
        return math.hypot(self.x, self.y)

    @property
    def bearing(self) -> float:
        """From the frame's x axis, in radians, left positive."""
        return math.atan2(self.y, self.x)

    def distance_to(self, other: "Point") -> float:
        return math.hypot(other.x - self.x, other.y - self.y)


@dataclass(frozen=True, slots=True)
class Pose:
    """A position and heading in a parent frame: ``x``, ``y`` in metres, ``heading`` in radians."""

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0

    @property
    def position(self) -> Point:
        return Point(self.x, self.y)

    def to_parent(self, local: Point) -> Point:
        """A point of this pose's own frame, in the parent frame."""
        c, s = math.cos(self.heading), math.sin(self.heading)
        return Point(self.x + c * local.x - s * local.y, self.y + s * local.x + c * local.y)

    def to_local(self, parent: Point) -> Point:
        """A point of the parent frame, in this pose's own frame."""
        c, s = math.cos(self.heading), math.sin(self.heading)
        dx, dy = parent.x - self.x, parent.y - self.y
        return Point(c * dx + s * dy, -s * dx + c * dy)

    def to_locals(self, parents: Iterable[tuple[float, float]]) -> list[Point]:
        """:meth:`to_local` for many points: the heading's cosine and sine are taken once."""
        c, s, x, y = math.cos(self.heading), math.sin(self.heading), self.x, self.y
        return [Point(c * (px - x) + s * (py - y), -s * (px - x) + c * (py - y)) for px, py in parents]

    def moved(self, forward: float, turn: float) -> "Pose":
        """The pose after driving ``forward`` metres along an arc that turns by ``turn`` radians."""
        half = self.heading + turn / 2
        return Pose(
            self.x + forward * math.cos(half),
            self.y + forward * math.sin(half),
            wrap_angle(self.heading + turn),
        )
