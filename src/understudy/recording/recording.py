"""A recording that can be read."""

import json
import logging
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, cast

from rosbags.typesys.stores import ros2_humble as ros

from understudy.recording.decoding import decode, place
from understudy.recording.exact import OBSERVATION_TYPE
from understudy.recording.replaying import exact_commands, exact_observations
from understudy.recording.sampling import sampled_commands, sampled_observations
from understudy.recording.source import Source, Topic
from understudy.recording.topics import EVENTS_TOPIC, OBSERVATION_TOPIC, TopicMap
from understudy.robot import Command, Cue, Observation

__all__ = ["Recording", "RecordingInfo"]

_log = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordingInfo:
    """What a recording says about itself.

    Attributes:
        path: its file.
        kind: ``bag`` for one that another program recorded.
        name: what people call it; the file's name for a bag.
        robot: the name of the robot's spec; empty for a bag.
        metadata: everything that was written about it, the above included.
        duration_s: from the first message to the last.
        topics: by name.
        attachments: names of the documents in it.
        complete: False where the file breaks off or is damaged; what comes before can be read.
        exact: its observations are equal to the live ones bit for bit, not sampled.
    """

    path: Path
    kind: Literal["demonstration", "run", "bag"]
    name: str
    robot: str
    metadata: Mapping[str, str]
    duration_s: float
    topics: Mapping[str, Topic]
    attachments: tuple[str, ...]
    complete: bool
    exact: bool


class Recording:
    """A demonstration, a run, or a ROS 2 robot's bag. Made by :func:`understudy.recording.read_recording`.

    Every iterator opens the file anew, reads as it goes, and closes it at its end. In a file that breaks off it ends
    at the last whole message.

    All of them raise :class:`~understudy.errors.RecordingError` where a message cannot be decoded, or where a file
    with an intact index turns out to be damaged.
    """

    def __init__(self, source: Source, topics: TopicMap, roles: Mapping[str, str]) -> None:
        self._source = source
        self._map = topics
        self._roles = roles
        exact = source.topics.get(OBSERVATION_TOPIC)
        kind = source.metadata.get("kind")
        self.info = RecordingInfo(
            path=source.path,
            kind=cast(Literal["demonstration", "run"], kind) if kind in ("demonstration", "run") else "bag",
            name=source.metadata.get("name", source.path.stem),
            robot=source.metadata.get("robot", ""),
            metadata=MappingProxyType(dict(source.metadata)),
            duration_s=source.duration_s,
            topics=MappingProxyType(dict(source.topics)),
            attachments=source.attachments,
            complete=source.complete,
            exact=exact is not None and exact.types == (OBSERVATION_TYPE,),
        )

    def observations(self, *, images: bool = True) -> Iterator[Observation]:
        """What the robot sensed, one observation a control step.

        Args:
            images: False leaves every image out, which is several times faster.
        """
        if self.info.exact:
            return exact_observations(self._source, self._roles, images=images)
        return sampled_observations(self._source, self._roles, self._map, images=images)

    def commands(self) -> Iterator[tuple[float, Command]]:
        """What the robot was told, each with its time in the observations' seconds."""
        if self.info.exact:
            return exact_commands(self._source)
        return sampled_commands(self._source, self._roles)

    def cues(self) -> Iterator[tuple[float, Cue]]:
        """The teacher's words, each with the time of the observation that hands it over."""
        for obs in self.observations(images=False):
            for cue in obs.cues:
                yield obs.time_s, cue

    def events(self) -> Iterator[dict[str, Any]]:
        """The trace, as it was recorded. A bag has none."""
        for raw in self._source.messages([EVENTS_TOPIC], sorted_by_time=False):
            text = cast(ros.std_msgs__msg__String, decode(self._source.path, raw)).data
            try:
                event = json.loads(text)
            except ValueError:
                event = None
            if isinstance(event, dict):
                yield event
            else:
                # Only another program can have written it, and the trace is not what is learned from.
                _log.warning("%s: passed over %r, which is no JSON object", place(self._source.path, raw), text[:80])

    def attachment(self, name: str) -> bytes:
        """An attached document.

        Raises:
            RecordingError: there is none of this name.
        """
        return self._source.attachment(name)
