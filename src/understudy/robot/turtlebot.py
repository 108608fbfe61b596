"""A TurtleBot-like robot in numbers: round, no gripper, a laser that looks all around, and a wider camera."""

import math

from understudy.robot.spec import CameraMount, LaserMount, RobotSpec

__all__ = ["TURTLEBOT"]

TURTLEBOT = RobotSpec(
    name="turtlebot",
    length=0.34,
    width=0.34,
    height=0.22,
    mass=4.0,
    max_linear=0.31,
    max_angular=1.5,
    max_linear_acceleration=0.6,
    max_angular_acceleration=3.0,
    # As with the Pioneer, the laser's plane must clear the small boxes and meet the tall targets.
    laser=LaserMount(x=-0.04, height=0.25, rays=360, range_max=8.0, noise_std=0.015, sweep=math.tau),
    camera=CameraMount(x=0.05, height=0.30, tilt=math.radians(8), field=math.radians(69), width=160, rows=120),
    gripper=None,
    sonar_poses=(),
    sonar_height=0.0,
    sonar_range=0.0,
    sonar_cone=0.0,
    round=True,
)
