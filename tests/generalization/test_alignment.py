"""Alignment against all paths, one by one."""

from collections.abc import Sequence
from functools import cache
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from understudy.generalization import align
from understudy.network import END, START, Edge, Topology

from .words import learned, paths_of, symbols_of, tasks, walks

LETTERS = "ABC"


def common(one: Sequence[str], other: Sequence[str], worth: Sequence[tuple[int, int]]) -> tuple[int, int]:
    """The best common subsequence of two words by definition: the longest, and then that of the greatest support."""

    @cache
    def best(i: int, j: int) -> tuple[int, int]:
        if i == len(one) or j == len(other):
            return 0, 0
        found = [best(i + 1, j), best(i, j + 1)]
        if one[i] == other[j]:
            length, support = best(i + 1, j + 1)
            found.append((length + worth[i][0], support + worth[i][1]))
        return max(found)

    return best(0, 0)


@st.composite
def graphs(draw: st.DrawFn) -> tuple[Topology, dict[str, str]]:
    """Any graph with one START and one END, and how often its ways were shown."""
    count = draw(st.integers(1, 6))
    ids = [f"n{index}" for index in range(count)]
    symbols = {id_: draw(st.sampled_from(LETTERS)) for id_ in ids}
    all_ids = [START, *ids, END]
    edges = set()
    for index, id_ in enumerate(ids, start=1):
        edges.add((draw(st.sampled_from(all_ids[:index])), id_))
        edges.add((id_, draw(st.sampled_from(all_ids[index + 1 :]))))
    extra = st.tuples(st.integers(0, count), st.integers(1, count + 1)).filter(lambda pair: pair[0] < pair[1])
    for first, last in draw(st.lists(extra, max_size=5)):
        if (first, last) != (0, count + 1):
            edges.add((all_ids[first], all_ids[last]))
    shown = st.lists(st.sampled_from(("d1", "d2", "d3")), unique=True).map(lambda names: tuple(sorted(names)))
    return Topology(ids, [Edge(source=a, target=b, shown=draw(shown)) for a, b in sorted(edges)]), symbols


@given(graphs(), st.lists(st.sampled_from(LETTERS), max_size=6))
def test_no_path_does_better(graph: tuple[Topology, dict[str, str]], word: list[str]) -> None:
    topology, symbols = graph
    matches = align(topology, symbols, word)
    expected = max(
        common([symbols[id_] for id_ in path], word, [(1, len(topology.shown_by[id_])) for id_ in path])
        for path in paths_of(topology)
    )
    assert (len(matches), sum(len(topology.shown_by[match.id]) for match in matches)) == expected


@given(graphs(), st.lists(st.sampled_from(LETTERS), max_size=6))
def test_what_is_matched_is_a_common_subsequence(graph: tuple[Topology, dict[str, str]], word: list[str]) -> None:
    topology, symbols = graph
    matches = align(topology, symbols, word)
    assert all(symbols[match.id] == word[match.place] for match in matches)
    assert all(first.place < last.place and topology.leads(first.id, last.id) for first, last in pairwise(matches))
    assert align(topology, symbols, word) == matches


@given(walks(max_words=3))
def test_a_word_of_the_task_matches_from_end_to_end(words: list[str]) -> None:
    *_, task = tasks(*words)
    for word in words:
        assert len(align(task.topology, symbols_of(task), word.split())) == len(word.split())


def test_of_equally_long_ones_the_one_that_was_shown_more_often() -> None:
    *_, task = tasks("R L P", "R P", "R P")
    assert [match.id for match in align(task.topology, symbols_of(task), ["R", "P", "L"])] == ["R-1", "P-1"]
    assert [match.id for match in align(task.topology, symbols_of(task), ["L", "R"])] == ["R-1"]


def test_of_equals_the_last_one_of_the_word() -> None:
    task = learned("d1", "A B")
    assert align(task.topology, symbols_of(task), ["A", "A", "B"]) == (("A-1", 1), ("B-1", 2))
    assert align(task.topology, symbols_of(task), ["B", "A"]) == (("A-1", 1),)


class Counted(dict[str, tuple[str, ...]]):
    """Counts how often a node's predecessors are looked at, all of them together."""

    looked = 0

    def __getitem__(self, id_: str) -> tuple[str, ...]:
        found = super().__getitem__(id_)
        self.looked += len(found)
        return found


def ladder(rungs: int) -> tuple[Topology, dict[str, str]]:
    """Rungs with two steps each to choose from, and so with 2 to the power of the rungs paths."""
    ids = [f"{side}{rung}" for rung in range(rungs) for side in "lr"]
    edges = [(START, "l0"), (START, "r0"), (f"l{rungs - 1}", END), (f"r{rungs - 1}", END)]
    edges += [(f"{a}{rung}", f"{b}{rung + 1}") for rung in range(rungs - 1) for a in "lr" for b in "lr"]
    return Topology(ids, [Edge(source=a, target=b) for a, b in edges]), {id_: id_[0] for id_ in ids}


def test_the_cost_grows_with_the_graph_and_not_with_its_paths() -> None:
    looked = {}
    for rungs in (10, 20, 40):
        topology, symbols = ladder(rungs)
        topology.predecessors = counted = Counted(topology.predecessors)
        assert len(align(topology, symbols, ["l"] * rungs)) == rungs
        looked[rungs] = counted.looked
        assert counted.looked <= 4 * len(topology.edges)
    assert looked[40] - looked[20] == 2 * (looked[20] - looked[10])
