"""Skills without a robot, for tests of the execution alone."""

from collections.abc import Mapping
from dataclasses import replace
from random import Random

from understudy.behaviors import Action, Actuator, Instance, Memory, Parameter, Parameters, Skill, SkillSet
from understudy.execution import Program, compile_network
from understudy.network import Case, Component, Link, LinkType, Network
from understudy.perception import Percepts

from .reference import Behaviors
from .strategies import SENSES

__all__ = ["Stub", "closed", "compiled", "stub_skill"]


class Stub:
    """Both halves of a skill that the test speaks for: goals and preconditions are handed in from outside."""

    parameters: tuple[Parameter, ...] = ()

    def __init__(self, name: str, actuators: frozenset[str], maintaining: bool) -> None:
        self.name = name
        self.actuators = frozenset(map(Actuator, actuators))
        self.maintaining = maintaining

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        return False

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        return True

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        return {}

    def describe(self, parameters: Parameters) -> str:
        return self.name

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        return Action(), {}


def stub_skill(name: str, actuators: frozenset[str] = frozenset(), maintaining: bool = False) -> Skill:
    stub = Stub(name, actuators, maintaining)
    return Skill(stub, stub)


def compiled(network: Network, behaviors: Behaviors) -> Program:
    """The program of a network whose behaviors are stubs."""
    known = {**dict.fromkeys(SENSES, (frozenset[str](), False)), **behaviors}
    return compile_network(network, SkillSet(*(stub_skill(name, *rest) for name, rest in known.items())))


def closed(network: Network) -> Network:
    """The network with every implied ordering link stored, at every depth (semantics §2)."""
    after: dict[str, set[str]] = {}
    for id_ in reversed(network.topological_order):
        after[id_] = set()
        for link in network.outgoing[id_]:
            after[id_] |= {link.target} | after[link.target]
    linked = {(link.source, link.target) for link in network.links}
    implied = [
        Link(source=source, target=target, type=LinkType.ORDERING)
        for source in network.topological_order
        for target in sorted(after[source])
        if (source, target) not in linked
    ]
    components = tuple(
        part if isinstance(part, Component) else replace(part, cases=tuple(map(_closed_case, part.cases)))
        for part in network.components
    )
    return Network(components, (*network.links, *implied), network.inhibitions, network.paths)


def _closed_case(case: Case) -> Case:
    return replace(case, network=closed(case.network))
