"""The room from above, to scale, with what was driven in it (Figures 4.6, 4.10, 4.12)."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from understudy.figures.labels import clean
from understudy.figures.placement import Placer, Rect
from understudy.figures.sheet import Sheet
from understudy.figures.style import (
    BODY,
    FLOOR,
    HAIR,
    INK,
    MUTED,
    PAPER,
    SMALL,
    TITLE,
    blend,
    edge,
    elide,
    paint,
    text_width,
    wrap,
)
from understudy.figures.trajectories import Mark, Trajectory
from understudy.geometry import Point, Pose
from understudy.robot import PIONEER

if TYPE_CHECKING:
    from understudy.sim.world import Door, World

__all__ = ["draw_arena"]

_LARGEST = (400.0, 470.0)
"""Width and height of the room on paper, points, at most."""
_MARGIN = 26.0
_PANEL = 178.0
_BETWEEN = 26.0
_ROW = 16.0
_BADGE = 6.6
_SCALE_BAR = 22.0
_SWUNG_DEG = 3.0
_LEAF = "#8a6f4e"
"""Wood: none of the eight colors."""
_OTHER = blend(INK, FLOOR, 0.72)
_STEP_M = 0.03
_ARROWS_M = 0.9
"""Trajectories are drawn in steps of three centimetres, with an arrow head every so many metres."""


def draw_arena(
    world: "World",
    trajectories: Sequence[Trajectory] = (),
    marks: Sequence[Mark] = (),
    *,
    title: str | None = None,
    subtitle: str = "",
    note: str = "",
    doors: Sequence[float] = (),
    others: Sequence[NDArray[np.float64]] = (),
) -> Figure:
    """Draw a room with trajectories and marks.

    Args:
        world: the room as it was at the beginning.
        trajectories: drawn in this order; they grow darker with time.
        marks: numbered in the order of time.
        title: the world's name if left out.
        subtitle: a line or two below it.
        doors: how far each door was open in the end, degrees; left out, they are drawn as they were at the beginning.
        note: of boxes and doors, ``at the start`` where nobody knows what became of them.
        others: what was driven at other times, as thin lines behind all else: rows of seconds, x and y in metres.
    """
    name = world.name if title is None else title
    return _Picture(world, trajectories, marks, name, subtitle, note, doors, others).draw()


class _Picture:
    """One room on one sheet."""

    def __init__(
        self,
        world: "World",
        trajectories: Sequence[Trajectory],
        marks: Sequence[Mark],
        title: str,
        subtitle: str,
        note: str,
        doors: Sequence[float],
        others: Sequence[NDArray[np.float64]],
    ) -> None:
        self.others = others
        self.opened = list(doors) or [door.open_deg for door in world.doors]
        self.note = f", {clean(note)}" if note else ""
        self.world, self.trajectories = world, [line for line in trajectories if len(line.points)]
        self.marks = sorted(marks, key=lambda mark: mark.time_s) if self.trajectories else []
        length, depth = world.arena.size
        self.scale = min(_LARGEST[0] / length, _LARGEST[1] / depth)
        self.room = (length * self.scale, depth * self.scale)
        self.beside = self.room[1] >= 0.8 * self.room[0]
        found = any(mark.found for mark in self.marks)
        self.rows = [*self.trajectories, *self.marks, *(["found"] if found else [])]
        self.columns = 1 if self.beside else max(1, int(self.room[0] // _PANEL))
        self.panel = _PANEL if self.beside else (self.room[0] + _BETWEEN) / self.columns - _BETWEEN
        across = self.room[0] + (_PANEL + _BETWEEN if self.beside else 0.0)
        self.title = wrap(clean(title), across, TITLE, "bold", lines=2)
        self.subtitle = wrap(clean(subtitle), across, BODY, lines=2)
        self.left = _MARGIN
        self.top = _MARGIN + 18 * len(self.title) + 14 * len(self.subtitle) + (6.0 if self.title else 0.0)
        panel = math.ceil(len(self.rows) / self.columns) * _ROW
        below = self.room[1] + _SCALE_BAR
        height = max(below, panel + 14.0) if self.beside else below + 16.0 + panel
        self.sheet = Sheet(across + 2 * _MARGIN, self.top + height + _MARGIN - 6.0, clean(title))
        self.marked = [self.xy(*self._line_of(mark).at(mark.time_s)) for mark in self.marks]
        self.placer = Placer(Rect(self.left, self.top, self.left + self.room[0], self.top + self.room[1]))

    def draw(self) -> Figure:
        y = _MARGIN + 4
        for line in self.title:
            self.sheet.text(_MARGIN, y, line, size=TITLE, weight="bold")
            y += 18
        for line in self.subtitle:
            self.sheet.text(_MARGIN, y, line, color=MUTED)
            y += 14
        self._floor()
        for path in self.others:
            self.sheet.line([self.xy(x, y) for _, x, y in path], color=_OTHER, width=0.7, z=2.5)
        self._things()
        self._bodies()
        for trajectory in self.trajectories:
            self._path(trajectory)
        self._names()
        self._badges()
        if self.beside:
            self._panel(self.left + self.room[0] + _BETWEEN, self.top + 6.0)
        else:
            self._panel(self.left, self.top + self.room[1] + _SCALE_BAR + 16.0)
        return self.sheet.figure

    def xy(self, x: float, y: float) -> tuple[float, float]:
        """A place of the world on the sheet."""
        return self.left + x * self.scale, self.top + self.room[1] - y * self.scale

    def _floor(self) -> None:
        (length, depth), thick = self.world.arena.size, 5.0
        self.sheet.rectangle(
            self.left - thick,
            self.top - thick,
            self.room[0] + 2 * thick,
            self.room[1] + 2 * thick,
            fill=INK,
            radius=2.0,
        )
        self.sheet.rectangle(self.left, self.top, *self.room, fill=FLOOR, z=2)
        for metre in range(1, math.ceil(length)):
            self.sheet.line([self.xy(metre, 0), self.xy(metre, depth)], color=HAIR, width=0.7, cap="butt")
        for metre in range(1, math.ceil(depth)):
            self.sheet.line([self.xy(0, metre), self.xy(length, metre)], color=HAIR, width=0.7, cap="butt")
        # The length of the scale is that of the grid.
        y0 = self.top + self.room[1] + 17.0
        x0, one = self.left, min(1.0, length) * self.scale
        self.sheet.line([(x0, y0), (x0 + one, y0)], width=1.0, color=MUTED, cap="butt")
        for x in (x0, x0 + one):
            self.sheet.line([(x, y0 - 3), (x, y0 + 3)], width=1.0, color=MUTED, cap="butt")
        self.sheet.text(x0 + one + 7, y0, f"{min(1.0, length):g} m", size=SMALL, color=MUTED)

    def _things(self) -> None:
        for wall in self.world.walls:
            start, end = self.xy(*wall.start), self.xy(*wall.end)
            self.sheet.line([start, end], color=INK, width=max(3.0, 0.04 * self.scale), cap="butt", z=3)
            steps = max(2, int(math.dist(start, end) / 6))
            for part in np.linspace(0, 1, steps):
                x, y = (a + part * (b - a) for a, b in zip(start, end, strict=True))
                self.placer.take(Rect.around(x, y, 7, 7), 3.0)
        for door, opened in zip(self.world.doors, self.opened, strict=True):
            self._door(door, opened)
        for target in self.world.targets:
            x, y = self.xy(*target.at)
            radius = target.radius * self.scale
            self.sheet.disc(x, y, radius, fill=paint(target.color), border=edge(target.color), line=1.4, z=5)
            self.placer.take(Rect.around(x, y, 2 * radius + 3, 2 * radius + 3), 4.0)
        for box in self.world.boxes:
            self._square(Pose(*box.at, math.radians(box.heading_deg)), box.size, box.color)

    def _door(self, door: "Door", opened: float) -> None:
        """The leaf as it stands in the end, and where it has swung from."""
        hinge, width = self.xy(*door.hinge), max(2.4, 0.03 * self.scale)
        if abs(opened - door.open_deg) > _SWUNG_DEG:
            steps = np.linspace(door.open_deg, opened, 24)
            swing = [self.xy(*door.edge(float(step))) for step in steps]
            self.sheet.line(swing, color=MUTED, width=0.9, dashes=(1.6, 2.2), z=2.6)
            self.sheet.line([hinge, swing[0]], color=MUTED, width=1.2, dashes=(3.0, 2.2), z=2.6)
        edge_ = self.xy(*door.edge(opened))
        self.sheet.line([hinge, edge_], color=PAPER, width=width + 2.0, cap="butt", z=3)
        self.sheet.line([hinge, edge_], color=_LEAF, width=width, cap="butt", z=3.05)
        self.sheet.disc(*hinge, 0.5 * width + 0.8, fill=INK, z=3.1)
        for part in np.linspace(0, 1, 8):
            x, y = (a + float(part) * (b - a) for a, b in zip(hinge, edge_, strict=True))
            self.placer.take(Rect.around(x, y, 7, 7), 3.0)

    def _square(self, pose: Pose, size: float, color: str, *, ghost: bool = False) -> None:
        half = size / 2
        corners = [pose.to_parent(Point(x, y)) for x, y in ((half, half), (-half, half), (-half, -half), (half, -half))]
        self.sheet.polygon(
            [self.xy(*corner) for corner in corners],
            fill=blend(paint(color), PAPER, 0.65) if ghost else paint(color),
            border=edge(color),
            line=1.2,
            dashes=(1.8, 1.2) if ghost else None,
            z=5,
        )
        x, y = self.xy(pose.x, pose.y)
        self.placer.take(Rect.around(x, y, 1.4 * size * self.scale + 3, 1.4 * size * self.scale + 3), 4.0)

    def _path(self, trajectory: Trajectory) -> None:
        path = trajectory.resampled(_STEP_M)
        if len(path) < 2:
            return
        dark, pale = paint(trajectory.color), blend(paint(trajectory.color), FLOOR, 0.62)
        places = np.array([self.xy(x, y) for x, y in path[:, 1:3]])
        age = (path[:, 0] - path[0, 0]) / max(path[-1, 0] - path[0, 0], 1e-9)
        for x, y in places[::3]:
            self.placer.take(Rect.around(x, y, 5, 5), 0.8)
        pieces = [places[index : index + 2] for index in range(len(places) - 1)]
        shades = [blend(pale, dark, float(part)) for part in age[1:]]
        if trajectory.dashed:
            shown = [index for index in range(len(pieces)) if index % 4 < 2]
            pieces, shades = [pieces[index] for index in shown], [shades[index] for index in shown]
        thin = trajectory.body == "box"
        self.sheet.line(places, color=FLOOR, width=2.4 if thin else 3.6, cap="butt", z=2.7)
        self.sheet.strokes(pieces, shades, width=1.2 if thin else 1.9, z=3.2)
        if thin:
            return
        every = round(_ARROWS_M / _STEP_M)
        for index in range(every // 2, len(places) - 6, every):
            if any(math.dist(places[index], at) < 13.0 for at in self.marked):
                continue
            (x1, y1), (x2, y2) = places[max(0, index - 2)], places[index + 2]
            self._arrow(places[index], math.atan2(y2 - y1, x2 - x1), blend(pale, dark, float(age[index])))

    def _arrow(self, place: NDArray[np.float64], heading: float, color: str) -> None:
        pose = Pose(float(place[0]), float(place[1]), heading)
        corners = [pose.to_parent(Point(x, y)) for x, y in ((5.2, 0), (-3.4, 4.0), (-1.6, 0), (-3.4, -4.0))]
        self.sheet.polygon(corners, fill=color, border=FLOOR, line=0.8, z=3.3)

    def _bodies(self) -> None:
        for robot in self.world.robots:
            self._robot(Pose(*robot.at, math.radians(robot.heading_deg)), PAPER, start=True)
        for trajectory in self.trajectories:
            if trajectory.body == "robot":
                self._robot(trajectory.last_pose, paint(trajectory.color))
            elif trajectory.body == "person":
                radius = self.world.teacher.radius if self.world.teacher else 0.15
                last = self.xy(*trajectory.points[-1, 1:3])
                first = self.xy(*trajectory.points[0, 1:3])
                color = paint(trajectory.color)
                self.sheet.disc(*first, radius * self.scale, border=color, dashes=(2.4, 1.8), line=1.0, z=2.8)
                self.sheet.disc(
                    *last, radius * self.scale, fill=blend(color, PAPER, 0.8), border=color, line=1.3, z=2.8
                )
                for x, y in (first, last):
                    self.placer.take(Rect.around(x, y, 2 * radius * self.scale, 2 * radius * self.scale), 1.5)
            else:
                sizes = [box.size for box in self.world.boxes if box.color == trajectory.color]
                self._square(trajectory.last_pose, sizes[0] if sizes else 0.09, trajectory.color, ghost=True)

    def _robot(self, pose: Pose, color: str, *, start: bool = False) -> None:
        """The Pioneer's outline; its nose and paddles show where it looks."""
        length, width, cut = PIONEER.length / 2, PIONEER.width / 2, 0.05
        outline = [
            (length - cut, width), (length, width - cut), (length, cut - width), (length - cut, -width),
            (cut - length, -width), (-length, cut - width), (-length, width - cut), (cut - length, width),
        ]  # fmt: skip
        line = MUTED if start else INK
        inside = "none" if start else blend(color, PAPER, 0.8)
        self._shape(pose, outline, fill=inside, z=2.8)
        # The outline lies over the trajectory, so that both are seen to the end.
        over = 2.9 if start else 3.5
        self._shape(pose, outline, border=line, dashes=(2.6, 1.8) if start else None, z=over)
        self._shape(
            pose, [(0.16, 0.0), (0.03, 0.05), (0.03, -0.05)], fill="none" if start else line, border=line, z=over
        )
        for side in (1.0, -1.0):
            y = side * (width - 0.035)
            wheel = [(0.08, y), (0.08, y - side * 0.05), (-0.08, y - side * 0.05), (-0.08, y)]
            self._shape(pose, wheel, fill=PAPER if start else line, border=line, z=over)
            if PIONEER.gripper:
                y = side * PIONEER.gripper.opening / 2
                ends = [pose.to_parent(Point(x, y)) for x in (length, PIONEER.gripper.x_front)]
                self.sheet.line([self.xy(*end) for end in ends], color=line, width=1.2 if start else 1.8, z=over)
        for ahead, across in ((0.0, 0.5), (0.34, 0.3)):
            x, y = self.xy(*pose.to_parent(Point(ahead, 0.0)))
            self.placer.take(Rect.around(x, y, across * self.scale, across * self.scale), 1.5)

    def _shape(
        self,
        pose: Pose,
        corners: Sequence[tuple[float, float]],
        *,
        fill: str = "none",
        border: str = "none",
        dashes: tuple[float, float] | None = None,
        z: float,
    ) -> None:
        placed = [self.xy(*pose.to_parent(Point(x, y))) for x, y in corners]
        self.sheet.polygon(placed, fill=fill, border=border, line=1.1, dashes=dashes, z=z)

    def _names(self) -> None:
        named = [(*target.at, target.radius, target.color.value) for target in self.world.targets]
        named += [(*box.at, 0.7 * box.size, f"{box.color.value} box{self.note}") for box in self.world.boxes]
        if self.note:
            for door, opened in zip(self.world.doors, self.opened, strict=True):
                x_m, y_m = (sum(ends) / 2 for ends in zip(door.hinge, door.edge(opened), strict=True))
                named.append((x_m, y_m, 0.1, f"door{self.note}"))
        for x_m, y_m, radius, text in named:
            x, y = self.xy(x_m, y_m)
            rect = self.placer.place(x, y, radius * self.scale + 2, (text_width(text, SMALL) + 2, 9.0))
            self._write(rect, text, INK)
        for robot in self.world.robots:
            text = "start" if len(self.world.robots) == 1 else f"{clean(robot.name)}, start"
            x, y = self.xy(*robot.at)
            rect = self.placer.place(x, y, 0.26 * self.scale, (text_width(text, SMALL) + 2, 9.0), first=90.0)
            self._write(rect, text, MUTED)

    def _write(self, rect: Rect, text: str, color: str) -> None:
        x, y = (rect.left + rect.right) / 2, (rect.top + rect.bottom) / 2
        self.sheet.text(x, y, text, size=SMALL, color=color, align="center", z=7, halo=2.0)

    def _badges(self) -> None:
        for index, (mark, (x, y)) in enumerate(zip(self.marks, self.marked, strict=True), start=1):
            rect = self.placer.place(x, y, 5.0, (2 * _BADGE + 2, 2 * _BADGE + 2), first=-45.0)
            at = ((rect.left + rect.right) / 2, (rect.top + rect.bottom) / 2)
            self.sheet.line([(x, y), at], color=INK, width=0.8, z=6.5)
            self.sheet.disc(x, y, 2.4, fill=INK, border=PAPER, line=0.8, z=6.6)
            self._badge(*at, index, found=mark.found)

    def _line_of(self, mark: Mark) -> Trajectory:
        named = (trajectory for trajectory in self.trajectories if trajectory.name == mark.on)
        return next(named, self.trajectories[0])

    def _badge(self, x: float, y: float, number: int, *, found: bool) -> None:
        self.sheet.disc(x, y, _BADGE, fill=PAPER if found else INK, border=INK, line=1.0, z=7)
        self.sheet.text(
            x, y, str(number), size=SMALL, weight="bold", color=INK if found else PAPER, align="center", z=8
        )

    def _panel(self, x: float, y: float) -> None:
        """The legend: what each line is, what happened at each number."""
        down = math.ceil(len(self.rows) / self.columns)
        for index, row in enumerate(self.rows):
            left = x + (index // down) * (self.panel + _BETWEEN)
            middle = y + (index % down) * _ROW
            if self.beside and index >= len(self.trajectories):
                middle += 8.0
            if isinstance(row, Trajectory):
                self._line_sample(left, middle, row)
            elif isinstance(row, Mark):
                self._badge(left + _BADGE, middle, index - len(self.trajectories) + 1, found=row.found)
                self.sheet.chip(left + 20, middle, row.color)
                begin = left + (33 if row.color else 20)
                time = f"{row.time_s:.1f} s"
                room = left + self.panel - 8 - text_width(time, BODY) - begin
                self.sheet.text(begin, middle, elide(clean(row.text), room, BODY))
                self.sheet.text(left + self.panel, middle, time, color=MUTED, align="right")
            else:
                self.sheet.disc(left + _BADGE, middle, _BADGE - 1, fill=PAPER, border=INK, line=1.0)
                self.sheet.text(left + 20, middle, "already so when its turn came", size=SMALL, color=MUTED)

    def _line_sample(self, x: float, y: float, trajectory: Trajectory) -> None:
        dark = paint(trajectory.color)
        pale = blend(dark, PAPER, 0.62)
        xs = np.linspace(x, x + 28, 15)
        pieces = [np.array([(a, y), (b, y)]) for a, b in pairwise(xs)]
        shades = [blend(pale, dark, index / 13) for index in range(14)]
        if trajectory.dashed:
            pieces, shades = pieces[::2], shades[::2]
        self.sheet.strokes(pieces, shades, width=1.2 if trajectory.body == "box" else 1.9)
        text = elide(clean(trajectory.name), self.panel - 90, BODY)
        self.sheet.text(x + 36, y, text)
        lasted = trajectory.points[-1, 0] - trajectory.points[0, 0]
        if trajectory.body != "box":
            self.sheet.text(x + self.panel, y, f"{lasted:.0f} s", color=MUTED, align="right")
