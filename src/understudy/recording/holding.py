"""What is held from message to message until a scan makes an observation of it."""

import logging
import math
from typing import Final, cast

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys.stores import ros2_humble as ros

from understudy.clock import CONTROL_PERIOD_S
from understudy.errors import RecordingError
from understudy.recording.decoding import decode, image_of, joint_fraction, odometry_of, place, scan_of, sonar_of
from understudy.recording.source import RawMessage
from understudy.recording.topics import GripperJoints
from understudy.robot import Cue, GripperReading, Observation, Odometry

__all__ = ["Grid", "Held"]

_log = logging.getLogger(__name__)

_EARLY: Final = 0.15
"""How far before its time, in periods, a scan may come: 15 ms. No usual rate puts its scans upon that boundary."""

_JITTER_S: Final = 1.0
"""Scans may arrive a little out of order; stamps that jump back further are another run's."""


class Held:
    """The newest reading of every sensor but the laser.

    Args:
        where: what the messages are from, for errors: a file, a robot.
        joints: how to read the gripper.
        odometry_known: there is no odometry to wait for.
    """

    def __init__(self, where: object, joints: GripperJoints, *, odometry_known: bool) -> None:
        self._where = where
        self._joints = joints
        self.odometry_known = odometry_known
        self._odometry = Odometry()
        self._sonar: NDArray[np.float32] = np.full(16, np.inf, np.float32)
        self._image: RawMessage | None = None
        self._positions: dict[str, float] = {}
        self._beam_broken = False
        self._cues: list[Cue] = []

    def take(self, role: str, raw: RawMessage) -> None:
        """Keeps a message; the roles are those of a :class:`~understudy.recording.TopicMap`.

        Raises:
            RecordingError: it cannot be decoded.
        """
        path = self._where
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

    def hear(self, cue: Cue) -> None:
        """Keeps a word that came some other way."""
        self._cues.append(cue)

    def observation(
        self, time_s: float, scan: ros.sensor_msgs__msg__LaserScan, *, zero_is_free: bool = False
    ) -> Observation:
        """What is held, with this scan; hands over the image and the cues.

        Args:
            time_s: of the observation.
            scan: the laser's message.
            zero_is_free: the driver gives 0.0 where nothing was met.

        Raises:
            RecordingError: the image cannot be decoded.
        """
        image, self._image = self._image, None
        cues, self._cues = tuple(self._cues), []
        return Observation(
            time_s=time_s,
            scan=scan_of(scan, zero_is_free=zero_is_free),
            sonar=self._sonar.copy(),
            image=None if image is None else image_of(self._where, image),
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
        text = cast(ros.std_msgs__msg__String, decode(self._where, raw)).data
        word = text.strip().upper()
        if word in Cue.__members__:
            self._cues.append(Cue(word))
        else:
            # A recogniser mishears; one stray word must not make a demonstration unreadable.
            _log.warning("%s: passed over %r; the cues are %s", place(self._where, raw), text, ", ".join(Cue))


class Grid:
    """Which scan begins a control period."""

    def __init__(self) -> None:
        self._zero_ns: int | None = None
        self._newest_s = 0.0
        self._period = -1

    def begin(self, stamp: int, *, where: str) -> float | None:
        """Seconds since the first scan, for the first scan in its period; None for the others.

        Raises:
            RecordingError: the stamps jump back.
        """
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
