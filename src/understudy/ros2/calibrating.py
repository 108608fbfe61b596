"""Which of a camera's colors is which: learned from patches of a picture, kept in the robot document."""

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Final, cast

import numpy as np
from numpy.typing import NDArray

from understudy.clock import Clock, WallClock
from understudy.errors import RobotDocumentError, RobotError
from understudy.recording import RawMessage, image_of
from understudy.robot import RGB, Color
from understudy.ros2.document import RobotDocument, load_robot
from understudy.ros2.roles import roles_of
from understudy.ros2.transport import Subscription, Transport

__all__ = ["alike", "keep_colors", "paint_of", "picture_from"]

_DARK: Final = 90
"""Sum of the three channels below which a color means nothing; perception leaves such pixels out, too."""

_MIXED: Final = 0.06
"""Where a fifth of the pixels differ from the patch's color by so much, in the channels' shares, it has several."""

_ALIKE: Final = 0.06
"""Two colors that are nearer to each other, in the channels' shares, are taken for each other in changing light."""

_BLOCK: Final = re.compile(r"^colors:.*\n(?:[ \t#].*\n|\n(?=[ \t]))*", re.MULTILINE)
_LOOK_S: Final = 0.05


def paint_of(image: NDArray[np.uint8], at: tuple[int, int], *, half: int = 4) -> tuple[int, int, int]:
    """The color of a patch of a picture.

    Args:
        image: RGB.
        at: its middle, as column and row.
        half: of its width, pixels.

    Raises:
        RobotError: it is not in the picture, too dark, or of several colors.
    """
    rows, width, _ = image.shape
    column, row = at
    if not (half <= column < width - half and half <= row < rows - half):
        raise RobotError(
            f"a patch of {2 * half + 1} pixels around {column},{row} is not in the picture of {width} by {rows};"
            " give column and row of its middle, from the upper left"
        )
    patch = image[row - half : row + half + 1, column - half : column + half + 1].reshape(-1, 3).astype(float)
    paint = np.median(patch, axis=0)
    if paint.sum() < _DARK:
        raise RobotError(f"the patch at {column},{row} is too dark to have a color; bring more light, or move it")
    shares = patch / np.maximum(patch.sum(axis=1, keepdims=True), 1.0)
    if float(np.percentile(np.abs(shares - _shares(paint)), 80, axis=0).max()) > _MIXED:
        raise RobotError(f"the patch at {column},{row} is of several colors; put the middle of one thing there")
    red, green, blue = (round(channel) for channel in paint.tolist())
    return red, green, blue


def alike(paints: Mapping[Color, tuple[int, int, int]]) -> list[tuple[Color, Color]]:
    """The pairs of colors that would be taken for each other.

    Args:
        paints: what was learned; the others are as in plain light.
    """
    all_of = {color: _shares(np.array(paints.get(color, RGB[color]), float)) for color in Color}
    names = list(all_of)
    return [
        (one, other)
        for index, one in enumerate(names)
        for other in names[index + 1 :]
        if float(np.linalg.norm(all_of[one] - all_of[other])) < _ALIKE and (one in paints or other in paints)
    ]


def keep_colors(path: Path, paints: Mapping[Color, tuple[int, int, int]]) -> RobotDocument:
    """Writes colors into a robot document's file, all or nothing; its other lines, comments too, stay as they are.

    Args:
        path: of the document.
        paints: those that were learned; others that it has stay.

    Returns:
        The new document.

    Raises:
        RobotDocumentError: the file cannot be read or written, or is no robot document.
    """
    document = load_robot(path)
    every = {color: (document.colors | dict(paints))[color] for color in Color if color in {*document.colors, *paints}}
    block = "colors:\n" + "".join(f"  {color.value}: {list(paint)}\n" for color, paint in every.items())
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        text = path.read_text(encoding="utf-8")
        rest = _BLOCK.sub("", text if text.endswith("\n") else text + "\n")
        part.write_text(rest + block, encoding="utf-8")
        changed = load_robot(part)
        part.replace(path)
    except OSError as error:
        raise RobotDocumentError(f"this file cannot be written: {error.strerror}", source=str(path)) from None
    finally:
        part.unlink(missing_ok=True)
    return changed


def picture_from(
    document: RobotDocument, transport: Transport, *, timeout_s: float = 10.0, clock: Clock | None = None
) -> NDArray[np.uint8]:
    """The next picture of a robot's camera, in its own size.

    Raises:
        RobotError: none comes; why, and how to mend it.
    """
    clock = clock or WallClock()
    role = next(role for role in roles_of(document) if role.name == "image")
    subscription: Subscription | None = None
    until_s = clock.now() + timeout_s
    while clock.now() < until_s:
        if subscription is None and (choice := role.choose(transport)) is not None:
            topic, type_name = choice
            subscription = transport.subscribe(topic, type_name, role.qos)
        if subscription is not None and (data := subscription.take()):
            return image_of(document.name, RawMessage(topic, type_name, 0, data[-1]))
        transport.wait(_LOOK_S)
    raise RobotError(role.fault(transport) or f"{role.topic} is published, but no picture came; is the camera running?")


def _shares(paint: NDArray[np.float64]) -> NDArray[np.float64]:
    return cast(NDArray[np.float64], paint / paint.sum())
