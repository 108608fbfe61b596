"""The tasks that come with the program."""

from pathlib import Path

from understudy.errors import NetworkError

__all__ = ["task_names", "task_path"]

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
