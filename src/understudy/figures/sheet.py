"""A sheet of paper, measured in points from its upper left corner. Everything that is drawn knows how large it is."""

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyBboxPatch, PathPatch, Polygon, Rectangle
from matplotlib.path import Path
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

from understudy.figures.style import BODY, CAP_HEIGHT, FAMILY, INK, PAPER, drawable, edge, paint

__all__ = ["DPI", "Sheet"]

DPI = 160

Align = Literal["left", "center", "right"]
Dashes = Sequence[float]


def _line_style(dashes: Dashes | None) -> Any:
    """What matplotlib calls a line of these dashes."""
    return (0, tuple(dashes)) if dashes else "solid"


class Sheet:
    """A figure with one pair of axes that covers it: x to the right, y downwards, both in points.

    Args:
        width: points.
        height: points.
        title: what it shows, for readers of the file.
    """

    def __init__(self, width: float, height: float, title: str = "") -> None:
        self.width, self.height = width, height
        self.figure = Figure(figsize=(width / 72, height / 72), dpi=DPI, facecolor=PAPER)
        self.figure.set_label(title)
        FigureCanvasAgg(self.figure)
        self.axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set_axis_off()
        self.axes.set_xlim(0, width)
        self.axes.set_ylim(height, 0)

    def text(
        self,
        x: float,
        y: float,
        text: str,
        *,
        size: float = BODY,
        color: str = INK,
        weight: str = "normal",
        align: Align = "left",
        z: float = 6,
        halo: float = 0.0,
    ) -> None:
        """One line whose capitals are centred on ``y``."""

        self.axes.text(
            x,
            y + size * CAP_HEIGHT / 2,
            drawable(text),
            size=size,
            color=color,
            weight=weight,
            family=FAMILY,
            ha=align,
            va="baseline",
            zorder=z,
            parse_math=False,
            path_effects=[withStroke(linewidth=halo, foreground=PAPER)] if halo else None,
        )

    def line(
        self,
        points: Sequence[tuple[float, float]] | NDArray[np.float64],
        *,
        color: str = INK,
        width: float = 0.8,
        dashes: Dashes | None = None,
        z: float = 2,
        cap: Literal["butt", "round", "projecting"] = "round",
    ) -> None:
        """A line through the points."""
        xs, ys = np.asarray(points, dtype=float).T
        [line] = self.axes.plot(
            xs, ys, color=color, linewidth=width, linestyle=_line_style(dashes), zorder=z, marker=""
        )
        line.set_snap(False)  # else two lines, one on the other, are not centred on each other
        line.set_dash_capstyle(cap)
        line.set_solid_capstyle(cap)
        line.set_solid_joinstyle("round")

    def strokes(
        self, segments: Sequence[NDArray[np.float64]], colors: Sequence[str] | str, *, width: float, z: float = 3
    ) -> None:
        """Many short lines at once, each in its own color."""
        self.axes.add_collection(
            LineCollection(
                list(segments), colors=colors, linewidths=width, capstyle="round", joinstyle="round", zorder=z
            ),
            autolim=False,
        )

    def rectangle(
        self,
        x: float,
        y: float,
        width: float,
        height: float,
        *,
        fill: str = "none",
        border: str = "none",
        line: float = 0.8,
        radius: float = 0.0,
        dashes: Dashes | None = None,
        hatch: str | None = None,
        z: float = 2,
    ) -> None:
        """A box from its upper left corner; the hatching takes the border's color."""
        kind: dict[str, Any] = {
            "facecolor": fill,
            "edgecolor": border,
            "linewidth": line if border != "none" else 0,
            "linestyle": _line_style(dashes),
            "hatch": hatch,
            "hatch_linewidth": 0.6,
            "zorder": z,
        }
        if radius:
            shape = f"round,pad=0,rounding_size={radius}"
            self.axes.add_patch(FancyBboxPatch((x, y), width, height, boxstyle=shape, mutation_aspect=1, **kind))
        else:
            self.axes.add_patch(Rectangle((x, y), width, height, **kind))

    def disc(
        self,
        x: float,
        y: float,
        radius: float,
        *,
        fill: str = "none",
        border: str = INK,
        line: float = 0.8,
        dashes: Dashes | None = None,
        z: float = 4,
    ) -> None:
        """A circle."""
        self.axes.add_patch(
            Circle(
                (x, y),
                radius,
                facecolor=fill,
                edgecolor=border,
                linewidth=line,
                linestyle=_line_style(dashes),
                zorder=z,
            )
        )

    def polygon(
        self,
        corners: Sequence[tuple[float, float]] | NDArray[np.float64],
        *,
        fill: str = "none",
        border: str = "none",
        line: float = 0.8,
        dashes: Dashes | None = None,
        z: float = 4,
    ) -> None:
        """A closed shape."""
        self.axes.add_patch(
            Polygon(
                np.asarray(corners, dtype=float),
                closed=True,
                facecolor=fill,
                edgecolor=border,
                linewidth=line if border != "none" else 0,
                linestyle=_line_style(dashes),
                joinstyle="round",
                zorder=z,
            )
        )

    def curve(self, path: Path, *, color: str, width: float, dashes: Dashes | None = None, z: float = 2) -> None:
        """An open curve."""
        self.axes.add_patch(
            PathPatch(
                path,
                fill=False,
                edgecolor=color,
                linewidth=width,
                linestyle=_line_style(dashes),
                capstyle="butt",
                joinstyle="round",
                snap=False,
                zorder=z,
            )
        )

    def chip(self, x: float, y: float, color: str, *, size: float = 8.0, z: float = 5) -> None:
        """A swatch of a trained color, its left edge at ``x``, centred on ``y``; nothing for no color."""
        if color:
            self.rectangle(
                x, y - size / 2, size, size, fill=paint(color), border=edge(color), line=0.8, radius=size / 4, z=z
            )
