"""From a pixel to one of the eight trained colors, by one look-up (A.1)."""

from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from understudy.robot import RGB, Color, Paints

__all__ = ["COLOR_CLASSES", "classify", "color_table"]

COLOR_CLASSES: tuple[Color, ...] = tuple(Color)
"""Class ``k`` of a classified image is ``COLOR_CLASSES[k - 1]``; class 0 is no trained color."""

_PAINTS: Paints = tuple(RGB[color] for color in COLOR_CLASSES)

_MAX_CHROMA_DISTANCE = 0.085
"""Half the distance between the two closest trained colors (light orange and yellow), in chromaticity."""

_MIN_BRIGHTNESS = 90
"""Sum of the three channels below which a pixel is too dark for its color to mean anything."""


@cache
def color_table(paints: Paints = _PAINTS) -> NDArray[np.uint8]:
    """The class of every 15-bit color, shape ``(65536,)``, index ``r5 << 10 | g5 << 5 | b5``, twice over.

    A pixel belongs to the nearest trained color in chromaticity (the channels' shares of their sum), which does not
    change with the brightness of the light; pixels that are dark or far from every trained color belong to none.
    """
    levels = np.arange(32) * 8.0 + 4.0
    pixels = np.stack(np.meshgrid(levels, levels, levels, indexing="ij"), axis=-1).reshape(-1, 3)
    brightness = pixels.sum(axis=1)
    chroma = pixels / brightness[:, None]
    trained = np.array(paints, dtype=float)
    trained /= trained.sum(axis=1, keepdims=True)
    distance = np.linalg.norm(chroma[:, None, :] - trained[None, :, :], axis=2)
    nearest = distance.argmin(axis=1)
    known = (distance.min(axis=1) <= _MAX_CHROMA_DISTANCE) & (brightness >= _MIN_BRIGHTNESS)
    return np.tile(np.where(known, nearest + 1, 0).astype(np.uint8), 2)


def classify(image: NDArray[np.uint8], paints: Paints = _PAINTS) -> NDArray[np.uint8]:
    """The color class of every pixel.

    Args:
        image: RGB, shape ``(height, width, 3)``.
        paints: how the camera sees the trained colors.

    Returns:
        Classes, shape ``(height, width)``, see :data:`COLOR_CLASSES`.
    """
    packed = cv2.cvtColor(image, cv2.COLOR_RGB2BGR555).view(np.uint16).reshape(image.shape[:2])
    classes: NDArray[np.uint8] = cv2.LUT(packed, color_table(paints)).reshape(packed.shape)  # type: ignore[assignment]
    return classes
