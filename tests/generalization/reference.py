"""Merging one demonstration at a time into a new network each, node by node and pair by pair: the slow, obvious way."""

import math
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from understudy.generalization.inputs import behaviors_of
from understudy.generalization.links import least_restrictive
from understudy.generalization.renaming import free_id, renamed, with_ids
from understudy.generalization.symbols import symbol_of
from understudy.network import (
    END,
    START,
    Component,
    Edge,
    Link,
    LinkType,
    Network,
    Occurrence,
    ParameterValue,
    Topology,
    expand_links,
    reduce_links,
)

__all__ = ["generalize", "typical"]

Row = NDArray[np.int64]
Pair = tuple[str, str]
Values = Mapping[str, float]
_DECIMALS = 3


def generalize(
    task: Network, demonstration: Network, *, names: tuple[str, str] = ("the task", "the demonstration")
) -> Network:
    """Adds a demonstration to a task."""
    known = behaviors_of(task, names[0])
    before = _ways(task, names[0])
    shown, demonstration = renamed(demonstration, before.demonstrations, names[1])
    demonstration = with_ids(demonstration, _matched_ids(before, known, behaviors_of(demonstration, names[1])))
    added = behaviors_of(demonstration, names[1])
    steps = tuple(added)
    order = _order(before.ids, steps)
    ways = Topology(order, _edges(before, order, steps, shown))
    alternatives = bool(task.paths) or not ways.is_chain
    return Network(
        tuple(_component(known.get(id_), added.get(id_)) for id_ in order),
        merged_links(task, demonstration, before, alternatives=alternatives),
        task.inhibitions,
        ways.edges if alternatives else (),
    )


def _matched_ids(ways: Topology, known: Mapping[str, Component], added: Mapping[str, Component]) -> dict[str, str]:
    """For every step of the demonstration the id of the same known step, or a new one."""
    symbols = {id_: symbol_of(component) for id_, component in known.items()}
    word = list(added)
    matches = align(ways, symbols, [symbol_of(component) for component in added.values()])
    ids = {word[match.place]: match.id for match in matches}
    taken = set(known)
    for id_ in word:
        if id_ not in ids:
            ids[id_] = free_id(id_, taken)
            taken.add(ids[id_])
    return ids


def _ways(task: Network, name: str) -> Topology:
    """The ways through the task; a plain one that nobody demonstrated counts as one demonstration."""
    if task.paths or task.demonstrations:
        return task.topology
    return Topology.of_chain(task.topological_order, (name,))


def _order(known: tuple[str, ...], steps: tuple[str, ...]) -> tuple[str, ...]:
    """All steps, each after what comes before it: what is new stands just before the next step that is not."""
    order = list(known)
    new: list[str] = []
    for id_ in (*steps, END):
        if id_ not in known and id_ != END:
            new.append(id_)
            continue
        place = order.index(id_) if id_ != END else len(order)
        order[place:place] = new
        new = []
    return tuple(order)


def _edges(before: Topology, order: tuple[str, ...], steps: tuple[str, ...], shown: tuple[str, ...]) -> list[Edge]:
    """All steps of the ways, in the order of what they join."""
    edges = {(edge.source, edge.target): edge for edge in before.edges}
    for source, target in zip((START, *steps), (*steps, END), strict=True):
        edge = edges.get((source, target), Edge(source=source, target=target))
        edges[source, target] = replace(edge, shown=(*edge.shown, *shown))
    rank = {id_: index for index, id_ in enumerate((START, *order, END))}
    return sorted(edges.values(), key=lambda edge: (rank[edge.source], rank[edge.target]))


def _component(known: Component | None, added: Component | None) -> Component:
    if known is None:
        assert added is not None
        return added
    if added is None:
        return known
    return replace(
        known,
        parameters=merged_parameters(known, added.occurrences),
        occurrences=(*known.occurrences, *added.occurrences),
    )


class Match(NamedTuple):
    """A node of the graph and the place of the same symbol in the word."""

    id: str
    place: int


def align(topology: Topology, symbols: Mapping[str, Hashable], word: Sequence[Hashable]) -> tuple[Match, ...]:
    """The longest common subsequence of a word and any path of a topology.

    Args:
        topology: what is known.
        symbols: of its nodes, by id.
        word: the symbols of the new demonstration.

    Returns:
        The matches from the beginning to the end.
    """
    table = _Table(topology, symbols, word)
    return table.matches()


class _Table:
    """The rows of all nodes, in topological order."""

    def __init__(self, topology: Topology, symbols: Mapping[str, Hashable], word: Sequence[Hashable]) -> None:
        self.topology, self.symbols, self.word = topology, symbols, word
        shown = {id_: len(topology.shown_by[id_]) for id_ in topology.ids}
        # One match more outweighs all support that a common subsequence can have.
        one = 1 + max(shown.values(), default=0) * min(len(word), len(topology.ids))
        self.worth = {id_: one + times for id_, times in shown.items()}
        places: dict[Hashable, list[int]] = {}
        for place, symbol in enumerate(word):
            places.setdefault(symbol, []).append(place)
        self.rows: dict[str, Row] = {START: np.zeros(len(word) + 1, np.int64)}
        for id_ in topology.ids:
            before = self.before(id_)
            row = before.copy()
            if here := places.get(symbols[id_]):
                at = np.array(here)
                row[at + 1] = np.maximum(before[at + 1], before[at] + self.worth[id_])
            self.rows[id_] = np.maximum.accumulate(row)

    def before(self, id_: str) -> Row:
        """The best that any path to a node can do without it."""
        first, *others = (self.rows[one] for one in self.topology.predecessors[id_])
        return np.maximum.reduce([first, *others]) if others else first

    def matches(self) -> tuple[Match, ...]:
        """One best path, read from the end."""
        found: list[Match] = []
        id_, length = self._best(END, len(self.word)), len(self.word)
        while id_ != START and length:
            before = self.before(id_)
            value = self.rows[id_][length]
            if self.word[length - 1] == self.symbols[id_] and before[length - 1] + self.worth[id_] == value:
                found.append(Match(id_, length - 1))
                length -= 1
                id_ = self._best(id_, length)
            elif before[length] == value:
                id_ = self._best(id_, length)
            else:
                length -= 1
        return tuple(reversed(found))

    def _best(self, id_: str, length: int) -> str:
        """The predecessor that has come farthest; the first of equally good ones."""
        return max(self.topology.predecessors[id_], key=lambda one: int(self.rows[one][length]))


def merged_links(known: Network, added: Network, before: Topology, *, alternatives: bool) -> tuple[Link, ...]:
    """The links of a generalised task.

    Args:
        known: the task.
        added: the new demonstration's network, in which the steps that were matched have the task's ids.
        before: the ways through the task, without the new demonstration.
        alternatives: there is more than one way now.
    """
    if not alternatives:
        return _of_one_way(known, added)
    stored = {_pair(link): link for link in known.links}
    new = {_pair(link): link for link in added.links}
    in_known, in_added = _type_of(known, before), _type_of(added, None)
    links = []
    for pair in dict.fromkeys((*stored, *new)):
        if not all(id_ in added.by_id for id_ in pair):
            type_ = in_known(pair)
        elif pair in stored or _shown_together(before, pair):
            type_ = least_restrictive(in_known(pair), in_added(pair))
        else:
            type_ = in_added(pair)
        if type_ is not None and type_ is not LinkType.ORDERING:
            links.append(_link(pair, type_, stored.get(pair), new.get(pair)))
    return tuple(links)


def _of_one_way(known: Network, added: Network) -> tuple[Link, ...]:
    """All show the same steps: every pair is in all of them."""
    old = {_pair(link): link for link in expand_links(known).links}
    new = {_pair(link): link for link in expand_links(added).links}
    links = []
    for pair, link in old.items():
        type_ = least_restrictive(link.type, new[pair].type if pair in new else None)
        if type_ is not None:
            links.append(_link(pair, type_, link, new[pair]))
    return reduce_links(replace(known, links=tuple(links))).links


def _shown_together(topology: Topology, pair: Pair) -> bool:
    """Whether some demonstration shows both."""
    first, second = (topology.shown_by.get(id_, ()) for id_ in pair)
    return any(name in second for name in first)


def _type_of(network: Network, topology: Topology | None) -> Callable[[Pair], LinkType | None]:
    """What a network asks of two of its steps: by a link, or by what lies between them; by its ways, if it has some."""
    direct = {_pair(link): link.type for link in network.links}
    leads = topology.leads if topology is not None and network.paths else _leads(network)
    return lambda pair: direct.get(pair) or (LinkType.ORDERING if leads(*pair) else None)


def _leads(network: Network) -> Callable[[str, str], bool]:
    rank = {id_: index for index, id_ in enumerate(network.by_id)}
    after: dict[str, int] = {}
    for id_ in reversed(network.topological_order):
        after[id_] = 0
        for link in network.outgoing[id_]:
            after[id_] |= after[link.target] | 1 << rank[link.target]
    return lambda source, target: bool(after[source] >> rank[target] & 1)


def _link(pair: Pair, type_: LinkType, old: Link | None, new: Link | None) -> Link:
    evidence = (*(old.evidence if old else ()), *(new.evidence if new else ()))
    return Link(source=pair[0], target=pair[1], type=type_, evidence=evidence)


def _pair(link: Link) -> Pair:
    return link.source, link.target


def typical(shown: Sequence[Values]) -> Values:
    """The shown values with the least sum of distances to all others; of equals the last, as in one demonstration.

    Each number is measured by the range over which it was shown, so that metres and degrees weigh alike. One that is
    missing is as far away as can be.
    """
    names = {name for values in shown for name in values}
    span = {}
    for name in names:
        numbers = [values[name] for values in shown if name in values]
        span[name] = max(numbers) - min(numbers)

    def apart(a: Values, b: Values, name: str) -> float:
        if name not in a or name not in b:
            return float(name in a or name in b)
        return abs(a[name] - b[name]) / span[name] if span[name] else 0.0

    best: Values = {}
    least = math.inf
    for values in shown:
        away = sum(apart(values, other, name) for other in shown for name in names)
        if away <= least + 1e-9:
            best, least = values, min(away, least)
    return best


def merged_parameters(component: Component, added: Sequence[Occurrence]) -> Mapping[str, ParameterValue]:
    """The parameters of a step after more occurrences of it.

    Numbers that are not those of its occurrences were written by somebody, who knows better: they stay.

    Args:
        component: as it was.
        added: from the new demonstration.
    """
    numbers = {name: value for name, value in component.parameters.items() if not isinstance(value, str)}
    learned = _rounded(typical([one.values for one in component.occurrences]))
    if numbers.keys() != learned.keys() or any(abs(numbers[name] - learned[name]) > 1e-3 for name in numbers):
        return component.parameters
    now = typical([one.values for one in (*component.occurrences, *added)])
    return {**component.parameters, **_rounded(now)}


def _rounded(values: Values) -> dict[str, float]:
    return {name: round(value, _DECIMALS) for name, value in values.items()}
