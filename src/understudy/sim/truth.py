"""What is really so in a simulation: for the teacher (who can see it), the referee and interventions alone.

Robots, perception and learning must not read it; what they know comes through a robot's observations.
"""

import math
from collections.abc import Sequence
from typing import Any

from understudy.geometry import Point, Pose
from understudy.sim.body import RobotBody
from understudy.sim.model import ArenaModel

__all__ = ["Truth"]


class Truth:
    """True places, in the arena's frame."""

    def __init__(self, arena: ArenaModel, data: Any, bodies: Sequence[RobotBody]) -> None:
        self._arena, self._data = arena, data
        self._target_rows = list(arena.target_mocap)
        self.bodies = tuple(bodies)

    def robot_pose(self, robot: int) -> Pose:
        """Of a robot, by its index in the document."""
        return self.bodies[robot].pose

    def target_places(self) -> list[Point]:
        """The middles of all targets, in the document's order."""
        return [Point(x, y) for x, y in self._data.mocap_pos[self._target_rows, :2].tolist()]

    def box_place(self, box: int) -> Point:
        """The middle of a box."""
        at = self._arena.box_pose[box]
        return Point(float(self._data.qpos[at]), float(self._data.qpos[at + 1]))

    def box_height(self, box: int) -> float:
        """Of the box's middle above the floor, metres."""
        return float(self._data.qpos[self._arena.box_pose[box] + 2])

    def door_opening(self, door: int) -> float:
        """How far a door is open, degrees, counter-clockwise from above."""
        return math.degrees(self._data.qpos[self._arena.door_angle[door]])

    def teacher_place(self) -> Point | None:
        """The middle of the teacher; None in a world without one."""
        if self._arena.teacher_mocap is None:
            return None
        x, y, _ = self._data.mocap_pos[self._arena.teacher_mocap].tolist()
        return Point(x, y)

    def gripped_box(self, robot: int) -> int | None:
        """The box between the robot's closed paddles, lifted or not."""
        body = self.bodies[robot]
        if not body.clamped:  # nearly always: no box need be looked at
            return None
        return next((i for i in range(len(self._arena.box_pose)) if body.grips(self.box_place(i))), None)

    def held_box(self, robot: int) -> int | None:
        """The box that the robot has lifted."""
        box = self.gripped_box(robot)
        return box if box is not None and self.bodies[robot].holds(self.box_place(box)) else None

    def gripper_stowed(self, robot: int) -> bool:
        """Whether the robot's gripper is empty, closed and lifted."""
        return self.bodies[robot].stowed
