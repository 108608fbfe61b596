"""``Localize``: find out in which room the robot is (§3.5.2.2)."""

from collections.abc import Mapping
from random import Random

from understudy.behaviors.rooms import HOME, LEFT_POST, OTHER, RIGHT_POST, doorway_of, observed_posts, posts_of, room_of
from understudy.behaviors.skill import Action, Actuator, Instance, Memory, Parameter, Parameters, Skill
from understudy.behaviors.wander import Wander
from understudy.perception import Attention, Percepts

__all__ = ["LOCALIZE", "AbstractLocalize", "PrimitiveLocalize"]

EITHER = "either"
WHICH = Parameter(name="room", kind="word", words=(EITHER, HOME, OTHER), default=EITHER)


class AbstractLocalize:
    """Goal: ``SideRoom(Home) = TRUE`` or ``SideRoom(OtherSide) = TRUE``: whichever it is, or the one that is asked for.

    As a step of a task it is asked for either; as a condition, for the one or the other.
    """

    name = "Localize"
    parameters: tuple[Parameter, ...] = (WHICH, LEFT_POST, RIGHT_POST)
    actuators = frozenset({Actuator.WHEELS})
    maintaining = False

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        doorway = doorway_of(percepts, parameters)
        return doorway is not None and parameters["room"] in (EITHER, room_of(doorway))

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        return True

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        return {Instance(self.name, (("room", EITHER), *observed_posts(door))): {} for door in percepts.doorways}

    def describe(self, parameters: Parameters) -> str:
        room = parameters["room"]
        return "find out in which room you are" if room == EITHER else f"find out that you are in the {room} room"

    def holding(self, parameters: Parameters) -> str:
        room = parameters["room"]
        return "the robot knows in which room it is" if room == EITHER else f"the robot is in the {room} room"

    def possible(self, parameters: Parameters) -> str:
        return "the robot can look around"

    def attention(self, parameters: Parameters) -> Attention:
        return posts_of(parameters)


class PrimitiveLocalize:
    """Wanders around until both posts of the door have been seen."""

    def __init__(self) -> None:
        self._wander = Wander()

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        return self._wander.step(percepts, memory, random)


LOCALIZE = Skill(AbstractLocalize(), PrimitiveLocalize())
