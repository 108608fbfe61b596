"""The seam between what a recording means and how it is stored.

One MCAP file is a source; another way of storing, such as a rosbag2 folder, is another class of this shape.
"""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Protocol

__all__ = ["RawMessage", "Source", "Topic"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Topic:
    """A topic as stored.

    Attributes:
        types: full names of its message types, ``sensor_msgs/msg/LaserScan``; nearly always one.
        encodings: how its messages are serialised; ROS 2 has ``cdr``.
        count: how many messages it has.
    """

    types: tuple[str, ...]
    encodings: tuple[str, ...]
    count: int


class RawMessage(NamedTuple):
    """One stored message, not yet decoded."""

    topic: str
    type: str
    time_ns: int
    data: bytes


class Source(Protocol):
    """A store of timed messages by topic."""

    @property
    def path(self) -> Path:
        """Where it is."""
        ...

    @property
    def topics(self) -> Mapping[str, Topic]:
        """By name."""
        ...

    @property
    def metadata(self) -> Mapping[str, str]:
        """What the recorder wrote about the recording; empty for bags of other makers."""
        ...

    @property
    def attachments(self) -> tuple[str, ...]:
        """The names of the attached documents."""
        ...

    @property
    def duration_s(self) -> float:
        """From the first message to the last."""
        ...

    @property
    def complete(self) -> bool:
        """False where the store breaks off or is damaged."""
        ...

    def messages(self, topics: Collection[str], *, sorted_by_time: bool) -> Iterator[RawMessage]:
        """The messages of these topics, in stored order or by their times; in stored order where it breaks off.

        Raises:
            RecordingError: damage in a store that says to be complete.
        """
        ...

    def attachment(self, name: str) -> bytes:
        """An attached document.

        Raises:
            RecordingError: there is none of this name.
        """
        ...
