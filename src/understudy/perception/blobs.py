"""From an image to colored blobs (A.3)."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from understudy.perception.colors import COLOR_CLASSES, classify
from understudy.robot import Color

__all__ = ["Blob", "find_blobs"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Blob:
    """A connected patch of one trained color; pixel columns and rows are inclusive, row 0 on top."""

    color: Color
    left: int
    right: int
    top: int
    bottom: int
    area: int

    @property
    def column(self) -> float:
        """The middle column."""
        return (self.left + self.right) / 2


def find_blobs(image: NDArray[np.uint8], *, min_area: int = 12) -> list[Blob]:
    """The colored blobs of an image, larger ones first within a color.

    Args:
        image: RGB, shape ``(height, width, 3)``.
        min_area: pixels; smaller patches are noise.
    """
    classes = classify(image)
    blobs: list[Blob] = []
    for index, color in enumerate(COLOR_CLASSES, start=1):
        mask = (classes == index).view(np.uint8)
        if cv2.countNonZero(mask) < min_area:
            continue
        # Labelling costs in proportion to the area looked at, and most of the picture is of no trained color.
        x, y, width, height = cv2.boundingRect(mask)
        _, _, stats, _ = cv2.connectedComponentsWithStats(mask[y : y + height, x : x + width], connectivity=8)
        found = [
            Blob(
                color=color,
                left=x + left,
                right=x + left + across - 1,
                top=y + top,
                bottom=y + top + down - 1,
                area=area,
            )
            for left, top, across, down, area in stats[1:].tolist()
            if area >= min_area
        ]
        blobs.extend(sorted(found, key=lambda blob: -blob.area))
    return blobs
