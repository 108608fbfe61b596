"""``PickUp(color)``: fetch a small box (§3.5.3.2, A.4)."""

import math
from collections.abc import Mapping
from random import Random

from understudy.behaviors.skill import Action, Actuator, Drive, Head, Instance, Memory, Parameter, Parameters, Skill
from understudy.behaviors.symbols import BOX, Way
from understudy.geometry import wrap_angle
from understudy.perception import Percepts, Thing
from understudy.robot import PIONEER, Color

__all__ = ["PICK_UP", "AbstractPickUp", "PrimitivePickUp"]

COLOR = Parameter(name="color", kind="color")

_BEAM = PIONEER.gripper.x_beam if PIONEER.gripper else 0.0

_DRAW_IN_TICKS = 3
"""Going on once the beam is broken: a box gripped by its near edge lies at the beam's edge, and slides out of it."""

_SETTLE_TICKS = 8
"""Paddles and lift need about this long; 0.8 s."""


class AbstractPickUp:
    """Goal: ``HaveObject = TRUE``, of the given color."""

    name = "PickUp"
    parameters = (COLOR,)
    actuators = frozenset({Actuator.WHEELS, Actuator.GRIPPER})
    maintaining = False
    ways = (
        Way(
            of={"color": BOX},
            goal="holding(color)",
            needs="gripper_empty",
            ends="gripper_empty, near(*), carried(color, *)",  # it drives to the box, wherever that stands
        ),
    )

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

    def holding(self, parameters: Parameters) -> str:
        return f"the {parameters['color']} box is in the gripper"

    def possible(self, parameters: Parameters) -> str:
        return f"the {parameters['color']} box is in sight or remembered"


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

    lowering_distance = 0.50
    """Up to here; nearer, the paddles' tips are above the box."""

    fresh_s = 2.0
    """A box seen this short a time ago is preferred to nearer ones that are only remembered."""

    patience_s = 6.0
    """Without coming nearer to the box for so long, the robot drives away and comes again another way."""

    withdraw_distance = 0.95
    """From here the box can be seen and approached anew."""

    back_ticks = 30
    leave_ticks = 60
    stray_ticks = 30
    release_ticks = (8, 45, 60)
    """Opening; then straight back until the camera sees what was let go; then turning away."""

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        gripper = percepts.gripper
        box = self._chosen(percepts, parameters["color"])
        if gripper is None:
            return Action(drive=Drive()), {}
        if box is None and not gripper.blocked:
            # Lost from view, most likely too near to be seen: from farther off it can be.
            return Action(drive=Drive(linear=-0.12)), {}
        phase, ticks = memory.get("phase", "approach"), memory.get("ticks", 0) + 1
        if phase == "release":
            return self._release(ticks)
        if gripper.blocked and phase != "close":
            phase, ticks = "close", 1 if gripper.open else _DRAW_IN_TICKS + 1
        if phase == "close":
            if ticks > _DRAW_IN_TICKS + _SETTLE_TICKS and gripper.holding and gripper.color != parameters["color"]:
                return self._release(1)  # another box got in between
            return self._close(gripper.blocked, ticks)
        assert box is not None
        ready = gripper.open and not gripper.raised
        if phase == "approach":
            memory = self._watch_progress(percepts.time_s, box, memory)
            if percepts.time_s - memory["since_s"] > self.patience_s:
                # What it is far enough from already is held up on the way to the box, not at it.
                far = box.position.distance > self.withdraw_distance
                memory, phase, ticks = (self._anywhere(percepts, random), "stray", 1) if far else (memory, "leave", 1)
            elif self._out_of_reach(box, ready=ready):
                phase, ticks = "back", 1
            else:
                return self._approach(box, ready=ready), memory
        return self._withdraw(percepts, box, {**memory, "phase": phase, "ticks": ticks}, random)

    @staticmethod
    def _watch_progress(time_s: float, box: Thing, memory: Memory) -> Memory:
        left = box.position.distance + 0.3 * abs(box.bearing)
        if left < memory.get("nearest", math.inf) - 0.03:
            return memory | {"nearest": left, "since_s": time_s}
        return memory

    def _chosen(self, percepts: Percepts, color: Color) -> Thing | None:
        same = [box for box in percepts.boxes if box.color == color]
        fresh = [box for box in same if percepts.time_s - box.seen_s <= self.fresh_s]
        return next(iter(fresh or same), None)

    def _out_of_reach(self, box: Thing, *, ready: bool) -> bool:
        """The box is beside or under the paddles: turning, or lowering them, would push it away or press on it."""
        away = box.position.distance
        beside = abs(box.bearing) > math.radians(20) and away < 0.65
        return beside or away < _BEAM - 0.05 or (not ready and away < self.lowering_distance)

    def _approach(self, box: Thing, *, ready: bool) -> Action:
        away, bearing = box.position.distance, box.bearing
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
        return Action(
            drive=drive,
            paddles="open" if near else None,
            lift="down" if near else None,
            aim=box.position,
            aim_radius=box.radius,
        )

    @staticmethod
    def _close(blocked: bool, ticks: int) -> tuple[Action, Memory]:
        if not blocked:  # it slipped out
            return Action(drive=Drive(), paddles="open", lift="down"), {"phase": "back", "ticks": 0}
        if ticks <= _DRAW_IN_TICKS:
            return Action(drive=Drive(linear=0.12), paddles="open", keep_on=True), {"phase": "close", "ticks": ticks}
        ticks_closed = ticks - _DRAW_IN_TICKS
        lifting = ticks_closed > _SETTLE_TICKS
        action = Action(
            drive=Drive(),
            paddles="close",
            lift="up" if lifting else None,
            # Do not interrupt me before it is lifted (§3.2.2): the goal is true as soon as the paddles are closed.
            keep_on=ticks_closed < 2 * _SETTLE_TICKS,
        )
        return action, {"phase": "close", "ticks": ticks}

    def _release(self, ticks: int) -> tuple[Action, Memory]:
        opened, clear, turned = self.release_ticks
        drive = Drive()
        if ticks > opened:
            drive = Drive(linear=-0.15, angular=0.6 if ticks > clear else 0.0)
        action = Action(drive=drive, paddles="open", lift="down")
        return action, {"phase": "release", "ticks": ticks} if ticks < turned else {"phase": "approach"}

    def _withdraw(self, percepts: Percepts, box: Thing, memory: Memory, random: Random) -> tuple[Action, Memory]:
        """Away from a box that cannot be taken from here: backwards, else forwards, else anywhere."""
        phase, ticks = memory["phase"], memory["ticks"]
        heading, away = percepts.odometry.pose.heading, box.position.distance
        drive: Drive | Head
        if phase == "back" and (ticks > self.back_ticks or abs(box.bearing) > math.radians(60)):
            phase, ticks = "leave", 1
        if phase == "leave" and ticks > self.leave_ticks:
            memory, phase, ticks = self._anywhere(percepts, random), "stray", 1
        if phase == "back":
            drive = Drive(linear=-0.15)
        elif phase == "leave":
            drive = Head(bearing=wrap_angle(box.bearing + math.pi), speed=0.3)
        else:
            drive = Head(bearing=wrap_angle(memory["toward"] - heading), speed=0.3)
        done = ticks > self.stray_ticks if phase == "stray" else away > self.withdraw_distance
        return Action(drive=drive), {"phase": "approach"} if done else {**memory, "phase": phase, "ticks": ticks}

    @staticmethod
    def _anywhere(percepts: Percepts, random: Random) -> Memory:
        """A direction by chance: what held the robot up is not where it was, seen from elsewhere."""
        return {"toward": wrap_angle(percepts.odometry.pose.heading + random.uniform(-2.5, 2.5))}


PICK_UP = Skill(AbstractPickUp(), PrimitivePickUp())
