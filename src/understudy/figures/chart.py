"""Rows over time: what all the timelines have in common. Labels to the left, seconds below, nothing else."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from understudy.figures.labels import Label, clean
from understudy.figures.sheet import Sheet
from understudy.figures.style import (
    BODY,
    FAINT,
    HAIR,
    MUTED,
    SMALL,
    SOFT,
    TITLE,
    edge,
    paint,
    text_width,
    wrap,
)

__all__ = ["BAR", "Chart", "Drawing", "KeyItem", "Row", "TimeAxis", "bar_colors", "lanes"]

BAR = 15.0
"""Height of a bar."""

_MARGIN = 26.0
_LABEL = 190.0
_SPAN = 470.0
_LINE = 12.0
_NUMBER = 18.0
_CHIP = 15.0
_LONG_AGO_S = 1e5
"""A clock that shows more than a day, such as a recording's, says nothing to a reader."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One row: its label, and how much room it takes below its bar.

    Attributes:
        label: to the left.
        number: before the label, where rows are steps.
        indent: how much farther to the right both stand, points.
        below: points.
    """

    label: Label
    number: str = ""
    indent: float = 0.0
    below: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class TimeAxis:
    """Where moments are on the sheet.

    Attributes:
        start, end: seconds.
        left, right: points.
        indent: where labels begin, points: after the numbers and chips, where there are any.
        zero: what the numbers below the rows count from: 0, or the start on a clock that began long ago.
    """

    start: float
    end: float
    left: float
    right: float
    indent: float
    zero: float = 0.0

    @classmethod
    def beside(cls, rows: Sequence[Row], start: float, end: float) -> "TimeAxis":
        """An axis to the right of the rows' labels."""
        widest = 0.0
        for row in rows:
            lines = [text_width(line, BODY, "bold") for line in _title(row.label)]
            lines += [text_width(line, SMALL) for line in _details(row.label)]
            widest = max([widest, *(row.indent + line for line in lines)])
        number = max((text_width(row.number, SMALL) for row in rows), default=0.0)
        indent = _MARGIN + (max(_NUMBER, number + 6.0) if number else 0.0)
        indent += _CHIP if any(row.label.color for row in rows) else 0.0
        left = indent + widest + 16.0
        zero = start if abs(start) >= _LONG_AGO_S else 0.0
        end = max(end, start + 1e-3)
        return cls(start=start, end=end, left=left, right=left + _SPAN, indent=indent, zero=zero)

    def x(self, time_s: float) -> float:
        """Where a moment is; what lies outside is drawn at the edge."""
        part = (min(max(time_s, self.start), self.end) - self.start) / (self.end - self.start)
        return self.left + part * (self.right - self.left)


Drawing = Callable[[Sheet, float, float], None]
"""Draws a sample, 20 points wide, its left edge at the first number and its middle at the second."""

KeyItem = tuple[Drawing, str]
"""A sample, and what it means."""


class Chart:
    """A sheet with rows over time.

    Args:
        axis: beside the labels of the rows.
        rows: from the top to the bottom.
        title: above.
        subtitle: a line or two below it.
        above: points between title and rows.
        right: points to the right of the rows.
        key: samples below, with their meaning.

    Attributes:
        middles: the middle of every row's bar, points.
        top, bottom: of all rows, points.
    """

    def __init__(
        self,
        axis: TimeAxis,
        rows: Sequence[Row],
        *,
        title: str = "",
        subtitle: str = "",
        above: float = 0.0,
        right: float = 14.0,
        key: Sequence[KeyItem] = (),
    ) -> None:
        self.axis = axis
        width = axis.right + right + _MARGIN
        headline = wrap(clean(title), width - 2 * _MARGIN, TITLE, "bold", lines=2)
        below = wrap(clean(subtitle), width - 2 * _MARGIN, BODY, lines=2)
        self.top = _MARGIN + 18.0 * len(headline) + 14.0 * len(below) + (6.0 if headline or below else 0.0) + above
        heights = [max(25.0, BAR + 9.0 + row.below, _text_height(row.label) + 10.0) for row in rows]
        self.bottom = self.top + sum(heights)
        places = _flow([_sample_width(text) for _, text in key], width - 2 * _MARGIN)
        lines_of_key = places[-1][1] + 1 if places else 0
        height = self.bottom + 20.0 + (12.0 + 17.0 * lines_of_key if key else 0.0) + _MARGIN - 8.0
        self.sheet = Sheet(width, height, clean(title))
        for index, line in enumerate(headline):
            self.sheet.text(_MARGIN, _MARGIN + 4 + 18 * index, line, size=TITLE, weight="bold")
        for index, line in enumerate(below):
            self.sheet.text(_MARGIN, _MARGIN + 4 + 18 * len(headline) + 14 * index, line, color=MUTED)
        self.middles: list[float] = []
        y = self.top
        self._rule(y)
        for row, height in zip(rows, heights, strict=True):
            self.middles.append(y + (height - row.below) / 2)
            self._label(row, self.middles[-1])
            y += height
            self._rule(y)
        self._seconds()
        for (draw, text), (x, line_of_key) in zip(key, places, strict=True):
            key_y = self.bottom + 36.0 + 17.0 * line_of_key
            draw(self.sheet, _MARGIN + x, key_y)
            self.sheet.text(_MARGIN + x + 28.0, key_y, text, size=SMALL, color=MUTED)

    @property
    def figure(self) -> Figure:
        """The picture."""
        return self.sheet.figure

    def _label(self, row: Row, middle: float) -> None:
        title, details = _title(row.label), _details(row.label)
        y = middle - _LINE * (len(title) + len(details) - 1) / 2
        left = self.axis.indent + row.indent
        self.sheet.text(_MARGIN + row.indent, y, row.number, size=SMALL, color=MUTED)
        self.sheet.chip(left - _CHIP, y, row.label.color, size=9.0)
        for line in title:
            self.sheet.text(left, y, line, weight="bold")
            y += _LINE
        for line in details:
            self.sheet.text(left, y, line, size=SMALL, color=MUTED)
            y += _LINE

    def _rule(self, y: float) -> None:
        self.sheet.line([(_MARGIN, y), (self.axis.right, y)], color=HAIR, width=0.7, cap="butt", z=1)

    def _seconds(self) -> None:
        y = self.bottom
        start, end = self.axis.start - self.axis.zero, self.axis.end - self.axis.zero
        ticks = MaxNLocator(nbins=8, steps=[1, 2, 2.5, 5, 10]).tick_values(start, end)
        shown = [float(tick) for tick in ticks if start - 1e-9 <= tick <= end + 1e-9]
        for tick in shown:
            x = self.axis.x(tick + self.axis.zero)
            self.sheet.line([(x, self.top), (x, y)], color=HAIR, width=0.7, cap="butt", z=1)
            self.sheet.line([(x, y), (x, y + 3.5)], color=FAINT, width=0.8, cap="butt", z=1)
            unit = " s" if tick == shown[-1] else ""
            # The unit stands beside the last number, which keeps its place under the tick.
            shift = text_width(unit, SMALL) / 2
            self.sheet.text(x + shift, y + 11.0, f"{tick:g}{unit}", size=SMALL, color=MUTED, align="center")
        self.sheet.line([(self.axis.left, y), (self.axis.right, y)], color=FAINT, width=0.8, cap="butt", z=1.5)


def bar_colors(label: Label) -> tuple[str, str]:
    """Fill and border of a bar: the color of what the behavior is about, or grey."""
    return (paint(label.color), edge(label.color)) if label.color else (SOFT, MUTED)


def lanes(spans: Iterable[tuple[float, float]]) -> list[int]:
    """For every span the first lane, from 0, in which it overlaps none that came before it."""
    ends: list[list[tuple[float, float]]] = []
    chosen = []
    for start, end in spans:
        lane = next(
            (index for index, taken in enumerate(ends) if all(end <= a or start >= b for a, b in taken)), len(ends)
        )
        if lane == len(ends):
            ends.append([])
        ends[lane].append((start, end))
        chosen.append(lane)
    return chosen


def _title(label: Label) -> tuple[str, ...]:
    return wrap(label.title, _LABEL, BODY, "bold", lines=2)


def _details(label: Label) -> tuple[str, ...]:
    return wrap(label.details, _LABEL, SMALL, lines=1)


def _text_height(label: Label) -> float:
    return _LINE * (len(_title(label)) + len(_details(label)))


def _sample_width(text: str) -> float:
    return 28.0 + text_width(text, SMALL) + 20.0


def _flow(widths: Sequence[float], available: float) -> list[tuple[float, int]]:
    """Places side by side, and in the next line where one is full: ``(x, line)``."""
    places = []
    x, line = 0.0, 0
    for width in widths:
        if x > 0 and x + width - 20.0 > available:
            x, line = 0.0, line + 1
        places.append((x, line))
        x += width
    return places
