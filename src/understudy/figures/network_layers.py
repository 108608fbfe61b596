"""The first half of a network's layout: which layer a box stands in, and in which order the boxes of a layer stand.

A link that skips layers passes through each of them in a slot of its own, so that no box can stand in its way.
"""

from bisect import bisect_right, insort
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import ceil
from typing import NamedTuple

from understudy.network import LinkType, Network

__all__ = ["Layers", "Segment", "Slot", "Wire", "arrange"]

_SWEEPS = 16
"""Few networks still improve after the third; each costs little."""


class Wire(NamedTuple):
    """What runs from one layer to another: a link, or what joins two rivals of which one inhibits the other."""

    source: str
    target: str
    rival: bool = False


class Slot(NamedTuple):
    """A place in a layer: of the box ``source``, or of a wire from ``source`` to ``target`` that passes through."""

    row: int
    source: str
    target: str = ""
    rival: bool = False

    @property
    def passing(self) -> bool:
        """It is a link's, and no box's."""
        return bool(self.target)


Segment = tuple[Slot, Slot]
"""The piece of a link between one layer and the next."""

Rows = list[list[Slot]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Layers:
    """The layers from the top to the bottom, each from left to right.

    Attributes:
        rows: their slots.
        routes: for every wire the slots that it runs through, both ends included, downwards.
        gaps: the pieces of the wires between each layer and the next; of rivals only those that pass layers.
        beside: rivals in one layer, the left one first.
        duties: which stand at the right end of their layers.
    """

    rows: tuple[tuple[Slot, ...], ...]
    routes: Mapping[Wire, tuple[Slot, ...]]
    gaps: tuple[tuple[Segment, ...], ...]
    beside: tuple[tuple[Slot, Slot], ...] = ()
    duties: tuple[Slot, ...] = ()


def arrange(network: Network) -> Layers:
    """Give every box a layer, and order the layers so that few links cross."""
    depth = _depths(network)
    rows: Rows = [[] for _ in range(max(depth.values(), default=-1) + 1)]
    side: dict[Slot, int] = {}
    for id_ in network.topological_order:
        slot = Slot(depth[id_], id_)
        rows[slot.row].append(slot)
        side[slot] = 0
    wires = [(Wire(link.source, link.target), link.type is LinkType.PERMANENT) for link in network.links]
    rivals = {tuple(sorted(pair, key=lambda id_: depth[id_])): None for pair in network.inhibitions}
    rivals = {(a, b): None for a, b in rivals if (b, a) not in rivals or a < b}
    wires += [(Wire(upper, lower, rival=True), True) for upper, lower in rivals if depth[upper] < depth[lower]]
    routes: dict[Wire, tuple[Slot, ...]] = {}
    for wire, to_the_right in wires:
        first, last = depth[wire.source], depth[wire.target]
        passed = [Slot(row, *wire) for row in range(first + 1, last)]
        for slot in passed:
            rows[slot.row].append(slot)
            # What must hold all the while keeps to the right, all else to the left; the longer way runs outside.
            side[slot] = len(passed) if to_the_right else -len(passed)
        routes[wire] = (Slot(first, wire.source), *passed, Slot(last, wire.target))
    gaps: list[list[Segment]] = [[] for _ in rows[1:]]
    for wire, route in routes.items():
        if not wire.rival or len(route) > 2:
            for upper, lower in pairwise(route):
                gaps[upper.row].append((upper, lower))
    ordered = _uncross([sorted(row, key=lambda slot: side[slot]) for row in rows], gaps)
    duties = {component.id for component in network.components if component.trigger is not None}
    ordered = [sorted(row, key=lambda slot: not slot.passing and slot.source in duties) for row in ordered]
    place = {slot: index for row in ordered for index, slot in enumerate(row)}
    beside = [
        sorted((Slot(depth[a], a), Slot(depth[b], b)), key=place.__getitem__) for a, b in rivals if depth[a] == depth[b]
    ]
    return Layers(
        rows=tuple(map(tuple, ordered)),
        routes=routes,
        gaps=tuple(map(tuple, gaps)),
        beside=tuple((left, right) for left, right in beside),
        duties=tuple(slot for row in ordered for slot in row if not slot.passing and slot.source in duties),
    )


def _depths(network: Network) -> dict[str, int]:
    """The longest way to each box; one that is needed more than it needs goes down to where it is needed."""
    depth: dict[str, int] = {}
    for id_ in network.topological_order:
        depth[id_] = max((depth[link.source] + 1 for link in network.incoming[id_]), default=0)
    for id_ in reversed(network.topological_order):
        needed = network.outgoing[id_]
        if len(needed) > len(network.incoming[id_]):
            depth[id_] = min(depth[link.target] for link in needed) - 1
    duties = [id_ for id_ in network.topological_order if network.by_id[id_].trigger is not None]
    # Boxes without any link fill a field about as high as it is wide in boxes, instead of one endless row.
    alone = [
        id_
        for id_ in network.topological_order
        if not network.incoming[id_] and not network.outgoing[id_] and id_ not in duties
    ]
    across = max(3, round((len(alone) / 2) ** 0.5))
    across = ceil(len(alone) / max(1, ceil(len(alone) / across)))  # the last row as full as the others
    for index, id_ in enumerate(alone):
        depth[id_] = index // across
    # Duties stand under each other, beside the sequence.
    row = -1
    for id_ in duties:
        row = depth[id_] = max(depth[id_], row + 1)
    # A duty that waits for another one may have left a layer empty.
    used = sorted(set(depth.values()))
    return {id_: used.index(row) for id_, row in depth.items()}


def _uncross(rows: Rows, gaps: Sequence[Sequence[Segment]]) -> Rows:
    """Sweeps down and up by barycentres, then exchanges of neighbours; never worse than what was given."""
    above: dict[Slot, list[Slot]] = {slot: [] for row in rows for slot in row}
    below: dict[Slot, list[Slot]] = {slot: [] for row in rows for slot in row}
    for gap in gaps:
        for upper, lower in gap:
            above[lower].append(upper)
            below[upper].append(lower)
    best, fewest = rows, _crossings(rows, gaps)
    for sweep in range(_SWEEPS):
        if fewest == 0:
            break
        down = sweep % 2 == 0
        rows = [list(row) for row in rows]
        for row in range(1, len(rows)) if down else range(len(rows) - 2, -1, -1):
            towards = rows[row - 1 if down else row + 1]
            place = {slot: float(index) for index, slot in enumerate(towards)}
            neighbours = above if down else below
            rows[row] = _by_barycentre(rows[row], {slot: [place[n] for n in neighbours[slot]] for slot in rows[row]})
        count = _crossings(rows, gaps)
        if count < fewest:
            best, fewest = rows, count
    return _exchange(best, above, below) if fewest else best


def _by_barycentre(row: Sequence[Slot], places: Mapping[Slot, Sequence[float]]) -> list[Slot]:
    """Sorted by the mean place of the neighbours; slots without any stay where they are."""
    moving = [slot for slot in row if places[slot]]
    moving.sort(key=lambda slot: sum(places[slot]) / len(places[slot]))
    sorted_ones = iter(moving)
    return [next(sorted_ones) if places[slot] else slot for slot in row]


def _exchange(rows: Rows, above: Mapping[Slot, Sequence[Slot]], below: Mapping[Slot, Sequence[Slot]]) -> Rows:
    """Exchange neighbours as long as it takes crossings away."""
    rows = [list(row) for row in rows]
    place = {slot: index for row in rows for index, slot in enumerate(row)}

    def crossed(left: Slot, right: Slot) -> int:
        return sum(
            place[mine] > place[other]
            for neighbours in (above, below)
            for mine in neighbours[left]
            for other in neighbours[right]
        )

    improved = True
    while improved:
        improved = False
        for row in rows:
            for index in range(len(row) - 1):
                left, right = row[index], row[index + 1]
                if crossed(right, left) < crossed(left, right):
                    row[index], row[index + 1] = right, left
                    place[left], place[right] = index + 1, index
                    improved = True
    return rows


def _crossings(rows: Rows, gaps: Sequence[Sequence[Segment]]) -> int:
    place = {slot: index for row in rows for index, slot in enumerate(row)}
    total = 0
    for gap in gaps:
        ends: list[int] = []
        for _, lower in sorted((place[upper], place[lower]) for upper, lower in gap):
            total += len(ends) - bisect_right(ends, lower)
            insort(ends, lower)
    return total
