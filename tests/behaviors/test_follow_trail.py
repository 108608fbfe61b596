"""Following a teacher's trail: around the corner that the teacher went around, and not across it."""

import math
from random import Random

from understudy.behaviors import Action, Drive, Following, FollowTeacher, FollowTrail, Head, Memory
from understudy.geometry import Point, Pose, wrap_angle
from understudy.perception import Percepts, Thing
from understudy.robot import Color, Odometry

CORNER = [Point(0.8 + 0.02 * step, 0.0) for step in range(60)] + [Point(2.0, 0.02 * step) for step in range(60)]
"""A teacher at 0.2 m/s, from 0.8 m before the robot: 1.2 m straight on, then to the left."""


def sees(pose: Pose, teacher: Point | None, time_s: float = 0.0) -> Percepts:
    person = None
    if teacher is not None:
        here = pose.to_local(teacher)
        person = Thing(id=1, color=Color.BLUE, position=here, radius=0.1, sensed=True, seen_s=time_s)
    return Percepts(time_s=time_s, odometry=Odometry(pose=pose), teacher=person)


def moved(pose: Pose, action: Action) -> Pose:
    """A tenth of a second later, in an empty room."""
    if isinstance(action.drive, Head):
        turn = max(-action.drive.turn, min(action.drive.turn, 2.0 * action.drive.bearing))
        speed = action.drive.speed * max(0.0, math.cos(action.drive.bearing))
    else:
        assert isinstance(action.drive, Drive)
        turn, speed = action.drive.angular, action.drive.linear
    heading = wrap_angle(pose.heading + 0.1 * turn)
    return Pose(pose.x + 0.1 * speed * math.cos(heading), pose.y + 0.1 * speed * math.sin(heading), heading)


def way(follow: Following, teacher: list[Point | None]) -> list[Pose]:
    poses, memory = [Pose()], Memory()
    for tick, place in enumerate(teacher):
        action, memory = follow.step(sees(poses[-1], place, 0.1 * tick), memory, Random(0))
        poses.append(moved(poses[-1], action))
    return poses


def off_the_corner(poses: list[Pose]) -> float:
    return max(min(math.dist((pose.x, pose.y), place) for place in [Point(0.0, 0.0), *CORNER]) for pose in poses[40:])


def test_the_corner_is_not_cut() -> None:
    waiting = [CORNER[-1]] * 30
    assert off_the_corner(way(FollowTrail(), [*CORNER, *waiting])) < 0.12
    assert off_the_corner(way(FollowTeacher(), [*CORNER, *waiting])) > 0.2


def test_it_stops_behind_a_teacher_that_stands() -> None:
    last = way(FollowTrail(), [*CORNER, *[CORNER[-1]] * 60])[-1]
    assert 0.5 < math.dist((last.x, last.y), CORNER[-1]) < 0.75


def test_it_does_not_run_into_a_teacher_that_comes_back() -> None:
    back = [Point(0.8 - 0.02 * step, 0.0) for step in range(20)]
    assert way(FollowTrail(), back)[-1].x < 0.1


def test_out_of_sight_it_goes_to_the_trails_end_and_looks_around() -> None:
    poses = way(FollowTrail(), [*CORNER, *[None] * 100])
    assert math.dist((poses[-1].x, poses[-1].y), CORNER[-1]) < 0.45
    assert abs(wrap_angle(poses[-1].heading - poses[-20].heading)) > 1.0


def test_before_it_has_seen_anybody_it_turns() -> None:
    action, _ = FollowTrail().step(sees(Pose(), None), {}, Random(0))
    assert isinstance(action.drive, Drive)
    assert action.drive.angular > 0
