"""Where everything of a network in networks stands: boxes in boxes, cases side by side, switches below them.

A pure function of the network and of the sizes of what is written. Every network is laid out by itself
(:mod:`understudy.figures.network_layout`); the box of a NAB is as large as what stands in it.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from understudy.figures.network_layout import Place, Route, layout
from understudy.figures.numbering import cases_of
from understudy.figures.ways import with_ways
from understudy.network import LinkType, Nab, Network

__all__ = ["BORDER", "LinkLine", "Plan", "RivalLine", "Sizes", "SwitchLine", "plan"]

Size = tuple[float, float]

BORDER = 4.4
"""Width of the border of three lines."""

_PAD = 14.0
_PANEL_PAD = 12.0
_BETWEEN_PANELS = 14.0
_PORT = 16.0
"""From one switch to the next where they leave a case or enter it."""
_LANE_GAP = 9.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Sizes:
    """How large what is written is, in points.

    Attributes:
        boxes: by path, of behaviors and of NABs of which only the outside is drawn.
        headings: by path, of NABs that are drawn with what stands in them.
        panels: of the headings of cases, by what the paths of their components begin with.
        switches: by path of the NAB, in document order.
    """

    boxes: Mapping[str, Size] = field(default_factory=dict)
    headings: Mapping[str, Size] = field(default_factory=dict)
    panels: Mapping[str, Size] = field(default_factory=dict)
    switches: Mapping[str, tuple[Size, ...]] = field(default_factory=dict)


class LinkLine(NamedTuple):
    """A link: downwards."""

    inside: str
    type: LinkType
    route: Route


class RivalLine(NamedTuple):
    """What joins two rivals, with the ends at which the other one is kept still."""

    inside: str
    route: Route
    first_held: bool
    last_held: bool


class SwitchLine(NamedTuple):
    """The switch of that number of a NAB: from a case down, across, and up to another; where its label stands."""

    path: str
    number: int
    route: Route
    label: Place


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """A picture's geometry, in points from its upper left corner.

    Attributes:
        width, height: of everything.
        boxes: of all components that are drawn, by path; each NAB before its parts.
        panels: of cases that are named or asked for, by what the paths of their components begin with.
        links, rivals, switches: the lines, of all networks.
    """

    width: float
    height: float
    boxes: Mapping[str, Place] = field(default_factory=dict)
    panels: Mapping[str, Place] = field(default_factory=dict)
    links: tuple[LinkLine, ...] = ()
    rivals: tuple[RivalLine, ...] = ()
    switches: tuple[SwitchLine, ...] = ()

    def moved(self, x: float, y: float) -> "Plan":
        """The same elsewhere."""
        return Plan(
            width=self.width,
            height=self.height,
            boxes={path: _moved(place, x, y) for path, place in self.boxes.items()},
            panels={inside: _moved(place, x, y) for inside, place in self.panels.items()},
            links=tuple(line._replace(route=_along(line.route, x, y)) for line in self.links),
            rivals=tuple(line._replace(route=_along(line.route, x, y)) for line in self.rivals),
            switches=tuple(
                line._replace(route=_along(line.route, x, y), label=_moved(line.label, x, y)) for line in self.switches
            ),
        )


def plan(network: Network, sizes: Sizes, *, inside: str = "") -> Plan:
    """Lay a network out with everything that stands in it.

    Args:
        network: the task, or a part of it.
        sizes: of what is written.
        inside: what the paths of its components begin with.
    """
    network = with_ways(network)
    opened = {
        component.id: _opened(component, inside + component.id, sizes)
        for component in network.components
        if isinstance(component, Nab) and inside + component.id in sizes.headings
    }
    closed = {
        component.id: sizes.boxes[inside + component.id]
        for component in network.components
        if component.id not in opened
    }
    # Boxes of one network are equally wide.
    width = max((width for width, _ in closed.values()), default=0.0)
    size = {id_: (width, height) for id_, (_, height) in closed.items()}
    size |= {id_: (part.width, part.height) for id_, part in opened.items()}
    drawn = layout(network, size)
    parts = []
    for id_, place in drawn.places.items():
        if id_ in opened:
            # The box is wider than what is in it if many lines meet its edge.
            middle = (place.width - opened[id_].width) / 2
            part = opened[id_].moved(place.x + middle, place.y)
            parts.append(replace(part, boxes={inside + id_: place, **part.boxes}))
        else:
            parts.append(Plan(width=0.0, height=0.0, boxes={inside + id_: place}))
    held = set(network.inhibitions)
    return _together(
        Plan(
            width=drawn.width,
            height=drawn.height,
            links=tuple(
                LinkLine(inside, link.type, drawn.routes[link.source, link.target])
                for link in sorted(network.links, key=lambda link: link.type.strength)
            ),
            rivals=tuple(
                RivalLine(inside, route, (last, first) in held, (first, last) in held)
                for (first, last), route in drawn.rivals.items()
            ),
        ),
        parts,
    )


def _opened(nab: Nab, path: str, sizes: Sizes) -> Plan:
    """What stands in the box of a NAB, measured from the box's corner; its size is the box's."""
    heading_width, heading_height = sizes.headings[path]
    frame = BORDER + _PAD
    panels: dict[str, Place] = {}
    parts: list[Plan] = []
    columns = []
    for inside, _, case in cases_of(path, nab):
        inner = plan(case.network, sizes, inside=inside)
        if inside in sizes.panels:
            label_width, label_height = sizes.panels[inside]
            ports = sum((switch.source == case.name) + (switch.target == case.name) for switch in nab.switches)
            wide = max(inner.width, label_width, _PORT * (ports + 1)) + 2 * _PANEL_PAD
            columns.append((inside, inner, wide, label_height + _PANEL_PAD / 2, _PANEL_PAD))
        else:
            columns.append((inside, inner, inner.width, 0.0, 0.0))
    content = sum(wide for _, _, wide, _, _ in columns) + _BETWEEN_PANELS * (len(columns) - 1)
    top = BORDER + heading_height + 4.0
    tall = max(inner.height + above + 2 * pad for _, inner, _, above, pad in columns)
    x = max(0.0, (heading_width - content) / 2)
    for inside, inner, wide, above, pad in columns:
        if pad:
            panels[inside] = Place(x, top, wide, tall)
        parts.append(inner.moved(x + (wide - inner.width) / 2, top + pad + above))
        x += wide + _BETWEEN_PANELS
    switches, bottom = _switches(nab, path, panels, sizes.switches.get(path, ()), top + tall)
    right = max([heading_width, content, *(line.label.x + line.label.width for line in switches)])
    left = min([0.0, *(line.label.x for line in switches)])
    whole = Plan(width=0.0, height=0.0, panels=panels, switches=switches)
    whole = _together(whole, parts).moved(frame - left, 0.0)
    return replace(whole, width=right - left + 2 * frame, height=bottom + frame)


def _switches(
    nab: Nab, path: str, panels: Mapping[str, Place], labels: tuple[Size, ...], floor: float
) -> tuple[tuple[SwitchLine, ...], float]:
    """The lines below the cases, short ones above long ones so that they run inside each other; and where they end."""
    place = {case.name: panels[inside] for inside, _, case in cases_of(path, nab) if inside in panels}
    ends = [(place[switch.source].middle, place[switch.target].middle) for switch in nab.switches]
    order = sorted(range(len(ends)), key=lambda index: abs(ends[index][1] - ends[index][0]))
    # The ports of every case from left to right: lines to the left, the longest outermost, then lines to the right.
    ports: dict[str, list[tuple[int, int, tuple[int, bool]]]] = {}
    for turn, index in enumerate(order):
        switch, (begin, end) = nab.switches[index], ends[index]
        towards = 1 if end >= begin else -1
        ports.setdefault(switch.source, []).append((towards, -towards * turn, (index, False)))
        towards = -towards if begin != end else 1
        ports.setdefault(switch.target, []).append((towards, -towards * turn, (index, True)))
    xs: dict[tuple[int, bool], float] = {}
    for name, wanted in ports.items():
        for index, (_, _, port) in enumerate(sorted(wanted)):
            xs[port] = place[name].middle + _PORT * (index - (len(wanted) - 1) / 2)
    lines: dict[int, SwitchLine] = {}
    y = floor
    for index in order:
        x1, x2 = xs[index, False], xs[index, True]
        width, height = labels[index]
        left, right = sorted((x1, x2))
        y += _LANE_GAP
        if right - left >= width + 16.0:
            label = Place((left + right - width) / 2, y, width, height)
            y += height + 3.0
        else:
            # Too short to carry its label, which then stands beside it.
            label = Place(right + 8.0, y, width, height)
            y += height / 2
        route = ((x1, floor), (x1, y), (x2, y), (x2, floor))
        lines[index] = SwitchLine(path, index, route, label)
        y = max(y, label.y + label.height)
    return tuple(lines[index] for index in range(len(ends))), y


def _together(whole: Plan, parts: list[Plan]) -> Plan:
    """One plan with everything of the parts; the size stays."""
    return replace(
        whole,
        boxes={**whole.boxes, **{path: place for part in parts for path, place in part.boxes.items()}},
        panels={**whole.panels, **{inside: place for part in parts for inside, place in part.panels.items()}},
        links=(*whole.links, *(line for part in parts for line in part.links)),
        rivals=(*whole.rivals, *(line for part in parts for line in part.rivals)),
        switches=(*whole.switches, *(line for part in parts for line in part.switches)),
    )


def _moved(place: Place, x: float, y: float) -> Place:
    return place._replace(x=place.x + x, y=place.y + y)


def _along(route: Route, x: float, y: float) -> Route:
    return tuple((a + x, b + y) for a, b in route)
