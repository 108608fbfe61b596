"""A changed room: the same things in other places (§4.5.4: "five times in a changed environment")."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from understudy.errors import WorldError
from understudy.geometry import Point, Pose
from understudy.sim.layout import Footprint, check_layout
from understudy.sim.world import Box, RobotStart, Target, World

__all__ = ["rearranged"]

_TRIES_A_GROUP = 60
_TRIES_A_ROOM = 200

_TOUCHING_M = 0.05

_TURN = math.radians(20)
"""So far a robot's start turns at most in a room whose things only jitter."""


@dataclass(slots=True, kw_only=True)
class _Group:
    """Things that move together: indices into the document's lists."""

    targets: list[int]
    boxes: list[int]


def rearranged(
    world: World,
    seed: int,
    *,
    spacing: float = 0.8,
    wall_margin: float = 0.5,
    robot_clearance: float = 0.4,
) -> World:
    """A room with the same things at random places, for a robot that is left to itself: without a teacher.

    Things of one group move as one: they keep their distances and bearings to each other. Every robot starts at a
    random free place. The same seed gives the same room, and becomes the seed of its noise. In a world with ``jitter``
    all of it moves by so little only, nothing turns but the robots, and what stood nearer than these gaps still may.

    Args:
        world: the room to be changed; its inner walls and doors stay, and targets that touch them.
        seed: of the drawing.
        spacing: least gap between things of different groups, metres.
        wall_margin: least gap between things and walls, metres.
        robot_clearance: least gap around a robot's start, metres.

    Raises:
        WorldError: no such room was found; smaller gaps or a larger arena would help.
    """
    rng = np.random.default_rng(seed)
    if world.jitter is not None:
        spacing, wall_margin, robot_clearance = _gaps_kept(world, spacing, wall_margin, robot_clearance)
    for _ in range(_TRIES_A_ROOM):
        changed = _draw(world, rng, spacing, wall_margin, robot_clearance)
        if changed is not None:
            room = world.model_copy(update={**changed, "seed": seed, "teacher": None})
            check_layout(room, source=f"{world.name}, rearranged with seed {seed}")
            return room
    raise WorldError(
        f"no free arrangement found in {_TRIES_A_ROOM} tries with spacing {spacing:g} m, wall margin {wall_margin:g} m"
        f" and robot clearance {robot_clearance:g} m; make them smaller or the arena larger",
        source=world.name,
    )


def _draw(
    world: World, rng: np.random.Generator, spacing: float, wall_margin: float, robot_clearance: float
) -> dict[str, object] | None:
    size = world.arena.size
    walls = _building(world)
    targets, boxes = list(world.targets), list(world.boxes)
    placed: list[Footprint] = []
    for group in _groups(world):
        for _ in range(_TRIES_A_GROUP):
            move = _random_move(world, group, rng)
            new_targets = {i: _moved_target(world.targets[i], move) for i in group.targets}
            new_boxes = {i: _moved_box(world.boxes[i], move) for i in group.boxes}
            shapes = [Footprint.of_target(target) for target in new_targets.values()]
            shapes += [Footprint.of_box(box) for box in new_boxes.values()]
            if _clear(shapes, size, wall_margin, [(placed, spacing), (walls, wall_margin)]):
                break
        else:
            return None
        for i, target in new_targets.items():
            targets[i] = target
        for i, box in new_boxes.items():
            boxes[i] = box
        placed += shapes
    robots: list[RobotStart] = []
    for robot in world.robots:
        for _ in range(_TRIES_A_GROUP):
            pose = _random_start(world, robot, rng)
            shape = Footprint.of_robot(pose, robot.spec)
            if _clear([shape], size, robot_clearance, [(placed, robot_clearance), (walls, robot_clearance)]):
                break
        else:
            return None
        start = {"at": _rounded(pose.position), "heading_deg": round(math.degrees(pose.heading), 1)}
        robots.append(robot.model_copy(update=start))
        placed.append(shape)
    return {"targets": tuple(targets), "boxes": tuple(boxes), "robots": tuple(robots)}


def _building(world: World) -> list[Footprint]:
    walls = [Footprint.of_wall(wall) for wall in world.walls]
    walls += [Footprint.of_door(door, turned) for door in world.doors for turned in (door.open_deg, 0.0)]
    return walls + [Footprint.of_target(world.targets[i]) for i in _built_in(world)]


def _gaps_kept(world: World, spacing: float, wall_margin: float, robot_clearance: float) -> tuple[float, float, float]:
    """The gaps, but none wider than what the room has already."""
    size, walls = world.arena.size, _building(world)
    groups = [
        [Footprint.of_target(world.targets[i]) for i in group.targets]
        + [Footprint.of_box(world.boxes[i]) for i in group.boxes]
        for group in _groups(world)
    ]
    things = [shape for group in groups for shape in group]
    for group, other in combinations(groups, 2):
        spacing = min(spacing, *(a.gap_to(b) for a in group for b in other))
    for shape in things:
        wall_margin = min(wall_margin, shape.gap_to_arena(size), *(shape.gap_to(wall) for wall in walls))
    for robot in world.robots:
        shape = Footprint.of_robot(Pose(*robot.at, math.radians(robot.heading_deg)), robot.spec)
        others = (shape.gap_to(other) for other in walls + things)
        robot_clearance = min(robot_clearance, shape.gap_to_arena(size), *others)
    return spacing, wall_margin, robot_clearance


def _built_in(world: World) -> set[int]:
    """Targets that touch a wall or a closed door belong to the building: the posts of a door."""
    building = [Footprint.of_wall(wall) for wall in world.walls]
    building += [Footprint.of_door(door, 0.0) for door in world.doors]
    shapes = map(Footprint.of_target, world.targets)
    return {i for i, shape in enumerate(shapes) if any(shape.gap_to(part) < _TOUCHING_M for part in building)}


def _groups(world: World) -> list[_Group]:
    """The larger groups first, as they are the harder ones to place."""
    named: dict[str, _Group] = {}
    alone: list[_Group] = []
    built_in = _built_in(world)
    for i, target in enumerate(world.targets):
        if i in built_in:
            continue
        if target.group is None:
            alone.append(_Group(targets=[i], boxes=[]))
        else:
            named.setdefault(target.group, _Group(targets=[], boxes=[])).targets.append(i)
    for i, box in enumerate(world.boxes):
        if box.group is None:
            alone.append(_Group(targets=[], boxes=[i]))
        else:
            named.setdefault(box.group, _Group(targets=[], boxes=[])).boxes.append(i)
    return sorted(named.values(), key=lambda group: -len(group.targets) - len(group.boxes)) + alone


def _random_move(world: World, group: _Group, rng: np.random.Generator) -> tuple[Pose, Pose]:
    """The frame of a group, before and after."""
    places = [world.targets[i].at for i in group.targets] + [world.boxes[i].at for i in group.boxes]
    middle = Pose(sum(x for x, _ in places) / len(places), sum(y for _, y in places) / len(places))
    if world.jitter is not None:
        dx, dy = rng.uniform(-world.jitter, world.jitter, 2).tolist()
        return middle, Pose(middle.x + dx, middle.y + dy)
    x, y = (rng.random(2) * world.arena.size).tolist()
    return middle, Pose(x, y, rng.uniform(-math.pi, math.pi))


def _random_start(world: World, robot: RobotStart, rng: np.random.Generator) -> Pose:
    if world.jitter is not None:
        dx, dy = rng.uniform(-world.jitter, world.jitter, 2).tolist()
        turned = rng.uniform(-_TURN, _TURN)
        return Pose(robot.at[0] + dx, robot.at[1] + dy, math.radians(robot.heading_deg) + turned)
    x, y = (rng.random(2) * world.arena.size).tolist()
    return Pose(x, y, rng.uniform(-math.pi, math.pi))


def _moved_target(target: Target, move: tuple[Pose, Pose]) -> Target:
    before, after = move
    return target.model_copy(update={"at": _rounded(after.to_parent(before.to_local(Point(*target.at))))})


def _moved_box(box: Box, move: tuple[Pose, Pose]) -> Box:
    before, after = move
    turned = box.heading_deg + math.degrees(after.heading)
    place = _rounded(after.to_parent(before.to_local(Point(*box.at))))
    return box.model_copy(update={"at": place, "heading_deg": round(turned, 1)})


def _rounded(place: Point) -> tuple[float, float]:
    # To a millimetre, so that a room that is written down and read again is the same.
    return round(place.x, 3), round(place.y, 3)


def _clear(
    shapes: list[Footprint],
    size: tuple[float, float],
    margin: float,
    others: Iterable[tuple[list[Footprint], float]],
) -> bool:
    return all(shape.inside(size, margin) for shape in shapes) and all(
        shape.gap_to(other) >= gap for shape in shapes for placed, gap in others for other in placed
    )
