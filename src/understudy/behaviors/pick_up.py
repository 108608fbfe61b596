"""``PickUp(color)``: fetch a small box (§3.5.3.2, A.4)."""

import math
from collections.abc import Mapping
from random import Random

from understudy.behaviors.skill import Action, Actuator, Drive, Head, Instance, Memory, Parameter, Parameters, Skill
from understudy.geometry import wrap_angle
from understudy.perception import Percepts, Thing
from understudy.robot import PIONEER, Color

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

    A box that is too near to be seen is approached from memory. If it is beside or under the paddles the robot first
    backs off, and where it cannot, drives away and comes back: so it also finds out when memory was wrong.

    Its memory holds the ``phase``, and how many ``ticks`` it has been in it.
    """

    speed = 0.35
    align_distance = 0.85
    """From here on, metres to the robot's origin, the box must stand straight ahead before the robot goes on."""

    prepare_distance = 1.5
    """From here on the gripper is lowered and opened."""

    fresh_s = 2.0
    """A box seen this short a time ago is preferred to nearer ones that are only remembered."""

    back_ticks = 30
    leave_ticks = 60
    release_ticks = (8, 22, 40)
    """Opening; then straight back until the paddles' tips are clear; then turning away."""

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        gripper = percepts.gripper
        box = self._chosen(percepts, parameters["color"])
        if gripper is None or (box is None and not gripper.blocked):
            return Action(drive=Drive()), {}
        phase, ticks = memory.get("phase", "approach"), memory.get("ticks", 0) + 1
        if phase == "release":
            return self._release(ticks)
        if gripper.blocked and phase != "close":
            phase, ticks = "close", 1
        if phase == "close":
            if ticks > _SETTLE_TICKS and gripper.holding and gripper.color != parameters["color"]:
                return self._release(1)  # another box got in between
            return self._close(gripper.blocked, ticks)
        assert box is not None
        if phase in ("back", "leave"):
            return self._withdraw(box, phase, ticks)
        return self._approach(box, ready=gripper.open and not gripper.raised)

    def _chosen(self, percepts: Percepts, color: Color) -> Thing | None:
        same = [box for box in percepts.boxes if box.color == color]
        fresh = [box for box in same if percepts.time_s - box.seen_s <= self.fresh_s]
        return next(iter(fresh or same), None)

    def _approach(self, box: Thing, *, ready: bool) -> tuple[Action, Memory]:
        away, bearing = box.position.distance, box.bearing
        beside = abs(bearing) > math.radians(20) and away < 0.65
        if beside or away < _BEAM - 0.05:
            # Turning here would push it away.
            return self._withdraw(box, "back", 1)
        drive: Drive | Head
        if away > self.align_distance:
            drive = Head(bearing=bearing, speed=min(self.speed, 0.12 + 0.8 * (away - self.align_distance)))
        elif abs(bearing) > math.radians(4) and away > 0.60:
            drive = Drive(angular=max(-0.8, min(0.8, 1.8 * bearing)))
        elif not ready:
            drive = Drive(angular=max(-0.3, min(0.3, 1.5 * bearing)))
        else:
            drive = Drive(linear=0.12, angular=max(-0.4, min(0.4, 1.5 * bearing)))
        near = away < self.prepare_distance
        action = Action(
            drive=drive,
            paddles="open" if near else None,
            lift="down" if near else None,
            aim=box.position,
            aim_radius=box.radius,
        )
        return action, {"phase": "approach"}

    @staticmethod
    def _close(blocked: bool, ticks: int) -> tuple[Action, Memory]:
        if not blocked:  # it slipped out
            return Action(drive=Drive(), paddles="open", lift="down"), {"phase": "back"}
        lifting = ticks > _SETTLE_TICKS
        action = Action(
            drive=Drive(),
            paddles="close",
            lift="up" if lifting else None,
            # Do not interrupt me before it is lifted (§3.2.2): the goal is true as soon as the paddles are closed.
            keep_on=ticks < 2 * _SETTLE_TICKS,
        )
        return action, {"phase": "close", "ticks": ticks}

    def _release(self, ticks: int) -> tuple[Action, Memory]:
        opened, clear, turned = self.release_ticks
        drive = Drive()
        if ticks > opened:
            drive = Drive(linear=-0.15, angular=0.6 if ticks > clear else 0.0)
        action = Action(drive=drive, paddles="open", lift="down")
        return action, {"phase": "release", "ticks": ticks} if ticks < turned else {"phase": "approach"}

    def _withdraw(self, box: Thing, phase: str, ticks: int) -> tuple[Action, Memory]:
        drive: Drive | Head = Drive(linear=-0.15)
        if phase == "leave":
            drive = Head(bearing=wrap_angle(box.bearing + math.pi), speed=0.3)
        far_enough = box.position.distance > self.align_distance
        if phase == "back" and ticks >= self.back_ticks:
            phase, ticks = ("approach" if box.position.distance > 0.65 else "leave"), 0
        elif phase == "leave" and (far_enough or ticks >= self.leave_ticks):
            phase, ticks = "approach", 0
        return Action(drive=drive, paddles="open", lift="down"), {"phase": phase, "ticks": ticks}


PICK_UP = Skill(AbstractPickUp(), PrimitivePickUp())
