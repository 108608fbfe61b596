"""A behavior network as a picture (Figures 3.10, 4.7, 4.11, 4.13), with the networks that stand in it, to any depth."""

from collections.abc import Mapping

from matplotlib.figure import Figure

from understudy.behaviors import Skill
from understudy.execution.trace import State
from understudy.figures.labels import clean
from understudy.figures.network_boxes import draw_behavior, draw_lines, draw_nab, draw_panel
from understudy.figures.network_legend import Legend
from understudy.figures.network_lines import draw_link, draw_rival, draw_switch
from understudy.figures.network_plan import Plan, plan
from understudy.figures.network_text import Texts, texts_of
from understudy.figures.sheet import Sheet
from understudy.figures.style import PAPER, TITLE, text_width, wrap
from understudy.network import Network

__all__ = ["draw_network"]

_MARGIN = 26.0
_LEVEL = 10.0
"""How much higher what stands in a box is drawn than the box."""


def draw_network(
    network: Network,
    states: Mapping[str, State | str] | None = None,
    skills: Mapping[str, Skill] | None = None,
    *,
    title: str = "",
    depth: int | None = None,
) -> Figure:
    """Draw a network from the top to the bottom.

    Args:
        network: as stored, without the ordering links that others imply.
        states: what components are doing, by path: fill, border, a sign and the word tell it.
        skills: by name; with them, parameters that a component leaves to their defaults are shown, too, and
            conditions are told in the skills' words.
        title: above the picture.
        depth: how many networks in each other are drawn with what stands in them; of deeper ones only the outside.
            None for all of them, 0 for the task's own steps alone.
    """
    texts = texts_of(network, states or {}, skills or {}, depth)
    drawn = plan(network, texts.sizes)
    legend = Legend(drawn, texts, drawn.width)
    headline = wrap(clean(title), max(drawn.width, legend.width, 260.0), TITLE, "bold", lines=2)
    title_width = max((text_width(line, TITLE, "bold") for line in headline), default=0.0)
    top = _MARGIN + (18.0 * len(headline) + 10.0 if headline else 0.0)
    sheet = Sheet(
        max(drawn.width, legend.width, title_width) + 2 * _MARGIN,
        top + drawn.height + (16.0 + legend.height if legend.height else 0.0) + _MARGIN,
        clean(title) or "a behavior network",
    )
    for index, line in enumerate(headline):
        sheet.text(_MARGIN, _MARGIN + 4 + 18 * index, line, size=TITLE, weight="bold")
    _draw(sheet, drawn.moved((sheet.width - drawn.width) / 2, top), texts)
    begin = (sheet.width - legend.width) / 2 if legend.width < drawn.width else _MARGIN
    legend.draw(sheet, begin, top + drawn.height + 16.0)
    return sheet.figure


def _draw(sheet: Sheet, drawn: Plan, texts: Texts) -> None:
    heights = texts.sizes.headings
    for line in drawn.links:
        draw_link(sheet, line.route, line.type, z=_level(line.inside) + 2)
    for rival in drawn.rivals:
        draw_rival(
            sheet, rival.route, first_held=rival.first_held, last_held=rival.last_held, z=_level(rival.inside) + 2.5
        )
    for path, place in drawn.boxes.items():
        z = _level(path) + 4
        if path in texts.headings:
            draw_nab(sheet, place, texts.headings[path], heading=heights[path][1], z=z)
        elif path in texts.closed:
            draw_nab(sheet, place, texts.boxes[path], heading=None, z=z)
        else:
            draw_behavior(sheet, place, texts.boxes[path], z=z)
    for inside, place in drawn.panels.items():
        draw_panel(sheet, place, texts.panels[inside], z=_level(inside) - _LEVEL + 6)
    for switch in drawn.switches:
        z = _level(switch.path) + 8
        draw_switch(sheet, switch.route, z=z)
        sheet.rectangle(*switch.label, fill=PAPER, z=z + 0.6)
        draw_lines(sheet, switch.label.x, switch.label.y, texts.switches[switch.path][switch.number], z=z + 0.7)


def _level(path: str) -> float:
    """How high something is drawn that stands at a path, or among the components whose paths begin so."""
    return _LEVEL * path.count("/")
