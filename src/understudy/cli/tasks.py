"""Tasks as they are named on the command line: a file, one that comes with the program, or one in the library."""

from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from understudy.cli.options import DEFAULT_WORKSPACE
from understudy.errors import NetworkError

if TYPE_CHECKING:
    from understudy.library import Library, Revision
    from understudy.network import Network, Task

__all__ = ["NamedTask", "named_task", "open_library", "place_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedTask:
    """A task that somebody named.

    Attributes:
        task: its document.
        network: the same as a network.
        source: where it is, for messages.
        kept: the revision, if it is in the library; None for a file.
    """

    task: "Task"
    network: "Network"
    source: str
    kept: "Revision | None" = None


def place_of(library: str | None, workspace: Path = DEFAULT_WORKSPACE) -> str:
    """Where the library is: as it was said, else in the workspace."""
    return library or str(workspace / "library.db")


def open_library(location: str) -> "Library":
    """The library at a place, made if it is not there, by the computer's clock.

    Raises:
        LibraryError: it cannot be opened.
    """
    from understudy.library import Library  # noqa: PLC0415 - help must come at once

    return Library(location, now=lambda: datetime.now(UTC))


def named_task(name: str | Path, library: str | None = None, workspace: Path = DEFAULT_WORKSPACE) -> NamedTask:
    """A file; else a task that comes with the program; else one in the library, ``fetch``, or ``fetch@3``.

    Args:
        name: what was given.
        library: as it was given with ``--library``.
        workspace: in which it is otherwise.

    Raises:
        NetworkError: there is none of them, or the document is malformed.
        LibraryError: the library cannot be opened, or has no such revision.
    """
    from understudy.library import exists, name_and_number, network_of  # noqa: PLC0415
    from understudy.network import load_task, task_names, task_path  # noqa: PLC0415

    path, place = Path(name), place_of(library, workspace)
    if path.is_file() or (path.suffix.lower() in (".yaml", ".yml", ".json") and not path.is_dir()):
        task, network = load_task(path)  # which says what is wrong with it
        return NamedTask(task=task, network=network, source=str(path))
    if str(name) in task_names():
        task, network = load_task(task_path(str(name)))
        return NamedTask(task=task, network=network, source=str(name))
    if not exists(place):
        raise NetworkError(
            f"there is no such file, no such task among: {', '.join(task_names())}; and no library in {place}",
            source=str(name),
        )
    kept, number = name_and_number(str(name))
    opened = open_library(place)
    names = opened.names()
    if kept not in names:
        raise NetworkError(
            f"there is no such file, no such task among: {', '.join(task_names())}; nor among those in the library"
            f" {place}: {', '.join(names) or 'none'}",
            source=str(name),
        )
    revision = opened.revision(kept, number)
    task, network = network_of(revision)
    return NamedTask(task=task, network=network, source=str(revision), kept=revision)
