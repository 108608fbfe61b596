"""``PickUp(color)``: fetch a small box (§3.5.3.2, A.4)."""

import math
from collections.abc import Mapping
from random import Random

from understudy.behaviors.skill import Action, Actuator, Drive, Head, Instance, Memory, Parameter, Parameters, Skill
from understudy.perception import Percepts
from understudy.robot import PIONEER

__all__ = ["PICK_UP", "AbstractPickUp", "PrimitivePickUp"]

COLOR = Parameter(name="color", kind="color")

_BEAM = PIONEER.gripper.x_beam if PIONEER.gripper else 0.0

_SETTLE_TICKS = 8
"""Paddles and lift need about this long; 0.8 s."""


class AbstractPickUp:
    """Goal: ``HaveObject = TRUE``, of the given color."""

    name = "PickUp"
    parameters = (COLOR,)
    actuators = frozenset({Actuator.WHEELS, Actuator.GRIPPER})
    maintaining = False

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        gripper = percepts.gripper
        return gripper is not None and gripper.holding and gripper.color == parameters["color"]

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        gripper = percepts.gripper
        return gripper is not None and (gripper.blocked or percepts.nearest_box(parameters["color"]) is not None)

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        gripper = percepts.gripper
        if gripper is None or not gripper.holding or gripper.color is None:
            return {}
        return {Instance(self.name, (("color", str(gripper.color)),)): {}}

    def describe(self, parameters: Parameters) -> str:
        return f"pick up the {parameters['color']} box"


class PrimitivePickUp:
    """Aligns with the box, drives it in between the open paddles, closes, lifts.

    Its memory holds the ``phase`` and, for the blind last stretch, how many ticks it may still go on.
    """

    speed = 0.35
    align_distance = 0.85
    """From here on, metres to the robot's origin, the box must stand straight ahead before the robot goes on."""

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        phase = memory.get("phase", "approach")
        gripper = percepts.gripper
        if gripper is None:
            return Action(), {}
        if gripper.blocked and phase in ("approach", "enter"):
            phase, memory = "close", {"phase": "close", "ticks": 0}
        if phase == "close":
            return self._close(gripper.blocked, memory)
        if phase == "back":
            return self._back(memory)
        return self._approach(percepts, parameters, memory)

    def _approach(self, percepts: Percepts, parameters: Parameters, memory: Memory) -> tuple[Action, Memory]:
        box = percepts.nearest_box(parameters["color"])
        gripper = percepts.gripper
        if box is None or gripper is None:
            return Action(drive=Drive()), {}
        ready = gripper.open and not gripper.raised
        paddles, lift = "open" if box.position.distance < 1.5 else None, "down" if box.position.distance < 1.5 else None
        away, bearing = box.position.distance, box.bearing
        drive: Drive | Head
        phase = "approach"
        if away > self.align_distance:
            drive = Head(bearing=bearing, speed=min(self.speed, 0.12 + 0.8 * (away - self.align_distance)))
        elif abs(bearing) > math.radians(20) and away < 0.65 or away < _BEAM - 0.05:
            # Beside or under the paddles: turning here would push it away. Back off and try again.
            return self._back({"phase": "back", "ticks": 0})
        elif abs(bearing) > math.radians(4) and away > 0.60:
            drive = Drive(angular=max(-0.8, min(0.8, 1.8 * bearing)))
        elif not ready:
            drive = Drive(angular=max(-0.3, min(0.3, 1.5 * bearing)))
        else:
            phase = "enter"
            drive = Drive(linear=0.12, angular=max(-0.4, min(0.4, 1.5 * bearing)))
        action = Action(
            drive=drive, paddles=paddles, lift=lift, aim=box.position, aim_radius=box.radius  # type: ignore[arg-type]
        )
        return action, {"phase": phase}

    @staticmethod
    def _close(blocked: bool, memory: Memory) -> tuple[Action, Memory]:
        ticks = memory["ticks"] + 1
        if not blocked:  # it slipped out
            return Action(drive=Drive(), paddles="open", lift="down"), {"phase": "back", "ticks": 0}
        if ticks <= _SETTLE_TICKS:
            return Action(drive=Drive(), paddles="close", keep_on=True), {"phase": "close", "ticks": ticks}
        lifted = ticks >= 2 * _SETTLE_TICKS
        return (
            Action(drive=Drive(), paddles="close", lift="up", keep_on=not lifted),
            {"phase": "close", "ticks": ticks},
        )

    @staticmethod
    def _back(memory: Memory) -> tuple[Action, Memory]:
        ticks = memory["ticks"] + 1
        action = Action(drive=Drive(linear=-0.15), paddles="open", lift="down")
        return action, {"phase": "back", "ticks": ticks} if ticks < 30 else {"phase": "approach"}


PICK_UP = Skill(AbstractPickUp(), PrimitivePickUp())
