"""Where to stand: at the wanted distance and angle, with room, and without changing one's mind."""

import math

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from pytest import approx

from understudy.behaviors.stand import Stand, choose_direction, stand_at
from understudy.geometry import Point, Pose, wrap_angle

NOTHING = np.empty((0, 2))


def direction_to(
    target: Point, bearing: float = 0.0, distance: float = 0.8, heading: float = 0.0, **more: object
) -> float:
    values = {"obstacles": NOTHING} | more
    return choose_direction(target, 0.1, distance, bearing, heading, **values)  # type: ignore[arg-type]


def choose(target: Point, bearing: float = 0.0, distance: float = 0.8, heading: float = 0.0, **more: object) -> Stand:
    direction = direction_to(target, bearing, distance, heading, **more)
    return stand_at(direction, target, distance, bearing, heading)


places = st.builds(Point, st.floats(-3, 3), st.floats(-3, 3))


@given(places, st.floats(-math.pi / 2, math.pi / 2), st.floats(0.4, 2.0), st.floats(-3, 3))
def test_from_there_the_target_is_at_its_distance_and_bearing(
    target: Point, bearing: float, distance: float, heading: float
) -> None:
    stand = choose(target, bearing, distance, heading=heading)
    seen = Pose(stand.place.x, stand.place.y, stand.heading).to_local(target)
    assert seen.distance == approx(distance)
    assert wrap_angle(seen.bearing - bearing) == approx(0.0, abs=1e-6)


def test_a_target_ahead_is_approached_straight() -> None:
    stand = choose(Point(3.0, 0.0))
    assert stand.place.distance_to(Point(2.2, 0.0)) < 0.01
    assert stand.heading == approx(0.0, abs=1e-6)


def test_a_target_to_be_passed_on_the_left_is_passed_in_one_line() -> None:
    stand = choose(Point(3.0, 0.8), math.pi / 2)
    assert stand.place.distance_to(Point(3.0, 0.0)) < 0.15
    assert abs(stand.heading) < 0.2


def test_a_wall_on_that_side_sends_the_robot_to_another() -> None:
    wall = np.column_stack((np.linspace(0, 5, 100), np.full(100, -0.35)))
    stand = choose(Point(3.0, 0.0), math.pi / 2, obstacles=wall)
    assert np.hypot(wall[:, 0] - stand.place.x, wall[:, 1] - stand.place.y).min() > 0.5


def test_a_stand_that_could_not_be_reached_is_avoided() -> None:
    first = direction_to(Point(3.0, 0.0))
    second = direction_to(Point(3.0, 0.0), avoided=[first])
    assert abs(wrap_angle(second - first)) >= math.radians(35)


@given(places, st.floats(-1.5, 1.5), st.floats(-0.1, 0.1), st.floats(-0.1, 0.1))
def test_a_small_movement_does_not_change_the_mind(target: Point, bearing: float, dx: float, dy: float) -> None:
    assume(target.distance > 1.2)  # on its way; beside the target itself it may well turn to another stand
    first = direction_to(target, bearing)
    moved = Point(target.x + dx, target.y + dy)
    assert direction_to(moved, bearing, previous=first) == approx(first)
