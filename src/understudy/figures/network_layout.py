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

from understudy.figures.network_layers import Layers, Segment, Slot, Wire, arrange
from understudy.network import Network

__all__ = ["BOX", "Layout", "Place", "Route", "layout"]

BOX = (150.0, 40.0)
"""Width and height of a box, in points, unless told otherwise."""

_BETWEEN_BOXES = 22.0
_BETWEEN_LINES = 13.0
_BOX_TO_LINE = 15.0
_BETWEEN_RIVALS = 44.0
_GAP = 40.0
_PORTS = 16.0
"""From one line to the next where they leave a box or enter it; arrow heads must not touch."""
_ROUNDS = 60


_STAIR = 8.0
"""How far below each other lines side by side begin to swing."""

_LANDING = 11.0
"""The straight last stretch of a line, so that its head points the way the line comes."""

_LANE = 9.0
"""How far below each other lines run that join rivals in one layer."""

Pair = tuple[str, str]
_Swings = dict[Wire, tuple[float, float]]


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
        rivals: what joins boxes of which one inhibits the other, or both each other; from the upper to the lower one,
            and from the left to the right.
    """

    width: float
    height: float
    places: Mapping[str, Place]
    routes: Mapping[Pair, Route]
    rivals: Mapping[Pair, Route]


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
    gaps, under = _ends(layers, middles, size)
    heights = [max((size[slot.source][1] for slot in row if not slot.passing), default=0.0) for row in layers.rows]
    bands = [_LANE * (max(lanes, default=-1) + 1) for lanes in (_lanes(row) for row in under)]
    stairs = [_stairs(swings) for swings in gaps]
    tops = _tops([height + band for height, band in zip(heights, bands, strict=True)], gaps, stairs, gap)
    places = {
        slot.source: Place(
            middles[slot] - size[slot.source][0] / 2,
            tops[slot.row] + (heights[slot.row] - size[slot.source][1]) / 2,
            *size[slot.source],
        )
        for slot in middles
        if not slot.passing
    }
    routes: dict[Wire, Route] = {}
    for wire, route in layers.routes.items():
        points = [(gaps[route[0].row][wire][0], places[wire.source].bottom)]
        for slot in route[:-1]:
            # Through a layer straight, through the gap below it in a swing, above or below the others of the gap.
            x1, x2 = gaps[slot.row][wire]
            step, last = stairs[slot.row].get(wire, 0), max(stairs[slot.row].values(), default=0)
            points.append((x1, tops[slot.row] + heights[slot.row] + bands[slot.row] + _STAIR * step))
            points.append((x2, tops[slot.row + 1] - _LANDING - _STAIR * (last - step)))
        points.append((points[-1][0], places[wire.target].y))
        routes[wire] = tuple(
            point for index, point in enumerate(points) if index == 0 or point[1] > points[index - 1][1]
        )
    rivals = {(wire.source, wire.target): route for wire, route in routes.items() if wire.rival}
    for row, spans in enumerate(under):
        floor = tops[row] + heights[row]
        for (pair, (x1, x2)), lane in zip(spans.items(), _lanes(spans), strict=True):
            y = floor + _LANE * (lane + 1)
            rivals[pair] = ((x1, places[pair[0]].bottom), (x1, y), (x2, y), (x2, places[pair[1]].bottom))
    for left, right in layers.beside:
        if (left.source, right.source) not in rivals:
            one, other = places[left.source], places[right.source]
            y = tops[left.row] + heights[left.row] / 2
            rivals[left.source, right.source] = ((one.x + one.width, y), (other.x, y))
    lines = [*routes.values(), *rivals.values()]
    xs = [place.x for place in places.values()] + [x for route in lines for x, _ in route]
    ends = [place.x + place.width for place in places.values()] + [x for route in lines for x, _ in route]
    left_edge = min(xs, default=0.0)
    return Layout(
        width=max(ends, default=0.0) - left_edge,
        height=tops[len(heights) - 1] + heights[-1] + bands[-1] if heights else 0.0,
        places={id_: place._replace(x=place.x - left_edge) for id_, place in places.items()},
        routes={
            (wire.source, wire.target): _shifted(route, left_edge) for wire, route in routes.items() if not wire.rival
        },
        rivals={pair: _shifted(route, left_edge) for pair, route in rivals.items()},
    )


def _shifted(route: Route, left: float) -> Route:
    return tuple((x - left, y) for x, y in route)


def _ports_width(network: Network, id_: str) -> float:
    rivals = sum(id_ in pair for pair in network.inhibitions)
    return _PORTS * (max(len(network.incoming[id_]), len(network.outgoing[id_])) + rivals + 1)


def _middles(layers: Layers, size: Mapping[str, tuple[float, float]]) -> dict[Slot, float]:
    """The x of every slot's middle."""
    column = _columns(layers)
    beside = frozenset(layers.beside)
    members: dict[Slot, list[Slot]] = {}
    for slot, head in column.items():
        members.setdefault(head, []).append(slot)
    # (left column, right column) -> how far apart their middles must be.
    apart: dict[tuple[Slot, Slot], float] = {}
    for row in layers.rows:
        for left, right in pairwise(row):
            pair = column[left], column[right]
            distance = _apart(left, right, size, _BETWEEN_RIVALS if (left, right) in beside else _BETWEEN_BOXES)
            apart[pair] = max(apart.get(pair, 0.0), distance)
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
    alone = [slot for slot in layers.duties if head[slot] == slot]
    return head | dict.fromkeys(alone, alone[0]) if alone else head


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


def _apart(left: Slot, right: Slot, size: Mapping[str, tuple[float, float]], boxes: float) -> float:
    half = sum(size[slot.source][0] / 2 for slot in (left, right) if not slot.passing)
    if left.passing and right.passing:
        return _BETWEEN_LINES
    return half + (_BOX_TO_LINE if left.passing or right.passing else boxes)


def _pull(upper: Slot, lower: Slot) -> float:
    """Boxes draw each other; the ends of long lines come along."""
    return 1.0 if upper.passing or lower.passing else 4.0


def _ends(
    layers: Layers, middles: Mapping[Slot, float], size: Mapping[str, tuple[float, float]]
) -> tuple[list[_Swings], list[dict[Pair, tuple[float, float]]]]:
    """Where lines begin and end, their ends at the ports of the boxes.

    Returns:
        Gap by gap, from which x to which each piece of a wire runs; and layer by layer, from which x to which the
        lines below it run that join rivals with another box between them.
    """
    leaving: dict[Slot, list[tuple[float, Wire]]] = {}
    entering: dict[Slot, list[tuple[float, Wire]]] = {}
    for wire, route in layers.routes.items():
        leaving.setdefault(route[0], []).append((middles[route[1]], wire))
        entering.setdefault(route[-1], []).append((middles[route[-2]], wire))
    around = [(left, right) for left, right in layers.beside if _between(left, right, layers)]
    for left, right in around:
        leaving.setdefault(left, []).append((middles[right], Wire(left.source, right.source)))
        leaving.setdefault(right, []).append((middles[left], Wire(right.source, left.source)))
    starts, ends = (
        {wire: x for box, lines in side.items() for wire, x in _ports(middles[box], size[box.source][0], lines).items()}
        for side in (leaving, entering)
    )
    gaps: list[_Swings] = [{} for _ in layers.gaps]
    for wire, route in layers.routes.items():
        xs = [starts[wire], *(middles[slot] for slot in route[1:-1]), ends[wire]]
        for slot, x1, x2 in zip(route, xs, xs[1:], strict=False):
            gaps[slot.row][wire] = (x1, x2)
    under: list[dict[Pair, tuple[float, float]]] = [{} for _ in layers.rows]
    for left, right in around:
        pair = left.source, right.source
        under[left.row][pair] = starts[Wire(left.source, right.source)], starts[Wire(right.source, left.source)]
    return gaps, under


def _between(left: Slot, right: Slot, layers: Layers) -> bool:
    """Whether another box stands between two of one layer."""
    row = layers.rows[left.row]
    return any(not slot.passing for slot in row[row.index(left) + 1 : row.index(right)])


def _lanes(spans: Mapping[Pair, tuple[float, float]]) -> list[int]:
    """For every line below a layer, how many others it lets pass above it, so that none lies on another."""
    lanes: dict[Pair, int] = {}
    for pair, (x1, x2) in sorted(spans.items(), key=lambda item: item[1][1] - item[1][0]):
        met = [lane for other, lane in lanes.items() if spans[other][0] < x2 + _PORTS and x1 < spans[other][1] + _PORTS]
        lanes[pair] = next(lane for lane in range(len(met) + 1) if lane not in met)
    return [lanes[pair] for pair in spans]


def _ports(middle: float, width: float, lines: Sequence[tuple[float, Wire]]) -> dict[Wire, float]:
    """Where lines meet an edge of a box: side by side in the order of where they come from or go to.

    The one that goes straight keeps to the middle, and the others stand to its left and right.
    """
    ordered = sorted(lines)
    count = len(ordered)
    straight = next((index for index, (x, _) in enumerate(ordered) if abs(x - middle) < 0.5), None)
    first = -(count - 1) / 2 if straight is None else -float(straight)
    reach = (width - _PORTS) / 2 / _PORTS
    first = min(max(first, -reach), reach - (count - 1))
    return {wire: middle + _PORTS * (first + index) for index, (_, wire) in enumerate(ordered)}


def _stairs(swings: _Swings) -> dict[Wire, int]:
    """How many other lines of a gap each one lets pass above it, so that lines side by side keep their distance.

    Of two lines to the right, the one that begins farther to the right runs above the other; to the left, the reverse.
    """
    stairs: dict[Wire, int] = {}
    for sign in (1.0, -1.0):
        group = [(sign * x1, sign * x2, wire) for wire, (x1, x2) in swings.items() if sign * (x2 - x1) > 0.5]
        group.sort(key=lambda line: -line[0])
        for index, (x1, x2, wire) in enumerate(group):
            above = [stairs[other] for begin, _, other in group[:index] if begin < x2 and begin > x1]
            stairs[wire] = max(above, default=-1) + 1
    return stairs


def _tops(
    heights: Sequence[float], gaps: Sequence[_Swings], stairs: Sequence[Mapping[Wire, int]], gap: float
) -> list[float]:
    """The upper edge of every layer."""
    tops = [0.0]
    for height, swings, steps in zip(heights, gaps, stairs, strict=False):
        # A line that runs far across needs room to swing, and lines side by side need room for each other.
        across = max((abs(x1 - x2) for x1, x2 in swings.values()), default=0.0)
        between = gap if swings else gap / 2
        tops.append(tops[-1] + height + between + min(0.14 * across, gap) + _STAIR * max(steps.values(), default=0))
    return tops
