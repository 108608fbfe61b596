"""Where the boxes of a network stand and where its links run: layered, from the top to the bottom.

A pure function of the network and of the boxes' sizes: the same input gives the same picture. The layers and their
order come from :mod:`understudy.figures.network_layers`; here they get their coordinates. Slots that belong under each
other (a link passing several layers, a box and its only successor) form *columns*, which move as one, so that such
lines are straight. Columns start packed, in the middle between as far left and as far right as they can be, and then
move in turn to the mean of what they are linked to, as far as their neighbours let them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from types import MappingProxyType
from typing import NamedTuple

from understudy.figures.network_layers import Layers, Segment, Slot, arrange
from understudy.network import Network

__all__ = ["BOX", "Layout", "Place", "Route", "layout"]

BOX = (150.0, 40.0)
"""Width and height of a box, in points, unless told otherwise."""

_BETWEEN_BOXES = 22.0
_BETWEEN_LINES = 13.0
_BOX_TO_LINE = 15.0
_GAP = 40.0
_PORTS = 16.0
"""From one line to the next where they leave a box or enter it; arrow heads must not touch."""
_ROUNDS = 60


_STAIR = 8.0
"""How far below each other lines side by side begin to swing."""

_LANDING = 11.0
"""The straight last stretch of a line, so that its head points the way the line comes."""

Pair = tuple[str, str]
_Swings = dict[Pair, tuple[float, float]]


class Place(NamedTuple):
    """A box: its upper left corner and its size, in points, y downwards."""

    x: float
    y: float
    width: float
    height: float

    @property
    def middle(self) -> float:
        """The x of its middle."""
        return self.x + self.width / 2

    @property
    def bottom(self) -> float:
        """The y of its lower edge."""
        return self.y + self.height


Route = tuple[tuple[float, float], ...]
"""The points of a link, each lower than the one before; from one to the next it runs straight or swings, and always
downwards at the points themselves."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Layout:
    """A picture's geometry, in points from its upper left corner.

    Attributes:
        width, height: of everything.
        places: of the components, by id.
        routes: of the links, by ``(source, target)``.
    """

    width: float
    height: float
    places: Mapping[str, Place]
    routes: Mapping[Pair, Route]


def layout(
    network: Network, sizes: Mapping[str, tuple[float, float]] = MappingProxyType({}), *, gap: float = _GAP
) -> Layout:
    """Lay a network out.

    Args:
        network: a directed acyclic graph.
        sizes: width and height of boxes by id, in points; :data:`BOX` for those that are missing.
        gap: between the layers, at least; more where many links run across.
    """
    layers = arrange(network)
    size = {component.id: sizes.get(component.id, BOX) for component in network.components}
    size = {id_: (max(width, _ports_width(network, id_)), height) for id_, (width, height) in size.items()}
    middles = _middles(layers, size)
    gaps = _ends(layers, middles, size)
    heights = [max(size[slot.source][1] for slot in row if not slot.passing) for row in layers.rows]
    stairs = [_stairs(swings) for swings in gaps]
    tops = _tops(heights, gaps, stairs, gap)
    places = {
        slot.source: Place(
            middles[slot] - size[slot.source][0] / 2,
            tops[slot.row] + (heights[slot.row] - size[slot.source][1]) / 2,
            *size[slot.source],
        )
        for slot in middles
        if not slot.passing
    }
    routes: dict[Pair, Route] = {}
    for pair, route in layers.routes.items():
        points = [(gaps[route[0].row][pair][0], places[pair[0]].bottom)]
        for slot in route[:-1]:
            # Through a layer straight, through the gap below it in a swing, above or below the others of the gap.
            x1, x2 = gaps[slot.row][pair]
            step, last = stairs[slot.row].get(pair, 0), max(stairs[slot.row].values(), default=0)
            points.append((x1, tops[slot.row] + heights[slot.row] + _STAIR * step))
            points.append((x2, tops[slot.row + 1] - _LANDING - _STAIR * (last - step)))
        points.append((points[-1][0], places[pair[1]].y))
        routes[pair] = tuple(
            point for index, point in enumerate(points) if index == 0 or point[1] > points[index - 1][1]
        )
    xs = [place.x for place in places.values()] + [x for route in routes.values() for x, _ in route]
    ends = [place.x + place.width for place in places.values()] + [x for route in routes.values() for x, _ in route]
    left = min(xs, default=0.0)
    return Layout(
        width=max(ends, default=0.0) - left,
        height=tops[len(heights) - 1] + heights[-1] if heights else 0.0,
        places={id_: place._replace(x=place.x - left) for id_, place in places.items()},
        routes={pair: tuple((x - left, y) for x, y in route) for pair, route in routes.items()},
    )


def _ports_width(network: Network, id_: str) -> float:
    return _PORTS * (max(len(network.incoming[id_]), len(network.outgoing[id_])) + 1)


def _middles(layers: Layers, size: Mapping[str, tuple[float, float]]) -> dict[Slot, float]:
    """The x of every slot's middle."""
    column = _columns(layers)
    members: dict[Slot, list[Slot]] = {}
    for slot, head in column.items():
        members.setdefault(head, []).append(slot)
    # (left column, right column) -> how far apart their middles must be.
    apart: dict[tuple[Slot, Slot], float] = {}
    for row in layers.rows:
        for left, right in pairwise(row):
            pair = column[left], column[right]
            apart[pair] = max(apart.get(pair, 0.0), _apart(left, right, size))
    lefts: dict[Slot, list[tuple[Slot, float]]] = {head: [] for head in members}
    rights: dict[Slot, list[tuple[Slot, float]]] = {head: [] for head in members}
    for (left, right), distance in apart.items():
        lefts[right].append((left, distance))
        rights[left].append((right, distance))
    order = _left_to_right(lefts, rights)
    leftmost: dict[Slot, float] = {}
    for head in order:
        leftmost[head] = max((leftmost[left] + distance for left, distance in lefts[head]), default=0.0)
    width = max(leftmost.values(), default=0.0)
    rightmost: dict[Slot, float] = {}
    for head in reversed(order):
        rightmost[head] = min((rightmost[right] - distance for right, distance in rights[head]), default=width)
    at = {head: (leftmost[head] + rightmost[head]) / 2 for head in order}
    pulls: dict[Slot, list[tuple[Slot, float]]] = {head: [] for head in members}
    for gap in layers.gaps:
        for upper, lower in gap:
            weight = _pull(upper, lower)
            if column[upper] != column[lower]:
                pulls[column[upper]].append((column[lower], weight))
                pulls[column[lower]].append((column[upper], weight))
    for turn in range(_ROUNDS):
        for head in order if turn % 2 == 0 else reversed(order):
            if pulls[head]:
                wish = sum(at[other] * weight for other, weight in pulls[head]) / sum(w for _, w in pulls[head])
                low = max((at[left] + distance for left, distance in lefts[head]), default=wish)
                high = min((at[right] - distance for right, distance in rights[head]), default=wish)
                at[head] = min(max(wish, low), high) if low <= high else at[head]
    return {slot: at[column[slot]] for slot in column}


def _columns(layers: Layers) -> dict[Slot, Slot]:
    """For every slot the uppermost one of its column. Columns never cross each other."""
    place = {slot: index for row in layers.rows for index, slot in enumerate(row)}
    head = {slot: slot for row in layers.rows for slot in row}
    for gap in layers.gaps:
        boxes_below: dict[Slot, int] = {}
        boxes_above: dict[Slot, int] = {}
        for upper, lower in gap:
            if not upper.passing and not lower.passing:
                boxes_below[upper] = boxes_below.get(upper, 0) + 1
                boxes_above[lower] = boxes_above.get(lower, 0) + 1
        straight: list[Segment] = [segment for segment in gap if segment[0].passing and segment[1].passing]
        straight += [(upper, lower) for upper, lower in gap if boxes_below.get(upper) == boxes_above.get(lower) == 1]
        taken: list[tuple[int, int]] = []
        for upper, lower in straight:
            a, b = place[upper], place[lower]
            if all((a < c and b < d) or (a > c and b > d) for c, d in taken):
                taken.append((a, b))
                head[lower] = head[upper]
    return head


def _left_to_right(
    lefts: Mapping[Slot, Sequence[tuple[Slot, float]]], rights: Mapping[Slot, Sequence[tuple[Slot, float]]]
) -> list[Slot]:
    """The columns, each after all that stand to its left."""
    waiting = {head: len(lefts[head]) for head in lefts}
    order = [head for head in lefts if not waiting[head]]
    for head in order:  # grows while it is read
        for right, _ in rights[head]:
            waiting[right] -= 1
            if not waiting[right]:
                order.append(right)
    return order


def _apart(left: Slot, right: Slot, size: Mapping[str, tuple[float, float]]) -> float:
    half = sum(size[slot.source][0] / 2 for slot in (left, right) if not slot.passing)
    if left.passing and right.passing:
        return _BETWEEN_LINES
    return half + (_BOX_TO_LINE if left.passing or right.passing else _BETWEEN_BOXES)


def _pull(upper: Slot, lower: Slot) -> float:
    """Boxes draw each other; the ends of long lines come along."""
    return 1.0 if upper.passing or lower.passing else 4.0


def _ends(layers: Layers, middles: Mapping[Slot, float], size: Mapping[str, tuple[float, float]]) -> list[_Swings]:
    """Gap by gap, from which x to which each piece of a link runs, its ends at the ports of the boxes."""
    leaving: dict[Slot, list[tuple[float, Pair]]] = {}
    entering: dict[Slot, list[tuple[float, Pair]]] = {}
    for pair, route in layers.routes.items():
        leaving.setdefault(route[0], []).append((middles[route[1]], pair))
        entering.setdefault(route[-1], []).append((middles[route[-2]], pair))
    starts, ends = (
        {pair: x for box, lines in side.items() for pair, x in _ports(middles[box], size[box.source][0], lines).items()}
        for side in (leaving, entering)
    )
    gaps: list[_Swings] = [{} for _ in layers.gaps]
    for pair, route in layers.routes.items():
        xs = [starts[pair], *(middles[slot] for slot in route[1:-1]), ends[pair]]
        for slot, x1, x2 in zip(route, xs, xs[1:], strict=False):
            gaps[slot.row][pair] = (x1, x2)
    return gaps


def _ports(middle: float, width: float, lines: Sequence[tuple[float, Pair]]) -> dict[Pair, float]:
    """Where lines meet an edge of a box: side by side in the order of where they come from or go to.

    The one that goes straight keeps to the middle, and the others stand to its left and right.
    """
    ordered = sorted(lines)
    count = len(ordered)
    straight = next((index for index, (x, _) in enumerate(ordered) if abs(x - middle) < 0.5), None)
    first = -(count - 1) / 2 if straight is None else -float(straight)
    reach = (width - _PORTS) / 2 / _PORTS
    first = min(max(first, -reach), reach - (count - 1))
    return {pair: middle + _PORTS * (first + index) for index, (_, pair) in enumerate(ordered)}


def _stairs(swings: _Swings) -> dict[Pair, int]:
    """How many other lines of a gap each one lets pass above it, so that lines side by side keep their distance.

    Of two lines to the right, the one that begins farther to the right runs above the other; to the left, the reverse.
    """
    stairs: dict[Pair, int] = {}
    for sign in (1.0, -1.0):
        group = [(sign * x1, sign * x2, pair) for pair, (x1, x2) in swings.items() if sign * (x2 - x1) > 0.5]
        group.sort(key=lambda line: -line[0])
        for index, (x1, x2, pair) in enumerate(group):
            above = [stairs[other] for begin, _, other in group[:index] if begin < x2 and begin > x1]
            stairs[pair] = max(above, default=-1) + 1
    return stairs


def _tops(
    heights: Sequence[float], gaps: Sequence[_Swings], stairs: Sequence[Mapping[Pair, int]], gap: float
) -> list[float]:
    """The upper edge of every layer."""
    tops = [0.0]
    for height, swings, steps in zip(heights, gaps, stairs, strict=False):
        # A line that runs far across needs room to swing, and lines side by side need room for each other.
        across = max((abs(x1 - x2) for x1, x2 in swings.values()), default=0.0)
        tops.append(tops[-1] + height + gap + min(0.14 * across, gap) + _STAIR * max(steps.values(), default=0))
    return tops
