"""What a skill that drives must keep clear of."""

import math

import numpy as np
from numpy.typing import NDArray

from understudy.geometry import Point
from understudy.perception import Percepts

__all__ = ["surroundings"]

_NEAR = 2.5
_RIM = np.array([(math.cos(a), math.sin(a)) for a in np.radians(np.arange(0, 360, 45))])


def surroundings(percepts: Percepts, aim: Point | None) -> NDArray[np.float64]:
    """What laser and sonars met, and the small boxes, which they pass over; but not the one that is aimed at.

    Args:
        percepts: of this tick.
        aim: the middle of the thing that is approached on purpose, in the robot's frame.

    Returns:
        Points in the robot's frame, metres, shape ``(n, 2)``.
    """
    boxes = [
        np.array([(box.position.x, box.position.y)]) + box.radius * _RIM
        for box in percepts.boxes
        if box.distance_m < _NEAR and (aim is None or aim.distance_to(box.position) > box.radius)
    ]
    return np.concatenate((percepts.obstacles, *boxes)) if boxes else percepts.obstacles
