"""Recordings: every demonstration and every run is one MCAP file with ROS 2 messages (``docs/recording.md``)."""

from understudy.recording.outcome import Outcome, outcome_of
from understudy.recording.reading import read_recording
from understudy.recording.recorder import FORMAT_VERSION, Recorder, RecordingKind
from understudy.recording.recording import Recording, RecordingInfo
from understudy.recording.source import Topic
from understudy.recording.topics import DEFAULT_TOPICS, GripperJoints, TopicMap

__all__ = [
    "DEFAULT_TOPICS",
    "FORMAT_VERSION",
    "GripperJoints",
    "Outcome",
    "Recorder",
    "Recording",
    "RecordingInfo",
    "RecordingKind",
    "Topic",
    "TopicMap",
    "outcome_of",
    "read_recording",
]
