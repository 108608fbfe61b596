"""What was driven in a room, and what happened on the way."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from understudy.execution.trace import Event
from understudy.figures.labels import label_of
from understudy.geometry import Point, Pose
from understudy.network import Component, Network
from understudy.robot import Cue

__all__ = ["Mark", "Trajectory", "marks_of_cues", "marks_of_run"]

_STILL_M = 0.05
"""What moved less than this on its last way tells no direction."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Trajectory:
    """Where something went.

    Attributes:
        name: for the legend: ``robot``, ``teacher``, ``orange box``.
        points: shape ``(n, 3)``: seconds, x and y in the world, metres. A fourth column is the heading in radians;
            without it, the direction of travel is taken.
        color: one of the eight trained colors, or any that Matplotlib knows.
        dashed: drawn dashed.
        body: what is drawn at the end.

    Raises:
        ValueError: the points are no such array.
    """

    name: str
    points: NDArray[np.float64]
    color: str = "#39424f"
    dashed: bool = False
    body: Literal["robot", "person", "box"] = "robot"

    def __post_init__(self) -> None:
        if self.points.ndim != 2 or self.points.shape[1] not in (3, 4):
            raise ValueError(f"points are rows of time, x, y and perhaps heading; given the shape {self.points.shape}")

    def at(self, time_s: float) -> Point:
        """Where it was at a time."""
        times = self.points[:, 0]
        return Point(*(float(np.interp(time_s, times, self.points[:, column])) for column in (1, 2)))

    def resampled(self, step_m: float) -> NDArray[np.float64]:
        """Time, x and y in equal steps along the way, both ends included; standing still leaves no points."""
        points = np.asarray(self.points, dtype=float)[:, :3]
        way = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points[:, 1:], axis=0).T))))
        moving = np.concatenate(([True], np.diff(way) > 0))
        steps = np.linspace(0.0, way[-1], max(2, round(way[-1] / step_m) + 1)) if way[-1] > 0 else way[:1]
        return np.column_stack([np.interp(steps, way[moving], column[moving]) for column in points.T])

    @property
    def last_pose(self) -> Pose:
        """Where it ended, looking where it says or where it last went."""
        x, y = (float(part) for part in self.points[-1, 1:3])
        if self.points.shape[1] > 3:
            return Pose(x, y, float(self.points[-1, 3]))
        for _, x1, y1 in self.points[::-1, :3]:
            if math.hypot(x - x1, y - y1) >= _STILL_M:
                return Pose(x, y, math.atan2(y - y1, x - x1))
        return Pose(x, y, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """Something that happened at a moment, shown as a number in the room and a line beside it.

    Attributes:
        time_s: on the trajectory's clock.
        text: ``Track green``, ``HERE``.
        color: a trained color to show with it.
        on: the name of the trajectory; empty for the first one.
        found: it was found to be so, and not brought about: an open badge.
    """

    time_s: float
    text: str
    color: str = ""
    on: str = ""
    found: bool = False


def marks_of_run(events: Iterable[Event], network: Network, *, on: str = "") -> tuple[Mark, ...]:
    """A mark for every step that was achieved. A network is achieved where its last step is, and needs no own mark."""
    marks = []
    for event in events:
        component = network.by_path.get(event.component)
        if event.kind == "achieved" and isinstance(component, Component):
            named = label_of(component)
            found = not event.detail.get("on_purpose", True)
            marks.append(Mark(time_s=event.time_s, text=named.title, color=named.color, on=on, found=found))
    return tuple(marks)


def marks_of_cues(cues: Iterable[tuple[float, Cue]], *, on: str = "") -> tuple[Mark, ...]:
    """A mark for every word of the teacher."""
    return tuple(Mark(time_s=time_s, text=cue.value, on=on) for time_s, cue in cues)
