"""Where a pixel points to in the robot's frame: a pinhole camera, tilted downward (Figure 3.9)."""

import math

from understudy.geometry import Point
from understudy.robot import CameraMount

__all__ = ["Projection"]


class Projection:
    """The camera's geometry.

    Args:
        camera: where it sits and how it looks.
    """

    def __init__(self, camera: CameraMount) -> None:
        self.camera = camera
        self._focal = camera.focal_px
        self._center_column = (camera.width - 1) / 2
        self._center_row = (camera.rows - 1) / 2
        self._cos, self._sin = math.cos(camera.tilt), math.sin(camera.tilt)

    @property
    def horizon_row(self) -> float:
        """The row of everything at the camera's own height; what rises above it is taller than the camera."""
        return self._center_row - self._focal * math.tan(self.camera.tilt)

    def _ray(self, column: float, row: float) -> tuple[float, float, float]:
        right = (column - self._center_column) / self._focal
        down = (row - self._center_row) / self._focal
        return self._cos - down * self._sin, -right, -(self._sin + down * self._cos)

    def bearing(self, column: float, row: float) -> float:
        """Direction of a pixel, radians, left positive."""
        forward, left, _ = self._ray(column, row)
        return math.atan2(left, forward)

    def floor_point(self, column: float, row: float) -> Point | None:
        """Where a pixel's ray meets the floor, in the robot's frame; None at or above the horizon."""
        forward, left, up = self._ray(column, row)
        if up >= -1e-3:
            return None
        scale = self.camera.height / -up
        return Point(self.camera.x + scale * forward, scale * left)

    def pixel(self, point: Point, height: float) -> tuple[float, float] | None:
        """Column and row of a point ``height`` above the floor; None behind the camera. Not always inside the image."""
        ahead, drop = point.x - self.camera.x, self.camera.height - height
        depth = ahead * self._cos + drop * self._sin
        if depth <= 0.02:
            return None
        down = -ahead * self._sin + drop * self._cos
        return (
            self._center_column - self._focal * point.y / depth,
            self._center_row + self._focal * down / depth,
        )

    def sees(self, point: Point, height: float, *, margin: int = 0) -> bool:
        """Whether a point would fall into the image, at least ``margin`` pixels from its border."""
        pixel = self.pixel(point, height)
        if pixel is None:
            return False
        column, row = pixel
        return margin <= column <= self.camera.width - 1 - margin and margin <= row <= self.camera.rows - 1 - margin
