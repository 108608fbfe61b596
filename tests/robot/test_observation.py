"""Readings that cannot be used are refused, single bad rays are not."""

import numpy as np
import pytest

from understudy.errors import RobotError
from understudy.geometry import Pose
from understudy.robot import Observation, Odometry, Scan


def scan(*ranges: float) -> Scan:
    return Scan(ranges=np.array(ranges, np.float32))


def test_single_bad_rays_pass() -> None:
    Observation(time_s=0.0, scan=scan(1.0, float("nan"), float("inf"))).check()


@pytest.mark.parametrize("ranges", [(), (float("nan"), float("nan"))])
def test_a_laser_without_a_usable_ray(ranges: tuple[float, ...]) -> None:
    with pytest.raises(RobotError, match=r"no usable ray at t=2\.5 s.*check the /scan topic"):
        Observation(time_s=2.5, scan=scan(*ranges)).check()


def test_odometry_that_is_no_number() -> None:
    lost = Odometry(pose=Pose(float("nan"), 0.0, 0.0))
    with pytest.raises(RobotError, match=r"odometry at t=1\.0 s is not a number"):
        Observation(time_s=1.0, scan=scan(1.0), odometry=lost).check()
