"""The referee: watches the truth of a run, and counts what should not have happened."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import mujoco
import numpy as np

from understudy.geometry import Point, Pose
from understudy.sim.layout import Footprint
from understudy.sim.mjcf import PHYSICS_STEP_S
from understudy.sim.model import Thing
from understudy.sim.simulation import Simulation

__all__ = ["Collision", "CollisionKind", "Referee"]

EPISODE_GAP_S = 0.3
"""A contact that was lost for less than this goes on: a body that scrapes along a wall bounces a little."""

GRAZING_S, GRAZING_N = 0.3, 90.0
"""Shorter and softer contacts only graze: the robot meets a wall at 0.1 m/s with 90 N (at 0.4 m/s, with 370 N)."""


class CollisionKind(StrEnum):
    """What a robot ran into; a door is pushed rather than run into, as boxes are."""

    WALL = "wall"
    TARGET = "target"
    PERSON = "person"
    ROBOT = "robot"
    DOOR = "door"


_KINDS = {
    Thing.WALL: CollisionKind.WALL,
    Thing.TARGET: CollisionKind.TARGET,
    Thing.PERSON: CollisionKind.PERSON,
    Thing.ROBOT: CollisionKind.ROBOT,
    Thing.DOOR: CollisionKind.DOOR,
}


@dataclass(slots=True, kw_only=True)
class Collision:
    """One episode of contact between a robot and something.

    Attributes:
        kind: what the robot touched.
        robot: its name.
        other: index of what was touched in the document's list (0 for the person).
        start_s: when it began.
        end_s: when it was seen last.
        max_force: greatest sum of normal forces, newtons.
    """

    kind: CollisionKind
    robot: str
    other: int
    start_s: float
    end_s: float
    max_force: float

    @property
    def grazing(self) -> bool:
        """Whether it was both short and soft."""
        return self.end_s - self.start_s <= GRAZING_S and self.max_force <= GRAZING_N


class Referee:
    """Watches a simulation from the moment it is made.

    Args:
        simulation: the run to be watched.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._arena = simulation.arena
        self._truth = simulation.truth
        self._names = [robot.name for robot in simulation.world.robots]
        self._open: dict[tuple[int, Thing, int], Collision] = {}
        self._harmless = b""
        self._wrench = np.zeros(6)
        self._robot_geoms = np.array([thing is Thing.ROBOT for thing, _ in self._arena.things])
        self._floor_or_box = np.array([thing in (Thing.FLOOR, Thing.BOX) for thing, _ in self._arena.things])
        self.collisions: list[Collision] = []
        """All episodes so far, in the order in which they began."""
        self.pushes: list[Collision] = []
        """The same for doors, which are there to be pushed: these are no collisions."""
        self.trajectories: dict[str, list[Pose]] = {name: [] for name in self._names}
        """True pose of each robot, one a control period, from when the referee began to watch."""
        self._substeps = 0
        self._start_s = simulation.time_s
        self._note_poses()
        simulation.observe(self._look)

    # -- what happened ----------------------------------------------------------------------------------------

    def count(self, kind: CollisionKind | None = None, *, grazing: bool = True) -> int:
        """Number of collisions, of one kind or of all; without the grazing ones if so wished."""
        return sum(1 for c in self.collisions if kind in (None, c.kind) and (grazing or not c.grazing))

    def minimum_distance(self, name: str = "learner") -> float:
        """Metres between the robot's outline and the nearest wall, target, person or other robot, now."""
        number = self._names.index(name)
        outline = self._outline(number)
        width, depth = self._simulation.world.arena.size
        gaps = [min(c.x, width - c.x, c.y, depth - c.y) for c in outline.corners]
        gaps += [outline.gap_to(Footprint.of_wall(wall)) for wall in self._simulation.world.walls]
        for target, place in zip(self._simulation.world.targets, self._truth.target_places(), strict=True):
            gaps.append(outline.gap_to(Footprint.disc(place, target.radius)))
        gaps += [outline.gap_to(self._outline(i)) for i in range(len(self._names)) if i != number]
        teacher, person = self._simulation.world.teacher, self._truth.teacher_place()
        if teacher is not None and person is not None:
            gaps.append(outline.gap_to(Footprint.disc(person, teacher.radius)))
        return min(gaps)

    # -- how things are ---------------------------------------------------------------------------------------

    def robot_pose(self, name: str = "learner") -> Pose:
        """The true pose of a robot."""
        return self._truth.robot_pose(self._names.index(name))

    def held_box(self, name: str = "learner") -> int | None:
        """Index of the box that a robot holds lifted."""
        return self._truth.held_box(self._names.index(name))

    def targets(self) -> list[Point]:
        """True places of the targets, in the document's order."""
        return self._truth.target_places()

    def boxes(self) -> list[Point]:
        """True places of the boxes, in the document's order."""
        return [self._truth.box_place(i) for i in range(len(self._simulation.world.boxes))]

    def doors(self) -> list[float]:
        """How far the doors are open, degrees, in the document's order."""
        return [self._truth.door_opening(i) for i in range(len(self._simulation.world.doors))]

    def teacher(self) -> Point | None:
        """True place of the teacher."""
        return self._truth.teacher_place()

    # -- watching ---------------------------------------------------------------------------------------------

    def _outline(self, robot: int) -> Footprint:
        return Footprint.of_robot(self._truth.robot_pose(robot), self._truth.bodies[robot].spec)

    def _note_poses(self) -> None:
        for i, name in enumerate(self._names):
            self.trajectories[name].append(self._truth.robot_pose(i))

    def _look(self, data: Any) -> None:
        self._substeps += 1
        now = self._start_s + self._substeps * PHYSICS_STEP_S
        if data.ncon:
            self._judge(data, now)
        if self._substeps % 10 == 0:
            self._note_poses()

    def _judge(self, data: Any, now: float) -> None:
        pairs = data.contact.geom
        signature = pairs.tobytes()
        if signature == self._harmless:
            return  # The usual case: nothing but a box on the floor.
        relevant = self._robot_geoms[pairs].any(axis=1) & ~self._floor_or_box[pairs].any(axis=1)
        if not relevant.any():
            self._harmless = signature
            return
        forces: dict[tuple[int, Thing, int], float] = {}
        for contact in np.flatnonzero(relevant).tolist():
            mujoco.mj_contactForce(self._simulation.arena.model, data, contact, self._wrench)
            first, second = (self._arena.things[geom] for geom in pairs[contact].tolist())
            robot, other = (first, second) if first[0] is Thing.ROBOT else (second, first)
            key = (robot[1], *other)
            forces[key] = forces.get(key, 0.0) + float(self._wrench[0])
        for key, force in forces.items():
            self._extend(key, force, now)

    def _extend(self, key: tuple[int, Thing, int], force: float, now: float) -> None:
        episode = self._open.get(key)
        if episode is None or now - episode.end_s > EPISODE_GAP_S:
            robot, thing, other = key
            episode = Collision(
                kind=_KINDS[thing],
                robot=self._names[robot],
                other=other,
                start_s=round(now, 9),
                end_s=now,
                max_force=0.0,
            )
            self._open[key] = episode
            (self.pushes if thing is Thing.DOOR else self.collisions).append(episode)
        episode.end_s = round(now, 9)
        episode.max_force = max(episode.max_force, force)
