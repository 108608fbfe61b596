"""How a run went, over time (Figure 4.14), and how long many runs took on average (Figure 4.9)."""

from collections.abc import Iterable, Sequence
from statistics import fmean, stdev

from matplotlib.figure import Figure

from understudy.execution.trace import Event, State
from understudy.figures.chart import BAR, Chart, Drawing, KeyItem, Row, TimeAxis, bar_colors
from understudy.figures.labels import label_of
from understudy.figures.sheet import Sheet
from understudy.figures.style import FAINT, INK, MUTED, PAPER, SMALL, SOFT, blend
from understudy.network import Network

__all__ = ["draw_progress", "draw_progress_average"]

_EXECUTING = "#c6cdd6"
_GOAL = 8.0
"""Height of the bar that shows when a goal held; the robot's doings fill the row behind it."""


def draw_progress(
    network: Network,
    events: Iterable[Event],
    duration: float,
    *,
    begin: float = 0.0,
    title: str = "progress",
    subtitle: str = "",
) -> Figure:
    """Draw a run: for every step when its goal held, when it was being done, and when it was achieved.

    Args:
        network: the task.
        events: the run's trace.
        duration: of the run, seconds.
        begin: the first moment on the trace's clock.
        title: above.
        subtitle: below it, for example why the task was not done.
    """
    order = network.topological_order
    events = sorted(events, key=lambda event: event.time_s)
    labels = [label_of(network.by_id[id_]) for id_ in order]
    axis = TimeAxis.beside(labels, 0.0, duration, numbered=True)
    rows = [Row(label=label, number=str(step)) for step, label in enumerate(labels, start=1)]
    chart = Chart(axis, rows, title=title, subtitle=subtitle, above=10.0, right=58.0, key=_KEY)
    sheet = chart.sheet
    for id_, label, middle in zip(order, labels, chart.middles, strict=True):
        mine = [event for event in events if event.component == id_]
        states = [(event.time_s - begin, event.detail.get("state")) for event in mine if event.kind == "state"]
        for start, end, state in _spells(states, duration):
            _doing(sheet, axis.x(start), axis.x(end), middle, str(state))
        goals = [(event.time_s - begin, bool(event.detail.get("holds"))) for event in mine if event.kind == "goal"]
        for start, end, holds in _spells(goals, duration):
            if holds:
                fill, border = bar_colors(label) if label.color else (MUTED, MUTED)
                width = max(axis.x(end) - axis.x(start), 1.2)
                sheet.rectangle(axis.x(start), middle - _GOAL / 2, width, _GOAL, fill=fill, border=border, z=3)
        for event in mine:
            if event.kind == "achieved":
                moment = event.time_s - begin
                _diamond(sheet, axis.x(moment), middle, found=not event.detail.get("on_purpose", True))
                sheet.text(sheet.width - 26.0, middle, f"{moment:.1f} s", align="right")
    for event in events:
        if event.kind == "complete":
            x = axis.x(event.time_s - begin)
            sheet.line([(x, chart.top - 4), (x, chart.bottom)], color=INK, width=1.0, z=2.5)
            text = f"complete {event.time_s - begin:.1f} s"
            sheet.text(x + 1.0, chart.top - 10.0, text, size=SMALL, weight="bold", align="right")
    sheet.text(sheet.width - 26.0, chart.top - 10.0, "achieved", size=SMALL, color=MUTED, align="right")
    return chart.figure


def draw_progress_average(
    network: Network, runs: Sequence[Sequence[tuple[str, float]]], *, title: str = "averaged progress"
) -> Figure:
    """Draw when the steps were achieved in several runs: every run a dot, the mean, and one standard deviation.

    Args:
        network: the task.
        runs: for every run the achieved components with their moments, as in :attr:`RunReport.achieved`.
        title: above.
    """
    order = network.topological_order
    labels = [label_of(network.by_id[id_]) for id_ in order]
    times = {id_: [moment for run in runs for one, moment in run if one == id_] for id_ in order}
    latest = max((moment for moments in times.values() for moment in moments), default=1.0)
    axis = TimeAxis.beside(labels, 0.0, latest * 1.04, numbered=True)
    rows = [Row(label=label, number=str(step), below=4.0) for step, label in enumerate(labels, start=1)]
    chart = Chart(axis, rows, title=title, right=128.0, key=_AVERAGE_KEY)
    sheet = chart.sheet
    means = []
    for id_, label, middle in zip(order, labels, chart.middles, strict=True):
        moments = times[id_]
        summary = f"{len(moments)} of {len(runs)}"
        if moments:
            mean = fmean(moments)
            spread = stdev(moments) if len(moments) > 1 else 0.0
            means.append((axis.x(mean), middle))
            fill, border = bar_colors(label)
            left, right = axis.x(mean - spread), axis.x(mean + spread)
            sheet.rectangle(
                left, middle - BAR / 2, max(right - left, 0.8), BAR, fill=blend(fill, PAPER, 0.62), border="none", z=2.5
            )
            for end in (left, right):
                sheet.line(
                    [(end, middle - BAR / 2), (end, middle + BAR / 2)], color=border, width=1.0, cap="butt", z=2.6
                )
            for index, moment in enumerate(moments):
                # Side by side in height, so that equal moments are still several dots.
                y = middle + (index - (len(moments) - 1) / 2) * min(2.6, (BAR - 4.0) / len(moments))
                sheet.disc(axis.x(moment), y, 2.0, fill=border, border=PAPER, line=0.5, z=3)
            sheet.line(
                [(axis.x(mean), middle - BAR / 2 - 2), (axis.x(mean), middle + BAR / 2 + 2)],
                width=2.2,
                cap="butt",
                z=3.5,
            )
            sheet.text(axis.right + 12, middle, f"{mean:.1f} s ± {spread:.1f} s")
        sheet.text(sheet.width - 26.0, middle, summary, size=SMALL, color=MUTED, align="right")
    if len(means) > 1:
        sheet.line(means, color=FAINT, width=1.0, dashes=(2.0, 2.0), z=2.2)
    return chart.figure


def _spells(changes: Sequence[tuple[float, object]], until: float) -> list[tuple[float, float, object]]:
    """From each change to the next, and from the last one to the end."""
    ends = [*(moment for moment, _ in changes[1:]), max([until, *(moment for moment, _ in changes[-1:])])]
    return [(start, end, value) for (start, value), end in zip(changes, ends, strict=False)]


def _doing(sheet: Sheet, left: float, right: float, middle: float, state: str) -> None:
    if state == State.EXECUTING:
        sheet.rectangle(left, middle - BAR / 2, right - left, BAR, fill=_EXECUTING, z=2)
    elif state == State.SEARCHING:
        sheet.rectangle(
            left, middle - BAR / 2, right - left, BAR, fill=PAPER, border=FAINT, hatch="/////", line=0.6, z=2
        )


def _diamond(sheet: Sheet, x: float, y: float, *, found: bool) -> None:
    corners = [(x, y - 6.5), (x + 5.2, y), (x, y + 6.5), (x - 5.2, y)]
    sheet.polygon(
        corners, fill=PAPER if found else INK, border=INK if found else PAPER, line=1.2 if found else 0.8, z=5
    )


def _goal_sample(sheet: Sheet, x: float, y: float) -> None:
    sheet.rectangle(x, y - _GOAL / 2, 20.0, _GOAL, fill=MUTED)


def _doing_sample(state: State) -> Drawing:
    return lambda sheet, x, y: _doing(sheet, x, x + 20.0, y, state)


def _diamond_sample(found: bool) -> Drawing:
    return lambda sheet, x, y: _diamond(sheet, x + 10.0, y, found=found)


def _dot_sample(sheet: Sheet, x: float, y: float) -> None:
    sheet.disc(x + 10.0, y, 2.0, fill=MUTED, border=PAPER, line=0.5)


def _mean_sample(sheet: Sheet, x: float, y: float) -> None:
    sheet.rectangle(x, y - 5.0, 20.0, 10.0, fill=blend(SOFT, PAPER, 0.3))
    for end in (x, x + 20.0):
        sheet.line([(end, y - 5.0), (end, y + 5.0)], color=MUTED, width=1.0, cap="butt", z=3)
    sheet.line([(x + 10.0, y - 6.5), (x + 10.0, y + 6.5)], width=2.2, cap="butt", z=3)


_KEY: list[KeyItem] = [
    (_goal_sample, "its goal holds"),
    (_doing_sample(State.EXECUTING), "executing"),
    (_doing_sample(State.SEARCHING), "searching"),
    (_diamond_sample(False), "achieved on purpose"),
    (_diamond_sample(True), "already so when its turn came"),
]
_AVERAGE_KEY: list[KeyItem] = [(_dot_sample, "one run"), (_mean_sample, "mean ± standard deviation")]
