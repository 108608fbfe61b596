"""ROS 2 message types as DDS knows them: made from their definitions, carrying bytes that were serialised elsewhere.

Cyclone DDS wants a Python class for every type. It needs the fields to tell others what the type is; serialising by
them would take 46 ms for a camera image, so the class only hands over the CDR bytes that rosbags has made.
"""

from functools import cache
from typing import Any, cast

from cyclonedds.idl import make_idl_struct, types
from rosbags.interfaces import Nodetype

from understudy.recording import message_fields

__all__ = ["dds_type_name", "ros_type_name", "sample_type"]

_BASE: dict[str, Any] = {
    "bool": bool,
    "byte": types.byte,
    "char": types.uint8,
    "float32": types.float32,
    "float64": types.float64,
    "int8": types.int8,
    "int16": types.int16,
    "int32": types.int32,
    "int64": types.int64,
    "string": str,
    "uint8": types.uint8,
    "uint16": types.uint16,
    "uint32": types.uint32,
    "uint64": types.uint64,
}

# Generic only in what Cyclone DDS makes of the subscript.
_ARRAY: Any = types.array
_SEQUENCE: Any = types.sequence


def dds_type_name(name: str) -> str:
    """``sensor_msgs/msg/Image`` as DDS calls it, ``sensor_msgs::msg::dds_::Image_``."""
    package, kind, message = name.split("/")
    return f"{package}::{kind}::dds_::{message}_"


def ros_type_name(name: str) -> str:
    """The inverse of :func:`dds_type_name`; what is no ROS 2 type keeps its name."""
    match name.split("::"):
        case package, kind, "dds_", message if message.endswith("_"):
            return f"{package}/{kind}/{message[:-1]}"
        case _:
            return name


@cache
def sample_type(name: str) -> Any:
    """The class of a ROS 2 message type. It is made from a message's CDR bytes, and holds them as ``cdr``.

    Raises:
        RecordingError: no such type is known.
    """
    fields = {field: _idl(kind) for field, kind in message_fields(name)}
    type_name = dds_type_name(name).replace("::", ".")
    made: Any = make_idl_struct(name.rpartition("/")[2], type_name, fields, dataclassify=False)
    # Not by a common base class: that would be told to others as a part of the type, which they do not know.
    made.__init__ = _hold
    made.serialize = _held
    made.deserialize = made.deserialize_key = classmethod(_holding)
    return made


def _hold(self: Any, cdr: bytes) -> None:
    self.cdr = cdr


def _held(self: Any, **how: object) -> bytes:
    return cast(bytes, self.cdr)


def _holding(kind: Any, data: bytes, /, **how: object) -> Any:
    return kind(data)


def _idl(kind: Any) -> Any:
    """A field's type, from rosbags' description of it."""
    node, detail = kind
    match node:
        case Nodetype.BASE:
            return _BASE[detail[0]]
        case Nodetype.NAME:
            return sample_type(detail)
        case Nodetype.ARRAY:
            return _ARRAY[_idl(detail[0]), detail[1]]
        case _:
            return _SEQUENCE[_idl(detail[0])]
