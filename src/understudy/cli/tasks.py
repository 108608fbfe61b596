"""Tasks as they are named on the command line: a file, or one that comes with the program."""

from pathlib import Path

from understudy.errors import NetworkError

__all__ = ["find_task"]


def find_task(name: str | Path) -> Path:
    """The file of a task: the one that is named, or a bundled one by its name.

    Raises:
        NetworkError: there is neither.
    """
    from understudy.network import task_names, task_path  # noqa: PLC0415 - help must come at once

    path = Path(name)
    if path.exists():
        return path
    if str(name) in task_names():
        return task_path(str(name))
    if path.suffix:
        return path  # whoever opens it says what is wrong
    raise NetworkError(
        f"there is no such file, and no such task among: {', '.join(task_names()) or 'none'}", source=str(name)
    )
