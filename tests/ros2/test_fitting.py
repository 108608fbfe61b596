"""Whatever way a laser is mounted, and however its driver counts, the robot sees the same room."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from understudy.errors import RobotError
from understudy.geometry import wrap_angle
from understudy.robot import Observation, Scan
from understudy.ros2 import RobotDocument
from understudy.ros2.fitting import Fitting, turned


def by_bearing(scan: Scan, yaw: float, *, upside_down: bool) -> dict[float, float]:
    """Slowly: what each ray says, by its bearing in the robot's frame, in whole microradians."""
    seen = {}
    for index, reading in enumerate(scan.ranges.tolist()):
        angle = scan.angle_min + index * scan.angle_increment
        bearing = wrap_angle((-angle if upside_down else angle) + yaw)
        seen[round(bearing, 5)] = reading
    return seen


sweeps = st.builds(
    lambda rays, share, first, backwards: Scan(
        ranges=np.arange(1, rays + 1, dtype=np.float32),
        angle_min=first,
        angle_increment=(-1 if backwards else 1) * share * math.tau / rays,
    ),
    st.integers(3, 40),
    st.floats(0.2, 0.9),
    st.floats(-7, 7),
    st.booleans(),
)
circles = st.builds(
    lambda rays, first, backwards: Scan(
        ranges=np.arange(1, rays + 1, dtype=np.float32),
        angle_min=first,
        angle_increment=(-1 if backwards else 1) * math.tau / rays,
    ),
    st.integers(4, 40),
    st.floats(-7, 7),
    st.booleans(),
)


def same(one: dict[float, float], other: dict[float, float]) -> None:
    """Equal, but for the rounding of a bearing."""
    assert len(one) == len(other)
    for reading in one.values():
        (a,) = [bearing for bearing, value in one.items() if value == reading]
        (b,) = [bearing for bearing, value in other.items() if value == reading]
        assert abs(wrap_angle(a - b)) < 1e-4


@given(sweeps | circles, st.floats(-7, 7), st.booleans())
def test_every_ray_keeps_its_bearing(scan: Scan, yaw: float, upside_down: bool) -> None:
    fitted = turned(scan, yaw, upside_down=upside_down)
    same(by_bearing(scan, yaw, upside_down=upside_down), by_bearing(fitted, 0.0, upside_down=False))
    assert fitted.angle_increment > 0.0
    assert fitted.ranges.flags.c_contiguous


@given(circles, st.floats(-7, 7), st.booleans())
def test_a_sweep_all_around_is_cut_behind_the_robot(scan: Scan, yaw: float, upside_down: bool) -> None:
    fitted = turned(scan, yaw, upside_down=upside_down)
    assert -math.pi - 1e-3 <= fitted.angle_min <= -math.pi + fitted.angle_increment


@given(sweeps)
def test_other_sweeps_are_counted_about_ahead(scan: Scan) -> None:
    fitted = turned(scan, 0.0)
    middle = fitted.angle_min + fitted.angle_increment * (fitted.ranges.size - 1) / 2
    assert abs(middle) <= math.pi + 1e-6


def test_a_ray_that_is_given_twice_is_taken_once() -> None:
    scan = Scan(ranges=np.ones(361, np.float32), angle_min=0.0, angle_increment=math.pi / 180)
    assert turned(scan, 0.0).ranges.size == 360


def test_the_pioneers_sweep_stays_as_it_is() -> None:
    scan = Scan(ranges=np.arange(181, dtype=np.float32))
    fitted = turned(scan, 0.0)
    assert np.array_equal(fitted.ranges, scan.ranges)
    assert fitted.angle_min == pytest.approx(scan.angle_min)


def picture(rows: int, width: int) -> NDArray[np.uint8]:
    image = np.zeros((rows, width, 3), np.uint8)
    image[:, width // 2 :] = (250, 10, 10)
    return image


def observation(image: NDArray[np.uint8] | None) -> Observation:
    return Observation(time_s=0.0, scan=Scan(ranges=np.ones(181, np.float32)), image=image)


def test_pictures_are_reduced_and_keep_their_colors() -> None:
    fitted = Fitting(RobotDocument()).observation(observation(picture(480, 640)))
    assert fitted.image is not None
    assert np.array_equal(fitted.image, picture(120, 160))
    assert Fitting(RobotDocument()).observation(observation(None)).image is None


def test_pictures_of_another_shape_are_refused() -> None:
    with pytest.raises(RobotError, match="640 by 360 pixels, which is another shape than the 160 by 120 of turtlebot"):
        Fitting(RobotDocument()).observation(observation(picture(360, 640)))
    wide = RobotDocument.model_validate({"camera": {"width": 160, "rows": 90}})
    assert Fitting(wide).observation(observation(picture(360, 640))).image is not None
