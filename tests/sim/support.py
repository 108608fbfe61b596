"""Small worlds, and ways of driving a robot in them."""

import math
from typing import Any

from understudy.geometry import Point, Pose
from understudy.robot import Command
from understudy.sim import SimRobot, Simulation, World

QUIET = dict.fromkeys(
    ("laser", "sonar", "image", "illumination", "odometry_scale", "odometry_heading", "false_blobs", "beam_misreads"), 0
)


def world_data(**changes: Any) -> dict[str, Any]:
    """A bare arena of 4 by 6 m with a robot in the middle that looks along y, and perfect senses."""
    data: dict[str, Any] = {
        "understudy": "world/1",
        "name": "test",
        "seed": 7,
        "arena": {"size": [4.0, 6.0]},
        "robots": [{"name": "learner", "at": [2.0, 2.0], "heading_deg": 90}],
        "noise": dict(QUIET),
    }
    data.update(changes)
    return data


def make_world(**changes: Any) -> World:
    """The bare arena, changed."""
    return World.from_data(world_data(**changes))


def simulate(**changes: Any) -> Simulation:
    """A run of the bare arena, changed."""
    return Simulation(make_world(**changes))


def drive(robot: SimRobot, seconds: float, linear: float = 0.0, angular: float = 0.0, **posture: Any) -> None:
    """Holds one command."""
    for _ in range(round(seconds * 10)):
        robot.act(Command(linear=linear, angular=angular, **posture))
        robot.wait()


def toward(pose: Pose, goal: Point, keep: float) -> Command:
    """A proportional controller on true positions, in place of a follower that perceives."""
    seen = pose.to_local(goal)
    linear = 0.0 if abs(seen.bearing) > math.radians(40) else max(-0.1, min(0.5, seen.distance - keep))
    return Command(linear=linear, angular=2.0 * seen.bearing)


def grasp(robot: SimRobot) -> None:
    """Picks up a box that stands straight ahead, its middle 0.65 m before the robot's."""
    drive(robot, 1.2, paddles="open", lift="down")
    for _ in range(60):
        gripper = robot.sense().gripper
        assert gripper is not None
        if gripper.beam_broken:
            break
        drive(robot, 0.1, linear=0.15)
    drive(robot, 0.2)
    drive(robot, 1.2, paddles="close")
    drive(robot, 1.2, lift="up")
