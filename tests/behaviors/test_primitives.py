"""The primitives from percepts alone: phases, giving up, finding another way."""

import math
from collections.abc import Iterator
from random import Random

import numpy as np
import pytest

from understudy.behaviors import Drive, FollowTeacher, Head, Memory, Motion, Wander
from understudy.behaviors.drop import DROP
from understudy.behaviors.pick_up import PICK_UP
from understudy.behaviors.skill import Action
from understudy.behaviors.surroundings import surroundings
from understudy.behaviors.track import TRACK
from understudy.geometry import Point, Pose
from understudy.perception import GripperState, Percepts, Thing
from understudy.robot import PIONEER, Color, Odometry

ORANGE = PICK_UP.complete({"color": "orange"})
GREEN = TRACK.complete({"color": "green", "distance_m": 0.6})


def gripper(
    *, open_: bool = True, raised: bool = False, blocked: bool = False, color: Color | None = None
) -> GripperState:
    holding = blocked and not open_
    return GripperState(holding=holding, empty=not blocked, color=color, open=open_, raised=raised, blocked=blocked)


def thing(x: float, y: float = 0.0, color: Color = Color.ORANGE, *, radius: float = 0.05, seen_s: float = 0.0) -> Thing:
    return Thing(id=7, color=color, position=Point(x, y), radius=radius, sensed=True, seen_s=seen_s)


def sees(
    time_s: float = 0.0, *, box: Thing | None = None, target: Thing | None = None, hand: GripperState | None = None
) -> Percepts:
    return Percepts(
        time_s=time_s,
        boxes=(box,) if box else (),
        targets=(target,) if target else (),
        gripper=hand or gripper(),
    )


def phases(percepts: Iterator[Percepts], memory: Memory | None = None) -> list[tuple[str, Action]]:
    """What PickUp does with a series of percepts."""
    found, memory = [], memory or {}
    for each in percepts:
        action, memory = PICK_UP.primitive.step(each, ORANGE, memory, Random(0))
        found.append((memory.get("phase", ""), action))
    return found


def test_pick_up_goes_aligns_enters_closes_and_lifts() -> None:
    far, [aside], [near] = (
        phases(iter([sees(box=thing(2.0))])),
        phases(iter([sees(box=thing(0.7, 0.2))])),
        phases(iter([sees(box=thing(0.55))])),
    )
    assert isinstance(far[0][1].drive, Head)
    assert far[0][1].lift is None
    assert isinstance(aside[1].drive, Drive)
    assert aside[1].drive.linear == 0.0
    assert aside[1].drive.angular > 0
    assert near[1].drive == Drive(linear=0.12)
    held = sees(hand=gripper(open_=False, blocked=True, color=Color.ORANGE))
    closing = phases(iter([*[sees(box=thing(0.33), hand=gripper(blocked=True))] * 4, *[held] * 16]))
    assert [action.drive for _, action in closing] == [Drive(linear=0.12)] * 3 + [Drive()] * 17
    assert [action.paddles for _, action in closing] == ["open"] * 3 + ["close"] * 17
    assert [action.lift for _, action in closing].count("up") == 9
    assert [action.keep_on for _, action in closing] == [True] * 18 + [False] * 2


def test_pick_up_does_not_lower_the_gripper_onto_a_box() -> None:
    [(phase, action)] = phases(iter([sees(box=thing(0.45), hand=gripper(raised=True))]))
    assert phase == "back"
    assert action.lift is None
    assert action.drive == Drive(linear=-0.15)


def test_pick_up_backs_off_from_a_box_beside_it_and_leaves_one_behind_it() -> None:
    [(phase, _)] = phases(iter([sees(box=thing(0.4, 0.25))]))
    assert phase == "back"
    [(phase, action)] = phases(iter([sees(box=thing(-0.4))]))
    assert phase == "leave"
    assert isinstance(action.drive, Head)
    assert abs(action.drive.bearing) < 0.1


def test_pick_up_tries_back_then_forwards_then_anywhere() -> None:
    stuck = [sees(tick / 10, box=thing(0.4, 0.25)) for tick in range(140)]
    order = [phase for phase, _ in phases(iter(stuck))]
    assert list(dict.fromkeys(order)) == ["back", "leave", "stray", "approach"]


def test_pick_up_loses_patience_with_a_box_that_does_not_come_nearer() -> None:
    stuck = [sees(tick / 10, box=thing(0.8, 0.3, seen_s=tick / 10)) for tick in range(80)]
    assert [phase for phase, _ in phases(iter(stuck))].index("leave") == 61


def test_pick_up_lets_another_box_go() -> None:
    wrong = sees(box=thing(1.0), hand=gripper(open_=False, blocked=True, color=Color.PINK))
    order = phases(iter([wrong] * 12))
    assert [phase for phase, _ in order] == ["close"] * 8 + ["release"] * 4
    assert order[-1][1].paddles == "open"


def test_drop_opens_backs_off_straight_and_then_turns() -> None:
    memory: Memory = {}
    actions = []
    for _ in range(48):
        action, memory = DROP.primitive.step(sees(), {}, memory, Random(0))
        actions.append(action)
    assert actions[0].lift == "down"
    drives = [action.drive for action in actions if isinstance(action.drive, Drive) and action.drive.linear < 0]
    assert drives[0].angular == 0.0
    assert drives[-1].angular != 0.0
    assert actions[-1].paddles == "close"
    assert [action.keep_on for action in actions] == [True] * 47 + [False]


def test_track_backs_up_when_it_has_come_a_little_too_near() -> None:
    close = sees(target=thing(0.58, color=Color.GREEN, radius=0.1))
    action, _ = TRACK.primitive.step(close, GREEN, {}, Random(0))
    assert isinstance(action.drive, Drive)
    assert action.drive.linear < 0


def test_track_gives_a_stand_up_that_it_cannot_reach() -> None:
    memory: Memory = {}
    directions = []
    for tick in range(70):
        _, memory = TRACK.primitive.step(
            sees(tick / 10, target=thing(2.0, color=Color.GREEN, radius=0.1)), GREEN, memory, Random(0)
        )
        directions.append(memory["direction"])
    assert len(set(directions[:60])) == 1
    assert len(set(directions)) == 2
    assert memory["avoided"] == [directions[0]]


def test_track_turns_on_the_spot_at_the_right_distance() -> None:
    aside = sees(target=thing(0.0, 0.7, color=Color.GREEN, radius=0.1))
    action, _ = TRACK.primitive.step(aside, GREEN, {}, Random(0))
    assert action.drive == Drive(angular=1.0)


def test_following_goes_to_where_the_teacher_was_last_and_looks_around_there() -> None:
    follow = FollowTeacher()
    teacher = Thing(id=1, color=Color.BLUE, position=Point(1.8, 0.9), radius=0.15, sensed=True, seen_s=0.0)
    _, memory = follow.step(Percepts(time_s=0.0, teacher=teacher), {}, Random(0))
    action, memory = follow.step(Percepts(time_s=1.0), memory, Random(0))
    assert action.drive == Head(bearing=pytest.approx(math.atan2(0.9, 1.8)), speed=0.25)
    arrived = Percepts(time_s=2.0, odometry=Odometry(pose=Pose(1.5, 0.6, 0.0)))
    action, memory = follow.step(arrived, memory, Random(0))
    assert action.drive == Drive(angular=0.6)


def test_wander_looks_around_once_and_then_goes_where_there_is_room() -> None:
    wander, memory = Wander(), {}
    wall = np.column_stack((np.linspace(-2, 2, 80), np.full(80, 0.6)))
    turned, heading = 0.0, 0.0
    for tick in range(200):
        percepts = Percepts(time_s=tick / 10, odometry=Odometry(pose=Pose(0, 0, heading)), obstacles=wall)
        action, memory = wander.step(percepts, memory, Random(1))
        if isinstance(action.drive, Head):
            break
        assert isinstance(action.drive, Drive)
        heading += action.drive.angular / 10
        turned += abs(action.drive.angular) / 10
    assert turned == pytest.approx(math.tau, abs=0.2)
    assert isinstance(action.drive, Head)
    going = heading + action.drive.bearing
    assert math.sin(going) < 0.5  # not into the wall on the left


def test_wander_goes_on_where_there_is_no_room_to_turn() -> None:
    wander, memory = Wander(), {}
    for tick in range(150):
        action, memory = wander.step(Percepts(time_s=tick / 10), memory, Random(1))
        if isinstance(action.drive, Head):
            return
    pytest.fail("it waits for ever to have turned around")


def test_boxes_are_gone_around_but_not_the_one_that_is_wanted() -> None:
    seen = sees(box=thing(1.0))
    assert np.hypot(*(surroundings(seen, None) - (1.0, 0.0)).T).max() == pytest.approx(0.05)
    assert len(surroundings(seen, Point(1.0, 0.0))) == 0


def test_commands_keep_to_the_robots_limits() -> None:
    command, _ = Motion(PIONEER).command([Action(drive=Drive(linear=3.0, angular=-9.0))], sees())
    assert (command.linear, command.angular) == (PIONEER.max_linear, -PIONEER.max_angular)
