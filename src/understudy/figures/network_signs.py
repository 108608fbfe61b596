"""Small signs in the boxes of a network: for states and for controls, to be told without color and without reading."""

import math

from understudy.execution.trace import State
from understudy.figures.sheet import Sheet
from understudy.figures.style import FAINT, INK, MUTED, PAPER

__all__ = ["draw_note_sign", "draw_state_sign"]


def draw_state_sign(sheet: Sheet, x: float, y: float, state: State, *, z: float = 6) -> None:
    """A sign for a state, centred on a point."""
    match state:
        case State.ACHIEVED:
            sheet.line([(x - 4.5, y), (x - 1.5, y + 3.5), (x + 4.5, y - 4)], color="#2f7d4a", width=2.0, z=z)
        case State.EXECUTING:
            sheet.polygon([(x - 3, y - 4.5), (x + 4.5, y), (x - 3, y + 4.5)], fill=INK, z=z)
        case State.SEARCHING:
            sheet.disc(x - 1, y - 1, 3.4, border=INK, line=1.4, z=z)
            sheet.line([(x + 1.6, y + 1.6), (x + 4.6, y + 4.6)], color=INK, width=1.6, z=z)
        case State.WAITING:
            for step in (-4.0, 0.0, 4.0):
                sheet.disc(x + step, y, 1.0, fill=FAINT, border=FAINT, line=0.4, z=z)
        case State.INHIBITED:
            sheet.disc(x, y, 4.2, border=FAINT, line=1.4, z=z)
            sheet.line([(x - 2.9, y + 2.9), (x + 2.9, y - 2.9)], color=FAINT, width=1.4, z=z)
        case State.SKIPPED:
            for step in (-3.4, 1.0):
                sheet.line([(x + step, y - 3.6), (x + step + 3, y), (x + step, y + 3.6)], color=MUTED, width=1.4, z=z)
        case State.BYPASSED:
            _past(sheet, x, y, color=FAINT, z=z)
        case State.RESTING:
            for step in (-1.8, 1.8):
                sheet.line([(x + step, y - 3.8), (x + step, y + 3.8)], color=FAINT, width=1.8, z=z)
        case State.UNUSED:
            sheet.line([(x - 3.6, y), (x + 3.6, y)], color=FAINT, width=1.6, z=z)


def draw_note_sign(sheet: Sheet, x: float, y: float, kind: str, *, z: float = 6) -> None:
    """A sign for a control, ten points wide, from its left edge."""
    x += 5.0
    match kind:
        case "loop":
            turn = [math.radians(angle) for angle in range(-50, 231, 10)]
            sheet.line([(x + 3.6 * math.sin(a), y + 3.6 * math.cos(a)) for a in turn], color=MUTED, width=1.2, z=z)
            tip = (x - 3.6 * math.sin(math.radians(50)), y + 3.6 * math.cos(math.radians(50)))
            sheet.polygon(
                [(tip[0] - 2.9, tip[1] + 0.9), (tip[0] + 1.9, tip[1] + 2.0), (tip[0] - 0.4, tip[1] - 2.8)],
                fill=MUTED,
                z=z,
            )
        case "timeout":
            corners = [(x - 3.2, y - 4.2), (x + 3.2, y - 4.2), (x - 3.2, y + 4.2), (x + 3.2, y + 4.2)]
            sheet.polygon(corners, border=MUTED, line=1.1, z=z)
            sheet.polygon([(x, y + 0.8), (x + 2.2, y + 3.8), (x - 2.2, y + 3.8)], fill=MUTED, z=z)
        case "until":
            sheet.line([(x - 2.8, y + 4.2), (x - 2.8, y - 4.2)], color=MUTED, width=1.2, z=z)
            sheet.polygon([(x - 2.8, y - 4.2), (x + 4.0, y - 2.0), (x - 2.8, y + 0.4)], fill=MUTED, z=z)
        case "shown":
            for step in (-3.6, 0.0, 3.6):
                filled = MUTED if step < 0 else PAPER
                sheet.disc(x + step, y, 1.4, fill=filled, border=MUTED, line=0.8, z=z)
        case "bypassed":
            _past(sheet, x, y, color=MUTED, z=z)
        case _:
            sheet.disc(x, y, 4.2, fill=PAPER, border=MUTED, line=1.1, z=z)
            sheet.line([(x, y - 2.6), (x, y), (x + 2.2, y + 1.2)], color=MUTED, width=1.1, z=z)


def _past(sheet: Sheet, x: float, y: float, *, color: str, z: float) -> None:
    """An arrow that goes around a dot."""
    turn = [math.radians(angle) for angle in range(-90, 91, 15)]
    sheet.disc(x - 1.6, y, 1.2, fill=color, border=color, line=0.4, z=z)
    sheet.line([(x - 1.6 + 4.0 * math.cos(a), y + 4.0 * math.sin(a)) for a in turn], color=color, width=1.2, z=z)
    sheet.polygon([(x - 3.4, y + 4.0), (x, y + 1.8), (x, y + 6.2)], fill=color, z=z)
