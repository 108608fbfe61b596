"""Where things stand: footprints on the floor, the gaps between them, and a check of a whole world."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

from understudy.errors import WorldError
from understudy.geometry import Point, Pose
from understudy.robot import RobotSpec
from understudy.sim.gait import CLEARANCE_M

if TYPE_CHECKING:
    from understudy.sim.world import Box, Door, RobotStart, Target, Teacher, Wall, World

__all__ = ["DOOR_HALF_THICKNESS_M", "WALL_HALF_THICKNESS_M", "Footprint", "check_layout", "footprints"]

WALL_HALF_THICKNESS_M = 0.02
DOOR_HALF_THICKNESS_M = 0.015

_SHORTEST_DOOR_M = 0.2


@dataclass(frozen=True, slots=True)
class Footprint:
    """A convex shape on the floor: the hull of ``corners`` (counter-clockwise), grown by ``radius``.

    One corner makes a disc, two a wall, four a box. Metres, in the arena's frame.
    """

    corners: tuple[Point, ...]
    radius: float = 0.0

    @classmethod
    def disc(cls, at: tuple[float, float], radius: float) -> "Footprint":
        """A round thing."""
        return cls((Point(*at),), radius)

    @classmethod
    def rectangle(cls, pose: Pose, back: float, front: float, half_width: float) -> "Footprint":
        """A rectangle in the frame of ``pose``, from ``back`` to ``front`` along its x axis."""
        local = ((back, -half_width), (front, -half_width), (front, half_width), (back, half_width))
        return cls(tuple(pose.to_parent(Point(*corner)) for corner in local))

    @classmethod
    def of_robot(cls, pose: Pose, spec: RobotSpec) -> "Footprint":
        """The body with its gripper."""
        if spec.round:
            return cls.disc((pose.x, pose.y), spec.width / 2)
        front = spec.gripper.x_front if spec.gripper else spec.length / 2
        return cls.rectangle(pose, -spec.length / 2, front, spec.width / 2)

    @classmethod
    def of_target(cls, target: "Target") -> "Footprint":
        """A target where the document puts it."""
        return cls.disc(target.at, target.radius)

    @classmethod
    def of_teacher(cls, teacher: "Teacher") -> "Footprint":
        """The teacher where the document puts it."""
        return cls.disc(teacher.at, teacher.radius)

    @classmethod
    def of_box(cls, box: "Box") -> "Footprint":
        """A box where the document puts it."""
        half = box.size / 2
        return cls.rectangle(Pose(*box.at, math.radians(box.heading_deg)), -half, half, half)

    @classmethod
    def of_wall(cls, wall: "Wall") -> "Footprint":
        """A wall with its thickness."""
        return cls((Point(*wall.start), Point(*wall.end)), WALL_HALF_THICKNESS_M)

    @classmethod
    def of_door(cls, door: "Door", open_deg: float) -> "Footprint":
        """A door's leaf when it is open so far."""
        return cls((Point(*door.hinge), door.edge(open_deg)), DOOR_HALF_THICKNESS_M)

    def gap_to(self, other: "Footprint") -> float:
        """Metres between the two edges; zero or less where they overlap."""
        if self._holds(other.corners[0]) or other._holds(self.corners[0]):
            return -self.radius - other.radius
        nearest = min(_segment_gap(*a, *b) for a in self._edges() for b in other._edges())
        return nearest - self.radius - other.radius

    def inside(self, size: tuple[float, float], margin: float = 0.0) -> bool:
        """Whether all of it lies in the arena, at least ``margin`` from its walls."""
        return self.gap_to_arena(size) >= margin

    def gap_to_arena(self, size: tuple[float, float]) -> float:
        """Metres from its edge to the nearest of the arena's walls; less than zero where it reaches out."""
        return min(min(c.x, size[0] - c.x, c.y, size[1] - c.y) for c in self.corners) - self.radius

    def _edges(self) -> Iterator[tuple[Point, Point]]:
        count = len(self.corners)
        for i in range(count if count > 2 else 1):
            yield self.corners[i], self.corners[(i + 1) % count]

    def _holds(self, point: Point) -> bool:
        if len(self.corners) < 3:
            return False
        return all((b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x) >= 0.0 for a, b in self._edges())


def _segment_gap(a: Point, b: Point, c: Point, d: Point) -> float:
    """Distance of the segments ab and cd, either of which may be a point."""

    def side(p: Point, q: Point, r: Point) -> float:
        return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)

    if side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0:
        return 0.0
    return min(_point_gap(a, c, d), _point_gap(b, c, d), _point_gap(c, a, b), _point_gap(d, a, b))


def _point_gap(p: Point, a: Point, b: Point) -> float:
    dx, dy = b.x - a.x, b.y - a.y
    length2 = dx * dx + dy * dy
    t = 0.0 if length2 == 0.0 else min(1.0, max(0.0, ((p.x - a.x) * dx + (p.y - a.y) * dy) / length2))
    return math.hypot(p.x - a.x - t * dx, p.y - a.y - t * dy)


def _robot_footprint(robot: "RobotStart") -> Footprint:
    return Footprint.of_robot(Pose(*robot.at, math.radians(robot.heading_deg)), robot.spec)


def footprints(world: "World") -> list[tuple[str, Footprint]]:
    """Every thing of the world with its path in the document."""
    found = [(f"walls[{i}]", Footprint.of_wall(wall)) for i, wall in enumerate(world.walls)]
    found += [(f"doors[{i}]", Footprint.of_door(door, door.open_deg)) for i, door in enumerate(world.doors)]
    found += [(f"targets[{i}]", Footprint.of_target(target)) for i, target in enumerate(world.targets)]
    found += [(f"boxes[{i}]", Footprint.of_box(box)) for i, box in enumerate(world.boxes)]
    found += [(f"robots[{i}]", _robot_footprint(robot)) for i, robot in enumerate(world.robots)]
    if world.teacher is not None:
        found.append(("teacher", Footprint.of_teacher(world.teacher)))
    return found


def check_layout(world: "World", *, source: str = "") -> None:
    """Refuses things that stand outside the arena or in each other, and names that are used twice.

    Raises:
        WorldError: for the first such thing, with its path.
    """
    size = world.arena.size
    for i, door in enumerate(world.doors):
        if door.length < _SHORTEST_DOOR_M:
            raise WorldError(
                f"the door is {door.length:g} m wide; it takes at least {_SHORTEST_DOOR_M:g} m from 'hinge' to 'to'",
                source=source,
                path=f"doors[{i}].to",
            )
    for path, footprint in footprints(world):
        # Walls may touch the arena's own walls: only their middle line has to be inside; and so with doors.
        flat = path.startswith(("walls", "doors"))
        shape = Footprint(footprint.corners) if flat else footprint
        if not shape.inside(size):
            corners = ", ".join(f"({c.x:.2f}, {c.y:.2f})" for c in shape.corners)
            raise WorldError(
                f"stands outside the arena: it reaches to {corners}"
                + (f" with radius {shape.radius:g}" if shape.radius else "")
                + f", the arena from (0, 0) to ({size[0]:g}, {size[1]:g})",
                source=source,
                path=path if flat else f"{path}.at",
            )
    for (first_path, first), (second_path, second) in combinations(footprints(world), 2):
        if first_path.startswith("walls") and second_path.startswith(("walls", "doors")):
            continue  # Walls meet in corners, and doors hang on them.
        gap = first.gap_to(second)
        if gap < 0.0:
            place = second_path if second_path.startswith("doors") else f"{second_path}.at"
            raise WorldError(f"overlaps {first_path}; move one of them", source=source, path=place)
    _check_script_places(world, source)
    names = [robot.name for robot in world.robots]
    for i, name in enumerate(names):
        if name in names[:i]:
            raise WorldError(f"a second robot is called {name!r}", source=source, path=f"robots[{i}].name")
    if world.teacher is not None and world.teacher.leads not in (None, *names):
        raise WorldError(
            f"no robot is called {world.teacher.leads!r}; there are: {', '.join(names)}",
            source=source,
            path="teacher.leads",
        )


def _check_script_places(world: "World", source: str) -> None:
    if world.teacher is None:
        return
    radius = world.teacher.radius
    solid = [(path, shape) for path, shape in footprints(world) if path.startswith(("walls", "doors", "targets"))]
    for i, item in enumerate(world.teacher.script):
        for key, place in (("walk", item.walk.to if item.walk else None), ("step_aside", item.step_aside)):
            if place is None:
                continue
            here = Footprint.disc(place, radius)
            path = f"teacher.script[{i}].{key}"
            if not here.inside(world.arena.size, CLEARANCE_M):
                raise WorldError(
                    f"the teacher (radius {radius:g}) would stand outside the arena, or nearer than"
                    f" {CLEARANCE_M:g} m to its wall, at ({place[0]:g}, {place[1]:g})",
                    source=source,
                    path=path,
                )
            for other, shape in solid:
                if here.gap_to(shape) < CLEARANCE_M:
                    raise WorldError(
                        f"the teacher cannot get there: it keeps {CLEARANCE_M:g} m from {other}",
                        source=source,
                        path=path,
                    )
