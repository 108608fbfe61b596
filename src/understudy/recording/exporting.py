"""A recording as a rosbag2 folder, which ``ros2 bag play`` and every other ROS 2 tool takes."""

import os
from pathlib import Path
from typing import Final, Literal

from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime
from rosbags.rosbag2 import StoragePlugin, Writer, WriterError

from understudy.errors import RecordingError
from understudy.recording.bag_source import BagSource, is_bag
from understudy.recording.mcap_source import McapSource
from understudy.recording.source import Source
from understudy.recording.topics import COMMAND_TOPIC, OBSERVATION_TOPIC
from understudy.recording.typestore import message_definition, message_hash

__all__ = ["export_bag"]

_STORAGES: Final = {"sqlite3": StoragePlugin.SQLITE3, "mcap": StoragePlugin.MCAP}

_OWN: Final = (OBSERVATION_TOPIC, COMMAND_TOPIC)
"""Of types that ROS 2 does not know: a player would refuse them, and the others say the same, rounded."""

_FORMAT_VERSION: Final = 8
"""The newest that Humble and Jazzy read."""


def export_bag(
    recording: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    storage: Literal["sqlite3", "mcap"] = "sqlite3",
) -> int:
    """Writes a recording as a rosbag2 folder.

    Args:
        recording: its file.
        folder: which must not exist yet.
        storage: in which format.

    Returns:
        How many messages it holds.

    Raises:
        RecordingError: the recording cannot be read, or the folder cannot be written.
    """
    path, target = Path(recording), Path(folder)
    source: Source = BagSource(path) if is_bag(path) else McapSource(path)
    wanted = [name for name in source.topics if name not in _OWN]
    count = 0
    try:
        with Writer(target, version=_FORMAT_VERSION, storage_plugin=_STORAGES[storage]) as writer:
            connections = {
                (name, kind): writer.add_connection(
                    name,
                    kind,
                    msgdef=message_definition(kind).decode(),
                    rihs01=message_hash(kind),
                    offered_qos_profiles=[_latched()] if name == "/tf_static" else [],
                )
                for name in wanted
                for kind in source.topics[name].types
            }
            for raw in source.messages(wanted, sorted_by_time=True):
                writer.write(connections[raw.topic, raw.type], raw.time_ns, raw.data)
                count += 1
    except WriterError as error:
        raise RecordingError(f"{target} cannot be written ({error}); name a folder that does not exist yet") from error
    except OSError as error:
        raise RecordingError(f"{target} cannot be written: {error.strerror or error}") from error
    return count


def _latched() -> Qos:
    """Said once, and kept for those who come later."""
    unlimited = QosTime(0, 0)
    return Qos(
        history=QosHistory.KEEP_LAST,
        depth=1,
        reliability=QosReliability.RELIABLE,
        durability=QosDurability.TRANSIENT_LOCAL,
        deadline=unlimited,
        lifespan=unlimited,
        liveliness=QosLiveliness.AUTOMATIC,
        liveliness_lease_duration=unlimited,
        avoid_ros_namespace_conventions=False,
    )
