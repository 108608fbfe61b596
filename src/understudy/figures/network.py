"""A behavior network as a picture (Figures 4.7, 4.11, 4.13): the kinds of links differ in shape, not in color.

======== =============================== ========================================
link     line                            means
======== =============================== ========================================
ordering dashed, thin, open head         has been achieved before
enabling solid, thin, open head          holds at the moment when the next begins
permanent double, filled head            holds all the while
======== =============================== ========================================
"""

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from matplotlib.figure import Figure
from matplotlib.path import Path

from understudy.behaviors import Skill
from understudy.execution.trace import State
from understudy.figures.labels import Label, clean, label_of
from understudy.figures.network_layout import Place, Route, layout
from understudy.figures.sheet import Sheet
from understudy.figures.style import (
    BODY,
    FAINT,
    INK,
    MUTED,
    PAPER,
    SMALL,
    TITLE,
    text_width,
    wrap,
)
from understudy.network import Component, LinkType, Nab, Network

__all__ = ["draw_network"]

_MEANING = {
    LinkType.ORDERING: "has been achieved before",
    LinkType.ENABLING: "holds when the next begins",
    LinkType.PERMANENT: "holds all the while",
}
_MARGIN = 26.0
_TEXT = 170.0
"""The longest line in a box; longer labels are broken."""
_LINE = 12.5
_PAD = 9.0
_CHIP = 10.0
_LEGEND_LINE = 17.0


def draw_network(
    network: Network,
    states: Mapping[str, State | str] | None = None,
    skills: Mapping[str, Skill] | None = None,
    *,
    title: str = "",
) -> Figure:
    """Draw a network from the top to the bottom.

    Args:
        network: as stored, without the ordering links that others imply.
        states: what components are doing, by id: fill, border, a sign and the word tell it.
        skills: by name; with them, parameters that a component leaves to their defaults are shown, too.
        title: above the picture.
    """
    states = states or {}
    texts = {id_: _Text(network, id_, skills or {}, states.get(id_)) for id_ in network.topological_order}
    width = max((text.width for text in texts.values()), default=0.0)
    height = max((text.height for text in texts.values()), default=0.0)
    drawn = layout(network, dict.fromkeys(texts, (width, height)))
    kinds = [kind for kind in reversed(LinkType) if any(link.type is kind for link in network.links)]
    legend = max((_legend_width(kind) for kind in kinds), default=0.0)
    headline = wrap(clean(title), max(drawn.width, legend, 260.0), TITLE, "bold", lines=2)
    title_width = max((text_width(line, TITLE, "bold") for line in headline), default=0.0)
    top = _MARGIN + (18.0 * len(headline) + 10.0 if headline else 0.0)
    sheet = Sheet(
        max(drawn.width, legend, title_width) + 2 * _MARGIN,
        top + drawn.height + (16.0 + _LEGEND_LINE * len(kinds) if kinds else 0.0) + _MARGIN,
    )
    for index, line in enumerate(headline):
        sheet.text(_MARGIN, _MARGIN + 4 + 18 * index, line, size=TITLE, weight="bold")
    left = (sheet.width - drawn.width) / 2
    for link in sorted(network.links, key=lambda link: link.type.strength):
        route = tuple((left + x, top + y) for x, y in drawn.routes[link.source, link.target])
        _link(sheet, route, link.type)
    for id_, place in drawn.places.items():
        texts[id_].draw(sheet, place._replace(x=left + place.x, y=top + place.y))
    begin = (sheet.width - legend) / 2 if legend < drawn.width else _MARGIN
    y = top + drawn.height + 16.0 + _LEGEND_LINE / 2
    for kind in kinds:
        _legend(sheet, begin, y, kind)
        y += _LEGEND_LINE
    return sheet.figure


class _Text:
    """What stands in a box: a number, a color, one or two lines of title, the numbers, the state."""

    def __init__(self, network: Network, id_: str, skills: Mapping[str, Skill], state: State | str | None) -> None:
        steps = {other: str(step) for step, other in enumerate(network.topological_order, start=1)}
        held_back = [steps[other] for one, other in network.inhibitions if one == id_]
        self.step = steps[id_]
        self.label: Label = label_of(_completed(network.by_id[id_], skills))
        self.state = State(state) if state is not None else None
        self.title = wrap(self.label.title, _TEXT, BODY, "bold", lines=3)
        details = [self.label.details, f"inhibits {', '.join(held_back)}" if held_back else ""]
        self.details = tuple(line for text in details for line in wrap(text, _TEXT, SMALL, lines=2))
        self.indent = _PAD + text_width("88", SMALL) + 7.0
        self.chip = _CHIP + 6.0 if self.label.color else 0.0
        widest = max(
            max((text_width(line, BODY, "bold") for line in self.title), default=0.0) + self.chip,
            max((text_width(line, SMALL) for line in self.details), default=0.0) + self.chip,
            text_width(self.state.value, SMALL) + self.chip + 4.0 if self.state else 0.0,
        )
        self.width = self.indent + widest + 14.0 + (16.0 if self.state else 0.0)
        lines = len(self.title) + len(self.details) + (1 if self.state else 0)
        self.height = max(2, lines) * _LINE + 2 * _PAD - 2.0

    def draw(self, sheet: Sheet, place: Place) -> None:
        state = self.state
        bold = state in (State.EXECUTING, State.SEARCHING)
        quiet = state in (State.WAITING, State.INHIBITED)
        sheet.rectangle(
            *place,
            fill="#e6f0e8" if state is State.ACHIEVED else "#fff8e6" if bold else PAPER,
            border=FAINT if quiet else INK,
            line=2.2 if bold else 1.0,
            radius=7.0,
            dashes=(2.6, 1.6) if state is State.SEARCHING else None,
            z=4,
        )
        ink = MUTED if quiet else INK
        lines = [(line, BODY, "bold", ink) for line in self.title]
        lines += [(line, SMALL, "normal", MUTED) for line in self.details]
        if state:
            lines.append((state.value, SMALL, "bold" if bold else "normal", ink))
        y = place.y + place.height / 2 - _LINE * (len(lines) - 1) / 2
        sheet.text(place.x + _PAD, y, self.step, size=SMALL, color=MUTED)
        x = place.x + self.indent
        sheet.chip(x, y, self.label.color, size=_CHIP)
        for text, size, weight, color in lines:
            sheet.text(x + self.chip, y, text, size=size, weight=weight, color=color)
            y += _LINE
        if state:
            _sign(sheet, place.x + place.width - 14.0, place.y + place.height / 2, state)


def _completed(component: Component | Nab, skills: Mapping[str, Skill]) -> Component | Nab:
    """The component with its skill's defaults, where the skill is known."""
    if isinstance(component, Nab) or component.behavior not in skills:
        return component
    values = skills[component.behavior].complete(component.parameters)
    plain = {name: value if isinstance(value, float) else str(value) for name, value in values.items()}
    return Component(id=component.id, behavior=component.behavior, parameters=plain)


def _sign(sheet: Sheet, x: float, y: float, state: State) -> None:
    """A sign for each state, to be told without color and without reading."""
    if state is State.ACHIEVED:
        sheet.line([(x - 4.5, y), (x - 1.5, y + 3.5), (x + 4.5, y - 4)], color="#2f7d4a", width=2.0, z=6)
    elif state is State.EXECUTING:
        sheet.polygon([(x - 3, y - 4.5), (x + 4.5, y), (x - 3, y + 4.5)], fill=INK, z=6)
    elif state is State.SEARCHING:
        sheet.disc(x - 1, y - 1, 3.4, border=INK, line=1.4, z=6)
        sheet.line([(x + 1.6, y + 1.6), (x + 4.6, y + 4.6)], color=INK, width=1.6, z=6)
    elif state is State.WAITING:
        for step in (-4.0, 0.0, 4.0):
            sheet.disc(x + step, y, 1.0, fill=FAINT, border=FAINT, line=0.4, z=6)
    else:
        sheet.disc(x, y, 4.2, border=FAINT, line=1.4, z=6)
        sheet.line([(x - 2.9, y + 2.9), (x + 2.9, y - 2.9)], color=FAINT, width=1.4, z=6)


def _link(sheet: Sheet, route: Route, kind: LinkType) -> None:
    """A link as a smooth line, with a light seam so that lines which cross are told apart."""
    (x, y) = route[-1]
    tip = (x, y - 1.0)
    before = 8.0 if kind is LinkType.PERMANENT else 1.5
    path = _smooth((*route[:-1], (x, y - before)))
    z = 2 + 0.1 * kind.strength
    sheet.curve(path, color=PAPER, width=6.0 if kind is LinkType.PERMANENT else 3.6, z=z)
    if kind is LinkType.PERMANENT:
        sheet.curve(path, color=INK, width=3.6, z=z + 0.01)
        sheet.curve(path, color=PAPER, width=1.8, z=z + 0.02)
        sheet.polygon([tip, (x - 4.6, y - 9.5), (x + 4.6, y - 9.5)], fill=INK, z=3)
    else:
        solid = kind is LinkType.ENABLING
        sheet.curve(path, color=INK, width=1.1, dashes=None if solid else (3.2, 2.4), z=z + 0.01)
        sheet.line([(x - 3.8, y - 8.0), tip, (x + 3.8, y - 8.0)], color=INK, width=1.2, z=3)


def _smooth(route: Route) -> Path:
    """Straight where a point stands under another, else a curve that leaves and arrives vertically."""
    vertices = [route[0]]
    codes: list[Any] = [Path.MOVETO]
    for (x1, y1), (x2, y2) in pairwise(route):
        if abs(x1 - x2) < 0.05:
            vertices.append((x2, y2))
            codes.append(Path.LINETO)
        else:
            bend = 0.62 * (y2 - y1)
            vertices += [(x1, y1 + bend), (x2, y2 - bend), (x2, y2)]
            codes += [Path.CURVE4] * 3
    return Path(vertices, codes)


_SAMPLE = 34.0


def _legend_width(kind: LinkType) -> float:
    return _SAMPLE + 10.0 + text_width("permanent", SMALL, "bold") + 8.0 + text_width(_MEANING[kind], SMALL)


def _legend(sheet: Sheet, x: float, y: float, kind: LinkType) -> None:
    end = x + _SAMPLE
    if kind is LinkType.PERMANENT:
        sheet.line([(x, y), (end - 8, y)], width=3.6, cap="butt")
        sheet.line([(x, y), (end - 8, y)], width=1.8, color=PAPER, cap="butt", z=2.5)
        sheet.polygon([(end, y), (end - 9, y - 4.6), (end - 9, y + 4.6)], fill=INK)
    else:
        dashes = None if kind is LinkType.ENABLING else (3.2, 2.4)
        sheet.line([(x, y), (end - 1, y)], width=1.1, dashes=dashes, cap="butt")
        sheet.line([(end - 7.5, y - 3.8), (end - 0.5, y), (end - 7.5, y + 3.8)], width=1.2, z=3)
    sheet.text(end + 10, y, kind.value, size=SMALL, weight="bold")
    sheet.text(end + 18 + text_width("permanent", SMALL, "bold"), y, _MEANING[kind], size=SMALL, color=MUTED)
