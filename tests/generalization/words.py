"""Demonstrations as words: every letter, or word, is one step."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from hypothesis import strategies as st

from understudy.generalization import generalize
from understudy.network import (
    END,
    START,
    Component,
    Interval,
    Link,
    LinkEvidence,
    LinkType,
    Network,
    Occurrence,
    Topology,
)

__all__ = ["edges_of", "learned", "paths_of", "symbols_of", "tasks", "walks", "without_evidence"]


def learned(name: str, word: str, links: Mapping[tuple[int, int], LinkType] | None = None) -> Network:
    """What is learned from a demonstration: the given links between steps, and ordering links from each to the next."""
    labels = word.split()
    ids = [f"{label}-{labels[: index + 1].count(label)}" for index, label in enumerate(labels)]
    components = tuple(
        Component(
            id=id_,
            behavior=label,
            occurrences=(Occurrence(demonstration=name, interval=Interval(2.0 * index, 2.0 * index + 1.0)),),
        )
        for index, (id_, label) in enumerate(zip(ids, labels, strict=True))
    )
    types = {(index - 1, index): LinkType.ORDERING for index in range(1, len(ids))} | dict(links or {})
    return Network(
        components, tuple(_link(name, components[a], components[b], type_) for (a, b), type_ in types.items())
    )


def _link(name: str, source: Component, target: Component, type_: LinkType) -> Link:
    first, last = source.occurrences[0].interval, target.occurrences[0].interval
    evidence = LinkEvidence(demonstration=name, source=first, target=last, relation="before")
    return Link(source=source.id, target=target.id, type=type_, evidence=(evidence,))


def tasks(*words: str) -> Iterator[Network]:
    """The task after each of the demonstrations d1, d2, …"""
    task: Network | None = None
    for number, word in enumerate(words, start=1):
        demonstration = learned(f"d{number}", word)
        task = demonstration if task is None else generalize(task, demonstration).network
        yield task


def edges_of(network: Network) -> set[str]:
    """The ways through a task, step by step: ``{"START A", "A B", "B END"}``; the first of its kind has no number."""
    short = {id_: id_.removesuffix("-1") for id_ in network.by_id}
    return {
        f"{short.get(edge.source, edge.source)} {short.get(edge.target, edge.target)}"
        for edge in network.topology.edges
    }


def paths_of(topology: Topology, begin: str = START) -> Iterator[tuple[str, ...]]:
    """Every path from START to END, one after the other."""
    for id_ in topology.successors[begin]:
        if id_ == END:
            yield ()
        else:
            yield from ((id_, *rest) for rest in paths_of(topology, id_))


def symbols_of(network: Network) -> dict[str, str]:
    return {part.id: part.behavior for part in network.components if isinstance(part, Component)}


@st.composite
def walks(draw: st.DrawFn, letters: str = "ABC", max_length: int = 5, max_words: int = 4) -> list[str]:
    """The words of several demonstrations."""
    word = st.lists(st.sampled_from(letters), min_size=1, max_size=max_length).map(" ".join)
    return draw(st.lists(word, min_size=1, max_size=max_words))


def without_evidence(network: Network) -> Network:
    return replace(
        network,
        components=tuple(replace(part, occurrences=()) for part in network.components if isinstance(part, Component)),
    )
