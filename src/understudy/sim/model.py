"""The compiled world: MuJoCo's model, and where in it everything is to be found."""

from dataclasses import dataclass
from enum import Enum
from typing import Any

import mujoco

from understudy.robot import RobotSpec
from understudy.sim.mjcf import mjcf
from understudy.sim.world import World

__all__ = ["ArenaModel", "RobotIndex", "Thing"]


class Thing(Enum):
    """What a geom belongs to."""

    FLOOR = "floor"
    WALL = "wall"
    DOOR = "door"
    TARGET = "target"
    BOX = "box"
    ROBOT = "robot"
    PERSON = "person"


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotIndex:
    """Where one robot's numbers are in MuJoCo's arrays.

    Attributes:
        body: its base, which rays leave out.
        pose: of x, y and heading in ``qpos``; ``speed`` likewise in ``qvel``.
        lift, left, right: of the gripper's joints in ``qpos``; None on a robot without one.
        ctrl: of its servos in ``ctrl``: forward, turn, sideways, and with a gripper paddles and lift.
        geoms: all of its geoms.
    """

    body: int
    pose: slice
    speed: slice
    lift: int | None
    left: int | None
    right: int | None
    ctrl: slice
    geoms: frozenset[int]


@dataclass(frozen=True, slots=True, kw_only=True)
class ArenaModel:
    """A definition only: it holds no state, so several simulations may share one.

    Attributes:
        model: MuJoCo's ``MjModel``.
        robots: in the document's order.
        box_pose: start of each box's position and quaternion in ``qpos``; ``box_speed`` likewise in ``qvel``.
        door_angle: each door's hinge in ``qpos``; ``door_speed`` likewise in ``qvel``.
        target_mocap: each target's row in ``mocap_pos``.
        teacher_mocap: the teacher's row, or None.
        things: for each geom, what it belongs to and which one, as an index into the document's list.
    """

    world: World
    model: Any
    robots: tuple[RobotIndex, ...]
    box_pose: tuple[int, ...]
    box_speed: tuple[int, ...]
    door_angle: tuple[int, ...]
    door_speed: tuple[int, ...]
    target_mocap: tuple[int, ...]
    teacher_mocap: int | None
    things: tuple[tuple[Thing, int], ...]

    @classmethod
    def build(cls, world: World) -> "ArenaModel":
        """Compiles a world."""
        model = mujoco.MjModel.from_xml_string(mjcf(world))
        boxes = [model.joint(f"box{i}") for i in range(len(world.boxes))]
        doors = [model.joint(f"door{i}") for i in range(len(world.doors))]
        targets = [model.body(f"target{i}") for i in range(len(world.targets))]
        return cls(
            world=world,
            model=model,
            robots=tuple(_robot_index(model, i, robot.spec) for i, robot in enumerate(world.robots)),
            box_pose=tuple(int(joint.qposadr[0]) for joint in boxes),
            box_speed=tuple(int(joint.dofadr[0]) for joint in boxes),
            door_angle=tuple(int(joint.qposadr[0]) for joint in doors),
            door_speed=tuple(int(joint.dofadr[0]) for joint in doors),
            target_mocap=tuple(int(body.mocapid[0]) for body in targets),
            teacher_mocap=int(model.body("teacher").mocapid[0]) if world.teacher else None,
            things=tuple(_thing(model.geom(i).name) for i in range(model.ngeom)),
        )


def _thing(name: str) -> tuple[Thing, int]:
    thing = name.partition(" ")[0]  # "robot0 left" is a part of "robot0"
    kind = thing.rstrip("0123456789")
    number = thing[len(kind) :]
    return (Thing.PERSON if kind == "teacher" else Thing(kind)), int(number or 0)


def _robot_index(model: Any, number: int, spec: RobotSpec) -> RobotIndex:
    name = f"robot{number}"
    x = model.joint(f"{name} x")
    position, speed = int(x.qposadr[0]), int(x.dofadr[0])
    ctrl = model.actuator(f"{name} forward").id

    def joint(part: str) -> int | None:
        return None if spec.gripper is None else int(model.joint(f"{name} {part}").qposadr[0])

    return RobotIndex(
        body=model.body(name).id,
        pose=slice(position, position + 3),
        speed=slice(speed, speed + 3),
        lift=joint("lift"),
        left=joint("left"),
        right=joint("right"),
        ctrl=slice(ctrl, ctrl + (3 if spec.gripper is None else 5)),
        geoms=frozenset(i for i in range(model.ngeom) if model.geom(i).name.partition(" ")[0] == name),
    )
