"""How long many runs took on average (Figure 4.9)."""

from collections.abc import Sequence
from statistics import fmean, stdev

from matplotlib.figure import Figure

from understudy.figures.chart import BAR, Chart, KeyItem, TimeAxis, bar_colors
from understudy.figures.progress import rows_of
from understudy.figures.sheet import Sheet
from understudy.figures.style import FAINT, MUTED, PAPER, SMALL, SOFT, blend
from understudy.network import Component, Network

__all__ = ["draw_progress_average"]


def draw_progress_average(
    network: Network, runs: Sequence[Sequence[tuple[str, float]]], *, title: str = "averaged progress"
) -> Figure:
    """Draw when the steps were achieved in several runs: every run a dot, the mean, and one standard deviation.

    Args:
        network: the task.
        runs: for every run the achieved components, by path, with their moments, as in :attr:`RunReport.achieved`.
        title: above.
    """
    # Of a step that is achieved several times in a run, in a loop, the last time counts.
    times = {path: [dict(run)[path] for run in runs if path in dict(run)] for path in network.by_path}
    latest = max((moment for moments in times.values() for moment in moments), default=1.0)
    rows = rows_of(network, below=4.0)
    axis = TimeAxis.beside(list(rows.values()), 0.0, latest * 1.04)
    chart = Chart(axis, list(rows.values()), title=title, right=128.0, key=_KEY)
    sheet = chart.sheet
    means = []
    for (path, row), middle in zip(rows.items(), chart.middles, strict=True):
        moments = times[path]
        summary = f"{len(moments)} of {len(runs)}"
        if moments:
            mean = fmean(moments)
            spread = stdev(moments) if len(moments) > 1 else 0.0
            if isinstance(network.by_path[path], Component):
                means.append((axis.x(mean), middle))
            fill, border = bar_colors(row.label)
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


def _dot_sample(sheet: Sheet, x: float, y: float) -> None:
    sheet.disc(x + 10.0, y, 2.0, fill=MUTED, border=PAPER, line=0.5)


def _mean_sample(sheet: Sheet, x: float, y: float) -> None:
    sheet.rectangle(x, y - 5.0, 20.0, 10.0, fill=blend(SOFT, PAPER, 0.3))
    for end in (x, x + 20.0):
        sheet.line([(end, y - 5.0), (end, y + 5.0)], color=MUTED, width=1.0, cap="butt", z=3)
    sheet.line([(x + 10.0, y - 6.5), (x + 10.0, y + 6.5)], width=2.2, cap="butt", z=3)


_KEY: list[KeyItem] = [(_dot_sample, "one run"), (_mean_sample, "mean ± standard deviation")]
