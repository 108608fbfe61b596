"""Landmarks: believed, corrected by each other, given up."""

import math
from typing import Literal

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pytest import approx

from understudy.geometry import Point, Pose
from understudy.perception import Attention, Perception
from understudy.perception.landmarks import LandmarkMemory
from understudy.robot import PIONEER, Color, GripperReading

from .scenes import Pillar, observed

LEFT, RIGHT, HOME = Color.GREEN, Color.YELLOW, Color.PINK
DOOR: list[Pillar] = [(LEFT, Point(2.0, 0.7)), (RIGHT, Point(2.0, -0.7))]
"""As the near room sees it: the robot looks at it along x."""

DOORS = Attention(landmarks=frozenset({HOME}), doorways=frozenset({(LEFT, RIGHT)}))


def seen(memory: LandmarkMemory, pose: Pose, places: dict[Color, Point], start_s: float, times: int = 3) -> bool:
    """Every landmark that many times; whether memory had to be given up."""
    lost = False
    for tick in range(times):
        for color, place in places.items():
            lost |= memory.sighted(start_s + tick / 10, pose, pose.to_local(place), 0.1, color)
    return lost


def test_a_landmark_is_believed_at_the_third_sighting() -> None:
    memory = LandmarkMemory([HOME])
    assert not seen(memory, Pose(), {HOME: Point(2, 0)}, 0.0, 2)
    assert not memory.known
    assert not seen(memory, Pose(), {HOME: Point(2, 0)}, 0.2, 1)
    assert memory.things(0.2, Pose())[HOME].position.distance_to(Point(2, 0)) < 0.01


def test_sightings_that_do_not_agree_are_none() -> None:
    memory = LandmarkMemory([HOME])
    for tick in range(9):
        memory.sighted(tick / 10, Pose(), Point(1.0 + tick % 3, 0), 0.1, HOME)
    assert not memory.known


@given(st.floats(-0.5, 0.5), st.floats(-0.3, 0.3), st.floats(-3, 3))
def test_one_landmark_tells_for_all_how_far_the_odometry_has_gone_wrong_in_turning(
    wrong: float, ahead: float, heading: float
) -> None:
    """After a turn that the wheels counted wrong, one post is enough to know where the other is."""
    memory = LandmarkMemory([LEFT, RIGHT])
    pose = Pose(ahead, 0.0, heading)
    places = dict(DOOR)
    seen(memory, pose, places, 0.0)
    believed = Pose(pose.x, pose.y, heading + wrong)
    assert not any(memory.sighted(4 + t / 10, believed, pose.to_local(places[LEFT]), 0.1, LEFT) for t in range(12))
    here = memory.things(5.2, believed)[RIGHT].position
    assert here.distance_to(pose.to_local(places[RIGHT])) < 0.06


@given(st.floats(-0.12, 0.12), st.floats(-0.12, 0.12))
def test_a_post_that_was_misplaced_finds_its_place_beside_the_other_one(x: float, y: float) -> None:
    """Seen together, they tell how they stand to each other: correcting both by either would never mend that."""
    memory = LandmarkMemory([LEFT, RIGHT])
    places = dict(DOOR)
    wrong = {LEFT: places[LEFT], RIGHT: Point(places[RIGHT].x + x, places[RIGHT].y + y)}
    seen(memory, Pose(), wrong, 0.0)
    seen(memory, Pose(), places, 0.3, 15)
    found = memory.things(1.7, Pose())
    assert found[LEFT].position.distance_to(found[RIGHT].position) == approx(1.4, abs=0.02)


def test_where_the_senses_contradict_memory_altogether_all_of_it_is_given_up() -> None:
    memory = LandmarkMemory([LEFT, RIGHT])
    seen(memory, Pose(), dict(DOOR), 0.0)
    elsewhere = Pose(4.0, 0.0, math.pi)
    assert not any(memory.sighted(1 + t / 10, Pose(), elsewhere.to_local(DOOR[0][1]), 0.1, LEFT) for t in range(2))
    assert set(memory.known) == {LEFT, RIGHT}
    assert memory.sighted(1.2, Pose(), elsewhere.to_local(DOOR[0][1]), 0.1, LEFT)
    assert set(memory.known) == {LEFT}


@pytest.mark.parametrize(("how", "looks"), [("through", 8), ("hidden", 100)])
def test_what_should_be_seen_and_is_not_is_forgotten(how: Literal["through", "hidden"], looks: int) -> None:
    memory = LandmarkMemory([HOME])
    seen(memory, Pose(), {HOME: Point(2, 0)}, 0.0)
    for tick in range(looks):
        assert memory.known
        memory.contradict(1 + tick / 10, Pose(), lambda here: how if here.x > 0 else "")
    assert not memory.known


def test_a_post_that_a_leaf_hides_is_known_as_long_as_the_other_one_is_where_it_should_be() -> None:
    memory = LandmarkMemory([LEFT, RIGHT])
    seen(memory, Pose(), dict(DOOR), 0.0)
    for tick in range(250):
        time_s = 1 + tick / 10
        if tick % 20 == 0:
            memory.sighted(time_s, Pose(), DOOR[1][1], 0.1, RIGHT)
        memory.contradict(time_s, Pose(), lambda here: "hidden" if here.y > 0 else "")
    assert set(memory.known) == {LEFT, RIGHT}


def watch(perception: Perception, pillars: list[Pillar], poses: list[Pose], start_s: float = 0.0, **more: object):  # type: ignore[no-untyped-def]
    for index, pose in enumerate(poses):
        percepts = perception.update(observed(round(start_s + index * 0.1, 9), pillars, pose, **more))  # type: ignore[arg-type]
    return percepts


def test_nobody_watches_landmarks_who_was_not_told_to() -> None:
    percepts = watch(Perception(PIONEER), DOOR, [Pose()] * 5)
    assert not percepts.landmarks
    assert not percepts.doorways


@pytest.mark.parametrize(("start", "room"), [(Pose(), "near"), (Pose(4.0, 0.0, math.pi), "far")])
def test_the_order_of_the_posts_tells_the_room(start: Pose, room: str) -> None:
    perception = Perception(PIONEER, attention=DOORS)
    [doorway] = watch(perception, DOOR, [start] * 4).doorways
    assert doorway.room == room
    assert abs(doorway.here.x) == approx(2.0, abs=0.06)
    assert doorway.here.y == approx(0.0, abs=0.06)
    assert doorway.half_width == approx(0.6, abs=0.06)
    # Turning away changes nothing: memory holds.
    [doorway] = watch(perception, DOOR, [Pose(start.x, start.y, start.heading + math.pi)], 0.4).doorways
    assert doorway.room == room


def test_a_robot_that_was_carried_to_the_other_room_notices_and_finds_out_again() -> None:
    perception = Perception(PIONEER, attention=DOORS)
    assert watch(perception, DOOR, [Pose()] * 4).doorways[0].room == "near"
    # The wheels noticed nothing: the odometry stays, the world moves.
    moved = Pose(4.5, 0.0, math.pi)
    around = [(color, moved.to_local(place)) for color, place in DOOR]
    percepts = watch(perception, around, [Pose()] * 6, 0.4)
    assert percepts.doorways[0].room == "far"
    assert percepts.doorways[0].here.x == approx(2.5, abs=0.1)


def test_what_is_pushed_is_known_by_its_color_and_back_on_the_floor_when_it_is_left() -> None:
    perception = Perception(PIONEER)
    box = (Color.ORANGE, Point(1.2, 0.0))
    for tick in range(4):
        perception.update(observed(tick / 10, [], boxes=[box], gripper=OPEN))
    at = Pose(0.87, 0.0)
    states = [perception.update(observed(0.4 + t / 10, [], at, blind=True, gripper=BROKEN)).gripper for t in range(9)]
    assert next(state.pushing for state in states if state) is None
    assert states[-1] is not None
    assert states[-1].pushing is Color.ORANGE
    assert not states[-1].holding
    pushed = Pose(2.0, 0.0)
    percepts = perception.update(observed(1.4, [], pushed, blind=True, gripper=BROKEN))
    assert not percepts.boxes, "it is no longer where it was seen"
    for tick in range(3):
        percepts = perception.update(observed(1.5 + tick / 10, [], pushed, blind=True, gripper=OPEN))
    assert percepts.gripper is not None
    assert percepts.gripper.pushing is None
    [left] = percepts.boxes
    assert left.position.distance_to(Point(0.39, 0.0)) < 0.02


def test_what_a_robot_pushed_stays_behind_when_it_is_carried_away() -> None:
    perception = Perception(PIONEER, attention=DOORS)
    for tick in range(4):
        perception.update(observed(tick / 10, DOOR, boxes=[(Color.ORANGE, Point(1.2, 0.0))], gripper=OPEN))
    at = Pose(0.87, 0.0)
    for tick in range(9):
        percepts = perception.update(observed(0.4 + tick / 10, DOOR, at, blind=True, gripper=BROKEN))
    assert percepts.gripper is not None
    assert percepts.gripper.pushing is Color.ORANGE
    fence = [Point(1.2 * math.cos(a / 4), 1.2 * math.sin(a / 4)) for a in range(-6, 7)]
    around = [(Color.RED, at.to_parent(post)) for post in fence]
    for tick in range(5):
        percepts = perception.update(observed(1.3 + tick / 10, around, at, blind=True, gripper=OPEN))
    assert percepts.gripper is not None
    assert percepts.gripper.pushing is None
    assert not percepts.boxes


OPEN = GripperReading(aperture=1.0, lift=0.0, beam_broken=False)
BROKEN = GripperReading(aperture=1.0, lift=0.0, beam_broken=True)
