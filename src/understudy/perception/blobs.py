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
    counts = np.bincount(classes.reshape(-1), minlength=len(COLOR_CLASSES) + 1)
    blobs: list[Blob] = []
    for index, color in enumerate(COLOR_CLASSES, start=1):
        if counts[index] < min_area:
            continue
        mask = (classes == index).view(np.uint8)
        _, _, stats, _ = cv2.connectedComponentsWithStats(mask, connectivity=8)
        found = [
            Blob(color=color, left=left, right=left + width - 1, top=top, bottom=top + height - 1, area=area)
            for left, top, width, height, area in stats[1:].tolist()
            if area >= min_area
        ]
        blobs.extend(sorted(found, key=lambda blob: -blob.area))
    return blobs
