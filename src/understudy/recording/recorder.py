"""Writing a recording while it happens."""

import json
import os
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from types import MappingProxyType, TracebackType
from typing import Any, Final, Literal, Self, get_args

import numpy as np
from mcap.well_known import MessageEncoding, Profile, SchemaEncoding
from mcap.writer import CompressionType, Writer

from understudy import __version__
from understudy.errors import RecordingError
from understudy.recording.encoding import (
    CommandEncoder,
    ObservationEncoder,
    TopicMessage,
    nanoseconds,
    string_message,
)
from understudy.recording.topics import EVENTS_TOPIC
from understudy.recording.typestore import encode_message, message_definition
from understudy.robot import Command, Observation, RobotSpec

__all__ = ["FORMAT_VERSION", "METADATA_NAME", "Recorder", "RecordingKind"]

FORMAT_VERSION: Final = 1
"""Raised when an older reader would misread a newer recording; new topics and metadata do not raise it."""

METADATA_NAME: Final = "understudy"
"""The name of the MCAP metadata record."""

RecordingKind = Literal["demonstration", "run"]

_FLUSH_PERIOD_NS: Final = 1_000_000_000
"""At most this much is lost when the process is killed. Each flush ends a chunk: shorter ones compress worse."""

_RESERVED: Final = ("format", "kind", "name", "robot", "software")

_MEDIA_TYPES: Final = {".yaml": "application/yaml", ".yml": "application/yaml", ".json": "application/json"}


class Recorder:
    """One demonstration or run, written to one MCAP file.

    All but the last second is with the operating system at any time: a process that is killed leaves a readable file.

    Args:
        path: the file; it must not exist yet, and its folder must.
        kind: ``"demonstration"`` or ``"run"``.
        name: what people call it.
        spec: the robot that is recorded.
        metadata: whatever else describes it, for example ``seed`` and ``world``.
        attachments: documents by their file names, so that the recording explains itself.

    Raises:
        RecordingError: the file exists or cannot be written; here and in every method.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        *,
        kind: RecordingKind,
        name: str,
        spec: RobotSpec,
        metadata: Mapping[str, str] = MappingProxyType({}),
        attachments: Mapping[str, bytes] = MappingProxyType({}),
    ) -> None:
        self.path = Path(path)
        self._encoder = ObservationEncoder(spec)
        self._commands = CommandEncoder()
        self._channels: dict[tuple[str, str], int] = {}
        self._schemas: dict[str, int] = {}
        self._flushed_ns: int | None = None
        self._over: str | None = None
        described = _described(kind, name, spec, metadata)
        try:
            self._file = self.path.open("xb")
        except FileExistsError:
            raise RecordingError(
                f"{self.path} exists already, and a recording is never overwritten; name another file, or move that one"
            ) from None
        except OSError as error:
            raise RecordingError(
                f"{self.path} cannot be written ({error.strerror}); name a file in a folder that exists"
                " and that you may write to"
            ) from error
        self._writer = Writer(self._file, compression=CompressionType.ZSTD)
        try:
            self._writer.start(profile=Profile.ROS2, library=f"understudy {__version__}")
            self._writer.add_metadata(METADATA_NAME, described)
            for file_name, data in attachments.items():
                # No wall-clock time: the same run makes the same file.
                media_type = _MEDIA_TYPES.get(Path(file_name).suffix, "application/octet-stream")
                self._writer.add_attachment(0, 0, file_name, media_type, data)
            self._writer.flush()  # type: ignore[no-untyped-call]  # as mcap has it
        except OSError as error:
            raise self._never_begun(error) from error

    def observation(self, obs: Observation) -> None:
        """Records what the robot sensed in one control step."""
        self._write(obs.time_s, self._encoder.messages(obs))

    def command(self, time_s: float, command: Command) -> None:
        """Records what the robot was told at this time."""
        self._write(time_s, self._commands.messages(time_s, command))

    def event(self, event: Mapping[str, object]) -> None:
        """Records an event of the trace: ``time_s``, ``kind``, and whatever else JSON can hold.

        It comes back as JSON gives it: tuples as lists, NumPy values as Python's. Infinity and NaN are kept.

        Raises:
            RecordingError: also when ``time_s`` or ``kind`` is missing, or a value is none that JSON knows.
        """
        time_s = event.get("time_s")
        if not isinstance(time_s, int | float) or "kind" not in event:
            raise RecordingError(f'an event needs a number "time_s" and a "kind"; this one has {dict(event)}')
        try:
            text = json.dumps(dict(event), default=_plain)
        except (TypeError, ValueError) as error:
            raise RecordingError(f"the event {dict(event)} cannot be written as JSON: {error}") from error
        self._write(time_s, [string_message(EVENTS_TOPIC, text)])

    def close(self) -> None:
        """Completes the file with its index. May be called again."""
        if self._over is not None:
            return
        self._over = "closed"
        try:
            self._writer.finish()  # type: ignore[no-untyped-call]  # as mcap has it
            self._file.close()
        except OSError as error:
            raise self._failed(error) from error

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _write(self, time_s: float, messages: Iterable[TopicMessage]) -> None:
        if self._over is not None:
            raise RecordingError(f"{self.path} is {self._over}; record into a new file")
        time_ns = nanoseconds(time_s)
        # All or nothing: a message that cannot be made must not leave half a step behind.
        encoded = [(topic, type_, encode_message(message, type_)) for topic, type_, message in messages]
        try:
            for topic, type_, data in encoded:
                self._writer.add_message(self._channel(topic, type_), time_ns, data, time_ns)
            # At once after the first message, too: a recording killed within its first second is one.
            if self._flushed_ns is None or abs(time_ns - self._flushed_ns) >= _FLUSH_PERIOD_NS:
                self._writer.flush()  # type: ignore[no-untyped-call]  # as mcap has it
                self._flushed_ns = time_ns
        except OSError as error:
            raise self._failed(error) from error

    def _channel(self, topic: str, type_: str) -> int:
        if (topic, type_) not in self._channels:
            if type_ not in self._schemas:
                self._schemas[type_] = self._writer.register_schema(
                    type_, SchemaEncoding.ROS2, message_definition(type_)
                )
            # The key that rosbag2 looks for; empty: its defaults.
            self._channels[topic, type_] = self._writer.register_channel(
                topic, MessageEncoding.CDR, self._schemas[type_], {"offered_qos_profiles": ""}
            )
        return self._channels[topic, type_]

    def _never_begun(self, error: OSError) -> RecordingError:
        """Takes the file away: without a header it is no recording, and it would block its name."""
        with suppress(OSError):
            self._file.close()  # tries the pending bytes once more, and closes in any case
        with suppress(OSError):
            self.path.unlink()
        return RecordingError(
            f"{self.path} cannot be written: {error.strerror}; there is no such file now."
            " Make room, or choose another disk, and record again"
        )

    def _failed(self, error: OSError) -> RecordingError:
        """Gives the file up, with what is in it."""
        with suppress(OSError):
            self._file.close()  # tries the pending bytes once more, and closes in any case
        kept = "nothing" if self._flushed_ns is None else f"what was recorded until t={self._flushed_ns / 1e9:g} s"
        self._over = f"broken off ({error.strerror})"
        return RecordingError(
            f"{self.path} cannot be written any further: {error.strerror}; {kept} is kept in it."
            " Make room, or choose another disk, and record again"
        )


def _described(kind: str, name: str, spec: RobotSpec, metadata: Mapping[str, str]) -> dict[str, str]:
    if kind not in get_args(RecordingKind):
        raise RecordingError(f"{kind!r} is no kind of recording; it is one of {', '.join(get_args(RecordingKind))}")
    if taken := sorted(set(metadata) & set(_RESERVED)):
        raise RecordingError(f"the metadata {', '.join(taken)} are written by the recorder itself; use other keys")
    own = {"format": str(FORMAT_VERSION), "kind": kind, "name": name, "robot": spec.name}
    return own | {"software": f"understudy {__version__}"} | dict(metadata)


def _plain(value: object) -> Any:
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    raise TypeError(f"{value!r} is a {type(value).__name__}")
