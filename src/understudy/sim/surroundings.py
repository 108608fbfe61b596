"""What stands in a walker's way."""

import math
from collections.abc import Iterator

from understudy.geometry import Point, Pose
from understudy.robot import RobotSpec
from understudy.sim.gait import CLEARANCE_M, ROBOT_CLEARANCE_M, Obstacle
from understudy.sim.model import ArenaModel
from understudy.sim.truth import Truth

__all__ = ["Surroundings"]

_REACH_M = 0.6
"""What is farther away than this, beyond its own size, does not matter to somebody's next step."""


class Surroundings:
    """Walls, doors, targets, boxes and robots around a place, as they truly are."""

    def __init__(self, arena: ArenaModel, truth: Truth) -> None:
        self._truth = truth
        self._size = arena.world.arena.size
        self._walls = [(Point(*wall.start), Point(*wall.end)) for wall in arena.world.walls]
        self._doors = arena.world.doors
        self._target_radii = [target.radius for target in arena.world.targets]
        self._box_radii = [box.size / math.sqrt(2) for box in arena.world.boxes]

    def near(self, here: Point) -> list[Obstacle]:
        """All obstacles within reach of a place."""
        found = list(self._still(here))
        for body in self._truth.bodies:
            found.append(Obstacle(_nearest_of_robot(body.pose, body.spec, here), ROBOT_CLEARANCE_M))
        return found

    def free(self, spot: Point, radius: float) -> bool:
        """Whether somebody of this radius could stand there; robots are not looked at, since they make room."""
        return all(spot.distance_to(thing.nearest) >= radius + thing.clearance for thing in self._still(spot))

    def _still(self, here: Point) -> Iterator[Obstacle]:
        width, depth = self._size
        for edge in (Point(0.0, here.y), Point(width, here.y), Point(here.x, 0.0), Point(here.x, depth)):
            if here.distance_to(edge) < _REACH_M:
                yield Obstacle(edge, CLEARANCE_M)
        for start, end in self._walls:
            nearest = _nearest_of_segment(start, end, here)
            if here.distance_to(nearest) < _REACH_M:
                yield Obstacle(nearest, CLEARANCE_M)
        for i, door in enumerate(self._doors):
            nearest = _nearest_of_segment(Point(*door.hinge), door.edge(self._truth.door_opening(i)), here)
            if here.distance_to(nearest) < _REACH_M:
                yield Obstacle(nearest, CLEARANCE_M)
        for place, radius in zip(self._truth.target_places(), self._target_radii, strict=True):
            if here.distance_to(place) < _REACH_M + radius:
                yield Obstacle(place, radius + CLEARANCE_M)
        for i, radius in enumerate(self._box_radii):
            place = self._truth.box_place(i)
            if here.distance_to(place) < _REACH_M + radius and not self._carried(i):
                yield Obstacle(place, radius + CLEARANCE_M)

    def _carried(self, box: int) -> bool:
        return any(self._truth.gripped_box(robot) == box for robot in range(len(self._truth.bodies)))


def _nearest_of_segment(a: Point, b: Point, here: Point) -> Point:
    dx, dy = b.x - a.x, b.y - a.y
    length2 = dx * dx + dy * dy
    t = min(1.0, max(0.0, ((here.x - a.x) * dx + (here.y - a.y) * dy) / length2)) if length2 else 0.0
    return Point(a.x + t * dx, a.y + t * dy)


def _nearest_of_robot(pose: Pose, spec: RobotSpec, here: Point) -> Point:
    """On the robot's body, its gripper included."""
    local = pose.to_local(here)
    back, front, side = -spec.length / 2, spec.gripper.x_front if spec.gripper else spec.length / 2, spec.width / 2
    return pose.to_parent(Point(min(front, max(back, local.x)), min(side, max(-side, local.y))))
