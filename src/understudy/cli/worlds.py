"""Worlds as they are named on the command line: a file, or one that comes with the program."""

from pathlib import Path
from typing import TYPE_CHECKING

from understudy.errors import WorldError

if TYPE_CHECKING:
    from understudy.sim import World

__all__ = ["find_world"]


def find_world(name: str) -> "World":
    """The world of a file, or a bundled one by its name.

    Raises:
        WorldError: there is neither, or the document is malformed.
    """
    from understudy.sim import load_world, world_names, world_path  # noqa: PLC0415 - MuJoCo takes its time

    if name in world_names():
        return load_world(world_path(name))
    if not Path(name).exists():
        raise WorldError(f"there is no such file, and no such world among: {', '.join(world_names())}", source=name)
    return load_world(name)
