"""Worlds as they are named on the command line: a file, or one that comes with the program."""

from pathlib import Path
from typing import TYPE_CHECKING

from understudy.errors import WorldError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from understudy.behaviors import Skill
    from understudy.network import Network
    from understudy.sim import World

__all__ = ["absent_colors", "find_world"]


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


def absent_colors(network: "Network", world: "World", skills: "Mapping[str, Skill]") -> list[str]:
    """The colors that a task asks for and that nothing in a room has: the robot would search for them in vain."""
    from understudy.network import Component  # noqa: PLC0415 - help must come at once

    present = {target.color.value for target in world.targets} | {box.color.value for box in world.boxes}
    asked: list[str] = []
    for part in network.by_path.values():
        if isinstance(part, Component) and part.behavior in skills:
            named = [one.name for one in skills[part.behavior].abstract.parameters if one.kind == "color"]
            asked += [str(part.parameters[name]) for name in named if name in part.parameters]
    return [color for color in dict.fromkeys(asked) if color not in present]
