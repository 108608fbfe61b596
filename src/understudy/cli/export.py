"""``understudy export``"""

from pathlib import Path
from typing import Annotated, Literal

import typer

__all__ = ["command"]


def command(
    recording: Annotated[Path, typer.Argument(help="A recording (.mcap).")],
    ros2bag: Annotated[Path | None, typer.Option("--ros2bag", help="The rosbag2 folder to write; a new one.")] = None,
    storage: Annotated[
        Literal["sqlite3", "mcap"], typer.Option(help="How the folder stores its messages.")
    ] = "sqlite3",
) -> None:
    """Writes a recording in another format."""
    if ros2bag is None:
        raise typer.BadParameter("in which format? Name a folder with --ros2bag")
    from understudy.recording import export_bag  # noqa: PLC0415 - help must come at once

    count = export_bag(recording, ros2bag, storage=storage)
    typer.echo(f"{count} messages in {ros2bag}; play them with: ros2 bag play {ros2bag}")
