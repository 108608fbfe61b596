"""The demonstrations that tasks were learned from, one by one, as words of steps."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from understudy.generalization.inputs import behaviors_of, check_shown
from understudy.generalization.renaming import renamed
from understudy.generalization.symbols import Symbol, symbol_of
from understudy.network import Component, Interval, LinkEvidence, LinkType, Network

__all__ = ["Demonstrated", "Step", "demonstrated"]


class Step(NamedTuple):
    """A symbol, and which time it comes in a demonstration: 1 is the first."""

    symbol: Symbol
    time: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Demonstrated:
    """One demonstration.

    Attributes:
        name: no other one is called so.
        steps: in the order in which they were done, as it showed them.
        place: of each in that order.
        links: what it says of two of them, with its evidence; an order that others imply is missing.
    """

    name: str
    steps: Mapping[Step, Component]
    place: Mapping[Step, int]
    links: Mapping[tuple[Step, Step], tuple[LinkType, LinkEvidence | None]]

    def type_of(self, source: Step, target: Step) -> LinkType | None:
        """What the target asks of the source, both of which are shown; None if it came first."""
        found = self.links.get((source, target))
        if found is not None:
            return found[0]
        return LinkType.ORDERING if self.place[source] < self.place[target] else None

    def evidence_of(self, source: Step, target: Step) -> LinkEvidence | None:
        """Why the target comes after the source; None if it does not, or nothing was seen."""
        if not all(step in self.steps for step in (source, target)) or self.type_of(source, target) is None:
            return None
        if (found := self.links.get((source, target))) is not None and found[1] is not None:
            return found[1]
        first, last = (_interval(self.steps[step]) for step in (source, target))
        if first is None or last is None:
            return None
        # Of a pair that no link joins only the order counts.
        relation = "before" if first.end < last.start else "overlaps" if first.end < last.end else "includes"
        return LinkEvidence(demonstration=self.name, source=first, target=last, relation=relation)


def demonstrated(tasks: Sequence[Network], names: Sequence[str]) -> list[Demonstrated]:
    """All demonstrations that some tasks were learned from.

    Args:
        tasks: each from one or from several.
        names: of all of them, for what has no evidence of its own.

    Raises:
        LearningError: a task has more than steps and links.
    """
    found: list[Demonstrated] = []
    for task, name in zip(tasks, names, strict=True):
        check_shown(task, name)
        for called, one in _one_by_one(task, name):
            (new,), network = renamed(one, {other.name for other in found}, called)
            found.append(_of(network, new))
    return found


def _one_by_one(task: Network, name: str) -> Iterator[tuple[str, Network]]:
    """The network of each demonstration of a task: a chain, with the task's links between the steps that it shows."""
    if not task.paths and len(task.demonstrations) <= 1:
        order = task.topological_order
        yield name, Network(tuple(task.by_id[id_] for id_ in order), task.links)
        return
    topology = task.topology
    for called in task.demonstrations:
        parts = [_seen_in(called, part) for part in behaviors_of(task, name).values()]
        if task.paths:
            parts = [part for part in parts if called in topology.shown_by[part.id]]
        else:
            parts = sorted(
                (part for part in parts if part.occurrences), key=lambda part: part.occurrences[0].interval.start
            )
        place = {part.id: index for index, part in enumerate(parts)}
        links = tuple(
            replace(link, evidence=tuple(one for one in link.evidence if one.demonstration == called))
            for link in task.links
            if link.source in place and link.target in place and place[link.source] < place[link.target]
        )
        yield called, Network(tuple(parts), links)


def _seen_in(name: str, part: Component) -> Component:
    return replace(part, occurrences=tuple(one for one in part.occurrences if one.demonstration == name))


def _of(network: Network, name: str) -> Demonstrated:
    times: Counter[Symbol] = Counter()
    steps: dict[Step, Component] = {}
    by_id: dict[str, Step] = {}
    for part in network.components:
        assert isinstance(part, Component)
        symbol = symbol_of(part)
        times[symbol] += 1
        step = Step(symbol, times[symbol])
        steps[step], by_id[part.id] = part, step
    return Demonstrated(
        name=name,
        steps=steps,
        place={step: index for index, step in enumerate(steps)},
        links={
            (by_id[link.source], by_id[link.target]): (link.type, link.evidence[0] if link.evidence else None)
            for link in network.links
        },
    )


def _interval(part: Component) -> Interval | None:
    return part.occurrences[0].interval if part.occurrences else None
