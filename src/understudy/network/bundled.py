"""The tasks that come with the program."""

from pathlib import Path

from understudy.errors import NetworkError

__all__ = ["find_task", "task_names", "task_path"]

_BUNDLED = Path(__file__).parent / "tasks"


def task_names() -> tuple[str, ...]:
    """Names of the bundled tasks."""
    return tuple(sorted(path.stem for path in _BUNDLED.glob("*.yaml")))


def task_path(name: str) -> Path:
    """The file of a bundled task.

    Raises:
        NetworkError: no bundled task has this name.
    """
    if name not in task_names():
        raise NetworkError(f"no bundled task is called {name!r}; there are: {', '.join(task_names()) or 'none'}")
    return _BUNDLED / f"{name}.yaml"


def find_task(name: str | Path) -> Path:
    """The file of a task: the one that is named, or a bundled one by its name.

    Raises:
        NetworkError: there is neither.
    """
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
