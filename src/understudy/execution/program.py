"""A definition made ready to run: ids become numbers, skills are bound, links become rows. No run-time data."""

from collections.abc import Mapping
from dataclasses import dataclass

from understudy.behaviors import Actuator, Parameters, Skill, unknown_skill
from understudy.errors import NetworkError, SkillError
from understudy.network import LinkType, Nab, Network

__all__ = ["Arc", "Node", "Program", "compile_network"]


@dataclass(frozen=True, slots=True)
class Arc:
    """One link: rows of its two nodes, and its type taken apart for the tick."""

    row: int
    source: int
    target: int
    type: LinkType


@dataclass(frozen=True, slots=True)
class Node:
    """One component with its skill and complete parameters."""

    row: int
    id: str
    skill: Skill
    parameters: Parameters
    actuators: tuple[Actuator, ...]
    maintaining: bool


@dataclass(frozen=True, slots=True)
class Program:
    """A compiled network. Rows are in document order, which settles every tie.

    Attributes:
        nodes: one a component.
        rows: of the nodes, by id.
        arcs: one a link.
        incoming, outgoing: for every node, the arcs that end and begin there.
        rivals: for every node, the nodes that it inhibits while it executes.
        sinks: the nodes whose goals are the task's.
        followers: for every node, how many nodes come after it on any path; at least 1.
    """

    network: Network
    nodes: tuple[Node, ...]
    rows: Mapping[str, int]
    arcs: tuple[Arc, ...]
    incoming: tuple[tuple[Arc, ...], ...]
    outgoing: tuple[tuple[Arc, ...], ...]
    rivals: tuple[tuple[int, ...], ...]
    sinks: tuple[int, ...]
    followers: tuple[int, ...]


def compile_network(network: Network, skills: Mapping[str, Skill], *, source: str = "") -> Program:
    """Binds a network to skills.

    Args:
        network: the definition.
        skills: by name.
        source: the document's name, for messages.

    Raises:
        NetworkError: a component names a skill that is not there, or gives it parameters that it does not take.
    """
    nodes = []
    for row, component in enumerate(network.components):
        path = f"components[{row}] ({component.id})"
        if isinstance(component, Nab):
            raise NetworkError("networks in a component's place cannot be executed yet", source=source, path=path)
        try:
            if component.behavior not in skills:
                raise SkillError(unknown_skill(component.behavior, skills))
            skill = skills[component.behavior]
            parameters = skill.complete(component.parameters)
        except SkillError as error:
            raise NetworkError(str(error), source=source, path=path) from None
        abstract = skill.abstract
        actuators = tuple(sorted(abstract.actuators))
        nodes.append(Node(row, component.id, skill, parameters, actuators, abstract.maintaining))
    rows = {node.id: node.row for node in nodes}
    arcs = tuple(Arc(row, rows[link.source], rows[link.target], link.type) for row, link in enumerate(network.links))
    incoming: list[list[Arc]] = [[] for _ in nodes]
    outgoing: list[list[Arc]] = [[] for _ in nodes]
    for arc in arcs:
        incoming[arc.target].append(arc)
        outgoing[arc.source].append(arc)
    rivals: list[list[int]] = [[] for _ in nodes]
    for rival, inhibited in network.inhibitions:
        rivals[rows[rival]].append(rows[inhibited])
    return Program(
        network=network,
        nodes=tuple(nodes),
        rows=rows,
        arcs=arcs,
        incoming=tuple(map(tuple, incoming)),
        outgoing=tuple(map(tuple, outgoing)),
        rivals=tuple(map(tuple, rivals)),
        sinks=tuple(rows[id_] for id_ in network.sinks),
        followers=_followers(network, rows, outgoing),
    )


def _followers(network: Network, rows: Mapping[str, int], outgoing: list[list[Arc]]) -> tuple[int, ...]:
    """The size of each node's transitive closure, by sets of rows written as bits of one number."""
    after = [0] * len(outgoing)
    for id_ in reversed(network.topological_order):
        for arc in outgoing[rows[id_]]:
            after[arc.source] |= after[arc.target] | 1 << arc.target
    return tuple(max(1, bits.bit_count()) for bits in after)
