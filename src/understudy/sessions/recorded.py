"""What a recording is of: the robot, the room, the task."""

from typing import Any

from understudy.documents import parse_text
from understudy.errors import DocumentError, NetworkError, RecordingError, RobotDocumentError, WorldError
from understudy.network import Network, Task, parse_task
from understudy.recording import Recording
from understudy.robot import PIONEER, ROBOTS, RobotSpec
from understudy.ros2 import parse_robot
from understudy.sim import World

__all__ = ["limit_of", "seed_of", "spec_of", "task_of", "world_of"]


def spec_of(recording: Recording) -> RobotSpec:
    """The robot that was recorded; the Pioneer for a bag, which does not say.

    Raises:
        RecordingError: it is of a robot that is not known here.
        RobotDocumentError: what is attached is no robot.
    """
    name = "robot.yaml"
    if name in recording.info.attachments:
        return parse_robot(_attached(recording, name, RobotDocumentError), source=_source(recording, name)).spec
    robot = recording.info.robot or PIONEER.name
    if robot not in ROBOTS:
        raise RecordingError(
            f"{recording.info.path} is of a robot called {robot!r}; known here are: {', '.join(ROBOTS)}"
        )
    return ROBOTS[robot]


def seed_of(recording: Recording) -> int:
    """Of all chance in it; the world's own, or 0, where that is not said."""
    if "seed" in recording.info.metadata:
        return int(recording.info.metadata["seed"])
    world = world_of(recording)
    return world.seed if world is not None else 0


def limit_of(recording: Recording) -> float:
    """How many seconds the run was allowed; five minutes where that is not said (§4.5.4.1)."""
    return float(recording.info.metadata.get("limit_s", 300.0))


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
