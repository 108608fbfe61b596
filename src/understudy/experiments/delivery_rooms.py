"""The rooms of the delivery task: its four initial conditions (§3.5.2.3), and the hand that moves things in mid-run."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from understudy.errors import WorldError
from understudy.execution import Decision
from understudy.geometry import Point
from understudy.perception import Percepts
from understudy.sessions import Stage
from understudy.sim import World

__all__ = ["CONDITIONS", "Condition", "Hand", "Movable", "beacon_of", "draw_room"]

Side = Literal["home", "other"]
Movable = Literal["box", "robot"]

_OPEN_DEG = 80.0

_WALL_M, _APART_M, _DOOR_M = 0.6, 0.7, 1.3
"""Nothing is put nearer to a wall, to another thing, or to the middle of the door."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """Where the robot and the box are at first."""

    robot: Side
    box: Side

    def __str__(self) -> str:
        return f"robot {self.robot}, box {self.box}"


CONDITIONS = tuple(Condition(robot=robot, box=box) for robot in ("home", "other") for box in ("home", "other"))


def draw_room(world: World, condition: Condition, rng: np.random.Generator, *, door_open: bool) -> World:
    """The world with robot and box somewhere in the rooms of the condition, and the door open or closed."""
    box = _place(world, condition.box, rng)
    robot = _place(world, condition.robot, rng, apart_from=[Point(*box)])
    opening = _OPEN_DEG * float(rng.choice((-1.0, 1.0)))
    heading, turned = float(rng.uniform(-180, 180)), float(rng.uniform(-45, 45))
    return world.model_copy(
        update={
            "boxes": (world.boxes[0].model_copy(update={"at": box, "heading_deg": round(turned, 1)}),),
            "robots": (world.robots[0].model_copy(update={"at": robot, "heading_deg": round(heading, 1)}),),
            "doors": (world.doors[0].model_copy(update={"open_deg": opening if door_open else 0.0}),),
        }
    )


def beacon_of(world: World) -> int:
    """The target that is no post of the door."""
    door = [Point(*world.doors[0].hinge), Point(*world.doors[0].to)]
    return next(i for i, t in enumerate(world.targets) if all(Point(*t.at).distance_to(end) > 0.5 for end in door))


class Hand:
    """Moves the box or the robot, once, somewhere in either room.

    Args:
        what: is moved; None moves nothing.
        when_s: the moment.
        rng: draws the place.
    """

    def __init__(self, what: Movable | None, when_s: float, rng: np.random.Generator) -> None:
        self._what, self._when_s, self._rng = what, when_s, rng
        self._stage: Stage | None = None
        self.did = ""
        """What was moved, whereto and when."""

    def prepare(self, stage: Stage) -> None:
        """Is given the rooms before the run."""
        self._stage = stage

    def watch(self, percepts: Percepts, decision: Decision) -> None:
        """Is called after every tick."""
        stage = self._stage
        if self._what is None or self.did or stage is None or percepts.time_s < self._when_s:
            return
        side: Side = "home" if self._rng.random() < 0.5 else "other"
        robot, box = stage.referee.robot_pose(stage.robot.name).position, stage.referee.boxes()[0]
        place = _place(stage.world, side, self._rng, apart_from=[box if self._what == "robot" else robot])
        heading = float(self._rng.uniform(-180, 180))
        if self._what == "box":
            stage.simulation.move_box(0, place, heading)
        else:
            stage.simulation.move_robot(place, heading, stage.robot.name)
        self.did = f"the {self._what} to ({place[0]:.1f}, {place[1]:.1f}) at {percepts.time_s:.0f} s"


def _place(
    world: World, side: Side, rng: np.random.Generator, *, apart_from: Sequence[Point] = ()
) -> tuple[float, float]:
    """A free place in a room: the one on the beacon's side of the door, or the other."""
    width, depth = world.arena.size
    door = Point(*(np.array(world.doors[0].hinge) + np.array(world.doors[0].to)) / 2)
    home = Point(*world.targets[beacon_of(world)].at)
    for _ in range(1000):
        x, y = rng.uniform(_WALL_M, width - _WALL_M), rng.uniform(_WALL_M, depth - _WALL_M)
        place = Point(round(x, 3), round(y, 3))
        at_home = (y < door.y) is (home.y < door.y)
        if (
            at_home is (side == "home")
            and abs(y - door.y) >= _WALL_M
            and place.distance_to(door) >= _DOOR_M
            and all(place.distance_to(other) >= _APART_M for other in [home, *apart_from])
        ):
            return place.x, place.y
    raise WorldError(f"no free place found in the {side} room", source=world.name)
