"""Avoid: whatever is asked for, the robot's outline stays clear (A.4)."""

import math

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray
from pytest import approx

from understudy.behaviors import Avoid, Drive, Head
from understudy.geometry import Point
from understudy.robot import PIONEER

avoid = Avoid(PIONEER)
FRONT, BACK, HALF_WIDTH = 0.42, -0.22, 0.19


def points(*given_: tuple[float, float]) -> NDArray[np.float64]:
    return np.array(given_, float).reshape(-1, 2)


def gap(place: tuple[float, float], drive: Drive, after_s: float) -> float:
    """Distance of a point from the robot's outline after driving for a while, in many small steps."""
    x = y = heading = 0.0
    for _ in range(200):
        x += drive.linear * after_s / 200 * math.cos(heading)
        y += drive.linear * after_s / 200 * math.sin(heading)
        heading += drive.angular * after_s / 200
    dx, dy = place[0] - x, place[1] - y
    along, across = dx * math.cos(heading) + dy * math.sin(heading), dy * math.cos(heading) - dx * math.sin(heading)
    outside = max(BACK - along, along - FRONT, 0.0), max(abs(across) - HALF_WIDTH, 0.0)
    return math.hypot(*outside)


coordinates = st.floats(-1.5, 1.5)
drives = st.builds(Drive, linear=st.floats(-0.2, 0.5), angular=st.floats(-1.5, 1.5))


@given(st.lists(st.tuples(coordinates, coordinates), max_size=8), drives)
def test_no_command_leads_into_an_obstacle(obstacles: list[tuple[float, float]], wanted: Drive) -> None:
    assume(all(gap(place, Drive(), 0.1) > 0.08 for place in obstacles))
    drive, overridden = avoid.guard(wanted, points(*obstacles), None, 0.0)
    assert overridden is (drive != wanted)
    for place in obstacles:
        assert gap(place, drive, 0.3) > 0.02


@given(drives)
def test_in_the_open_nothing_is_overridden(wanted: Drive) -> None:
    assert avoid.guard(wanted, points((3.0, 0.0)), None, 0.0) == (wanted, False)


def test_the_thing_aimed_at_may_come_nearer() -> None:
    ahead = points((0.53, 0.0))
    slowly = Drive(linear=0.05)
    _, overridden = avoid.guard(slowly, ahead, None, 0.0)
    assert overridden
    assert avoid.guard(slowly, ahead, Point(0.63, 0.0), 0.1) == (slowly, False)


def test_what_is_too_near_already_may_be_left_but_not_approached() -> None:
    beside = points((0.0, 0.22))
    assert avoid.guard(Drive(linear=0.3), beside, None, 0.0)[1] is False
    assert avoid.guard(Drive(angular=1.0), beside, None, 0.0)[1] is True


def test_a_free_direction_is_gone_straight() -> None:
    drive = avoid.steer(Head(bearing=0.0, speed=0.4), points((2.0, 0.0)), None, 0.0)
    assert drive == Drive(linear=approx(0.4), angular=0.0)


def test_an_obstacle_on_the_way_is_gone_around() -> None:
    pillar = points((0.8, 0.05), (0.8, 0.1))
    drive = avoid.steer(Head(bearing=0.0, speed=0.4), pillar, None, 0.0)
    assert drive.angular < 0  # to the right, where there is more room
    assert drive.linear > 0


def test_the_target_itself_is_no_obstacle() -> None:
    surface = points((0.8, 0.0))
    drive = avoid.steer(Head(bearing=0.0, speed=0.4), surface, Point(0.9, 0.0), 0.1)
    assert drive == Drive(linear=approx(0.4), angular=0.0)


def test_behind_means_turning_on_the_spot() -> None:
    drive = avoid.steer(Head(bearing=math.pi * 0.9, speed=0.4), points(), None, 0.0)
    assert drive.linear == approx(0.0)
    assert drive.angular > 0.5


def test_walled_in_it_turns() -> None:
    ring = np.column_stack((0.7 * np.cos(np.linspace(0, 6.28, 90)), 0.7 * np.sin(np.linspace(0, 6.28, 90))))
    drive = avoid.steer(Head(bearing=0.3, speed=0.4), ring, None, 0.0)
    assert drive.linear == 0.0
    assert drive.angular != 0.0


def test_beside_a_target_it_goes_on_to_where_it_can_turn() -> None:
    """The gripper's tips would sweep into it; behind it there is room, and no turning back on the way there."""
    pole = np.stack([0.15 + 0.1 * np.cos(np.linspace(0, 6, 30)), 0.42 + 0.1 * np.sin(np.linspace(0, 6, 30))], axis=1)
    gone = 0.0
    for _ in range(60):
        drive, overridden = avoid.guard(Drive(angular=1.0), pole - (gone, 0.0), None, 0.0)
        if not overridden:
            break
        assert drive.angular == 0.0
        assert drive.linear > 0.0
        gone += 0.1 * drive.linear
    assert 0.0 < gone < 0.4


def test_where_the_way_on_is_closed_it_goes_back_to_where_it_can_turn() -> None:
    beside = [(0.15 + 0.1 * math.cos(a), 0.42 + 0.1 * math.sin(a)) for a in np.linspace(0, 6, 30)]
    wall = [(0.55, y) for y in np.linspace(-0.6, 0.6, 40)]
    drive, overridden = avoid.guard(Drive(angular=1.0), points(*beside, *wall), None, 0.0)
    assert overridden
    assert drive.linear < 0.0


def test_what_stands_beyond_the_way_is_not_gone_around() -> None:
    wall = points(*((0.85, y) for y in np.linspace(-1.5, 1.5, 60)))
    assert avoid.steer(Head(bearing=0.0, speed=0.3, way=0.1), wall, None, 0.0).linear > 0.2
    assert avoid.steer(Head(bearing=0.0, speed=0.3), wall, None, 0.0).linear < 0.1
