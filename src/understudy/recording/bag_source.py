"""Reading rosbag2 folders, of SQLite or MCAP storage, in one file or several; and single SQLite files."""

from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType
from typing import Final

import apsw
from rosbags.rosbag2 import Reader, ReaderError

from understudy.errors import RecordingError
from understudy.recording.mcap_records import DAMAGE
from understudy.recording.source import RawMessage, Topic

__all__ = ["BagSource", "is_bag"]

_SQLITE: Final = b"SQLite format 3\0"


def is_bag(path: Path) -> bool:
    """Whether this is a rosbag2 folder, or an SQLite file as one holds."""
    if path.is_dir():
        return (path / "metadata.yaml").exists()
    try:
        with path.open("rb") as file:
            return file.read(len(_SQLITE)) == _SQLITE
    except OSError:
        return False  # whoever opens it says what is wrong


class BagSource:
    """A rosbag2. Each walk through it opens it anew.

    Raises:
        RecordingError: it cannot be read.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        with self._opened() as reader:
            self._topics = {
                name: Topic(
                    types=tuple(dict.fromkeys(one.msgtype for one in topic.connections)),
                    encodings=("cdr",),  # the reader refuses all others
                    count=topic.msgcount,
                )
                for name, topic in sorted(reader.topics.items())
            }
            self._duration_s = reader.duration / 1e9

    @property
    def path(self) -> Path:
        """The folder, or the file."""
        return self._path

    @property
    def topics(self) -> Mapping[str, Topic]:
        """By name."""
        return self._topics

    @property
    def metadata(self) -> Mapping[str, str]:
        """Nothing: it is another program's."""
        return MappingProxyType({})

    @property
    def attachments(self) -> tuple[str, ...]:
        """None: a rosbag2 has no place for them."""
        return ()

    @property
    def duration_s(self) -> float:
        """From the first message to the last."""
        return self._duration_s

    @property
    def complete(self) -> bool:
        """Whether it has its end; one that has none cannot be opened."""
        return True

    def messages(self, topics: Collection[str], *, sorted_by_time: bool) -> Iterator[RawMessage]:
        """The messages of these topics, by their times within each of its files.

        Raises:
            RecordingError: it is damaged.
        """
        with self._opened() as reader:
            wanted = [one for one in reader.connections if one.topic in topics]
            if wanted:  # none would mean all of them
                for connection, time_ns, data in reader.messages(wanted):
                    yield RawMessage(connection.topic, connection.msgtype, time_ns, bytes(data))

    def attachment(self, name: str) -> bytes:
        """There is none.

        Raises:
            RecordingError: always.
        """
        raise RecordingError(f"{self.path} has no attachment {name!r}; a rosbag2 has none")

    @contextmanager
    def _opened(self) -> Iterator[Reader]:
        try:
            with Reader(self._path) as reader:
                yield reader
        except (ReaderError, apsw.Error, *DAMAGE) as error:
            raise RecordingError(
                f"{self._path} cannot be read as a rosbag2 ({error or type(error).__name__}); mend it with"
                f" `ros2 bag reindex {self._path}`, or copy it anew from where it was recorded"
            ) from error
        except OSError as error:
            raise RecordingError(f"{self._path} cannot be read: {error.strerror or error}") from error
