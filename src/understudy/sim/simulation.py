"""A world in motion: robots, the teacher, and time, which passes in control periods of 0.1 s.

Order of one step:

1. The teacher sees how things are, speaks, and walks on.
2. Every robot's servos move toward its command.
3. Physics, in steps of 10 ms; observers (a referee) look after each.
4. Carried boxes are put back by the integrator's error.
5. Wheels' odometry takes in the motion; old readings become stale; the clock advances.
"""

import math
from collections.abc import Callable, Iterable
from typing import Any

import mujoco
import numpy as np

from understudy.clock import CONTROL_PERIOD_S, SteppedClock
from understudy.errors import WorldError
from understudy.geometry import Point, Pose
from understudy.robot import Color, Cue
from understudy.sim.body import RobotBody
from understudy.sim.mjcf import BOX_HEIGHT_M, PHYSICS_STEP_S
from understudy.sim.model import ArenaModel
from understudy.sim.noise import NoiseStreams
from understudy.sim.scenery import Scenery
from understudy.sim.simulated_robot import SimRobot
from understudy.sim.slips import Slip
from understudy.sim.teacher import ScriptedTeacher
from understudy.sim.truth import Truth
from understudy.sim.world import DOOR_RANGE_DEG, World

__all__ = ["Simulation"]

_SUBSTEPS = round(CONTROL_PERIOD_S / PHYSICS_STEP_S)
_FRACTIONS = (np.arange(_SUBSTEPS) + 1.0)[:, None] / _SUBSTEPS


class Simulation:
    """One run of a world. Same world, seed and calls: the same observations, bit for bit.

    Args:
        world: the document.
        seed: of all randomness, instead of the document's.
    """

    def __init__(self, world: World, seed: int | None = None) -> None:
        self.world = world
        self.seed = world.seed if seed is None else seed
        self.arena = ArenaModel.build(world)
        self._model = self.arena.model
        self._data: Any = mujoco.MjData(self._model)
        self._clock = SteppedClock()
        self._bodies = [
            RobotBody(index, start.spec, self._data, Pose(*start.at, math.radians(start.heading_deg)))
            for index, start in zip(self.arena.robots, world.robots, strict=True)
        ]
        self.truth = Truth(self.arena, self._data, self._bodies)
        # The teacher's slips come last, so that the robots' noise is the same with any teacher, or without one.
        *seeds, seed_of_teacher = np.random.SeedSequence(self.seed).spawn(len(self._bodies) + 1)
        self._teacher: ScriptedTeacher | None = None
        if world.teacher is not None:
            self._teacher = ScriptedTeacher(self.arena, self.truth, np.random.default_rng(seed_of_teacher))
        for joint, door in zip(self.arena.door_angle, world.doors, strict=True):
            self._data.qpos[joint] = math.radians(door.open_deg)
        mujoco.mj_kinematics(self._model, self._data)
        scenery = Scenery(self.arena, self._data)
        self._robots = {
            start.name: SimRobot(
                start.name,
                body,
                self._model,
                self._data,
                scenery=scenery,
                noise=world.noise,
                streams=NoiseStreams.spawn(seed_of_robot),
                now=self._clock.now,
                step=self.step,
            )
            for start, body, seed_of_robot in zip(world.robots, self._bodies, seeds, strict=True)
        }
        self._observers: list[Callable[[Any], None]] = []
        self._servos = self._data.ctrl
        self._ramps = np.zeros((_SUBSTEPS, self._model.nu))
        mujoco.mj_forward(self._model, self._data)

    # -- running ----------------------------------------------------------------------------------------------

    @property
    def time_s(self) -> float:
        """Seconds since the run began, in exact steps of 0.1."""
        return self._clock.now()

    @property
    def teacher_done(self) -> bool:
        """Whether the teacher's script has come to its end; True in a world without a teacher."""
        return self._teacher is None or self._teacher.done

    @property
    def teacher(self) -> ScriptedTeacher | None:
        """The teacher, to be walked by hand or watched."""
        return self._teacher

    @property
    def teacher_complaints(self) -> list[tuple[float, str]]:
        """What the teacher waited for in vain so far, with the time at which it went on; empty without a teacher."""
        return list(self._teacher.complaints) if self._teacher is not None else []

    @property
    def teacher_slips(self) -> tuple[Slip, ...]:
        """Where the teacher departs from the script in this run; nowhere with careful habits, or without a teacher."""
        return self._teacher.slips if self._teacher is not None else ()

    @property
    def teacher_at(self) -> str:
        """Where in the script the teacher is, ``script[3]: walk to (2.4, 1.4)``; empty when done or without one."""
        return self._teacher.at if self._teacher is not None else ""

    def robot(self, name: str = "learner") -> SimRobot:
        """One of the world's robots.

        Raises:
            WorldError: the world has no robot of this name.
        """
        if name not in self._robots:
            raise WorldError(
                f"no robot is called {name!r}; there are: {', '.join(self._robots)}", source=self.world.name
            )
        return self._robots[name]

    def say(self, word: Cue, *, to: Iterable[str] | None = None) -> None:
        """Speaks a cue, heard by all robots, or by those named, with their next observation."""
        for name in self._robots if to is None else to:
            self.robot(name).hear(word)

    def step(self) -> None:
        """Lets one control period pass."""
        model, data = self._model, self._data
        if self._teacher is not None:
            for word in self._teacher.advance(self.time_s):
                self.say(word)
            row = data.mocap_pos[self.arena.teacher_mocap]
            row[0], row[1] = self._teacher.gait.place
        for body in self._bodies:
            begin, end = body.advance_servos()
            self._ramps[:, body.index.ctrl] = begin + _FRACTIONS * (end - begin)
        for servos in self._ramps:
            self._servos[:] = servos
            mujoco.mj_step(model, data)
            for look in self._observers:
                look(data)
        self._undo_carrying_error()
        mujoco.mj_kinematics(model, data)
        self._clock.advance()
        for robot in self._robots.values():
            robot.period_passed()

    def observe(self, look: Callable[[Any], None]) -> None:
        """Calls ``look`` with MuJoCo's state after every physics step."""
        self._observers.append(look)

    def _undo_carrying_error(self) -> None:
        """Pulls carried boxes back by what the integrator pushed them outward.

        Each physics step moves a body along the tangent, so one that turns with the robot at a distance r drifts
        outward by r(ωΔt)²/2. Friction resists speed, not displacement: without this, a box leaves the gripper
        within a minute of turning.
        """
        for number, body in enumerate(self._bodies):
            turn = body.turning_rate * PHYSICS_STEP_S
            if abs(turn) < 1e-5:
                continue
            box = self.truth.gripped_box(number)
            if box is None:
                continue
            share = _SUBSTEPS * turn * turn / 2
            place, pose = self.truth.box_place(box), body.pose
            at = self.arena.box_pose[box]
            self._data.qpos[at] -= share * (place.x - pose.x)
            self._data.qpos[at + 1] -= share * (place.y - pose.y)

    # -- interventions: what an experimenter's hand does in mid-run ----------------------------------------------

    def move_target(self, which: int | Color, to: tuple[float, float]) -> None:
        """Puts a target elsewhere: by its index in the document, or the first of its color."""
        target = self._which(which, [target.color for target in self.world.targets], "target")
        row = self._data.mocap_pos[self.arena.target_mocap[target]]
        row[0], row[1] = self._on_floor(to)
        self._touched()

    def move_box(self, which: int | Color, to: tuple[float, float], heading_deg: float = 0.0) -> None:
        """Puts a box on the floor elsewhere, out of a gripper, too."""
        box = self._which(which, [box.color for box in self.world.boxes], "box")
        x, y = self._on_floor(to)
        half = math.radians(heading_deg) / 2
        at, speed = self.arena.box_pose[box], self.arena.box_speed[box]
        self._data.qpos[at : at + 7] = x, y, BOX_HEIGHT_M / 2, math.cos(half), 0.0, 0.0, math.sin(half)
        self._data.qvel[speed : speed + 6] = 0.0
        self._touched()

    def swing_door(self, which: int, open_deg: float) -> None:
        """Opens or closes a door by hand, as far as the document could say."""
        if not 0 <= which < len(self.world.doors):
            raise WorldError(f"there is no door {which}; the world has {len(self.world.doors)}", source=self.world.name)
        if not abs(open_deg) <= DOOR_RANGE_DEG:
            raise WorldError(
                f"a door swings from -{DOOR_RANGE_DEG:g} to {DOOR_RANGE_DEG:g} degrees, given {open_deg:g}",
                source=self.world.name,
            )
        self._data.qpos[self.arena.door_angle[which]] = math.radians(open_deg)
        self._data.qvel[self.arena.door_speed[which]] = 0.0
        self._touched()

    def move_robot(self, to: tuple[float, float], heading_deg: float, name: str = "learner") -> None:
        """Lifts a robot and puts it down elsewhere; its odometry does not notice. What it holds goes with it."""
        x, y = self._on_floor(to)
        robot = self.robot(name)
        number = list(self._robots).index(name)
        box, old = self.truth.gripped_box(number), self.truth.robot_pose(number)
        new = Pose(x, y, math.radians(heading_deg))
        robot.carried_to(new)
        if box is not None:
            self._carry_along(box, old, new)
        self._touched()

    def _carry_along(self, box: int, old: Pose, new: Pose) -> None:
        at, speed = self.arena.box_pose[box], self.arena.box_speed[box]
        place = new.to_parent(old.to_local(self.truth.box_place(box)))
        half = (new.heading - old.heading) / 2
        turned = np.zeros(4)
        mujoco.mju_mulQuat(
            turned, np.array([math.cos(half), 0.0, 0.0, math.sin(half)]), self._data.qpos[at + 3 : at + 7]
        )
        self._data.qpos[at : at + 2] = place
        self._data.qpos[at + 3 : at + 7] = turned
        self._data.qvel[speed : speed + 6] = 0.0

    def _which(self, which: int | Color, colors: list[Color], kind: str) -> int:
        if isinstance(which, Color):
            if which in colors:
                return colors.index(which)
            raise WorldError(f"no {kind} is {which}; there are: {', '.join(colors) or 'none'}", source=self.world.name)
        if not 0 <= which < len(colors):
            raise WorldError(f"there is no {kind} {which}; the world has {len(colors)}", source=self.world.name)
        return which

    def _on_floor(self, to: tuple[float, float]) -> Point:
        width, depth = self.world.arena.size
        if not (0.0 <= to[0] <= width and 0.0 <= to[1] <= depth):
            raise WorldError(
                f"({to[0]:g}, {to[1]:g}) is outside the arena, which goes from (0, 0) to ({width:g}, {depth:g})",
                source=self.world.name,
            )
        return Point(*to)

    def _touched(self) -> None:
        mujoco.mj_forward(self._model, self._data)
        for robot in self._robots.values():
            robot.forget_readings()
