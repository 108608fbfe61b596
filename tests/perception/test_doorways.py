"""Doorways: whether there is a way through, and from where that can be told."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from pytest import approx

from understudy.geometry import Point, Pose
from understudy.perception import Doorway, Thing
from understudy.perception.doorways import DoorwayMemory
from understudy.perception.lifted import put_elsewhere
from understudy.robot import Color, Scan

from .scenes import swept

POSTS = (Color.GREEN, Color.YELLOW)
FREE = 0.6


def leaf(open_deg: float, length: float = 1.16) -> NDArray[np.float64]:
    """Points along a leaf in the doorway's frame, hinged beside the left post; positive opens into the far room."""
    away = np.linspace(0, length, 60)[:, None]
    turned = math.radians(open_deg)
    direction: NDArray[np.float64] = np.array([[math.sin(turned), -math.cos(turned)]])
    return np.array([[0.0, 0.58]]) + away * direction


def judged(robot: Pose, points: NDArray[np.float64], times: int = 3, memory: DoorwayMemory | None = None) -> Doorway:
    """The doorway as a robot at a pose of the doorway's frame knows it, which meets these points."""
    memory = memory or DoorwayMemory([POSTS])
    places = {POSTS[0]: Point(0.0, 0.7), POSTS[1]: Point(0.0, -0.7)}
    things = {
        color: Thing(id=0, color=color, position=robot.to_local(place), radius=0.1, sensed=True, seen_s=1.0)
        for color, place in places.items()
    }
    met = np.array([robot.to_local(Point(x, y)) for x, y in points.tolist()]).reshape(-1, 2)
    for _ in range(times):
        [doorway] = memory.update(things, met)
    return doorway


@given(st.floats(-1.5, -0.6), st.floats(-0.6, 0.6))
def test_a_closed_door_leaves_no_way_and_an_open_one_does(x: float, y: float) -> None:
    robot = Pose(x, y, math.atan2(-y, -x))
    shut, wide = judged(robot, leaf(0)), judged(robot, leaf(85))
    assert shut.room == "near"
    assert not shut.free(0.3)
    assert wide.free(0.66)


@pytest.mark.parametrize("open_deg", [30, 50, 70, 80, -50, -70, -80])
def test_the_way_is_as_wide_as_the_leaf_leaves_it(open_deg: float) -> None:
    doorway = judged(Pose(-2.0, -0.1, 0.0), leaf(open_deg))
    assert doorway.gap is not None
    low, high = doorway.gap
    assert low == approx(-0.55, abs=0.01)
    assert high == approx(0.58 - 1.16 * math.cos(math.radians(open_deg)), abs=0.03)


@pytest.mark.parametrize(
    "robot", [Pose(-0.3, 0.0), Pose(-5.0, 0.0), Pose(-0.8, 1.5, -1.0), Pose(-1.5, 0.0, math.pi), Pose(-1.5, 0.0, 1.5)]
)
def test_from_too_near_too_far_aside_or_with_the_back_to_it_nothing_is_told(robot: Pose) -> None:
    assert judged(robot, leaf(0)).gap is None


def test_somebody_who_stands_before_it_hides_it() -> None:
    person = np.array([[-1.6, y] for y in np.linspace(-0.15, 0.15, 20)])
    assert judged(Pose(-2.2, 0.0), np.concatenate((leaf(80), person))).gap is None


def test_what_was_seen_last_is_kept_until_it_is_seen_otherwise_three_times() -> None:
    memory = DoorwayMemory([POSTS])
    assert judged(Pose(-1.5, 0.0), leaf(85), memory=memory).free(0.66)
    assert judged(Pose(-1.5, 0.0, math.pi), np.zeros((0, 2)), memory=memory).free(0.66)
    assert judged(Pose(-1.5, 0.0), leaf(0), times=1, memory=memory).free(0.66)
    assert not judged(Pose(-1.5, 0.0), leaf(0), memory=memory).free(0.66)


def test_posts_that_stand_too_near_or_too_far_are_no_door() -> None:
    for apart in (0.5, 3.0):
        things = {
            color: Thing(id=0, color=color, position=Point(2.0, y), radius=0.1, sensed=True, seen_s=0.0)
            for color, y in zip(POSTS, (apart / 2, -apart / 2), strict=True)
        }
        assert DoorwayMemory([POSTS]).update(things, np.zeros((0, 2))) == ()


ROOM = [(Color.RED, Point(3.0, 1.0)), (Color.RED, Point(2.0, -1.0)), (Color.RED, Point(-1.0, 2.0))]


@given(st.floats(-0.15, 0.15), st.floats(-0.05, 0.05), st.floats(-3, 3))
def test_driving_and_turning_is_not_being_lifted(turn: float, forward: float, heading: float) -> None:
    before = Pose(0.0, 0.0, heading)
    assert not put_elsewhere(boxed(before), boxed(before.moved(forward, turn)), turn)


def boxed(pose: Pose) -> Scan:
    """A sweep in a room of 4 by 6 m with pillars in it."""
    bearings = pose.heading + np.radians(np.arange(-90, 91))
    c, s = np.cos(bearings), np.sin(bearings)
    with np.errstate(divide="ignore", over="ignore"):
        across = np.where(c > 0, (2.0 - pose.x) / c, (-2.0 - pose.x) / c)
        along = np.where(s > 0, (3.0 - pose.y) / s, (-3.0 - pose.y) / s)
    walls = np.minimum(np.abs(across), np.abs(along))
    return Scan(ranges=np.minimum(walls, swept(ROOM, pose, wall=9.0).ranges).astype(np.float32))


def test_being_put_on_the_other_side_of_the_room_is() -> None:
    assert put_elsewhere(boxed(Pose(-1.0, -2.0, 0.0)), boxed(Pose(1.0, 2.0, 2.0)), 0.0)


def test_being_put_before_another_wall_which_looks_much_like_the_first_is() -> None:
    assert put_elsewhere(boxed(Pose(1.3, 0.0, 0.0)), boxed(Pose(1.2, 2.0, 0.6)), 0.0)


def test_a_door_that_swings_open_is_not_being_lifted() -> None:
    closed = np.full(181, 1.0, np.float32)
    opened = closed.copy()
    opened[60:120] = 4.0
    assert not put_elsewhere(Scan(ranges=closed), Scan(ranges=opened), 0.0)
