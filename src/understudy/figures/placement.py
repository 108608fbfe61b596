"""Where a label goes: near what it names, over nothing else, inside the room."""

import math
from typing import NamedTuple

__all__ = ["Placer", "Rect"]

_DIRECTIONS = 16
_DISTANCES = (1.0, 6.0, 13.0, 22.0, 34.0)


class Rect(NamedTuple):
    """A rectangle by its upper left and lower right corners, y downwards."""

    left: float
    top: float
    right: float
    bottom: float

    @classmethod
    def around(cls, x: float, y: float, width: float, height: float) -> "Rect":
        """The rectangle of this size about a middle."""
        return cls(x - width / 2, y - height / 2, x + width / 2, y + height / 2)

    def overlap(self, other: "Rect") -> float:
        """The area that both cover."""
        width = min(self.right, other.right) - max(self.left, other.left)
        height = min(self.bottom, other.bottom) - max(self.top, other.top)
        return max(0.0, width) * max(0.0, height)

    @property
    def area(self) -> float:
        """In square points."""
        return (self.right - self.left) * (self.bottom - self.top)


class Placer:
    """Remembers what is taken, and finds a place for one label after the other.

    Args:
        bounds: what labels should stay in.
    """

    def __init__(self, bounds: Rect) -> None:
        self.bounds = bounds
        self._taken: list[tuple[Rect, float]] = []

    def take(self, rect: Rect, weight: float = 1.0) -> None:
        """Mark a place as taken; the weight says how bad it is to cover it."""
        self._taken.append((rect, weight))

    def place(self, x: float, y: float, clearance: float, size: tuple[float, float], *, first: float = 0.0) -> Rect:
        """The best place for a label beside a thing, which is taken from then on.

        Args:
            x, y: the thing's middle.
            clearance: the thing's radius.
            size: width and height of the label.
            first: the preferred direction in degrees, 0 to the right and 90 downwards.
        """
        width, height = size
        best = Rect.around(x, y, width, height)
        least = math.inf
        for distance in _DISTANCES:
            for index in range(_DIRECTIONS):
                # 0, 1, -1, 2, -2, … sixteenths of a turn away from the preferred direction
                turn = (index + 1) // 2 * (1 if index % 2 else -1)
                angle = math.radians(first + 360 * turn / _DIRECTIONS)
                across, down = math.cos(angle), math.sin(angle)
                # From the thing's edge to the label's nearest edge it is always the same way.
                reach = clearance + distance
                to_x = x + across * reach + width / 2 * _side(across)
                to_y = y + down * reach + height / 2 * _side(down)
                rect = Rect.around(to_x, to_y, width, height)
                cost = self._cost(rect) + 0.02 * distance + 0.004 * abs(turn)
                if cost < least:
                    best, least = rect, cost
        self.take(best, 2.0)
        return best

    def _cost(self, rect: Rect) -> float:
        outside = rect.area - rect.overlap(self.bounds)
        return (3 * outside + sum(weight * rect.overlap(taken) for taken, weight in self._taken)) / rect.area


def _side(part: float) -> float:
    """-1 to 1: how far a label is shifted by its own half; gently, so that diagonals hug their corner."""
    return max(-1.0, min(1.0, 1.6 * part))
