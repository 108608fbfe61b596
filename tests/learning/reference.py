"""The learner once more, slowly and obviously, from the definitions. Moments are whole milliseconds here.

Nothing in this file may use the code under test, but for the plain value types that tests hand over.
"""

from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations

import networkx as nx  # type: ignore[import-untyped]  # ships no type information

Span = tuple[int, int]
Typed = dict[tuple[int, int], str]


def same(x: int, y: int, tolerance: int) -> bool:
    return abs(x - y) <= tolerance


def earlier(x: int, y: int, tolerance: int) -> bool:
    return x < y and not same(x, y, tolerance)


def rows_of_table_4_1(a: Span, b: Span, tolerance: int) -> list[tuple[str, str | None]]:
    """All rows (semantics §4) that apply; the tests demand that there is just one."""
    (a1, a2), (b1, b2) = a, b

    def eq(x: int, y: int) -> bool:
        return same(x, y, tolerance)

    def lt(x: int, y: int) -> bool:
        return earlier(x, y, tolerance)

    table = [
        ("before", lt(a1, b1) and lt(a2, b1), "ordering"),
        ("meets", lt(a1, b1) and eq(a2, b1), "enabling"),
        ("overlaps", lt(a1, b1) and lt(b1, a2) and lt(a2, b2), "enabling"),
        ("includes", lt(a1, b1) and lt(b1, a2) and lt(b2, a2), "permanent"),
        ("ends", lt(a1, b1) and lt(b1, a2) and eq(a2, b2), "permanent"),
        ("starts", eq(a1, b1) and lt(a2, b2), None),
        ("started-by", eq(a1, b1) and lt(b2, a2), None),
        ("equals", eq(a1, b1) and eq(a2, b2), None),
    ]
    return [(name, link) for name, applies, link in table if applies]


def all_links(
    spans: Sequence[Span],
    tolerance: int,
    *,
    moments: Sequence[int] | None = None,
    not_held: Mapping[tuple[int, int], bool] | None = None,
    with_values: Iterable[int] = (),
) -> Typed:
    """Every pair compared (§4.4.1, step 4), in the order of the moments (by default the onsets), nothing left out.

    Args:
        spans: in order of appearance.
        tolerance: of all comparisons.
        moments: what orders the observations.
        not_held: pairs for which the first one's learned values did not hold all through the second one.
        with_values: the parameterised ones: achieved at their end, and enabling only for whom they were achieved last.
    """
    moments = [start for start, _ in spans] if moments is None else moments
    links: Typed = {}
    for i, j in combinations(range(len(spans)), 2):
        first, second = (i, j) if moments[i] <= moments[j] else (j, i)
        if same(moments[first], moments[second], tolerance):
            continue
        if not earlier(spans[first][0], spans[second][0], tolerance):
            links[first, second] = "ordering"
            continue
        [(_, link)] = rows_of_table_4_1(spans[first], spans[second], tolerance)
        assert link is not None
        if link == "permanent" and not_held and not_held.get((first, second)):
            link = "ordering"
        links[first, second] = link
    watched = set(with_values)

    def achieved(k: int) -> tuple[int, int, int]:
        return spans[k][1] if k in watched else spans[k][0], moments[k], k

    demoted = [
        (i, j)
        for (i, j), link in links.items()
        if link == "enabling" and i in watched
        if any(achieved(k) > achieved(i) for k, successor in links if successor == j)
    ]
    return links | dict.fromkeys(demoted, "ordering")


def without_implied(links: Mapping[tuple[int, int], str]) -> Typed:
    """The links but for the ordering ones to which there is another path."""
    kept: Typed = {}
    graph = nx.DiGraph(list(links))
    for (source, target), type_ in links.items():
        graph.remove_edge(source, target)
        if type_ != "ordering" or not nx.has_path(graph, source, target):
            kept[source, target] = type_
        graph.add_edge(source, target)
    return kept


def joined(links: Iterable[tuple[int, int]], nodes: int) -> set[tuple[int, int]]:
    """All pairs that a path joins."""
    graph = nx.DiGraph(list(links))
    graph.add_nodes_from(range(nodes))
    return {(source, target) for source in graph for target in nx.descendants(graph, source)}


def runs_of_true(history: Sequence[bool], merge_gap: int) -> list[Span]:
    """Ticks ``[first true, first false)`` of every run; runs with a gap of at most ``merge_gap`` are one."""
    filled = list(history)
    for start in range(len(history)):
        for stop in range(start, len(history)):
            gap = not any(history[start:stop])
            inside = start > 0 and history[start - 1] and history[stop]
            if gap and inside and stop - start <= merge_gap:
                filled[start:stop] = [True] * (stop - start)
    runs = []
    for start, now in enumerate(filled):
        if now and (start == 0 or not filled[start - 1]):
            stop = start
            while stop < len(filled) and filled[stop]:
                stop += 1
            runs.append((start, stop))
    return runs


def is_salient(
    span: Span,
    behavior: str,
    words: Sequence[tuple[int, str]],
    *,
    demonstration_start: int,
    grace: int,
    delay: int,
    things: Sequence[Span] | None = None,
) -> bool:
    """Whether a demonstration with these words keeps the observation.

    Args:
        span: of the observation.
        behavior: whose goal it is.
        words: with their times.
        demonstration_start: when it began.
        grace: how early or late a word may come.
        delay: how long TAKE and DROP may take.
        things: if one can point at it: all that one could point at, it too.
    """
    if not words:
        return True
    start, end = span
    for time, _ in words:
        late = end < time
        if start - grace <= time <= end + grace:
            others = things if things is not None and late else ()
            if not any(begin - grace <= time <= stop for begin, stop in others):
                return True
    for word, brought_about in (("TAKE", "PickUp"), ("DROP", "Drop")):
        said_before = [time for time, said in words if said == word and time <= start]
        if behavior == brought_about and said_before and start - max(said_before) <= delay:
            return True
    return behavior == "Drop" and same(start, demonstration_start, 50)
