"""The boxes of a network's picture: behaviors with one line around them, NABs with three (Figure 3.10)."""

from understudy.execution.trace import State
from understudy.figures.network_layout import Place
from understudy.figures.network_plan import BORDER
from understudy.figures.network_signs import draw_note_sign, draw_state_sign
from understudy.figures.network_text import CHIP, LINE, PAD, BoxText, Lines
from understudy.figures.sheet import Sheet
from understudy.figures.style import FAINT, INK, MUTED, PAPER, SMALL

__all__ = ["draw_behavior", "draw_lines", "draw_nab", "draw_panel", "three_lines"]

_QUIET = (State.WAITING, State.INHIBITED, State.RESTING, State.UNUSED, State.SKIPPED, State.BYPASSED)
_BUSY = (State.EXECUTING, State.SEARCHING)
_RADIUS = 7.0
_CHIP = 10.0


def draw_behavior(sheet: Sheet, place: Place, text: BoxText, *, z: float) -> None:
    """The box of a behavior."""
    state = text.state
    sheet.rectangle(
        *place,
        fill=_fill(state),
        border=FAINT if state in _QUIET or text.bypassed else INK,
        line=2.2 if state in _BUSY else 1.0,
        radius=_RADIUS,
        dashes=(2.6, 1.6) if state is State.SEARCHING or text.bypassed else None,
        z=z,
    )
    _write(sheet, place, text, z=z + 1)


def draw_nab(sheet: Sheet, place: Place, text: BoxText, *, heading: float | None, z: float) -> None:
    """The box of a NAB.

    Args:
        sheet: to draw on.
        place: of all of it.
        text: in its heading.
        heading: how high that is, points; None if there is nothing else in it.
        z: of the border; what stands in it is drawn higher.
    """
    three_lines(sheet, place, radius=_RADIUS + 2.0, z=z, state=text.state)
    top = Place(place.x + BORDER, place.y + BORDER, place.width - 2 * BORDER, place.height - 2 * BORDER)
    _write(sheet, top if heading is None else top._replace(height=heading), text, z=z + 1)


def three_lines(sheet: Sheet, place: Place, *, radius: float, z: float, state: State | None = None) -> None:
    """A border of three lines, in the place that it may take."""
    x, y, width, height = place
    ink = FAINT if state in _QUIET else INK
    for index in range(3):
        inset = index * BORDER / 2
        inner = index == 2
        sheet.rectangle(
            x + inset,
            y + inset,
            width - 2 * inset,
            height - 2 * inset,
            fill=_fill(state) if inner else PAPER,
            border=ink,
            line=(1.8 if inner and state in _BUSY else 0.8),
            radius=max(1.0, radius - inset),
            dashes=(2.6, 1.6) if inner and state is State.SEARCHING else None,
            z=z + 0.01 * index,
        )


def draw_panel(sheet: Sheet, place: Place, lines: Lines, *, z: float) -> None:
    """A case: a light frame with its name and condition."""
    sheet.rectangle(*place, fill=PAPER, border=FAINT, line=0.8, radius=5.0, z=z)
    draw_lines(sheet, place.x + 12.0, place.y + 8.0, lines, z=z + 1)


def draw_lines(sheet: Sheet, x: float, y: float, lines: Lines, *, z: float) -> None:
    """A few lines from their upper left corner."""
    y += LINE / 2
    if lines.title:
        sheet.text(x, y, lines.title, size=SMALL, weight="bold", z=z)
        y += LINE
    for line in lines.text:
        sheet.text(x, y, line, size=SMALL, color=MUTED, z=z)
        y += LINE


def _fill(state: State | None) -> str:
    return "#e6f0e8" if state is State.ACHIEVED else "#fff8e6" if state in _BUSY else PAPER


def _write(sheet: Sheet, place: Place, text: BoxText, *, z: float) -> None:
    state = text.state
    ink = MUTED if state in _QUIET or text.bypassed else INK
    y = place.y + place.height / 2 - LINE * (text.lines - 1) / 2
    sheet.text(place.x + PAD, y, text.number, size=SMALL, color=MUTED, z=z)
    x = place.x + text.indent
    sheet.chip(x, y, text.label.color, size=_CHIP, z=z)
    for line in text.title:
        sheet.text(x + text.chip, y, line, weight="bold", color=ink, z=z)
        y += LINE
    for line in text.details:
        sheet.text(x + text.chip, y, line, size=SMALL, color=MUTED, z=z)
        y += LINE
    for note, lines in text.notes:
        draw_note_sign(sheet, x, y, note.kind, z=z)
        for line in lines:
            sheet.text(x + CHIP, y, line, size=SMALL, color=MUTED, z=z)
            y += LINE
    if state:
        weight = "bold" if state in _BUSY else "normal"
        sheet.text(x + text.chip, y, state.value, size=SMALL, color=ink, weight=weight, z=z)
        draw_state_sign(sheet, place.x + place.width - 14.0, place.y + place.height / 2, state, z=z)
