"""The Pioneer 2-DX in numbers (§3.5.1, A.1): where its sensors sit and how fast it may go.

The robot's frame has its origin on the floor between the drive wheels, about which it turns.
"""

import math
from dataclasses import dataclass

from understudy.geometry import Pose
from understudy.robot.colors import RGB, Paints

__all__ = ["PIONEER", "CameraMount", "GripperGeometry", "LaserMount", "RobotSpec"]


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


def _sonar_ring() -> tuple[Pose, ...]:
    # Eight in front, left to right, and eight behind; they sit on the body's rounded edge.
    front = [math.radians(a) for a in (90, 50, 30, 10, -10, -30, -50, -90)]
    angles = front + [math.pi - a for a in front]
    half_length, half_width = 0.20, 0.18
    return tuple(Pose(half_length * math.cos(a), half_width * math.sin(a), math.remainder(a, math.tau)) for a in angles)


PIONEER = RobotSpec(
    name="pioneer",
    length=0.44,
    width=0.38,
    height=0.22,
    mass=9.0,
    max_linear=0.5,
    max_angular=1.5,
    max_linear_acceleration=0.8,
    max_angular_acceleration=4.0,
    # The laser's plane must clear the small boxes (0.10 m) and meet the tall targets (0.50 m).
    laser=LaserMount(x=0.10, height=0.30, rays=181, range_max=8.0, noise_std=0.015),
    # Tilted a little, so that a small box is seen until it is about 0.4 m before the gripper's tips.
    camera=CameraMount(x=0.12, height=0.34, tilt=math.radians(12), field=math.radians(48.8), width=160, rows=120),
    gripper=GripperGeometry(x_back=0.24, x_front=0.40, x_beam=0.33, opening=0.20, lift_height=0.08),
    sonar_poses=_sonar_ring(),
    sonar_height=0.20,
    sonar_range=5.0,
    sonar_cone=math.radians(25),
)
