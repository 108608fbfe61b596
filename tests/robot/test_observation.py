"""Readings that cannot be used are refused, single bad rays are not."""

import numpy as np
import pytest

from understudy.errors import RobotError
from understudy.geometry import Pose
from understudy.robot import GripperReading, Observation, Odometry, Scan


def scan(*ranges: float) -> Scan:
    return Scan(ranges=np.array(ranges, np.float32))


def test_single_bad_rays_pass() -> None:
    Observation(time_s=0.0, scan=scan(*[1.0] * 8, float("nan"), float("inf"))).check()


@pytest.mark.parametrize("ranges", [(), (float("nan"),) * 2, (1.0,) * 7 + (float("nan"),) * 2])
def test_a_laser_that_is_partly_blind(ranges: tuple[float, ...]) -> None:
    with pytest.raises(
        RobotError, match=r"of \d laser rays are unusable \(NaN\) at t=2\.5 s.*check the laser or the /scan topic"
    ):
        Observation(time_s=2.5, scan=scan(*ranges)).check()


def test_odometry_that_is_no_number() -> None:
    lost = Odometry(pose=Pose(float("nan"), 0.0, 0.0))
    with pytest.raises(RobotError, match=r"odometry at t=1\.0 s is not a number"):
        Observation(time_s=1.0, scan=scan(1.0), odometry=lost).check()


def test_speeds_and_gripper_must_be_numbers() -> None:
    with pytest.raises(RobotError, match="are not numbers"):
        Observation(time_s=1.0, scan=scan(1.0), odometry=Odometry(linear=float("nan"))).check()
    with pytest.raises(RobotError, match="are not numbers"):
        Observation(time_s=1.0, scan=scan(1.0), gripper=GripperReading(aperture=float("nan"))).check()
