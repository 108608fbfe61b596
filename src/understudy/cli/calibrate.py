"""``understudy calibrate``"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from understudy.robot import Color

__all__ = ["command"]


def command(
    robot: Annotated[Path, typer.Argument(help="The document of the robot, into which the colors are written.")],
    patch: Annotated[
        list[str],
        typer.Option(
            "--patch",
            help="COLOR=COLUMN,ROW, where in the picture something of this color is; COLOR alone: in its middle.",
        ),
    ],
    picture: Annotated[
        Path | None, typer.Option(help="A picture that the camera took; its next one, over ROS 2, if not given.")
    ] = None,
    half: Annotated[int, typer.Option(min=0, max=100, help="Half of a patch's width, pixels.")] = 4,
) -> None:
    """Learns how a robot's camera sees the eight colors. Exit code 1 if two of them look alike to it."""
    import cv2  # noqa: PLC0415 - help must come at once
    import numpy as np  # noqa: PLC0415

    from understudy.errors import RobotError  # noqa: PLC0415
    from understudy.ros2 import alike, keep_colors, load_robot, open_transport, paint_of, picture_from  # noqa: PLC0415

    document = load_robot(robot)
    places = [_read(one) for one in patch]
    if picture is not None:
        found = cv2.imdecode(np.frombuffer(picture.read_bytes(), np.uint8), cv2.IMREAD_COLOR_RGB)
        if found is None:
            raise RobotError(f"{picture} is no picture that can be read; PNG and JPEG can")
        image = np.asarray(found, np.uint8)
    else:
        transport = open_transport(document.transport, domain=document.domain)
        try:
            image = picture_from(document, transport)
        finally:
            transport.close()
    rows, width, _ = image.shape
    paints = {color: paint_of(image, at or (width // 2, rows // 2), half=half) for color, at in places}
    document = keep_colors(robot, paints)
    for color, (red, green, blue) in paints.items():
        typer.echo(f"{color.value}: {red}, {green}, {blue}")
    missing = [color.value for color in _all_colors() if color not in document.colors]
    typer.echo(f"Written into {robot}" + (f"; as in plain light: {', '.join(missing)}" if missing else ""))
    pairs = alike(document.colors)
    for one, other in pairs:
        typer.echo(f"{one.value} and {other.value} look alike to this camera; paint one of them otherwise", err=True)
    raise typer.Exit(1 if pairs else 0)


def _all_colors() -> "tuple[Color, ...]":
    from understudy.robot import Color  # noqa: PLC0415

    return tuple(Color)


def _read(patch: str) -> "tuple[Color, tuple[int, int] | None]":
    """A color and a place, from ``COLOR=COLUMN,ROW``."""
    from understudy.robot import Color  # noqa: PLC0415

    name, _, place = patch.partition("=")
    try:
        color = Color(name.strip())
        if not place:
            return color, None
        column, row = (int(number) for number in place.split(","))
    except ValueError:
        raise typer.BadParameter(
            f"{patch!r} is no COLOR=COLUMN,ROW; the colors are: {', '.join(Color)}; in quotes if one has a blank"
        ) from None
    return color, (column, row)
