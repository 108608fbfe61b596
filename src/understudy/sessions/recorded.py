"""The documents that a recording carries: the room and the task."""

from typing import Any

from understudy.documents import parse_text
from understudy.errors import DocumentError, NetworkError, WorldError
from understudy.network import Network, Task, parse_task
from understudy.recording import Recording
from understudy.sim import World

__all__ = ["task_of", "world_of"]


def task_of(recording: Recording) -> tuple[Task, Network] | None:
    """The task that was executed; None if none is attached.

    Raises:
        NetworkError: what is attached is no task.
    """
    name = "task.yaml"
    if name not in recording.info.attachments:
        return None
    return parse_task(_attached(recording, name, NetworkError), source=_source(recording, name))


def world_of(recording: Recording) -> World | None:
    """The simulated room; None if none is attached.

    Raises:
        WorldError: what is attached is no world.
    """
    name = "world.yaml"
    if name not in recording.info.attachments:
        return None
    return World.from_data(_attached(recording, name, WorldError), source=_source(recording, name))


def _attached(recording: Recording, name: str, kind: type[DocumentError]) -> Any:
    try:
        text = recording.attachment(name).decode()
    except UnicodeDecodeError:
        raise kind(
            "the attachment is no text in UTF-8, so it is no document", source=_source(recording, name)
        ) from None
    return parse_text(text, source=_source(recording, name), kind=kind)


def _source(recording: Recording, name: str) -> str:
    return f"{recording.info.path}: {name}"
