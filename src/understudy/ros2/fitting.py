"""From what a robot's drivers give to what the skills expect: sweeps counted from ahead, pictures of one size."""

import math
from dataclasses import replace

import cv2
import numpy as np
from numpy.typing import NDArray

from understudy.errors import RobotError
from understudy.robot import Observation, Scan
from understudy.ros2.document import RobotDocument

__all__ = ["Fitting", "turned"]


class Fitting:
    """Fits observations to the robot of a document, live ones and those of its bags.

    Args:
        document: says how the laser sits, and what the camera's pictures are reduced to.
    """

    def __init__(self, document: RobotDocument) -> None:
        self._name = document.name
        self._yaw = math.radians(document.laser.yaw_deg)
        self._upside_down = document.laser.upside_down
        self._width, self._rows = document.camera.width, document.camera.rows

    def observation(self, given: Observation) -> Observation:
        """The observation as the robot's spec has it.

        Raises:
            RobotError: the picture is of another shape than the document says, so its directions cannot be told.
        """
        scan = turned(given.scan, self._yaw, upside_down=self._upside_down)
        return replace(given, scan=scan, image=None if given.image is None else self._reduced(given.image))

    def _reduced(self, image: NDArray[np.uint8]) -> NDArray[np.uint8]:
        rows, width = image.shape[:2]
        if width * self._rows != rows * self._width:
            raise RobotError(
                f"the camera's pictures have {width} by {rows} pixels, which is another shape than the"
                f" {self._width} by {self._rows} of {self._name}: put a size of this shape into its document, as"
                f" camera.width and camera.rows, and check camera.field_deg"
            )
        if (width, rows) == (self._width, self._rows):
            return image
        return cv2.resize(image, (self._width, self._rows), interpolation=cv2.INTER_AREA).astype(np.uint8, copy=False)


def turned(scan: Scan, yaw: float, *, upside_down: bool = False) -> Scan:
    """A sweep counted counter-clockwise from the robot's own ahead, whatever way the laser is mounted.

    A sweep all around begins behind the robot, so that nothing before it is cut in two.

    Args:
        scan: as the driver gives it.
        yaw: direction of the laser's angle 0 in the robot's frame, radians.
        upside_down: it turns the other way around.
    """
    ranges, first, step = scan.ranges, scan.angle_min, scan.angle_increment
    if upside_down:
        first, step = -first, -step
    if step < 0.0:
        ranges, first, step = ranges[::-1], first + step * (ranges.size - 1), -step
    first += yaw
    if ranges.size * step < math.tau - step / 2:
        middle = first + step * (ranges.size - 1) / 2
        first += math.remainder(middle, math.tau) - middle
    else:
        # Some drivers give the first ray once more at the end.
        ranges = ranges[: round(math.tau / step)]
        behind = math.ceil((-math.pi - first) / step - 1e-6)
        ranges = np.roll(ranges, -behind)
        first += behind * step
    return replace(scan, ranges=np.ascontiguousarray(ranges), angle_min=first, angle_increment=step)
