"""Serialising ROS 2 messages: the Humble definitions, and the two of our own.

Humble's definitions of the types used here are those of every later release, so a file's own copies are never compiled:
reading an unknown file runs no code that was made from it.
"""

from functools import cache
from typing import Any

from rosbags.serde import SerdeError
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from understudy.errors import RecordingError
from understudy.recording.exact import DEFINITIONS

__all__ = ["decode_message", "encode_message", "message_definition", "message_fields", "message_hash"]


@cache
def _typestore() -> Typestore:
    store = get_typestore(Stores.ROS2_HUMBLE)
    for name, text in DEFINITIONS.items():
        store.register(get_types_from_msg(text, name))
    return store


@cache
def message_definition(name: str) -> bytes:
    """The text of a message type with all types that it holds, as MCAP's schema encoding ``ros2msg`` wants it."""
    if name in DEFINITIONS:
        return DEFINITIONS[name].encode()  # with its comments, which the type store drops
    text, _ = _typestore().generate_msgdef(name, ros_version=2)
    return text.encode()


@cache
def message_hash(name: str) -> str:
    """The hash by which ROS 2 since Iron tells message types apart (REP 2016)."""
    return _typestore().hash_rihs01(name)


def message_fields(name: str) -> list[tuple[str, Any]]:
    """The fields of a message type, each with its kind as rosbags describes it.

    Raises:
        RecordingError: no such type is known.
    """
    definitions = _typestore().fielddefs
    if name not in definitions:
        raise RecordingError(f"no message type is called {name}; ROS 2 types are called like sensor_msgs/msg/LaserScan")
    return list(definitions[name][1])


def encode_message(message: object, name: str) -> bytes:
    """A message as CDR. The object needs the fields of the type, not its class."""
    return bytes(_typestore().serialize_cdr(message, name))


def decode_message(data: bytes, name: str, *, where: str) -> object:
    """The message that CDR bytes hold.

    Args:
        data: the message's bytes.
        name: its type.
        where: file, topic and time, for the error.

    Raises:
        RecordingError: the bytes are no such message.
    """
    try:
        return _typestore().deserialize_cdr(data, name)
    except SerdeError as error:
        raise RecordingError(
            f"{where} holds {len(data)} bytes that are no {name} ({error}); record it again, or leave the topic out"
        ) from error
