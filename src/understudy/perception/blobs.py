"""From an image to colored blobs (A.3)."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from understudy.perception.colors import COLOR_CLASSES, classify
from understudy.robot import Color, Paints

__all__ = ["Blob", "find_blobs"]

_CLASSES = len(COLOR_CLASSES) + 1


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


def find_blobs(image: NDArray[np.uint8], *, min_area: int = 12, paints: Paints | None = None) -> list[Blob]:
    """The colored blobs of an image, larger ones first within a color.

    Args:
        image: RGB, shape ``(height, width, 3)``.
        min_area: pixels; smaller patches are noise.
        paints: how the camera sees the trained colors; in plain light if left out.
    """
    classes = classify(image) if paints is None else classify(image, paints)
    # Most of the picture is of no trained color; only what is around the rest is looked at further.
    x, y, width, height = cv2.boundingRect(classes)
    if not width:
        return []
    crop = classes[y : y + height, x : x + width]
    counts = cv2.calcHist([crop], [0], None, [_CLASSES], [0, _CLASSES]).reshape(-1).tolist()
    blobs: list[Blob] = []
    for index, color in enumerate(COLOR_CLASSES, start=1):
        if counts[index] >= min_area:
            blobs += _components(crop == index, int(counts[index]), color, x, y, min_area)
    return blobs


def _components(mask: NDArray[np.bool_], count: int, color: Color, x: int, y: int, min_area: int) -> list[Blob]:
    """The connected patches of a mask of ``count`` pixels, whose upper left corner is at column ``x``, row ``y``."""
    patches = mask.view(np.uint8)
    left_most, top_most, width, height = cv2.boundingRect(patches)
    patches = patches[top_most : top_most + height, left_most : left_most + width]
    x, y = x + left_most, y + top_most
    labels, _ = cv2.connectedComponents(patches, connectivity=8)
    if labels == 2:
        # All of it is one patch, as nearly always: its measures are known, and measuring costs more than labelling.
        return [Blob(color=color, left=x, right=x + width - 1, top=y, bottom=y + height - 1, area=count)]
    _, _, stats, _ = cv2.connectedComponentsWithStats(patches, connectivity=8)
    found = [
        Blob(color=color, left=x + left, right=x + left + across - 1, top=y + top, bottom=y + top + down - 1, area=area)
        for left, top, across, down, area in stats[1:].tolist()
        if area >= min_area
    ]
    return sorted(found, key=lambda blob: -blob.area)
