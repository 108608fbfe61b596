"""Where pixels point to, and what in a sweep stands free."""

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from pytest import approx

from understudy.geometry import Point, Pose
from understudy.perception import find_cylinders
from understudy.perception.projection import Projection
from understudy.robot import PIONEER, Color, Scan

from .scenes import swept

projection = Projection(PIONEER.camera)


@given(st.floats(0.5, 4.0), st.floats(-0.4, 0.4))
def test_a_point_of_the_floor_is_found_again(forward: float, bearing: float) -> None:
    point = Point(PIONEER.camera.x + forward * math.cos(bearing), forward * math.sin(bearing))
    pixel = projection.pixel(point, 0.0)
    assert pixel is not None
    found = projection.floor_point(*pixel)
    assert found is not None
    assert (found.x, found.y) == (approx(point.x, abs=1e-9), approx(point.y, abs=1e-9))
    assert projection.bearing(*pixel) == approx(bearing)


def test_what_is_as_high_as_the_camera_stands_at_the_horizon() -> None:
    for distance in (1.0, 3.0, 6.0):
        pixel = projection.pixel(Point(distance, 0.0), PIONEER.camera.height)
        assert pixel is not None
        assert pixel[1] == approx(projection.horizon_row)


def test_the_sky_has_no_place_on_the_floor() -> None:
    assert projection.floor_point(80, projection.horizon_row - 1) is None
    assert projection.pixel(Point(-1.0, 0.0), 0.0) is None
    assert not projection.sees(Point(2.0, 2.0), 0.0)
    assert projection.sees(Point(2.0, 0.0), 0.0)


@given(st.floats(0.4, 4.0), st.floats(-1.4, 1.4))
def test_a_pillar_is_found_where_it_is(reach: float, bearing: float) -> None:
    place = Point(PIONEER.laser.x + reach * math.cos(bearing), reach * math.sin(bearing))
    [cylinder] = find_cylinders(swept([(Color.RED, place)], Pose()), PIONEER.laser.x)
    assert cylinder.center.distance_to(place) < 0.05
    assert cylinder.radius == approx(0.10, abs=0.05)


def wall_at(distance: float, *, slant: float = 0.0) -> Scan:
    """A straight wall before the laser, turned by ``slant``."""
    bearings = np.radians(np.arange(-90, 91))
    with np.errstate(divide="ignore", invalid="ignore"):
        ranges = distance * math.cos(slant) / np.cos(bearings - slant)
    ranges[(ranges <= 0) | (ranges > 8)] = np.inf
    return Scan(ranges=ranges.astype(np.float32))


def test_walls_are_no_pillars_even_at_a_grazing_angle() -> None:
    for slant in np.radians([0, 40, 70, 80]):
        assert find_cylinders(wall_at(1.0, slant=slant), PIONEER.laser.x) == []


def test_unusable_rays_count_as_free() -> None:
    scan = swept([(Color.RED, Point(2.0, 0.0))], Pose())
    scan.ranges[40:60] = np.nan
    scan.ranges[60:70] = np.inf
    assert len(find_cylinders(scan, PIONEER.laser.x)) == 1
