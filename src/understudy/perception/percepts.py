"""What the robot knows of its surroundings at one moment: the values on which goals and skills rest."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from understudy.geometry import Point, bearing_to_angle
from understudy.robot import Color, Odometry

__all__ = ["GripperState", "Percepts", "Thing"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Thing:
    """A target, a box or the teacher, as perceived or remembered.

    Attributes:
        id: the same as long as the robot believes it to be the same thing.
        color: the color it was seen in most often.
        position: of its middle, in the robot's frame, metres.
        radius: metres.
        sensed: camera or laser met it in this very observation; otherwise it is remembered (§3.5.3.2).
        seen_s: when a sensor last met it.
        followed: the camera found it, and the sensors have met it ever since (§3.5.3.2); false for what the laser
            alone met again where memory had it.
    """

    id: int
    color: Color
    position: Point
    radius: float
    sensed: bool
    seen_s: float
    followed: bool = True

    @property
    def distance_m(self) -> float:
        """From the robot's turning point to the thing's surface."""
        return max(0.0, self.position.distance - self.radius)

    @property
    def bearing(self) -> float:
        """Radians, 0 ahead, left positive."""
        return self.position.bearing

    @property
    def angle_deg(self) -> float:
        """As the skills count it: 0 right, 90 ahead, 180 left; beyond both behind the robot (§3.5.3.2)."""
        return bearing_to_angle(self.bearing)


@dataclass(frozen=True, slots=True, kw_only=True)
class GripperState:
    """What the gripper tells (A.3).

    Attributes:
        holding: closed, with something between the paddles.
        empty: nothing between the paddles.
        color: of what it holds; None while it holds nothing, or something of which it does not know the color.
        open: the paddles stand wide open.
        raised: the lift is up.
        blocked: something stands between the paddles, whether they are closed or not.
    """

    holding: bool
    empty: bool
    color: Color | None
    open: bool
    raised: bool
    blocked: bool


def _no_points() -> NDArray[np.float64]:
    return np.empty((0, 2))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Percepts:
    """Everything perceived and remembered at one moment.

    Attributes:
        time_s: of the observation.
        odometry: as the wheels tell.
        targets: tall colored things, nearest first.
        boxes: small colored things on the floor, nearest first.
        teacher: None while unseen.
        gripper: None on a robot without one.
        obstacles: points that laser and sonars met, robot's frame, metres, shape ``(n, 2)``.
    """

    time_s: float
    odometry: Odometry = Odometry()
    targets: Sequence[Thing] = ()
    boxes: Sequence[Thing] = ()
    teacher: Thing | None = None
    gripper: GripperState | None = None
    obstacles: NDArray[np.float64] = field(default_factory=_no_points)

    def nearest_target(self, color: Color) -> Thing | None:
        """The nearest target of a color, sensed or remembered."""
        return next((thing for thing in self.targets if thing.color == color), None)

    def nearest_box(self, color: Color) -> Thing | None:
        """The nearest box of a color, sensed or remembered."""
        return next((thing for thing in self.boxes if thing.color == color), None)
