"""What was observed in a demonstration, over time (Figure 4.8), and what became of it."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from understudy.figures.chart import BAR, Chart, Drawing, KeyItem, Row, TimeAxis, bar_colors, lanes
from understudy.figures.labels import Label, clean, label, number
from understudy.figures.sheet import Sheet
from understudy.figures.style import INK, MUTED, PAPER, SMALL, SOFT, blend, contrast, elide, text_width
from understudy.learning.learner import Lesson
from understudy.learning.observations import Demonstration, Observed
from understudy.learning.settings import DISTANCE
from understudy.robot import Cue

__all__ = ["draw_observations"]

_PRINT = 10.5
"""From one line of small print to the next."""
_WORD = 11.0
_FAR_M = 2.0
"""The height of a bar: what was last seen farther away does not count as visited (§4.4.1)."""
_FULLEST = 300.0
"""The longest small print."""
_POINTS = 240


@dataclass(frozen=True, slots=True, kw_only=True)
class _Bar:
    """One observation, and the small print below it: its values, or why it was left out."""

    observed: Observed
    left_out: bool
    text: str


@dataclass(slots=True, kw_only=True)
class _Line:
    """All observations of one kind, with the lanes of their small print."""

    label: Label
    bars: list[_Bar]
    lanes: list[int]

    @property
    def below(self) -> float:
        return _PRINT * (max(self.lanes, default=-1) + 1) + (2.0 if self.lanes else 0.0)


def draw_observations(
    seen: Demonstration | Lesson, *, cues: Iterable[tuple[float, Cue]] | None = None, title: str | None = None
) -> Figure:
    """Draw when which goal was observed, a row for each kind of observation.

    Of a lesson, what was kept is solid, and what was left out is hatched, with the reason below it.

    Args:
        seen: a demonstration, or what was learned from it.
        cues: the teacher's words; if left out, those that are known: all of a demonstration, the ones on
            observations of a lesson.
        title: the demonstration's name if left out.
    """
    bars: list[_Bar]
    if isinstance(seen, Lesson):
        name = seen.demonstration
        bars = [_Bar(observed=observed, left_out=False, text=_values(observed)) for observed in seen.kept]
        bars += [_Bar(observed=item.observed, left_out=True, text=item.reason) for item in seen.dropped]
        known = {cue for bar in bars for cue in bar.observed.cues}
        span: tuple[float, ...] = ()
    else:
        name, known, span = seen.name, set(seen.cues), seen.span
        bars = [_Bar(observed=observed, left_out=False, text=_values(observed)) for observed in seen.observations]
    bars.sort(key=lambda bar: bar.observed.interval.start)
    words = sorted(known if cues is None else cues)
    moments = [*span, *(time for time, _ in words), *(moment for bar in bars for moment in bar.observed.interval)]
    start, end = min(moments, default=0.0), max(moments, default=1.0)
    if 0 < start < 0.2 * end:
        start = 0.0
    return _draw(bars, words, start, end, name if title is None else title)


def _values(observed: Observed) -> str:
    return ", ".join(number(name, value) for name, value in observed.values.items())


def _draw(bars: Sequence[_Bar], words: Sequence[tuple[float, Cue]], start: float, end: float, title: str) -> Figure:
    rows: dict[object, _Line] = {}
    for bar in bars:
        instance = bar.observed.instance
        named = label(instance.behavior, dict(instance.parameters))
        rows.setdefault(instance, _Line(label=named, bars=[], lanes=[])).bars.append(bar)
    axis = TimeAxis.beside([Row(label=row.label) for row in rows.values()], start, end)
    for row in rows.values():
        spans = [_print_span(axis, bar) for bar in row.bars]
        taken = iter(lanes([span for span in spans if span is not None]))
        row.lanes = [next(taken) if span is not None else -1 for span in spans]
    # Words are flags to the right of their lines. A flag flies above those to its right: no line runs through it.
    flags = [(axis.x(time), axis.x(time) + text_width(word.value, SMALL, "bold") + 8.0) for time, word in words]
    heights = _flying(flags)
    chart = Chart(
        axis,
        [Row(label=row.label, below=row.below) for row in rows.values()],
        title=title,
        above=_WORD * (max(heights, default=-1) + 1) + (6.0 if words else 0.0),
        key=_key(bars),
    )
    for (time, word), lane in zip(words, heights, strict=True):
        x, y = axis.x(time), chart.top - 9.0 - _WORD * lane
        chart.sheet.line([(x, y - 4.0), (x, chart.bottom)], color=INK, width=0.8, dashes=(1.2, 2.2), z=4)
        chart.sheet.text(x + 3.0, y, word.value, size=SMALL, weight="bold")
    for row, middle in zip(rows.values(), chart.middles, strict=True):
        for bar, lane in zip(row.bars, row.lanes, strict=True):
            _bar(chart.sheet, axis, bar, row.label, middle)
            span = _print_span(axis, bar)
            if span is not None:
                y = middle + BAR / 2 + 7.0 + _PRINT * lane
                chart.sheet.text(span[0], y, _print(bar), size=SMALL, color=MUTED, halo=2.0)
    return chart.figure


def _flying(flags: Sequence[tuple[float, float]]) -> list[int]:
    """For every flag, given from left to right, the lowest line above all that begin within its length."""
    heights = [0] * len(flags)
    for index in reversed(range(len(flags))):
        under = [heights[other] for other in range(index + 1, len(flags)) if flags[other][0] < flags[index][1]]
        heights[index] = max(under, default=-1) + 1
    return heights


def _print(bar: _Bar) -> str:
    return elide(clean(bar.text), _FULLEST, SMALL)


def _print_span(axis: TimeAxis, bar: _Bar) -> tuple[float, float] | None:
    """From where to where the small print runs: from the bar's beginning, unless the sheet ends before."""
    if not bar.text:
        return None
    width = text_width(_print(bar), SMALL)
    begin = min(axis.x(bar.observed.interval.start), axis.right - width)
    return begin, begin + width + 10.0


def _bar(sheet: Sheet, axis: TimeAxis, bar: _Bar, named: Label, middle: float) -> None:
    start, end = bar.observed.interval
    left, fill, border = axis.x(start), *bar_colors(named)
    width = max(axis.x(end) - left, 1.6)
    if bar.left_out:
        fill, border = blend(fill, PAPER, 0.8), blend(border, PAPER, 0.35)
    sheet.rectangle(
        left,
        middle - BAR / 2,
        width,
        BAR,
        fill=fill,
        border=border,
        line=0.9,
        hatch="/////" if bar.left_out else None,
        z=3,
    )
    history = bar.observed.history
    if history is None or DISTANCE not in history.names or len(history.times) < 2:
        return
    some = np.linspace(0, len(history.times) - 1, min(_POINTS, len(history.times))).astype(int)
    metres = np.clip(history.values[some, history.names.index(DISTANCE)], 0.0, _FAR_M)
    xs = np.array([axis.x(float(time)) for time in history.times[some]])
    ys = middle + BAR / 2 - 1.5 - (BAR - 3.0) * metres / _FAR_M
    color = MUTED if bar.left_out else PAPER if contrast(fill, PAPER) > contrast(fill, INK) else INK
    sheet.line(np.column_stack([xs, ys]), color=color, width=1.0, z=3.5)


def _key(bars: Sequence[_Bar]) -> list[KeyItem]:
    key: list[KeyItem] = []
    if any(bar.left_out for bar in bars):
        key.append((_sample(SOFT, MUTED, None), "became a step"))
        key.append((_sample(blend(SOFT, PAPER, 0.6), blend(MUTED, PAPER, 0.35), "/////"), "left out"))
    if any(bar.observed.history and DISTANCE in bar.observed.history.names for bar in bars):
        key.append((_curve_sample, f"distance, 0 to {_FAR_M:g} m from the bottom to the top of a bar"))
    return key


def _sample(fill: str, border: str, hatch: str | None) -> Drawing:
    def draw(sheet: Sheet, x: float, y: float) -> None:
        sheet.rectangle(x, y - 5.0, 20.0, 10.0, fill=fill, border=border, line=0.9, hatch=hatch)

    return draw


def _curve_sample(sheet: Sheet, x: float, y: float) -> None:
    xs = np.linspace(0, 20, 21)
    sheet.line(np.column_stack([x + xs, y - 4 * np.cos(xs / 20 * 2 * np.pi)]), color=INK, width=1.0)
