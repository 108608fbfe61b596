"""Recordings: every demonstration and every run is one MCAP file with ROS 2 messages (``docs/recording.md``)."""

from understudy.recording.decoding import decode, image_of, posture_of, speeds_of, stamp_ns
from understudy.recording.encoding import ObservationEncoder, TopicMessage, stamp_of, string_message, twist_of
from understudy.recording.exporting import export_bag
from understudy.recording.holding import Grid, Held
from understudy.recording.outcome import Outcome, outcome_of
from understudy.recording.reading import read_recording
from understudy.recording.recorder import FORMAT_VERSION, Recorder, RecordingKind
from understudy.recording.recording import Recording, RecordingInfo
from understudy.recording.source import RawMessage, Topic
from understudy.recording.topics import DEFAULT_TOPICS, ROLE_TYPES, GripperJoints, TopicMap
from understudy.recording.typestore import decode_message, encode_message, message_fields

__all__ = [
    "DEFAULT_TOPICS",
    "FORMAT_VERSION",
    "ROLE_TYPES",
    "Grid",
    "GripperJoints",
    "Held",
    "ObservationEncoder",
    "Outcome",
    "RawMessage",
    "Recorder",
    "Recording",
    "RecordingInfo",
    "RecordingKind",
    "Topic",
    "TopicMap",
    "TopicMessage",
    "decode",
    "decode_message",
    "encode_message",
    "export_bag",
    "image_of",
    "message_fields",
    "outcome_of",
    "posture_of",
    "read_recording",
    "speeds_of",
    "stamp_ns",
    "stamp_of",
    "string_message",
    "twist_of",
]
