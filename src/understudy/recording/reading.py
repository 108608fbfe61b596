"""Opening a recording, and refusing what cannot be learned from before anything is read."""

import os
from pathlib import Path

from understudy.errors import RecordingError
from understudy.recording.bag_source import BagSource, is_bag
from understudy.recording.mcap_source import McapSource
from understudy.recording.recorder import FORMAT_VERSION
from understudy.recording.recording import Recording
from understudy.recording.source import Source
from understudy.recording.topics import DEFAULT_TOPICS, OBSERVATION_TOPIC, ROLE_TYPES, TopicMap

__all__ = ["read_recording"]


def read_recording(path: str | os.PathLike[str], *, topics: TopicMap = DEFAULT_TOPICS) -> Recording:
    """Opens a recording of Understudy, or a bag of any ROS 2 robot.

    Args:
        path: an MCAP file, a rosbag2 folder, or an SQLite file as one holds.
        topics: the names of the topics, where they are not the conventional ones.

    Raises:
        RecordingError: the file is missing, empty or no recording; it has no laser or no odometry; a topic has a type
            that cannot be read; or a newer Understudy wrote it.
    """
    source: Source = BagSource(Path(path)) if is_bag(Path(path)) else McapSource(Path(path))
    _check_version(source)
    roles = {role: topic for role in ROLE_TYPES if (topic := _topic_for(source, topics, role)) is not None}
    for role, topic in roles.items():
        _check_type(source, role, topic)
    if source.metadata and OBSERVATION_TOPIC not in source.topics and not source.complete:
        raise RecordingError(f"{source.path} breaks off before its first whole step; record it again")
    for role in ("scan", "odom"):
        if role not in roles and getattr(topics, role) is not None:
            raise _missing(source, topics, role)
    return Recording(source, topics, roles)


def _check_version(source: Source) -> None:
    version = source.metadata.get("format", str(FORMAT_VERSION))
    if not version.isdecimal() or int(version) > FORMAT_VERSION:
        raise RecordingError(
            f"{source.path} is a recording of format {version}, and this Understudy reads up to {FORMAT_VERSION};"
            " upgrade understudy"
        )


def _topic_for(source: Source, topics: TopicMap, role: str) -> str | None:
    return next((name for name in topics.candidates(role) if name in source.topics), None)


def _check_type(source: Source, role: str, name: str) -> None:
    topic = source.topics[name]
    if set(topic.types) <= set(ROLE_TYPES[role]) and topic.encodings == ("cdr",):
        return
    optional = "" if role == "scan" else f", or leave it out with TopicMap({role}=None)"
    raise RecordingError(
        f"{source.path}: {name} holds {', '.join(topic.types)} as {', '.join(topic.encodings)};"
        f" the {role} must be {' or '.join(ROLE_TYPES[role])} as cdr: {_mend(source, role)}{optional}"
    )


def _missing(source: Source, topics: TopicMap, role: str) -> RecordingError:
    if not source.complete and not source.topics:
        return RecordingError(f"{source.path} breaks off before its first message; record it again")
    optional = "" if role == "scan" else f", or do without it: TopicMap({role}=None)"
    return RecordingError(
        f"{source.path} has no topic {getattr(topics, role)} ({' or '.join(ROLE_TYPES[role])}):"
        f" {_mend(source, role)}{optional}"
    )


def _mend(source: Source, role: str) -> str:
    """Which other topic would do, or what there is at all."""
    fitting = [name for name, topic in source.topics.items() if set(topic.types) <= set(ROLE_TYPES[role])]
    if fitting:
        return f'it has {", ".join(fitting)}, so read it with topics=TopicMap({role}="{fitting[0]}")'
    return f"it has {', '.join(source.topics) or 'no topics'}; record the bag with the {role} topic"
