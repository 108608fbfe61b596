"""A simulated room with a robot in it, a referee beside it, and a memory of who walked where."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from understudy.clock import CONTROL_PERIOD_S
from understudy.geometry import Point
from understudy.sim import CollisionKind, Referee, Simulation, World
from understudy.sim.simulated_robot import SimRobot

__all__ = ["Stage", "Verdict"]

Path = NDArray[np.float64]
"""Time, place and, for robots, heading: rows of seconds, metres, metres, radians."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """What the referee saw. Nothing of it reaches the robot.

    Attributes:
        collisions: hard ones, by what was hit.
        grazes: short and soft contacts, by what was touched.
        boxes: where the boxes stand in the end.
    """

    collisions: Mapping[str, int]
    grazes: Mapping[str, int]
    boxes: tuple[Point, ...]

    @property
    def clean(self) -> bool:
        """No hard collision."""
        return not self.collisions


class Stage:
    """One run of a world, watched.

    Args:
        world: the room.
        seed: of all chance; the world's own if None.
    """

    def __init__(self, world: World, seed: int | None = None) -> None:
        self.world = world
        self.simulation = Simulation(world, seed=seed)
        self.referee = Referee(self.simulation)
        self.robot: SimRobot = self.simulation.robot(world.robots[0].name)
        self._teacher: list[tuple[float, float, float]] = []
        self._boxes: list[list[Point]] = []

    def look(self) -> None:
        """Notes where everybody is; to be called once a control period."""
        teacher = self.referee.teacher()
        if teacher is not None:
            self._teacher.append((self.simulation.time_s, *teacher))
        self._boxes.append(self.referee.boxes())

    @property
    def robot_path(self) -> Path:
        """Where the robot truly was."""
        return self.path_of(self.robot.name)

    def path_of(self, name: str) -> Path:
        """Where one of the robots truly was."""
        poses = self.referee.trajectories[name]
        return np.array([(index * CONTROL_PERIOD_S, p.x, p.y, p.heading) for index, p in enumerate(poses)])

    @property
    def teacher_path(self) -> Path | None:
        """Where the teacher truly was; None in a room without one."""
        return np.array(self._teacher) if self._teacher else None

    @property
    def box_paths(self) -> list[Path]:
        """Where the boxes truly were, one path a box."""
        times = np.arange(len(self._boxes)) * CONTROL_PERIOD_S
        return [np.column_stack((times, places)) for places in zip(*self._boxes, strict=True)]

    def verdict(self) -> Verdict:
        """What the referee has seen so far."""
        hard: dict[str, int] = {}
        soft: dict[str, int] = {}
        for kind in CollisionKind:
            every, firm = self.referee.count(kind), self.referee.count(kind, grazing=False)
            if firm:
                hard[kind.value] = firm
            if every - firm:
                soft[kind.value] = every - firm
        return Verdict(collisions=hard, grazes=soft, boxes=tuple(self.referee.boxes()))
