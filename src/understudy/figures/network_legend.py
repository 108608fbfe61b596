"""What the lines, borders and signs of a network's picture mean; only what occurs in it."""

from collections.abc import Callable
from dataclasses import dataclass

from understudy.figures.network_boxes import three_lines
from understudy.figures.network_layout import Place
from understudy.figures.network_lines import draw_rival, sample, switch_sample
from understudy.figures.network_plan import Plan
from understudy.figures.network_signs import draw_note_sign
from understudy.figures.network_text import Texts
from understudy.figures.sheet import Sheet
from understudy.figures.style import MUTED, SMALL, text_width
from understudy.network import LinkType

__all__ = ["Legend"]

_SAMPLE = 34.0
_LINE = 17.0
_BETWEEN = 30.0
_MEANING = {
    LinkType.PERMANENT: "holds all the while",
    LinkType.ENABLING: "holds when the next begins",
    LinkType.ORDERING: "has been achieved before",
}
_NOTES = {
    "duty": "stands beside the sequence, done when called",
    "loop": "how often its steps are done",
    "until": "counts as achieved then, too",
    "timeout": "if it takes longer without success",
    "shown": "the other demonstrations went another way",
    "bypassed": "never done, since a direct way leads past it",
}

_Draw = Callable[[Sheet, float, float], None]


@dataclass(frozen=True, slots=True)
class _Entry:
    draw: _Draw
    name: str
    meaning: str


class Legend:
    """The legend of one picture.

    Args:
        plan: what is drawn.
        texts: what is written in it.
        available: points, in which it may take two columns.

    Attributes:
        width, height: of all of it.
    """

    def __init__(self, plan: Plan, texts: Texts, available: float) -> None:
        self._entries = _entries(plan, texts)
        self._name = max((text_width(entry.name, SMALL, "bold") for entry in self._entries), default=0.0)
        meaning = max((text_width(entry.meaning, SMALL) for entry in self._entries), default=0.0)
        self._column = _SAMPLE + 10.0 + self._name + 8.0 + meaning
        count = len(self._entries)
        two = count > 4 and available >= 2 * self._column + _BETWEEN
        self._rows = (count + 1) // 2 if two else count
        self.width = (2 * self._column + _BETWEEN if two else self._column) if count else 0.0
        self.height = _LINE * self._rows

    def draw(self, sheet: Sheet, left: float, top: float) -> None:
        """Draw it from its upper left corner."""
        for index, entry in enumerate(self._entries):
            x = left + (self._column + _BETWEEN) * (index // self._rows)
            y = top + _LINE * (index % self._rows) + _LINE / 2
            entry.draw(sheet, x, y)
            sheet.text(x + _SAMPLE + 10.0, y, entry.name, size=SMALL, weight="bold")
            sheet.text(x + _SAMPLE + 18.0 + self._name, y, entry.meaning, size=SMALL, color=MUTED)


def _entries(plan: Plan, texts: Texts) -> list[_Entry]:
    kinds = {line.type for line in plan.links}
    entries = [_Entry(_link(kind), kind.value, meaning) for kind, meaning in _MEANING.items() if kind in kinds]
    if plan.rivals:
        entries.append(_Entry(_rival, "inhibits", "while it executes, the other keeps still"))
    if texts.headings or texts.closed:
        entries.append(_Entry(_nab, "network", "achieved when its last steps are"))
    if plan.switches:
        entries.append(_Entry(_switch, "switch", "the other case is begun anew"))
    written = {note.kind for text in (*texts.boxes.values(), *texts.headings.values()) for note, _ in text.notes}
    entries += [_Entry(_note(kind), kind, meaning) for kind, meaning in _NOTES.items() if kind in written]
    return entries


def _link(kind: LinkType) -> _Draw:
    return lambda sheet, x, y: sample(sheet, x, y, x + _SAMPLE, kind)


def _rival(sheet: Sheet, x: float, y: float) -> None:
    draw_rival(sheet, ((x, y), (x + _SAMPLE, y)), first_held=False, last_held=True)


def _switch(sheet: Sheet, x: float, y: float) -> None:
    switch_sample(sheet, x, y, x + _SAMPLE)


def _nab(sheet: Sheet, x: float, y: float) -> None:
    three_lines(sheet, Place(x + 3.0, y - 6.5, _SAMPLE - 6.0, 13.0), radius=5.0, z=2)


def _note(kind: str) -> _Draw:
    return lambda sheet, x, y: draw_note_sign(sheet, x + _SAMPLE / 2 - 5.0, y, kind)
