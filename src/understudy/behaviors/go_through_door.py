"""``GoThroughDoor(room)``: go through the door into a room (§3.5.2.2)."""

from collections.abc import Mapping
from random import Random

from understudy.behaviors.rooms import (
    HOME,
    LEFT_POST,
    OTHER,
    RIGHT_POST,
    ROOM,
    Passage,
    doorway_of,
    leaf_of,
    look_again,
    observed_posts,
    posts_of,
)
from understudy.behaviors.skill import Action, Actuator, Drive, Instance, Memory, Parameters, Skill
from understudy.perception import Attention, Doorway, Percepts

__all__ = ["GO_THROUGH_DOOR", "AbstractGoThroughDoor", "PrimitiveGoThroughDoor"]

_INSIDE_M = 0.95
"""So far beyond the line between the posts the robot is through: the leaf, when it is open, is beside it."""

_LOOK_FROM_M, _LOOK_TO_M = 2.5, 0.6
"""So far before that line the robot makes sure that the door is where it believes it to be."""


class AbstractGoThroughDoor:
    """Goal: ``SideRoom(room) = True``, and well in it."""

    name = "GoThroughDoor"
    parameters = (ROOM, LEFT_POST, RIGHT_POST)
    actuators = frozenset({Actuator.WHEELS})
    maintaining = False

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        doorway = doorway_of(percepts, parameters)
        return doorway is not None and _inside(doorway, parameters["room"])

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        return doorway_of(percepts, parameters) is not None

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        return {
            Instance(self.name, (("room", room), *observed_posts(door))): {}
            for room in (HOME, OTHER)
            for door in percepts.doorways
            if _inside(door, room)
        }

    def describe(self, parameters: Parameters) -> str:
        return f"go through the door into the {parameters['room']} room"

    def holding(self, parameters: Parameters) -> str:
        return f"the robot is well inside the {parameters['room']} room"

    def possible(self, parameters: Parameters) -> str:
        return "the door's posts are in sight or remembered"

    def attention(self, parameters: Parameters) -> Attention:
        return posts_of(parameters)


def _inside(doorway: Doorway, room: str) -> bool:
    x = doorway.here.x
    return (-x if room == HOME else x) >= _INSIDE_M


class PrimitiveGoThroughDoor:
    """Lines up before the door and drives through the middle of what is free, pushing the leaf where it is in the way.

    So gently that what stands between the open paddles stays between them.
    """

    speed, turn = 0.25, 0.6

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        doorway = doorway_of(percepts, parameters)
        assert doorway is not None
        passage = Passage.into(doorway, "near" if parameters["room"] == HOME else "far")
        if percepts.teacher is not None and passage.lined_up:
            return Action(drive=Drive()), {}  # somebody is in the way, and must not be pushed
        look = look_again(percepts, doorway) if -_LOOK_FROM_M < passage.here.x < -_LOOK_TO_M else None
        if look is not None:
            return Action(drive=look, pushing=leaf_of(doorway, shy=True)), {}
        drive = passage.through(passage.line, self.speed, self.turn)
        return Action(drive=drive, pushing=leaf_of(doorway, shy=not passage.lined_up)), {}


GO_THROUGH_DOOR = Skill(AbstractGoThroughDoor(), PrimitiveGoThroughDoor())
