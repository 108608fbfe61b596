"""What a robot is in numbers: its body, its sensors and where they sit, how fast it may go.

A robot's frame has its origin on the floor between the drive wheels, about which it turns.
"""

import math
from dataclasses import dataclass

from understudy.geometry import Pose
from understudy.robot.colors import RGB, Paints

__all__ = ["CameraMount", "GripperGeometry", "LaserMount", "RobotSpec"]


@dataclass(frozen=True, slots=True, kw_only=True)
class LaserMount:
    """Where the laser sits in the robot's frame, and what it gives: ``sweep`` is the angle that its rays cover."""

    x: float
    height: float
    rays: int
    range_max: float
    noise_std: float
    sweep: float = math.pi


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraMount:
    """Where the camera sits and how it looks; ``tilt`` is downward, radians; ``field`` the horizontal field of view."""

    x: float
    height: float
    tilt: float
    field: float
    width: int
    rows: int

    @property
    def focal_px(self) -> float:
        """Focal length in pixels (pinhole, square pixels)."""
        return self.width / 2 / math.tan(self.field / 2)


@dataclass(frozen=True, slots=True, kw_only=True)
class GripperGeometry:
    """Paddles in front of the body, from ``x_back`` to ``x_front``, at most ``opening`` apart.

    The infrared beam crosses between them at ``x_beam``; the lift raises them by ``lift_height``.
    """

    x_back: float
    x_front: float
    x_beam: float
    opening: float
    lift_height: float


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotSpec:
    """What a robot is made of, in metres, seconds and radians.

    ``gripper`` is None on a robot that has none; ``sonar_poses`` are in the robot's frame; a ``round`` robot is a
    cylinder of its length and width. ``paints`` is how its camera sees the colors.
    """

    name: str
    length: float
    width: float
    height: float
    mass: float
    max_linear: float
    max_angular: float
    max_linear_acceleration: float
    max_angular_acceleration: float
    laser: LaserMount
    camera: CameraMount
    gripper: GripperGeometry | None
    sonar_poses: tuple[Pose, ...]
    sonar_height: float
    sonar_range: float
    sonar_cone: float
    round: bool = False
    paints: Paints = tuple(RGB.values())
