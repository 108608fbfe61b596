"""Tasks as they are named on the command line: a file, or one that comes with the program."""

from pathlib import Path

__all__ = ["find_task"]


def find_task(name: str | Path) -> Path:
    """The file of a task: the one that is named, or a bundled one by its name.

    Raises:
        NetworkError: there is neither.
    """
    from understudy.network import find_task as found  # noqa: PLC0415 - help must come at once

    return found(name)
