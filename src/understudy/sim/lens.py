"""A tilted pinhole: from the floor plan and heights to pixels."""

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from understudy.robot import CameraMount

__all__ = ["NEAR_M", "Floats", "Lens", "clipped"]

Floats = NDArray[np.float64]

NEAR_M = 0.03
"""What is nearer to the lens' plane is cut off."""


class Lens:
    """The geometry of a :class:`CameraMount`.

    Points "in the view" are (forward, left) of the lens on the floor plan; points "in the camera" are
    (right, down, depth) along its tilted axes. Metres. Single points go through plain floats, which for the few
    corners of a picture is faster than arrays.
    """

    def __init__(self, mount: CameraMount) -> None:
        self._height = mount.height
        self._cos, self._sin = math.cos(mount.tilt), math.sin(mount.tilt)
        self._focal = mount.focal_px
        # OpenCV counts pixel centres, so that the optical axis lies half a pixel before the middle column.
        self._column, self._row = mount.width / 2 - 0.5, mount.rows / 2 - 0.5
        self._slope = mount.width / 2 / mount.focal_px

    def pixel(self, forward: float, left: float, height: float) -> tuple[int, int]:
        """Column and row of a point of the view at a height above the floor; it must lie before the lens."""
        up = height - self._height
        scale = self._focal / (self._cos * forward - self._sin * up)
        column = self._column - left * scale
        row = self._row - (self._sin * forward + self._cos * up) * scale
        return round(column), round(row)

    def pixels_at(self, in_view: Iterable[tuple[float, float]], height: float) -> list[tuple[int, int]]:
        """:meth:`pixel` for several points at one height: what follows from that is computed once."""
        focal, cos, sin, middle_column, middle_row = self._focal, self._cos, self._sin, self._column, self._row
        up = height - self._height
        nearer, above = sin * up, cos * up
        found = []
        for forward, left in in_view:
            scale = focal / (cos * forward - nearer)
            found.append((round(middle_column - left * scale), round(middle_row - (sin * forward + above) * scale)))
        return found

    def in_camera(self, in_view: Floats, height: Floats) -> Floats:
        """Points of the view at a height above the floor, in the camera."""
        forward, up = in_view[..., 0], height - self._height
        seen = np.empty((*forward.shape, 3))
        np.negative(in_view[..., 1], out=seen[..., 0])
        seen[..., 1] = -self._sin * forward - self._cos * up
        seen[..., 2] = self._cos * forward - self._sin * up
        return seen

    def pixels(self, in_camera: Floats) -> NDArray[np.int32]:
        """Points beyond the near plane as (column, row)."""
        columns_rows = in_camera[..., :2] * (self._focal / in_camera[..., 2:])
        columns_rows += (self._column, self._row)
        return np.rint(columns_rows).astype(np.int32)

    def depths(self, in_view: Sequence[tuple[float, float, float]]) -> list[float]:
        """Of points (forward, left, height), along the lens's axis."""
        cos, sin, lens = self._cos, self._sin, self._height
        return [cos * forward - sin * (height - lens) for forward, _, height in in_view]

    def off_screen(self, in_view: Sequence[tuple[float, float, float]], depths: Sequence[float]) -> bool:
        """Whether all points (forward, left, height) lie behind the lens, or all to one side of the picture."""
        if max(depths) <= NEAR_M:
            return True
        slope = self._slope
        lefts = [left - slope * depth for (_, left, _), depth in zip(in_view, depths, strict=True)]
        if min(lefts) > 0.0:
            return True
        return all(-left > slope * depth for (_, left, _), depth in zip(in_view, depths, strict=True))


def clipped(face: Floats) -> Floats:
    """The part of a convex face, in the camera, that lies beyond the near plane."""
    kept: list[list[float]] = []
    points = face.tolist()
    for a, b in zip(points, points[1:] + points[:1], strict=True):
        a_before, b_before = a[2] >= NEAR_M, b[2] >= NEAR_M
        if a_before:
            kept.append(a)
        if a_before != b_before:
            t = (NEAR_M - a[2]) / (b[2] - a[2])
            kept.append([p + t * (q - p) for p, q in zip(a, b, strict=True)])
    return np.array(kept)
