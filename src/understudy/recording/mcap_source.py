"""Reading MCAP files: the whole ones by their index, those that break off up to the last whole record."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from mcap.reader import make_reader
from mcap.records import Attachment, Channel, Footer, Message, Metadata, Schema

from understudy.errors import RecordingError
from understudy.recording.mcap_records import DAMAGE, check_is_mcap, chunk_records, stored_records, summary_is_intact
from understudy.recording.recorder import METADATA_NAME
from understudy.recording.source import RawMessage, Topic

__all__ = ["McapSource"]


@dataclass(slots=True, kw_only=True)
class _Contents:
    """What a file holds, from its index or from a walk through it; only the index tells where its chunks are."""

    channels: dict[int, Channel] = field(default_factory=dict)
    schemas: dict[int, Schema] = field(default_factory=dict)
    counts: Mapping[int, int] = field(default_factory=dict)
    metadata: dict[str, str] = field(default_factory=dict)
    attachments: list[str] = field(default_factory=list)
    start_ns: int = 0
    end_ns: int = 0
    chunks: list[int] = field(default_factory=list)
    complete: bool = False

    def type_of(self, channel: Channel) -> str:
        """The full name of a channel's message type; some writers leave the ``/msg/`` out."""
        schema = self.schemas.get(channel.schema_id)
        if schema is None:
            return "a message of unknown type"
        package, _, name = schema.name.rpartition("/")
        return schema.name if "/" in package or not package else f"{package}/msg/{name}"


class McapSource:
    """One MCAP file. Each walk through it opens the file anew.

    Raises:
        RecordingError: the file is missing, empty, or no MCAP.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        check_is_mcap(path)
        self._contents = self._indexed_contents() or self._walked_contents()
        self._topics = _topics(self._contents)

    @property
    def path(self) -> Path:
        """The file."""
        return self._path

    @property
    def topics(self) -> Mapping[str, Topic]:
        """By name."""
        return self._topics

    @property
    def metadata(self) -> Mapping[str, str]:
        """What Understudy's recorder wrote about the recording; empty for other bags."""
        return self._contents.metadata

    @property
    def attachments(self) -> tuple[str, ...]:
        """The names of the attached documents."""
        return tuple(self._contents.attachments)

    @property
    def duration_s(self) -> float:
        """From the first message to the last."""
        return (self._contents.end_ns - self._contents.start_ns) / 1e9

    @property
    def complete(self) -> bool:
        """Whether the file has its end, and everything before it."""
        return self._contents.complete

    def messages(self, topics: Collection[str], *, sorted_by_time: bool) -> Iterator[RawMessage]:
        """The messages of these topics; in stored order, too, where there is no index to sort them by.

        Raises:
            RecordingError: damage in a file with an intact index, or the disk cannot be read.
        """
        wanted = frozenset(topics)
        try:
            if sorted_by_time and self._contents.chunks:
                yield from self._sorted_messages(wanted)
            else:
                yield from self._stored_messages(wanted)
        except DAMAGE as error:
            # The readers of a file that breaks off have been told so by `complete`.
            if self.complete:
                raise RecordingError(
                    f"{self.path} is damaged ({error or type(error).__name__});"
                    " what was read up to here is good. Copy the file anew from where it was recorded"
                ) from error
        except OSError as error:
            raise RecordingError(f"{self.path} cannot be read any further: {error.strerror}") from error

    def attachment(self, name: str) -> bytes:
        """An attached document.

        Raises:
            RecordingError: there is none of this name.
        """
        try:
            for record in stored_records(self.path):
                if isinstance(record, Attachment) and record.name == name:
                    return record.data
        except (*DAMAGE, OSError):
            pass  # it was not among what can be read
        held = ", ".join(self.attachments) or "none"
        raise RecordingError(f"{self.path} has no attachment {name!r}; it has: {held}")

    def _sorted_messages(self, topics: frozenset[str]) -> Iterator[RawMessage]:
        with self.path.open("rb") as file:
            for _, channel, message in make_reader(file, validate_crcs=True).iter_messages(topics):
                yield RawMessage(channel.topic, self._contents.type_of(channel), message.log_time, message.data)

    def _stored_messages(self, topics: frozenset[str]) -> Iterator[RawMessage]:
        wanted = {id_: channel for id_, channel in self._contents.channels.items() if channel.topic in topics}
        types = {id_: self._contents.type_of(channel) for id_, channel in wanted.items()}
        chunks = self._contents.chunks
        for record in chunk_records(self.path, chunks) if chunks else stored_records(self.path):
            if isinstance(record, Message) and record.channel_id in wanted:
                channel_id = record.channel_id
                yield RawMessage(wanted[channel_id].topic, types[channel_id], record.log_time, record.data)

    def _indexed_contents(self) -> _Contents | None:
        """From the summary at the end; None where it is missing or broken, or says too little."""
        try:
            with self.path.open("rb") as file:
                if not summary_is_intact(file):
                    return None
                file.seek(0)
                reader = make_reader(file)
                summary = reader.get_summary()
                if summary is None or summary.statistics is None or not summary.channels or not summary.chunk_indexes:
                    return None
                metadata = [record.metadata for record in reader.iter_metadata() if record.name == METADATA_NAME]
                return _Contents(
                    channels=summary.channels,
                    schemas=summary.schemas,
                    counts=summary.statistics.channel_message_counts,
                    metadata=metadata[0] if metadata else {},
                    attachments=[index.name for index in summary.attachment_indexes],
                    start_ns=summary.statistics.message_start_time,
                    end_ns=summary.statistics.message_end_time,
                    chunks=[index.chunk_start_offset for index in summary.chunk_indexes],
                    complete=True,
                )
        except (*DAMAGE, OSError):
            return None

    def _walked_contents(self) -> _Contents:
        contents = _Contents()
        counts: Counter[int] = Counter()
        try:
            for record in stored_records(self.path):
                match record:
                    case Message():
                        first = not counts
                        counts[record.channel_id] += 1
                        contents.start_ns = record.log_time if first else min(contents.start_ns, record.log_time)
                        contents.end_ns = max(contents.end_ns, record.log_time)
                    case Channel():
                        # Repeated in the index at the end; those in the chunks have a checksum.
                        contents.channels.setdefault(record.id, record)
                    case Schema():
                        contents.schemas.setdefault(record.id, record)
                    case Metadata() if record.name == METADATA_NAME:
                        contents.metadata = record.metadata
                    case Attachment():
                        contents.attachments.append(record.name)
                    case Footer():
                        contents.complete = True
                    case _:
                        pass  # indexes
        except DAMAGE:
            contents.complete = False
        except OSError as error:
            raise RecordingError(f"{self.path} cannot be read: {error.strerror}") from error
        contents.counts = counts
        return contents


def _topics(contents: _Contents) -> dict[str, Topic]:
    by_name: dict[str, list[Channel]] = {}
    for channel in contents.channels.values():
        by_name.setdefault(channel.topic, []).append(channel)
    return {
        name: Topic(
            types=tuple(dict.fromkeys(contents.type_of(channel) for channel in channels)),
            encodings=tuple(dict.fromkeys(channel.message_encoding for channel in channels)),
            count=sum(contents.counts.get(channel.id, 0) for channel in channels),
        )
        for name, channels in sorted(by_name.items())
    }
