"""Skills that need no robot: they say what can be planned with them, and are never executed."""

from dataclasses import dataclass

from understudy.behaviors import Actuator, Parameter, Skill, Way


@dataclass(frozen=True)
class MadeUp:
    name: str
    ways: tuple[Way, ...] = ()
    parameters: tuple[Parameter, ...] = ()
    actuators: frozenset[Actuator] = frozenset()
    maintaining: bool = False

    def goal(self, percepts, parameters):
        return False

    def precondition(self, percepts, parameters):
        return True

    def observe(self, percepts):
        return {}

    def describe(self, parameters):
        return self.name


@dataclass(frozen=True)
class Mute:
    """A skill of somebody who never heard of planning."""

    name: str
    parameters: tuple[Parameter, ...] = ()
    actuators: frozenset[Actuator] = frozenset()
    maintaining: bool = False
    goal = MadeUp.goal
    precondition = MadeUp.precondition
    observe = MadeUp.observe
    describe = MadeUp.describe


class Still:
    def step(self, percepts, parameters, memory, random):
        raise AssertionError("it is never executed")


def skill(name: str, *ways: Way, colors: tuple[str, ...] = ()) -> Skill:
    parameters = tuple(Parameter(name=color, kind="color") for color in colors)
    return Skill(MadeUp(name, ways, parameters), Still())


def mute(name: str) -> Skill:
    return Skill(Mute(name), Still())
