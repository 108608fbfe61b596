"""What a new demonstration changed in a task."""

from dataclasses import dataclass
from itertools import pairwise

from understudy.network import END, START, LinkType, Network, Topology

__all__ = ["Branch", "Difference", "Relaxed", "difference_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Branch:
    """Where the new demonstration went another way than all before.

    Attributes:
        after: the last step that was the same, or START.
        before: the next step that was the same, or END.
        steps: what it did in between; nothing, if it went on directly.
        instead: all that the earlier ones did there.
    """

    after: str
    before: str
    steps: tuple[str, ...]
    instead: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Relaxed:
    """A condition that one demonstration kept and another one did not (Figure 5.6)."""

    source: str
    target: str
    was: LinkType
    now: LinkType | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """All that a demonstration changed.

    Attributes:
        demonstrations: that were added.
        merged: the steps that it shares with the task.
        added: the steps that are new.
        branches: where it went another way.
        bypassed: the steps that are never done any more since then, or never come to be.
        relaxed: the links that became less restrictive, the task's or its own.
        changed: the steps whose numbers became others.
    """

    demonstrations: tuple[str, ...]
    merged: tuple[str, ...]
    added: tuple[str, ...]
    branches: tuple[Branch, ...]
    bypassed: tuple[str, ...]
    relaxed: tuple[Relaxed, ...]
    changed: tuple[str, ...]


def difference_of(
    known: Network, added: Network, result: Network, before: Topology, demonstrations: tuple[str, ...]
) -> Difference:
    """What became of a task.

    Args:
        known: the task.
        added: the new demonstration's network, in which the steps that were matched have the task's ids.
        result: both together.
        before: the ways through the task.
        demonstrations: the names of what was added.
    """
    word = [id_ for id_ in result.topology.ids if id_ in added.by_id]
    known_edges = {(edge.source, edge.target) for edge in before.edges}
    stops = [START, *(id_ for id_ in word if id_ in known.by_id), END]
    places = {START: -1, **{id_: place for place, id_ in enumerate(word)}, END: len(word)}
    branches = []
    for first, last in pairwise(stops):
        steps = tuple(word[places[first] + 1 : places[last]])
        if steps or (first, last) not in known_edges:
            instead = tuple(id_ for id_ in before.ids if before.leads(first, id_) and before.leads(id_, last))
            branches.append(Branch(after=first, before=last, steps=steps, instead=instead))
    now = {(link.source, link.target): link.type for link in result.links}
    relaxed = []
    for link in (*known.links, *added.links):
        type_ = now.get((link.source, link.target), LinkType.ORDERING if result.paths else None)
        if type_ is None or type_.strength < link.type.strength:
            found = Relaxed(source=link.source, target=link.target, was=link.type, now=type_)
            relaxed += [found] if found not in relaxed else []
    return Difference(
        demonstrations=demonstrations,
        merged=tuple(id_ for id_ in word if id_ in known.by_id),
        added=tuple(id_ for id_ in word if id_ not in known.by_id),
        branches=tuple(branches),
        bypassed=tuple(id_ for id_ in result.topology.bypassed if id_ not in before.bypassed),
        relaxed=tuple(relaxed),
        changed=tuple(id_ for id_, part in known.by_id.items() if part.parameters != result.by_id[id_].parameters),  # type: ignore[union-attr]  # behaviors alone
    )
