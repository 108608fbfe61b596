"""Observations from any ROS 2 robot's bag: sample and hold, on the beat of its laser.

1. Messages are taken by their times in the bag; of those of one time, scans last.
2. Odometry, sonars, joints and the beam are held: an observation has the newest of each.
3. An image belongs to one observation, the first after it; so do cues.
4. The first scan in each control period makes an observation. The periods count from a little before the first scan, so
   that the jitter of a 10 Hz laser does not put two scans into one period and none into the next. A slower laser gives
   one observation a scan.
5. Scans before the first odometry are passed over: there is nothing to hold yet.
"""

import logging
import math
from collections.abc import Iterator, Mapping
from itertools import groupby
from typing import Final, Literal, cast

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys.stores import ros2_humble as ros

from understudy.clock import CONTROL_PERIOD_S
from understudy.errors import RecordingError
from understudy.recording.decoding import (
    decode,
    image_of,
    joint_fraction,
    odometry_of,
    place,
    scan_of,
    sonar_of,
    stamp_ns,
)
from understudy.recording.source import RawMessage, Source
from understudy.recording.topics import GripperJoints
from understudy.robot import Command, Cue, GripperReading, Observation, Odometry

__all__ = ["sampled_commands", "sampled_observations"]

_log = logging.getLogger(__name__)

_SENSORS: Final = ("scan", "odom", "sonar", "image", "joint_states", "beam", "cues")

_EARLY: Final = 0.15
"""How far before its time, in periods, a scan may come: 15 ms. No usual rate puts its scans upon that boundary."""

_JITTER_S: Final = 1.0
"""Scans may arrive a little out of order; stamps that jump back further are another run's."""


def sampled_observations(
    source: Source, roles: Mapping[str, str], joints: GripperJoints, *, images: bool
) -> Iterator[Observation]:
    """Observations from topics of differing rates; see the steps above.

    Args:
        source: a bag.
        roles: the topic that the bag has for each role; ``scan`` at least.
        joints: how to read the gripper.
        images: decode the images; without them every observation's image is None.

    Raises:
        RecordingError: a message cannot be decoded, or the laser's stamps jump back.
    """
    wanted = {roles[role]: role for role in _SENSORS if role in roles and (images or role != "image")}
    held = _Held(source, joints, odometry_known="odom" not in roles)
    grid = _Grid()
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
                yield held.observation(time_s, message)


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
            stamped = raw.type == "geometry_msgs/msg/TwistStamped"
            twist = (
                cast(ros.geometry_msgs__msg__TwistStamped, message).twist
                if stamped
                else cast(ros.geometry_msgs__msg__Twist, message)
            )
            linear, angular = twist.linear.x, twist.angular.z
            yield time_s, Command(linear=linear, angular=angular)
            continue
        paddles: Literal["open", "close"] | None = None
        lift: Literal["up", "down"] | None = None
        for word in cast(ros.std_msgs__msg__String, message).data.lower().split():
            match word:
                case "open" | "close":
                    paddles = word
                case "up" | "down":
                    lift = word
                case _:
                    _log.warning(
                        "%s: passed over %r; the words are open, close, up, down", place(source.path, raw), word
                    )
        if paddles or lift:
            yield time_s, Command(linear=linear, angular=angular, paddles=paddles, lift=lift)


class _Held:
    """The newest reading of every sensor but the laser."""

    def __init__(self, source: Source, joints: GripperJoints, *, odometry_known: bool) -> None:
        self._source = source
        self._joints = joints
        self.odometry_known = odometry_known
        self._odometry = Odometry()
        self._sonar: NDArray[np.float32] = np.full(16, np.inf, np.float32)
        self._image: RawMessage | None = None
        self._positions: dict[str, float] = {}
        self._beam_broken = False
        self._cues: list[Cue] = []

    def take(self, role: str, raw: RawMessage) -> None:
        path = self._source.path
        match role:
            case "odom":
                self._odometry = odometry_of(cast(ros.nav_msgs__msg__Odometry, decode(path, raw)))
                self.odometry_known = True
            case "sonar":
                self._sonar = sonar_of(path, raw)
            case "image":
                self._image = raw  # decoded only if it is the newest when a scan comes
            case "joint_states":
                state = cast(ros.sensor_msgs__msg__JointState, decode(path, raw))
                # Several nodes may report on this topic, each its own joints; some report no positions.
                self._positions.update(zip(state.name, state.position.tolist(), strict=False))
            case "beam":
                self._beam_broken = cast(ros.std_msgs__msg__Bool, decode(path, raw)).data
            case "cues":
                self._hear(raw)

    def observation(self, time_s: float, scan: ros.sensor_msgs__msg__LaserScan) -> Observation:
        """What is held, with this scan; hands over the image and the cues."""
        image, self._image = self._image, None
        cues, self._cues = tuple(self._cues), []
        return Observation(
            time_s=time_s,
            scan=scan_of(scan),
            sonar=self._sonar.copy(),
            image=None if image is None else image_of(self._source.path, image),
            odometry=self._odometry,
            gripper=self._gripper(),
            cues=cues,
        )

    def _gripper(self) -> GripperReading | None:
        joints = self._joints
        aperture = joint_fraction(self._positions, joints.finger, joints.finger_closed, joints.finger_open)
        if aperture is None:
            return None
        lift = joint_fraction(self._positions, joints.lift, joints.lift_down, joints.lift_up)
        return GripperReading(aperture=aperture, lift=1.0 if lift is None else lift, beam_broken=self._beam_broken)

    def _hear(self, raw: RawMessage) -> None:
        text = cast(ros.std_msgs__msg__String, decode(self._source.path, raw)).data
        word = text.strip().upper()
        if word in Cue.__members__:
            self._cues.append(Cue(word))
        else:
            # A recogniser mishears; one stray word must not make a demonstration unreadable.
            _log.warning("%s: passed over %r; the cues are %s", place(self._source.path, raw), text, ", ".join(Cue))


class _Grid:
    """Which scan begins a control period."""

    def __init__(self) -> None:
        self._zero_ns: int | None = None
        self._newest_s = 0.0
        self._period = -1

    def begin(self, stamp: int, *, where: str) -> float | None:
        """Seconds since the first scan, for the first scan in its period; None for the others."""
        if self._zero_ns is None:
            self._zero_ns = stamp
        time_s = (stamp - self._zero_ns) / 1e9
        if time_s < self._newest_s - _JITTER_S:
            raise RecordingError(
                f"{where}: the laser's stamps jump back by {self._newest_s - time_s:.1f} s;"
                " the bag seems to hold two runs: cut it in two"
            )
        self._newest_s = max(self._newest_s, time_s)
        period = math.floor(time_s / CONTROL_PERIOD_S + _EARLY)
        if period <= self._period:
            return None
        self._period = period
        return time_s
