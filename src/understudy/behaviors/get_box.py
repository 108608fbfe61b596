"""``GetBox(color)``: have a box between the paddles, on the floor, so that it can be pushed (§3.5.2.2)."""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace
from random import Random

import numpy as np
from numpy.typing import NDArray

from understudy.behaviors.pick_up import PrimitivePickUp
from understudy.behaviors.rooms import in_this_room, near_leaf
from understudy.behaviors.skill import Action, Actuator, Drive, Head, Instance, Memory, Parameter, Parameters, Skill
from understudy.behaviors.stand import stand_at
from understudy.geometry import wrap_angle
from understudy.perception import Percepts, Thing
from understudy.robot import PIONEER

__all__ = ["GET_BOX", "AbstractGetBox", "PrimitiveGetBox"]

_HALF_WAY_M = PIONEER.width / 2 + 0.07
_SIDES = np.radians(np.arange(0, 360, 10))
_Choose = Callable[[list[tuple[float, float]]], tuple[float, float]]

COLOR = Parameter(name="color", kind="color")


class AbstractGetBox:
    """Goal: ``HaveBox = True``, of the given color. A box beyond a door is out of reach."""

    name = "GetBox"
    parameters = (COLOR,)
    actuators = frozenset({Actuator.WHEELS, Actuator.GRIPPER})
    maintaining = False

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        return percepts.gripper is not None and percepts.gripper.pushing == parameters["color"]

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        if percepts.gripper is None:
            return False
        color = parameters["color"]
        return percepts.gripper.blocked or any(
            box.color == color and in_this_room(percepts, box.position) for box in percepts.boxes
        )

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        # Where there are no rooms to push it from and to, nobody means the pushing.
        if not percepts.doorways or percepts.gripper is None or percepts.gripper.pushing is None:
            return {}
        return {Instance(self.name, (("color", str(percepts.gripper.pushing)),)): {}}

    def describe(self, parameters: Parameters) -> str:
        return f"get the {parameters['color']} box, to push it"

    def holding(self, parameters: Parameters) -> str:
        return f"the {parameters['color']} box is between the paddles, to be pushed"

    def possible(self, parameters: Parameters) -> str:
        return f"the {parameters['color']} box is in sight or remembered in this room"


class PrimitiveGetBox:
    """Takes the box in between the open paddles as ``PickUp`` does, and leaves them open.

    A leaf that stands before the box would push it along. So the robot comes to it from another side, if there is one;
    and so it does, from any, when it does not get at the box.
    """

    speed = 0.30
    draw_in_speed = 0.12
    patience_ticks = 20
    """What stands between the paddles for so long, and is not known to be the box, is another one."""

    near_m = 1.0
    """As near to the box as this the robot looks whether its way is free."""

    around_m = 0.95
    """So far from the box is the place on another side of it to which the robot goes."""

    around_s = 15.0
    """Longer than this it does not try to get there."""

    def __init__(self) -> None:
        self._fetch = PrimitivePickUp()

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        gripper = percepts.gripper
        if gripper is not None and gripper.blocked and memory.get("phase") != "release":
            ticks = memory.get("let_in", 0) + 1
            if ticks > self.patience_ticks:
                memory = {"phase": "release", "ticks": 0}
            else:
                drive = Drive(linear=self.draw_in_speed)
                return Action(drive=drive, paddles="open", lift="down"), {"let_in": ticks}
        boxes = [box for box in percepts.boxes if in_this_room(percepts, box.position)]
        box = next((box for box in boxes if box.color == parameters["color"]), None)
        if box is not None and memory.get("phase", "approach") == "approach" and "straight_on" not in memory:
            here = np.array([wrap_angle(box.bearing + math.pi)])
            if box.distance_m < self.near_m and _barred(percepts, box, here, box.distance_m)[0]:
                memory = self._begin_around(percepts, box, memory, min)
        if box is not None and memory.get("phase") == "around":
            side = wrap_angle(memory["side"] - percepts.odometry.pose.heading)
            stand = stand_at(side, box.position, self.around_m, 0.0, 0.0).place
            if stand.distance > 0.2 and percepts.time_s - memory["since_s"] < self.around_s:
                return Action(drive=Head(bearing=stand.bearing, speed=self.speed)), memory
            memory = {"straight_on": True}
        before = memory.get("phase")
        action, memory = self._fetch.step(replace(percepts, boxes=boxes), parameters, memory, random)
        if box is not None and memory.get("phase") == "leave" != before:
            memory = self._begin_around(percepts, box, memory, random.choice)
        return replace(action, pushing=near_leaf(percepts)), memory

    def _begin_around(self, percepts: Percepts, box: Thing, memory: Memory, choose: _Choose) -> Memory:
        """To another side of the box, from which nothing stands before it; memory as it is where there is none."""
        free = _SIDES[~_barred(percepts, box, _SIDES, self.around_m + PIONEER.length / 2)]
        stands = [(stand_at(side, box.position, self.around_m, 0.0, 0.0).place, side) for side in free.tolist()]
        ways = [(place.distance, side) for place, side in stands if in_this_room(percepts, place)]
        if not ways:
            return memory
        side = wrap_angle(choose(ways)[1] + percepts.odometry.pose.heading)
        return {"phase": "around", "side": side, "since_s": percepts.time_s}


def _barred(percepts: Percepts, box: Thing, sides: NDArray[np.float64], reach: float) -> NDArray[np.bool_]:
    """For each side of a box, as directions in the robot's frame, whether anything tall stands there within reach."""
    x, y = percepts.obstacles[:, 0] - box.position.x, percepts.obstacles[:, 1] - box.position.y
    c, s = np.cos(sides)[:, None], np.sin(sides)[:, None]
    away, aside = c * x + s * y, c * y - s * x
    barred: NDArray[np.bool_] = (away > 0) & (away < reach) & (np.abs(aside) < _HALF_WAY_M)
    found: NDArray[np.bool_] = np.logical_or.reduce(barred, axis=1)
    return found


GET_BOX = Skill(AbstractGetBox(), PrimitiveGetBox())
