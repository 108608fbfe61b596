"""``GetBox(color)``: have a box between the paddles, on the floor, so that it can be pushed (§3.5.2.2)."""

from collections.abc import Mapping
from dataclasses import replace
from random import Random

from understudy.behaviors.pick_up import PrimitivePickUp
from understudy.behaviors.rooms import in_this_room
from understudy.behaviors.skill import Action, Actuator, Drive, Instance, Memory, Parameter, Parameters, Skill
from understudy.perception import Percepts

__all__ = ["GET_BOX", "AbstractGetBox", "PrimitiveGetBox"]

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
    """Takes the box in between the open paddles as ``PickUp`` does, and leaves them open."""

    draw_in_speed = 0.12
    patience_ticks = 20
    """What stands between the paddles for so long, and is not known to be the box, is another one."""

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
        return self._fetch.step(replace(percepts, boxes=boxes), parameters, memory, random)


GET_BOX = Skill(AbstractGetBox(), PrimitiveGetBox())
