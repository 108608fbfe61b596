"""The lines of a network's picture. They differ in shape, not in color.

======== ================================ =============================================
line     looks                            means
======== ================================ =============================================
ordering dashed, thin, open head          has been achieved before
enabling solid, thin, open head           holds at the moment when the next begins
permanent double, filled head             holds all the while
rival    dotted, a bar at the end         while the one executes, the other keeps still
switch   dash and dot, hollow head        one case gives way to another
======== ================================ =============================================
"""

from itertools import pairwise
from typing import Any

from matplotlib.path import Path

from understudy.figures.network_layout import Route
from understudy.figures.sheet import Sheet
from understudy.figures.style import INK, PAPER
from understudy.network import LinkType

__all__ = ["draw_link", "draw_rival", "draw_switch", "link_head", "sample", "switch_sample"]

_DASHED = (3.2, 2.4)
_DOTTED = (0.9, 1.9)
_DASH_DOT = (5.5, 1.8, 1.1, 1.8)
_BAR = 4.6


def draw_link(sheet: Sheet, route: Route, kind: LinkType, *, z: float = 2) -> None:
    """A link as a smooth line, with a light seam so that lines which cross are told apart."""
    (x, y) = route[-1]
    before = 8.0 if kind is LinkType.PERMANENT else 1.5
    path = _smooth((*route[:-1], (x, y - before)))
    z += 0.1 * kind.strength
    sheet.curve(path, color=PAPER, width=6.0 if kind is LinkType.PERMANENT else 3.6, z=z)
    if kind is LinkType.PERMANENT:
        sheet.curve(path, color=INK, width=3.6, z=z + 0.01)
        sheet.curve(path, color=PAPER, width=1.8, z=z + 0.02)
    else:
        dashes = None if kind is LinkType.ENABLING else _DASHED
        sheet.curve(path, color=INK, width=1.1, dashes=dashes, z=z + 0.01)
    link_head(sheet, x, y - 1.0, kind, z=z + 0.5)


def link_head(sheet: Sheet, x: float, y: float, kind: LinkType, *, z: float) -> None:
    """The head of a link that ends downwards at a point."""
    if kind is LinkType.PERMANENT:
        sheet.polygon([(x, y), (x - 4.6, y - 8.5), (x + 4.6, y - 8.5)], fill=INK, z=z)
    else:
        sheet.line([(x - 3.8, y - 7.0), (x, y), (x + 3.8, y - 7.0)], color=INK, width=1.2, z=z)


def draw_rival(sheet: Sheet, route: Route, *, first_held: bool, last_held: bool, z: float = 2) -> None:
    """What joins rivals: from box to box, with a bar at the end of the one that is kept still."""
    before = [*route]
    for held, end, towards in ((first_held, 0, 1), (last_held, -1, -2)):
        if held:
            before[end] = _short_of(route[end], route[towards])
            _bar(sheet, before[end], route[end], z=z + 0.4)
    downwards = all(above[1] < below[1] for above, below in pairwise(before))
    path = _smooth(tuple(before)) if downwards else Path(before)
    sheet.curve(path, color=PAPER, width=4.0, z=z + 0.3)
    sheet.curve(path, color=INK, width=1.5, dashes=_DOTTED, z=z + 0.31)


def draw_switch(sheet: Sheet, route: Route, *, z: float = 2) -> None:
    """From a case down, across and up to another one."""
    (x, y) = route[-1]
    path = Path([*route[:-1], (x, y + 8.0)])
    sheet.curve(path, color=PAPER, width=3.6, z=z)
    sheet.curve(path, color=INK, width=1.1, dashes=_DASH_DOT, z=z + 0.01)
    sheet.polygon([(x, y + 1.0), (x - 4.4, y + 9.0), (x + 4.4, y + 9.0)], fill=PAPER, border=INK, line=1.1, z=z + 0.5)


def _short_of(end: tuple[float, float], towards: tuple[float, float]) -> tuple[float, float]:
    """A little before the end of a line that arrives upright or level."""
    (x, y), (a, b) = end, towards
    if abs(y - b) < 0.05:
        return x + (2.6 if a > x else -2.6), y
    return x, y + (2.6 if b > y else -2.6)


def _bar(sheet: Sheet, point: tuple[float, float], end: tuple[float, float], *, z: float) -> None:
    (x, y) = point
    ends = [(x, y - _BAR), (x, y + _BAR)] if abs(end[1] - y) < 0.05 else [(x - _BAR, y), (x + _BAR, y)]
    sheet.line(ends, color=INK, width=2.2, cap="butt", z=z)


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


def sample(sheet: Sheet, x: float, y: float, end: float, kind: LinkType) -> None:
    """A link from left to right, for the legend."""
    if kind is LinkType.PERMANENT:
        sheet.line([(x, y), (end - 8, y)], width=3.6, cap="butt")
        sheet.line([(x, y), (end - 8, y)], width=1.8, color=PAPER, cap="butt", z=2.5)
        sheet.polygon([(end, y), (end - 9, y - 4.6), (end - 9, y + 4.6)], fill=INK)
    else:
        dashes = None if kind is LinkType.ENABLING else _DASHED
        sheet.line([(x, y), (end - 1, y)], width=1.1, dashes=dashes, cap="butt")
        sheet.line([(end - 7.5, y - 3.8), (end - 0.5, y), (end - 7.5, y + 3.8)], width=1.2, z=3)


def switch_sample(sheet: Sheet, x: float, y: float, end: float) -> None:
    """A switch from left to right, for the legend."""
    sheet.line([(x, y), (end - 8, y)], width=1.1, dashes=_DASH_DOT, cap="butt")
    sheet.polygon([(end, y), (end - 8, y - 4.4), (end - 8, y + 4.4)], fill=PAPER, border=INK, line=1.1)
