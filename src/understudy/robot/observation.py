"""What a robot senses at one moment, as its sensors give it."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from understudy.errors import RobotError
from understudy.geometry import Pose
from understudy.robot.cues import Cue

__all__ = ["GripperReading", "Observation", "Odometry", "Scan"]

_MAX_BAD_RAYS = 0.2
"""Share of unusable rays from which on a sweep is refused; single ones are normal."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scan:
    """One sweep of the laser range-finder, counter-clockwise, in the laser's own frame.

    Attributes:
        ranges: metres, shape ``(rays,)``, float32; ``inf`` where nothing was met (REP 117), ``nan`` where
            the reading is unusable.
        angle_min: bearing of the first ray, radians (-π/2 is the robot's right).
        angle_increment: radians between rays.
        range_max: metres.
    """

    ranges: NDArray[np.float32]
    angle_min: float = -math.pi / 2
    angle_increment: float = math.pi / 180
    range_max: float = 8.0

    @property
    def unusable(self) -> int:
        """How many rays gave no reading."""
        # A sum of squares is NaN if any of the numbers is, which is quicker told than counted.
        if not math.isnan(self.ranges.dot(self.ranges)):
            return 0
        return int(np.isnan(self.ranges).sum())


@dataclass(frozen=True, slots=True, kw_only=True)
class Odometry:
    """Dead reckoning from the wheels: it drifts.

    Attributes:
        pose: in the frame in which the robot was switched on.
        linear: forward speed, m/s.
        angular: turning speed, rad/s, left positive.
    """

    pose: Pose = Pose()
    linear: float = 0.0
    angular: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class GripperReading:
    """The gripper's own sensors.

    Attributes:
        aperture: 0 paddles together … 1 fully open. Closed on a box it stays above 0.
        lift: 0 on the floor … 1 raised.
        beam_broken: something stands between the paddles (A.1, infrared).
    """

    aperture: float = 0.0
    lift: float = 1.0
    beam_broken: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Observation:
    """Everything that the robot senses in one control period.

    Attributes:
        time_s: seconds since the robot's clock began.
        scan: laser.
        sonar: metres, shape ``(sonars,)``, float32, in the order of the robot's ``sonar_poses``; ``inf`` for no echo.
        image: camera, shape ``(height, width, 3)``, uint8, RGB; None where no new picture came.
        odometry: from the wheels.
        gripper: None on a robot without one.
        cues: the words heard since the last observation, in order.
    """

    time_s: float
    scan: Scan
    sonar: NDArray[np.float32] = field(default_factory=lambda: np.full(16, np.inf, np.float32))
    image: NDArray[np.uint8] | None = None
    odometry: Odometry = Odometry()
    gripper: GripperReading | None = None
    cues: tuple[Cue, ...] = ()

    def check(self) -> None:
        """Refuse readings on which no decision can rest.

        A few unusable rays are normal and pass; perception takes their neighbours' word.

        Raises:
            RobotError: the time or the odometry is not a number, or the laser gave no usable ray at all.
        """
        pose = self.odometry.pose
        if not all(map(math.isfinite, (self.time_s, pose.x, pose.y, pose.heading))):
            raise RobotError(
                f"the odometry at t={self.time_s} s is not a number ({pose}); "
                "check the wheel encoders or the /odom topic"
            )
        rays, bad = self.scan.ranges.size, self.scan.unusable
        if not rays or bad > _MAX_BAD_RAYS * rays:
            raise RobotError(
                f"{bad} of {rays} laser rays are unusable (NaN) at t={self.time_s} s, and the robot must "
                "not drive blindly; check the laser or the /scan topic"
            )
        speeds = (self.odometry.linear, self.odometry.angular)
        hand = (self.gripper.aperture, self.gripper.lift) if self.gripper else ()
        if not all(map(math.isfinite, (*speeds, *hand))):
            raise RobotError(
                f"speeds {speeds} or gripper {hand} are not numbers at t={self.time_s} s; "
                "check the /odom and /joint_states topics"
            )
