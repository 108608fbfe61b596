"""The Pioneer 2-DX in numbers (§3.5.1, A.1): where its sensors sit and how fast it may go."""

import math

from understudy.geometry import Pose
from understudy.robot.spec import CameraMount, GripperGeometry, LaserMount, RobotSpec

__all__ = ["PIONEER"]


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
