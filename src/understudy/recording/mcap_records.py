"""The records of an MCAP file, up to the first that is broken."""

import io
import struct
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import BinaryIO, Final

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.records import Chunk, McapRecord
from mcap.stream_reader import StreamReader, breakup_chunk
from mcap.writer import MCAP0_MAGIC

from understudy.errors import RecordingError

__all__ = ["DAMAGE", "check_is_mcap", "chunk_records", "stored_records", "summary_is_intact"]

DAMAGE: Final = (
    McapError,
    zstandard.ZstdError,
    struct.error,
    ValueError,  # checksums, UTF-8
    KeyError,  # a channel or schema that was never declared
    RuntimeError,  # lz4
    EOFError,
    OverflowError,
    MemoryError,
)
"""What the decoders of records and chunks raise on broken bytes."""

_FOOTER: Final = struct.Struct("<QQI8s")
"""Where the summary starts, where its offsets start, its checksum (0: none), and the magic that ends the file."""

_OTHER_FORMATS: Final = {b"#ROSBAG": "a ROS 1 bag"}


def check_is_mcap(path: Path) -> None:
    """Refuses what is no MCAP file.

    Raises:
        RecordingError: the file is missing, empty, a folder, or in another format.
    """
    try:
        if path.is_dir():
            inside = sorted(path.glob("*.mcap"))
            mend = f"read the file in it: {inside[0]}" if inside else "name an .mcap file"
            raise RecordingError(f"{path} is a folder without the metadata.yaml of a rosbag2; {mend}")
        with path.open("rb") as file:
            start = file.read(16)
    except OSError as error:
        raise RecordingError(f"{path} cannot be read ({error.strerror}); name an .mcap file that exists") from error
    if not start:
        raise RecordingError(f"{path} is empty, and a recording is an MCAP file; record it again")
    if start.startswith(MCAP0_MAGIC):
        return
    for magic, what in _OTHER_FORMATS.items():
        if start.startswith(magic):
            raise RecordingError(
                f"{path} is {what}, and a recording is an MCAP file;"
                f" convert it: rosbags-convert --src {path} --dst {path.with_suffix('')}-mcap --dst-storage mcap"
            )
    raise RecordingError(f"{path} is no MCAP file (it begins with {start[:8]!r}); name a recording that ends in .mcap")


def summary_is_intact(file: BinaryIO) -> bool:
    """Whether a file has a summary that fits its checksum, where it has one; the MCAP reader does not look."""
    end = file.seek(0, io.SEEK_END)
    if end < _FOOTER.size:
        return False
    file.seek(end - _FOOTER.size)
    summary_start, _, checksum, magic = _FOOTER.unpack(file.read(_FOOTER.size))
    summary_end = end - len(MCAP0_MAGIC) - 4  # the checksum covers the footer, too, up to itself
    if magic != MCAP0_MAGIC or not 0 < summary_start <= summary_end:
        return False
    file.seek(summary_start)
    return checksum in (0, zlib.crc32(file.read(summary_end - summary_start)))


def stored_records(path: Path) -> Iterator[McapRecord]:
    """The records of a file in stored order, those in chunks unpacked and checked.

    Raises:
        DAMAGE: one of these, at the first record that is broken or not whole.
    """
    with path.open("rb") as file:
        # No record is longer than its file; without the limit a broken length would ask for gigabytes.
        reader = StreamReader(file, emit_chunks=True, record_size_limit=path.stat().st_size)
        for record in reader.records:
            if isinstance(record, Chunk):
                yield from breakup_chunk(record, validate_crc=True)
            else:
                yield record


def chunk_records(path: Path, offsets: Iterable[int]) -> Iterator[McapRecord]:
    """The records in the chunks at these places, in stored order.

    The places come from the index, which has a checksum. What a walk goes by, the lengths of the records, has none: one
    wrong bit there, and a whole chunk would be passed over in silence.

    Raises:
        DAMAGE: one of these, at the first chunk that is broken.
    """
    with path.open("rb") as file:
        for offset in sorted(offsets):
            file.seek(offset + 9)  # behind its opcode and its length
            yield from breakup_chunk(Chunk.read(ReadDataStream(file)), validate_crc=True)
