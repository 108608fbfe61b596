"""Observations from any ROS 2 robot's bag: sample and hold, on the beat of its laser.

1. Messages are taken by their times in the bag; of those of one time, scans last.
2. Odometry, sonars, joints and the beam are held: an observation has the newest of each.
3. An image belongs to one observation, the first after it; so do cues.
4. The first scan in each control period makes an observation. The periods count from a little before the first scan, so
   that the jitter of a 10 Hz laser does not put two scans into one period and none into the next. A slower laser gives
   one observation a scan.
5. Scans before the first odometry are passed over: there is nothing to hold yet.
"""

from collections.abc import Iterator, Mapping
from itertools import groupby
from typing import Final, cast

from rosbags.typesys.stores import ros2_humble as ros

from understudy.recording.decoding import decode, place, posture_of, speeds_of, stamp_ns
from understudy.recording.holding import Grid, Held
from understudy.recording.source import Source
from understudy.recording.topics import TopicMap
from understudy.robot import Command, Observation

__all__ = ["sampled_commands", "sampled_observations"]

_SENSORS: Final = ("scan", "odom", "sonar", "image", "joint_states", "beam", "cues")


def sampled_observations(
    source: Source, roles: Mapping[str, str], topics: TopicMap, *, images: bool
) -> Iterator[Observation]:
    """Observations from topics of differing rates; see the steps above.

    Args:
        source: a bag.
        roles: the topic that the bag has for each role; ``scan`` at least.
        topics: how to read the gripper, and what the laser's zeros mean.
        images: decode the images; without them every observation's image is None.

    Raises:
        RecordingError: a message cannot be decoded, or the laser's stamps jump back.
    """
    wanted = {roles[role]: role for role in _SENSORS if role in roles and (images or role != "image")}
    held = Held(source.path, topics.joints, odometry_known="odom" not in roles)
    grid = Grid()
    messages = source.messages(wanted, sorted_by_time=True)
    for _, simultaneous in groupby(messages, key=lambda raw: raw.time_ns):
        scans = []
        for raw in simultaneous:
            if wanted[raw.topic] == "scan":
                scans.append(raw)
            else:
                held.take(wanted[raw.topic], raw)
        for raw in scans:
            message = cast(ros.sensor_msgs__msg__LaserScan, decode(source.path, raw))
            time_s = grid.begin(stamp_ns(message.header) or raw.time_ns, where=place(source.path, raw))
            if time_s is not None and held.odometry_known:
                yield held.observation(time_s, message, zero_is_free=topics.zero_is_free)


def sampled_commands(source: Source, roles: Mapping[str, str]) -> Iterator[tuple[float, Command]]:
    """The commands that the robot was told, in seconds after the first scan.

    A message for the gripper alone is a command with the speeds told last.
    """
    first_scan = next(source.messages([roles["scan"]], sorted_by_time=True), None)
    if first_scan is None:
        return
    wanted = {roles[role]: role for role in ("cmd_vel", "gripper_command") if role in roles}
    linear = angular = 0.0
    for raw in source.messages(wanted, sorted_by_time=True):
        time_s = (raw.time_ns - first_scan.time_ns) / 1e9
        message = decode(source.path, raw)
        if wanted[raw.topic] == "cmd_vel":
            linear, angular = speeds_of(message, raw.type)
            yield time_s, Command(linear=linear, angular=angular)
            continue
        paddles, lift = posture_of(cast(ros.std_msgs__msg__String, message), where=place(source.path, raw))
        if paddles or lift:
            yield time_s, Command(linear=linear, angular=angular, paddles=paddles, lift=lift)
