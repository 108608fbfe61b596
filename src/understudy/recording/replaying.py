"""The observations of our own recordings: equal to the live ones, bit for bit."""

from collections.abc import Iterator, Mapping
from typing import cast

import numpy as np
from rosbags.typesys.stores import ros2_humble as ros

from understudy.errors import RecordingError
from understudy.geometry import Pose
from understudy.recording.decoding import decode, image_of, sonar_of
from understudy.recording.exact import ExactCommand, ExactObservation
from understudy.recording.source import RawMessage, Source
from understudy.recording.topics import COMMAND_TOPIC, OBSERVATION_TOPIC
from understudy.robot import Command, Cue, GripperReading, Observation, Odometry, Scan

__all__ = ["exact_commands", "exact_observations"]


def exact_observations(source: Source, roles: Mapping[str, str], *, images: bool) -> Iterator[Observation]:
    """Joins each exact message with the arrays stored before it.

    Args:
        source: a recording of our own.
        roles: the topic that the recording has for each role.
        images: decode the images; without them every observation's image is None.

    Raises:
        RecordingError: a step lacks its scan, sonars or image: someone has taken them out.
    """
    wanted = {roles[role]: role for role in ("scan", "sonar", "image") if role in roles}
    step: dict[str, RawMessage] = {}
    for raw in source.messages([*wanted, OBSERVATION_TOPIC], sorted_by_time=False):
        if raw.topic != OBSERVATION_TOPIC:
            step[wanted[raw.topic]] = raw
            continue
        # Decoded messages have our class's fields, not our class.
        exact = cast(ExactObservation, decode(source.path, raw))
        needed = {"scan", "sonar"} | ({"image"} if exact.has_image else set())
        if missing := needed - step.keys():
            raise RecordingError(
                f"{source.path}: the step at {exact.time_s} s lacks its {' and its '.join(sorted(missing))} message;"
                " read the recording as it was, before messages were taken out"
            )
        scan = cast(ros.sensor_msgs__msg__LaserScan, decode(source.path, step["scan"]))
        yield Observation(
            time_s=exact.time_s,
            scan=Scan(
                ranges=np.array(scan.ranges, np.float32),  # as they were, and not a view of the file
                angle_min=exact.scan_angle_min,
                angle_increment=exact.scan_angle_increment,
                range_max=exact.scan_range_max,
            ),
            sonar=sonar_of(source.path, step["sonar"]),
            image=image_of(source.path, step["image"]) if images and exact.has_image else None,
            odometry=Odometry(pose=Pose(exact.x, exact.y, exact.heading), linear=exact.linear, angular=exact.angular),
            gripper=_gripper(exact),
            cues=tuple(_cue(source, word) for word in exact.cues),
        )
        step = {}


def exact_commands(source: Source) -> Iterator[tuple[float, Command]]:
    """The commands with their times, as they were given."""
    for raw in source.messages([COMMAND_TOPIC], sorted_by_time=False):
        exact = cast(ExactCommand, decode(source.path, raw))
        yield exact.time_s, ExactCommand.to_command(exact)


def _gripper(exact: ExactObservation) -> GripperReading | None:
    if not exact.has_gripper:
        return None
    return GripperReading(
        aperture=exact.gripper_aperture, lift=exact.gripper_lift, beam_broken=exact.gripper_beam_broken
    )


def _cue(source: Source, word: str) -> Cue:
    try:
        return Cue(word)
    except ValueError:
        raise RecordingError(
            f"{source.path} has the cue {word!r}, which this Understudy does not know; upgrade understudy"
        ) from None
