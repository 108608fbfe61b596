"""One more demonstration of a known task (§5.1): what is common to both becomes one, the rest becomes alternatives."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from understudy.generalization.alignment import align
from understudy.generalization.difference import Difference, difference_of
from understudy.generalization.inputs import behaviors_of, check_demonstration
from understudy.generalization.links import merged_links
from understudy.generalization.renaming import free_id, renamed, with_ids
from understudy.generalization.symbols import symbol_of
from understudy.generalization.values import merged_parameters
from understudy.network import END, START, Component, Edge, Network, Topology

__all__ = ["Generalized", "generalize"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Generalized:
    """A task after one more demonstration, and what that changed."""

    network: Network
    difference: Difference


def generalize(
    task: Network, demonstration: Network, *, names: tuple[str, str] = ("the task", "the demonstration")
) -> Generalized:
    """Adds a demonstration to a task.

    Every demonstration given so far is a way from START to END of the result. Where all show the same steps, it is a
    plain network again. Steps are the same if they lie on the longest common subsequence (:mod:`.alignment`).

    Args:
        task: learned from one demonstration, or generalised over several.
        demonstration: the network that was learned from one more.
        names: of both, for the evidence; used for what has no evidence of its own, such as a task that was written.

    Raises:
        LearningError: one of them holds more than steps and links, or the demonstration has alternatives itself.
    """
    known = behaviors_of(task, names[0])
    check_demonstration(demonstration, names[1])
    before = _ways(task, names[0])
    shown, demonstration = renamed(demonstration, before.demonstrations, names[1])
    demonstration = with_ids(demonstration, _matched_ids(before, known, behaviors_of(demonstration, names[1])))
    added = behaviors_of(demonstration, names[1])
    steps = tuple(added)
    order = _order(before.ids, steps)
    ways = Topology(order, _edges(before, order, steps, shown))
    alternatives = bool(task.paths) or not ways.is_chain
    result = Network(
        tuple(_component(known.get(id_), added.get(id_)) for id_ in order),
        merged_links(task, demonstration, before, alternatives=alternatives),
        task.inhibitions,
        ways.edges if alternatives else (),
    )
    return Generalized(network=result, difference=difference_of(task, demonstration, result, before, shown))


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
