"""What a camera can see: colored boxes and cylinders, taken from MuJoCo's state as it is asked for them."""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from understudy.geometry import Point
from understudy.robot import RGB, TEACHER_COLOR
from understudy.sim.layout import WALL_HALF_THICKNESS_M
from understudy.sim.mjcf import WALL_HEIGHT_M
from understudy.sim.model import ArenaModel, Thing

__all__ = ["Cylinders", "Paint", "Prisms", "Scenery", "WallFace"]

Floats = NDArray[np.float64]

Paint = tuple[float, float, float]
"""RGB, 0 to 255."""

_WALL_PAINT: Paint = (206.0, 204.0, 198.0)
_DOOR_PAINT: Paint = (150.0, 140.0, 128.0)
_ROBOT_PAINT: Paint = (58.0, 58.0, 62.0)

_WALL_PIECE_M = 0.5
"""Inner walls are drawn in pieces: the painter's order goes by distances of middles."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WallFace:
    """The inner face of one of the arena's walls, from the floor to ``height``."""

    start: Point
    end: Point
    shade: float
    height: float = WALL_HEIGHT_M
    paint: Paint = _WALL_PAINT

    @classmethod
    def around(cls, size: tuple[float, float]) -> "tuple[WallFace, ...]":
        """All four, each in its own light, so that corners show."""
        width, depth = size
        plan = [Point(0.0, 0.0), Point(width, 0.0), Point(width, depth), Point(0.0, depth)]
        edges = zip(plan, plan[1:] + plan[:1], (0.96, 1.0, 0.94, 0.9), strict=True)
        return tuple(cls(start=start, end=end, shade=shade) for start, end, shade in edges)


class Prisms:
    """Boxes in any attitude: inner walls (which never move) first, then the geoms of doors, boxes and robots."""

    FACES: ClassVar[dict[tuple[int, int], list[int]]] = {
        (0, -1): [0, 1, 3, 2],
        (0, 1): [4, 5, 7, 6],
        (1, -1): [0, 1, 5, 4],
        (1, 1): [2, 3, 7, 6],
        (2, -1): [0, 2, 6, 4],
        (2, 1): [1, 3, 7, 5],
    }
    """Corners of each face in cyclic order, by axis and sign. Corners are counted from the least to the greatest along
    the third axis first, then the second, then the first.
    """

    def __init__(self, arena: ArenaModel, data: Any) -> None:
        model, world = arena.model, arena.world
        pieces = [piece for wall in world.walls for piece in _wall_pieces(Point(*wall.start), Point(*wall.end))]
        geoms: list[int] = []
        self.paints: list[Paint] = [_WALL_PAINT] * len(pieces)
        self.owners: list[int] = [-1] * len(pieces)
        self.boxes: list[int] = []
        """Which of them are boxes."""
        for geom, (thing, number) in enumerate(arena.things):
            if thing is Thing.BOX:
                self.boxes.append(len(self.paints))
                self.paints.append(RGB[world.boxes[number].color])
                self.owners.append(-1)
            elif thing is Thing.DOOR:
                self.paints.append(_DOOR_PAINT)
                self.owners.append(-1)
            elif thing is Thing.ROBOT and not _is_cylinder(model, geom):
                self.paints.append(_ROBOT_PAINT)
                self.owners.append(arena.robots[number].body)
            else:
                continue
            geoms.append(geom)
        self._geoms = np.array(geoms, np.intp)
        self._still = [(centre.tolist(), rotation.tolist()) for centre, rotation, _ in pieces]
        halves = np.concatenate([*(half[None] for _, _, half in pieces), model.geom_size[self._geoms]])
        self.halves: list[list[float]] = halves.tolist()
        self.radii: list[float] = np.linalg.norm(halves[:, :2], axis=1).tolist()
        self._places, self._attitudes = data.geom_xpos, data.geom_xmat.reshape(-1, 3, 3)

    def centres(self) -> list[list[float]]:
        """Where the middles are now: x, y and height."""
        return [centre for centre, _ in self._still] + _rows(self._places, self._geoms)

    def pose(self, i: int) -> tuple[list[float], list[list[float]]]:
        """Of one, now: its middle, and its axes as the columns of a matrix."""
        if i < len(self._still):
            return self._still[i]
        geom = self._geoms[i - len(self._still)]
        return self._places[geom].tolist(), self._attitudes[geom].tolist()


class Cylinders:
    """Upright cylinders: targets, the teacher, markers on robots."""

    def __init__(self, arena: ArenaModel, data: Any) -> None:
        model, world = arena.model, arena.world
        geoms: list[int] = []
        self.paints: list[Paint] = []
        self.owners: list[int] = []
        self.targets: list[int] = []
        """Which of them are targets."""
        for geom, (thing, number) in enumerate(arena.things):
            owner = -1
            if thing is Thing.TARGET:
                self.targets.append(len(geoms))
                color = world.targets[number].color
            elif thing is Thing.PERSON:
                color = TEACHER_COLOR
            elif thing is Thing.ROBOT and _is_cylinder(model, geom):
                marker = world.robots[number].marker
                assert marker is not None
                color, owner = marker, arena.robots[number].body
            else:
                continue
            geoms.append(geom)
            self.paints.append(RGB[color])
            self.owners.append(owner)
        self._geoms = np.array(geoms, np.intp)
        self._places = data.geom_xpos
        self.radii: list[float] = model.geom_size[self._geoms, 0].tolist()
        halves, heights = model.geom_size[self._geoms, 1], self._places[self._geoms, 2]
        # They stand upright and never leave their height.
        self.bottoms: list[float] = (heights - halves).tolist()
        self.tops: list[float] = (heights + halves).tolist()

    def centres(self) -> list[list[float]]:
        """Where the middles are now: x, y and height."""
        return _rows(self._places, self._geoms)


class Scenery:
    """All that a camera in one simulation can see. MuJoCo's kinematics must have been computed once."""

    def __init__(self, arena: ArenaModel, data: Any) -> None:
        self.arena_walls = WallFace.around(arena.world.arena.size)
        self.prisms = Prisms(arena, data)
        self.cylinders = Cylinders(arena, data)


def _rows(table: Floats, which: NDArray[np.intp]) -> list[list[float]]:
    rows: list[list[float]] = table.take(which, axis=0).tolist()
    return rows


def _is_cylinder(model: Any, geom: int) -> bool:
    return str(model.geom(geom).name).endswith(" marker")


def _wall_pieces(start: Point, end: Point) -> list[tuple[Floats, Floats, Floats]]:
    """Centre, rotation and half sizes of the pieces of one wall."""
    length, angle = start.distance_to(end), math.atan2(end.y - start.y, end.x - start.x)
    count = max(1, math.ceil(length / _WALL_PIECE_M))
    c, s = math.cos(angle), math.sin(angle)
    rotation = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    half = np.array([length / count / 2, WALL_HALF_THICKNESS_M, WALL_HEIGHT_M / 2])
    pieces = []
    for i in range(count):
        t = (i + 0.5) / count
        centre = np.array([start.x + t * (end.x - start.x), start.y + t * (end.y - start.y), WALL_HEIGHT_M / 2])
        pieces.append((centre, rotation, half))
    return pieces
