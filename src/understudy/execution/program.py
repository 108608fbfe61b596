"""A definition made ready to run: paths become numbers, skills are bound, links become rows. No run-time data.

The hierarchy is laid flat. Every component at every depth is a node, each NAB before its parts. What holds them
together is the *scope*, one network: the whole task is a scope, and every case of every NAB is one.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import reduce
from operator import or_

from understudy.behaviors import Actuator, Parameters, Skill, unknown_skill
from understudy.errors import NetworkError, SkillError
from understudy.execution.ways import Way, Ways
from understudy.network import (
    Component,
    Condition,
    Holds,
    LinkType,
    Nab,
    Network,
    ParameterValue,
    Possible,
    Repeat,
    Timeout,
    Trigger,
    atoms,
)
from understudy.perception import Attention

__all__ = ["Arc", "Node", "Program", "Route", "Scope", "Sense", "compile_network"]


@dataclass(frozen=True, slots=True)
class Arc:
    """One link: rows of its two nodes, and its type taken apart for the tick."""

    row: int
    source: int
    target: int
    type: LinkType


@dataclass(frozen=True, slots=True)
class Route:
    """One switch of a NAB: from one of its scopes to another."""

    source: int
    target: int
    when: Condition


@dataclass(frozen=True, slots=True)
class Node:
    """One component with its skill and complete parameters.

    Attributes:
        row: its number, in document order, each NAB before its parts.
        id: its path.
        scope: the network in which it stands.
        skill: None for a NAB.
        parameters: complete; empty for a NAB.
        actuators: what it locks; a NAB locks nothing itself.
        maintaining: its goal holds only while it acts.
        scopes: of a NAB, one for each case; empty for an abstract behavior.
        cases: the conditions of those, in the same order.
        routes: the switches between them.
        repeat, until, timeout, trigger: as in the definition.
    """

    row: int
    id: str
    scope: int
    skill: Skill | None
    parameters: Parameters
    actuators: tuple[Actuator, ...] = ()
    maintaining: bool = False
    scopes: tuple[int, ...] = ()
    cases: tuple[Condition | None, ...] = ()
    routes: tuple[Route, ...] = ()
    repeat: Repeat | None = None
    until: Condition | None = None
    timeout: Timeout | None = None
    trigger: Trigger | None = None


@dataclass(frozen=True, slots=True)
class Scope:
    """One network of the hierarchy.

    Attributes:
        number: 0 is the whole task.
        nab: the node in whose place it stands; -1 for the whole task.
        name: of the case.
        ids: rows of its own components by their ids.
        rows: those rows.
        sinks: the rows whose goals are the network's.
        duties: the rows that have a trigger.
        end: one behind the last row of it and all that is inside; it begins at ``rows[0]``.
        ways: through it, where there are alternatives.
    """

    number: int
    nab: int
    name: str
    ids: Mapping[str, int]
    rows: tuple[int, ...]
    sinks: tuple[int, ...]
    duties: tuple[int, ...]
    end: int
    ways: Ways | None = None

    def wanted(self, taken: Way) -> tuple[int, ...]:
        """The rows whose goals the network asks for: its sinks, or what may come next on the way that was taken."""
        return self.sinks if self.ways is None else self.ways.candidates(taken)


Sense = tuple[Skill, Parameters]


@dataclass(frozen=True, slots=True)
class Program:
    """A compiled network. Rows are in document order, which settles every tie.

    Attributes:
        network: the definition.
        nodes: one a component, at every depth.
        rows: of the nodes, by path.
        scopes: the networks, the whole task first.
        arcs: one a link.
        incoming, outgoing: for every node, the arcs that end and begin there.
        watching: of the outgoing ones, those that look at the node's effects: all but ordering links.
        rivals: for every node, the nodes that it inhibits while it executes.
        followers: for every node, how many nodes of its network come after it on any path (duties do not count), at
            least 1, and the same of the NAB in which it stands.
        nabs, untils, timeouts, duties: the rows that have those.
        senses: the skills and parameters that conditions ask for, by the text of what they ask.
    """

    network: Network
    nodes: tuple[Node, ...]
    rows: Mapping[str, int]
    scopes: tuple[Scope, ...]
    arcs: tuple[Arc, ...]
    incoming: tuple[tuple[Arc, ...], ...]
    outgoing: tuple[tuple[Arc, ...], ...]
    watching: tuple[tuple[Arc, ...], ...]
    rivals: tuple[tuple[int, ...], ...]
    followers: tuple[int, ...]
    nabs: tuple[int, ...]
    untils: tuple[int, ...]
    timeouts: tuple[int, ...]
    duties: tuple[int, ...]
    senses: Mapping[str, Sense]

    @property
    def attention(self) -> Attention:
        """The landmarks that the network's skills, and its conditions, need to have watched."""
        used = [(node.skill, node.parameters) for node in self.nodes if node.skill is not None]
        used += self.senses.values()
        return reduce(or_, (skill.attention(parameters) for skill, parameters in used), Attention())

    def ancestors(self, row: int) -> Iterator[int]:
        """The NABs in which a node stands, the innermost first."""
        row = self.scopes[self.nodes[row].scope].nab
        while row >= 0:
            yield row
            row = self.scopes[self.nodes[row].scope].nab


def compile_network(network: Network, skills: Mapping[str, Skill], *, source: str = "") -> Program:
    """Binds a network to skills.

    Args:
        network: the definition.
        skills: by name.
        source: the document's name, for messages.

    Raises:
        NetworkError: a component or a condition names a skill that is not there, or gives it parameters that it does
            not take.
    """
    compiler = _Compiler(skills, source)
    compiler.scope(network, nab=-1, name="", path="", at="", above=0)
    return compiler.program(network)


class _Compiler:
    """Collects nodes, arcs and scopes, depth first."""

    def __init__(self, skills: Mapping[str, Skill], source: str) -> None:
        self.skills, self.source = skills, source
        self.nodes: list[Node | None] = []
        self.scopes: list[Scope | None] = []
        self.links: list[tuple[int, int, LinkType]] = []
        self.rivals: dict[int, list[int]] = {}
        self.followers: list[int] = []
        self.senses: dict[str, Sense] = {}

    def scope(self, network: Network, *, nab: int, name: str, path: str, at: str, above: int) -> int:
        """Adds a network with all that is inside.

        Args:
            network: to be added.
            nab: the row in whose place it stands.
            name: of the case.
            path: of its components begins with this.
            at: where it stands in the document, for messages.
            above: the followers of its NAB.
        """
        number = len(self.scopes)
        self.scopes.append(None)
        after = _followers(network)
        ids: dict[str, int] = {}
        for index, component in enumerate(network.components):
            place = f"{at}components[{index}]"
            self.followers.append(after[component.id] + above)
            ids[component.id] = self._add(component, number, path, place)
        self.links += [(ids[link.source], ids[link.target], link.type) for link in network.links]
        for rival, inhibited in network.inhibitions:
            self.rivals.setdefault(ids[rival], []).append(ids[inhibited])
        self.scopes[number] = Scope(
            number=number,
            nab=nab,
            name=name,
            ids=ids,
            rows=tuple(ids.values()),
            sinks=tuple(ids[id_] for id_ in network.sinks),
            duties=tuple(ids[part.id] for part in network.components if part.trigger is not None),
            end=len(self.nodes),
            ways=Ways.of(network.topology, ids) if network.paths else None,
        )
        return number

    def _add(self, component: Component | Nab, scope: int, path: str, place: str) -> int:
        row = len(self.nodes)
        self.nodes.append(None)
        id_ = f"{path}{component.id}"
        where = f"{place} ({component.id})"
        for condition in (component.until, component.trigger.on if component.trigger else None):
            self._ask(condition, where)
        if isinstance(component, Component):
            skill, parameters = self._bound(component.behavior, component.parameters, where)
            abstract = skill.abstract
            self.nodes[row] = Node(
                row,
                id_,
                scope,
                skill,
                parameters,
                actuators=tuple(sorted(abstract.actuators)),
                maintaining=abstract.maintaining,
                until=component.until,
                timeout=component.timeout,
                trigger=component.trigger,
            )
            return row
        scopes = {}
        for index, case in enumerate(component.cases):
            self._ask(case.when, where)
            inside = f"{place}.network." if len(component.cases) == 1 else f"{place}.cases[{index}].network."
            below = "/".join(filter(None, (id_, case.name))) + "/"
            scopes[case.name] = self.scope(
                case.network, nab=row, name=case.name, path=below, at=inside, above=self.followers[row]
            )
        for switch in component.switches:
            self._ask(switch.when, where)
        self._ask(component.repeat.until if component.repeat else None, where)
        self.nodes[row] = Node(
            row,
            id_,
            scope,
            None,
            {},
            scopes=tuple(scopes.values()),
            cases=tuple(case.when for case in component.cases),
            routes=tuple(
                Route(scopes[switch.source], scopes[switch.target], switch.when) for switch in component.switches
            ),
            repeat=component.repeat,
            until=component.until,
            timeout=component.timeout,
            trigger=component.trigger,
        )
        return row

    def _bound(self, behavior: str, given: Mapping[str, ParameterValue], where: str) -> Sense:
        try:
            if behavior not in self.skills:
                raise SkillError(unknown_skill(behavior, self.skills))
            skill = self.skills[behavior]
            return skill, skill.complete(given)
        except SkillError as error:
            raise NetworkError(str(error), source=self.source, path=where) from None

    def _ask(self, condition: Condition | None, where: str) -> None:
        for atom in atoms(condition) if condition is not None else ():
            if isinstance(atom, Holds | Possible):
                self.senses[str(atom)] = self._bound(atom.behavior, atom.parameters, where)

    def program(self, network: Network) -> Program:
        """All that was collected."""
        nodes = tuple(node for node in self.nodes if node is not None)
        arcs = tuple(Arc(row, *link) for row, link in enumerate(self.links))
        incoming: list[list[Arc]] = [[] for _ in nodes]
        outgoing: list[list[Arc]] = [[] for _ in nodes]
        for arc in arcs:
            incoming[arc.target].append(arc)
            outgoing[arc.source].append(arc)
        return Program(
            network=network,
            nodes=nodes,
            rows={node.id: node.row for node in nodes},
            scopes=tuple(scope for scope in self.scopes if scope is not None),
            arcs=arcs,
            incoming=tuple(map(tuple, incoming)),
            outgoing=tuple(map(tuple, outgoing)),
            watching=tuple(tuple(arc for arc in arcs if arc.type is not LinkType.ORDERING) for arcs in outgoing),
            rivals=tuple(tuple(self.rivals.get(row, ())) for row in range(len(nodes))),
            followers=tuple(self.followers),
            nabs=tuple(node.row for node in nodes if node.scopes),
            untils=tuple(node.row for node in nodes if node.until is not None),
            timeouts=tuple(node.row for node in nodes if node.timeout is not None),
            duties=tuple(node.row for node in nodes if node.trigger is not None),
            senses=self.senses,
        )


def _followers(network: Network) -> Mapping[str, int]:
    """The size of each component's transitive closure without duties, by sets written as bits of one number.

    Where there are alternatives, nobody knows yet what will come after a component: it counts as one.
    """
    if network.paths:
        return dict.fromkeys(network.by_id, 1)
    place = {component.id: index for index, component in enumerate(network.components) if component.trigger is None}
    after = dict.fromkeys(network.by_id, 0)
    for id_ in reversed(network.topological_order):
        for link in network.outgoing[id_]:
            if link.target in place:  # nothing waits for a duty
                after[id_] |= after[link.target] | 1 << place[link.target]
    return {id_: max(1, bits.bit_count()) for id_, bits in after.items()}
