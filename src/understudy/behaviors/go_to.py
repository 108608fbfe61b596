"""``GoTo(place)``: go home, to the beacon, or to the door (§3.5.2.2)."""

import math
from collections.abc import Mapping
from dataclasses import replace
from random import Random

from understudy.behaviors.rooms import (
    BEACON,
    LEFT_POST,
    RIGHT_POST,
    Passage,
    doorway_of,
    near_leaf,
    observed_posts,
    posts_of,
)
from understudy.behaviors.skill import Action, Actuator, Drive, Head, Instance, Memory, Parameter, Parameters, Skill
from understudy.geometry import wrap_angle
from understudy.perception import Attention, Doorway, Percepts, Thing

__all__ = ["GO_TO", "AbstractGoTo", "PrimitiveGoTo"]

DOOR, HOME = "door", "home"
PLACE = Parameter(name="place", kind="word", words=(HOME, DOOR))

_HOME_M = 0.65
"""At home the robot's turning point is so far from the beacon's surface, and a box that it pushes in between."""

_HOME_SLACK_M, _HOME_SLACK = 0.10, math.radians(30)

_LATELY_S = 5.0
"""A beacon that was not seen for so long may be somewhere else."""

_DOOR_SLACK_M, _DOOR_SLACK = 0.25, math.radians(15)


class AbstractGoTo:
    """Goal: ``AtPlace(place) = True``: near the beacon and facing it, or before the door and facing it."""

    name = "GoTo"
    parameters = (PLACE, BEACON, LEFT_POST, RIGHT_POST)
    actuators = frozenset({Actuator.WHEELS})
    maintaining = False

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        if parameters["place"] == HOME:
            beacon = percepts.landmarks.get(parameters["beacon"])
            return beacon is not None and _at_home(percepts, beacon)
        doorway = doorway_of(percepts, parameters)
        return doorway is not None and _before_the_door(doorway)

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        if parameters["place"] == HOME:
            return parameters["beacon"] in percepts.landmarks
        return doorway_of(percepts, parameters) is not None

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        doors = percepts.doorways
        posts = {color for door in doors for color in door.posts}
        beacons = [color for color in percepts.landmarks if doors and color not in posts]
        found = [(DOOR, observed_posts(door)) for door in doors if _before_the_door(door)]
        found += [
            (HOME, ((BEACON.name, str(color)),)) for color in beacons if _at_home(percepts, percepts.landmarks[color])
        ]
        return {Instance(self.name, (("place", place), *which)): {} for place, which in found}

    def describe(self, parameters: Parameters) -> str:
        return "go home" if parameters["place"] == HOME else "go to the door"

    def holding(self, parameters: Parameters) -> str:
        return "the robot is at home" if parameters["place"] == HOME else "the robot is before the door"

    def possible(self, parameters: Parameters) -> str:
        what = "beacon is" if parameters["place"] == HOME else "door's posts are"
        return f"the {what} in sight or remembered"

    def attention(self, parameters: Parameters) -> Attention:
        if parameters["place"] == HOME:
            return Attention(landmarks=frozenset({parameters["beacon"]}))
        return posts_of(parameters)


def _at_home(percepts: Percepts, beacon: Thing) -> bool:
    return (
        beacon.distance_m <= _HOME_M + _HOME_SLACK_M
        and abs(beacon.bearing) <= _HOME_SLACK
        and percepts.time_s - beacon.seen_s <= _LATELY_S
    )


def _before_the_door(doorway: Doorway) -> bool:
    passage = Passage.into(doorway, "far" if doorway.room == "near" else "near")
    return passage.stand.distance <= _DOOR_SLACK_M and abs(passage.here.heading) <= _DOOR_SLACK


class PrimitiveGoTo:
    """Drives there, so gently that what stands between the open paddles stays between them."""

    speed, turn = 0.30, 0.6

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        if parameters["place"] == HOME:
            action: Action = self._home(percepts.landmarks[parameters["beacon"]])
            return replace(action, pushing=near_leaf(percepts)), {}
        doorway = doorway_of(percepts, parameters)
        assert doorway is not None
        action, memory = self._door(doorway, memory)
        return replace(action, pushing=near_leaf(percepts)), memory

    def _home(self, beacon: Thing) -> Action:
        left = beacon.distance_m - _HOME_M
        drive: Drive | Head
        if left > 0.5 * _HOME_SLACK_M:
            speed = min(self.speed, 0.10 + 0.6 * left)
            drive = Head(bearing=beacon.bearing, speed=speed, turn=self.turn)
        else:
            drive = Drive(angular=self._turn(beacon.bearing))
        return Action(drive=drive, aim=beacon.position, aim_radius=beacon.radius)

    def _door(self, doorway: Doorway, memory: Memory) -> tuple[Action, Memory]:
        passage = Passage.into(doorway, "far" if doorway.room == "near" else "near")
        left = passage.stand.distance
        # Once there it turns on the spot, and does not mind being moved a little by that.
        if left <= (0.9 if memory.get("there") else 0.4) * _DOOR_SLACK_M:
            return Action(drive=Drive(angular=self._turn(wrap_angle(passage.frame.heading)))), {"there": True}
        speed = min(self.speed, 0.10 + 0.6 * left)
        return Action(drive=Head(bearing=passage.stand.bearing, speed=speed, turn=self.turn)), {}

    def _turn(self, bearing: float) -> float:
        return max(-self.turn, min(self.turn, 1.5 * bearing))


GO_TO = Skill(AbstractGoTo(), PrimitiveGoTo())
