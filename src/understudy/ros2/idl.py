"""ROS 2 message types as DDS knows them: made from the definitions, and carrying bytes that were serialised elsewhere.

Cyclone DDS wants a Python class for every type. It needs the fields to tell other nodes what the type is; serialising by
them takes 46 ms for a camera image, so the class only hands over the CDR bytes that rosbags has made.
"""

from functools import cache
from typing import Any, Self

from cyclonedds.idl import IdlStruct, make_idl_struct
from cyclonedds.idl.types import array, float32, float64, int8, int16, int32, int64, sequence, uint8, uint16, uint32, uint64
from rosbags.interfaces import Nodetype

from understudy.recording import message_fields

__all__ = ["CdrSample", "dds_type_name", "sample_type"]

_BASE: dict[str, Any] = {
    "bool": bool,
    "byte": uint8,
    "char": uint8,
    "float32": float32,
    "float64": float64,
    "int8": int8,
    "int16": int16,
    "int32": int32,
    "int64": int64,
    "string": str,
    "uint8": uint8,
    "uint16": uint16,
    "uint32": uint32,
    "uint64": uint64,
}


class CdrSample(IdlStruct):
    """A message as its CDR bytes, header included. Its subclasses are the types, see :func:`sample_type`."""

    data: bytes

    @classmethod
    def holding(cls, data: bytes) -> Self:
        """A sample of this type with these bytes."""
        sample = cls.__new__(cls)
        sample.data = data
        return sample

    def serialize(self, buffer: Any = None, endianness: Any = None, use_version_2: bool | None = None) -> bytes:
        """The bytes as they are."""
        return self.data

    @classmethod
    def deserialize(cls, data: bytes, has_header: bool = True, use_version_2: bool | None = None) -> Self:
        """The bytes as they are."""
        return cls.holding(data)
