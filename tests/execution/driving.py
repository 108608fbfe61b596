"""The whole controller, driven through a scenario of the reference: skills that say what its worlds say."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from random import Random

from understudy.behaviors import Action, Actuator, Instance, Memory, Parameter, Parameters, Skill, SkillSet
from understudy.execution import Controller, Decision
from understudy.network import Case, Component, Nab, Network
from understudy.perception import Percepts
from understudy.robot import PIONEER

from .reference import World
from .strategies import SENSES, Scenario

__all__ = ["Driven", "controller_of", "drive", "percepts_of"]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WorldPercepts(Percepts):
    """Percepts that carry a world of the reference, and the next one, which knows who will have continued."""

    world: World
    following: World


class Spoken:
    """A skill of one component: the worlds say everything of it, by its path."""

    parameters: tuple[Parameter, ...] = ()

    def __init__(self, path: str, actuators: frozenset[str], maintaining: bool) -> None:
        self.name = self.path = path
        self.actuators = frozenset(map(Actuator, actuators))
        self.maintaining = maintaining

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        assert isinstance(percepts, WorldPercepts)
        return percepts.world.effects.get(self.path, False)

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        assert isinstance(percepts, WorldPercepts)
        return percepts.world.preconditions.get(self.path, True)

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        return {}

    def describe(self, parameters: Parameters) -> str:
        return self.name

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        assert isinstance(percepts, WorldPercepts)
        keep_on = self.path in percepts.following.continues
        return Action(keep_on=keep_on), {"steps": memory.get("steps", 0) + 1, "drawn": random.random()}


class Sensed(Spoken):
    """A skill that only conditions ask for."""

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        assert isinstance(percepts, WorldPercepts)
        return percepts.world.senses.get(f"{self.name}()", False)

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        assert isinstance(percepts, WorldPercepts)
        return percepts.world.senses.get(f"possible {self.name}()", False)


@dataclass(frozen=True, slots=True)
class Driven:
    """A controller after a scenario, with all that it decided."""

    controller: Controller
    decisions: list[Decision]


def controller_of(scenario: Scenario) -> Controller:
    """A controller whose every component has a skill of its own."""
    skills = [Spoken(path, *scenario.behaviors[c.behavior]) for path, c in _behaviors(scenario.network)]
    senses = [Sensed(name, frozenset(), False) for name in SENSES]
    network = _with_own_behaviors(scenario.network, "")
    return Controller(network, SkillSet(*(Skill(skill, skill) for skill in (*skills, *senses))), PIONEER)


def percepts_of(scenario: Scenario, tick: int) -> WorldPercepts:
    """What the robot perceives in one tick of a scenario."""
    history = scenario.history
    following = history[tick + 1] if tick + 1 < len(history) else World()
    return WorldPercepts(time_s=history[tick].time_s, world=history[tick], following=following)


def drive(scenario: Scenario) -> Driven:
    """Runs a scenario to its end."""
    controller = controller_of(scenario)
    decisions = [
        controller.tick(percepts_of(scenario, tick), world.events) for tick, world in enumerate(scenario.history)
    ]
    return Driven(controller, decisions)


def _behaviors(network: Network) -> list[tuple[str, Component]]:
    return [(path, part) for path, part in network.walk() if isinstance(part, Component)]


def _with_own_behaviors(network: Network, prefix: str) -> Network:
    """Every behavior called by its component's path."""
    components = tuple(
        replace(part, behavior=prefix + part.id)
        if isinstance(part, Component)
        else replace(part, cases=tuple(_case(part, index, prefix) for index in range(len(part.cases))))
        for part in network.components
    )
    return Network(components, network.links, network.inhibitions, network.paths)


def _case(nab: Nab, index: int, prefix: str) -> Case:
    case = nab.cases[index]
    inside = f"{prefix}{nab.id}/{case.name}/" if case.name else f"{prefix}{nab.id}/"
    return replace(case, network=_with_own_behaviors(case.network, inside))
