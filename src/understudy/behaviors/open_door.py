"""``OpenDoor``: push the door open (§3.5.2.2)."""

import math
from collections.abc import Mapping
from dataclasses import replace
from random import Random

from understudy.behaviors.rooms import (
    LEFT_POST,
    PASSABLE_M,
    RIGHT_POST,
    Passage,
    doorway_of,
    leaf_of,
    look_again,
    observed_posts,
    posts_of,
)
from understudy.behaviors.skill import Action, Actuator, Drive, Head, Instance, Memory, Parameters, Skill
from understudy.geometry import Point, wrap_angle
from understudy.perception import Attention, Doorway, Percepts

__all__ = ["OPEN_DOOR", "AbstractOpenDoor", "PrimitiveOpenDoor"]


class AbstractOpenDoor:
    """Goal: ``DoorOpened = True``: there was room to go through when the robot last saw it.

    It cannot be reached with a box in front, which the robot puts aside: ``HaveBox = False``.
    """

    name = "OpenDoor"
    parameters = (LEFT_POST, RIGHT_POST)
    actuators = frozenset({Actuator.WHEELS, Actuator.GRIPPER})
    maintaining = False

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        doorway = doorway_of(percepts, parameters)
        return doorway is not None and doorway.free(PASSABLE_M)

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        return doorway_of(percepts, parameters) is not None

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        free = [door for door in percepts.doorways if door.free(PASSABLE_M)]
        return {Instance(self.name, observed_posts(door)): {} for door in free}

    def describe(self, parameters: Parameters) -> str:
        return "open the door"

    def holding(self, parameters: Parameters) -> str:
        return "the door is open"

    def possible(self, parameters: Parameters) -> str:
        return "the door's posts are in sight or remembered"

    def attention(self, parameters: Parameters) -> Attention:
        return posts_of(parameters)


class PrimitiveOpenDoor:
    """Puts a box aside, lines up before the door, pushes the leaf by driving into the doorway, and comes back.

    As soon as the leaf gives way it keeps to the side of the hinge, which is the one where the leaf still is: so the
    door opens wider. Its memory holds the ``phase``, when that must be over, and ``into`` which room it pushes.
    """

    speed, turn = 0.20, 0.6
    deep_m = 0.75
    """So far beyond the line between the posts the robot's middle pushes."""

    clear_m = 1.0
    """So far before it the robot stops to look whether the door is open."""

    hinge_side_m = 0.20
    look_s = 1.5
    aside = math.radians(100)
    aside_m = 0.45
    """A box is put aside by turning so far, and driving on so far."""

    limits_s: Mapping[str, float] = {"turn": 8.0, "shove": 6.0, "leave": 5.0, "push": 20.0, "back": 20.0}
    """Longer than this no phase may take."""

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        doorway = doorway_of(percepts, parameters)
        assert doorway is not None
        if not memory:
            begin = "turn" if percepts.gripper is not None and percepts.gripper.blocked else "approach"
            memory = _phase(percepts, begin, {"into": "far" if doorway.room == "near" else "near"})
        passage = Passage.into(doorway, memory["into"])
        over = percepts.time_s - memory["since_s"] > self.limits_s.get(memory["phase"], math.inf)
        match memory["phase"]:
            case "turn" | "shove" | "leave":
                return self._put_aside(percepts, passage, memory, over=over)
            case "approach":
                return self._approach(percepts, doorway, passage, memory)
            case "push":
                action, memory = self._push(percepts, doorway, passage, memory, over=over)
                return replace(action, pushing=leaf_of(doorway, shy=False)), memory
            case "back":
                action, memory = self._back(percepts, passage, memory, over=over)
                return replace(action, pushing=leaf_of(doorway, shy=False)), memory
            case _:
                waited = percepts.time_s - memory["since_s"] > self.look_s
                return _stowed(Drive()), _phase(percepts, "approach", memory) if waited else memory

    def _put_aside(self, percepts: Percepts, passage: Passage, memory: Memory, *, over: bool) -> tuple[Action, Memory]:
        """To the side on which there is more room, and away from it again."""
        pose, phase = percepts.odometry.pose, memory["phase"]
        gone = pose.position.distance_to(Point(*memory["from"]))
        if phase == "turn":
            side = memory.get("side") or math.copysign(1.0, _room(percepts, 1.0) - _room(percepts, -1.0))
            memory = {**memory, "side": side}
            left = wrap_angle(side * self.aside - passage.here.heading)
            if abs(left) > math.radians(8) and not over:
                drive = Drive(angular=max(-self.turn, min(self.turn, 1.5 * left)))
                return Action(drive=drive, paddles="open", lift="down"), memory
            phase = "shove"
        elif phase == "shove" and (gone > self.aside_m or over):
            phase = "leave"
        elif phase == "leave" and (gone > self.aside_m or over):
            return _stowed(Drive()), _phase(percepts, "approach", memory)
        if phase != memory["phase"]:
            memory = _phase(percepts, phase, memory)
        drive = Drive(linear=0.2 if phase == "shove" else -0.2)
        return Action(drive=drive, paddles="open", lift="down"), memory

    def _approach(
        self, percepts: Percepts, doorway: Doorway, passage: Passage, memory: Memory
    ) -> tuple[Action, Memory]:
        stand, far = passage.stand, 2 * passage.half_width
        if stand.distance > 0.15 and not (abs(passage.here.y) < 0.10 and 0.8 < -passage.here.x < far):
            speed = min(self.speed + 0.1, 0.10 + 0.6 * stand.distance)
            return _stowed(Head(bearing=stand.bearing, speed=speed)), memory
        look = look_again(percepts, doorway)
        if look is not None:
            return _stowed(look), memory
        if abs(passage.here.heading) > math.radians(6):
            left = wrap_angle(-passage.here.heading)
            return _stowed(Drive(angular=max(-self.turn, min(self.turn, 1.5 * left)))), memory
        return _stowed(Drive()), _phase(percepts, "push", memory)

    def _push(
        self, percepts: Percepts, doorway: Doorway, passage: Passage, memory: Memory, *, over: bool
    ) -> tuple[Action, Memory]:
        offset = memory.get("offset", 0.0)
        if passage.here.x > -0.1 and not offset:
            offset = self.hinge_side_m * _leaf_side(percepts, doorway, passage)
            memory = {**memory, "offset": offset}
        if percepts.teacher is not None:
            return _stowed(Drive()), memory  # somebody is in the way, and must not be pushed
        if passage.here.x >= self.deep_m or over:
            return _stowed(Drive()), _phase(percepts, "back", memory)
        return _stowed(passage.through(offset, self.speed, self.turn)), memory

    def _back(self, percepts: Percepts, passage: Passage, memory: Memory, *, over: bool) -> tuple[Action, Memory]:
        if passage.here.x <= -self.clear_m or over:
            return _stowed(Drive()), _phase(percepts, "look", {**memory, "offset": 0.0})
        return _stowed(passage.backwards(0.0, self.speed)), memory


def _phase(percepts: Percepts, phase: str, memory: Memory) -> Memory:
    place = percepts.odometry.pose.position
    return {**memory, "phase": phase, "since_s": percepts.time_s, "from": [place.x, place.y]}


def _stowed(drive: Drive | Head) -> Action:
    """Driving with the gripper out of the way."""
    return Action(drive=drive, paddles="close", lift="up")


def _room(percepts: Percepts, side: float) -> float:
    """How far it is to what the laser meets at the robot's left (1) or right (-1)."""
    points = percepts.obstacles
    bearings = [math.atan2(y, x) for x, y in points.tolist()]
    ways = [math.hypot(x, y) for (x, y), a in zip(points.tolist(), bearings, strict=True) if 1.2 < side * a < 1.6]
    return min(ways, default=8.0)


def _leaf_side(percepts: Percepts, doorway: Doorway, passage: Passage) -> float:
    """On which side of the passage the leaf is, when it gives way: 1 left, -1 right."""
    met = percepts.obstacles[leaf_of(doorway, shy=False).holds(percepts.obstacles)].tolist()
    places = [passage.frame.to_local(Point(x, y)).y for x, y in met]
    return math.copysign(1.0, sum(places)) if places else 1.0


OPEN_DOOR = Skill(AbstractOpenDoor(), PrimitiveOpenDoor())
