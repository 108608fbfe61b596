"""Collisions are counted by kind, once each; interventions do what they say."""

import math
from itertools import pairwise

import pytest

from tests.sim.support import drive, simulate
from understudy.errors import WorldError
from understudy.geometry import Point
from understudy.robot import Color
from understudy.sim import CollisionKind, Referee


def test_a_free_run_has_no_collisions() -> None:
    simulation = simulate(targets=[{"color": "red", "at": [2.6, 2.6]}])
    referee = Referee(simulation)
    drive(simulation.robot(), 3.0, linear=0.4)
    assert referee.collisions == []
    assert referee.count() == 0


def test_a_wall_is_hit_once_while_the_robot_keeps_pushing() -> None:
    simulation = simulate(robots=[{"name": "learner", "at": [2.0, 5.0], "heading_deg": 90}])
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 5.0, linear=0.5)
    assert [c.kind for c in referee.collisions] == [CollisionKind.WALL]
    collision = referee.collisions[0]
    assert 1.0 < collision.start_s < 2.5
    assert collision.end_s == pytest.approx(5.0, abs=0.1)
    assert collision.max_force > 20.0
    assert not collision.grazing
    drive(robot, 1.0, linear=-0.3)
    drive(robot, 3.0, linear=0.3)
    assert referee.count(CollisionKind.WALL) == 2


def test_a_soft_touch_is_grazing() -> None:
    simulation = simulate(robots=[{"name": "learner", "at": [2.0, 5.55], "heading_deg": 90}])
    robot, referee = simulation.robot(), Referee(simulation)
    for _ in range(40):
        drive(robot, 0.1, linear=0.04)
        if referee.collisions:
            break
    robot.stop()
    drive(robot, 1.0, linear=-0.2)
    assert referee.count() == 1
    assert referee.count(grazing=False) == 0


@pytest.mark.parametrize(
    ("things", "kind"),
    [
        ({"targets": [{"color": "red", "at": [0.5, 0.5]}, {"color": "red", "at": [2.0, 2.8]}]}, CollisionKind.TARGET),
        ({"teacher": {"at": [2.0, 2.8]}}, CollisionKind.PERSON),
        ({"walls": [{"from": [1, 2.8], "to": [3, 2.8]}]}, CollisionKind.WALL),
    ],
)
def test_collisions_are_told_apart(things: dict[str, object], kind: CollisionKind) -> None:
    simulation = simulate(**things)
    referee = Referee(simulation)
    drive(simulation.robot(), 3.0, linear=0.4)
    assert [c.kind for c in referee.collisions] == [kind]
    assert referee.collisions[0].other == (1 if kind is CollisionKind.TARGET else 0)
    assert referee.count(kind) == 1
    assert all(referee.count(other) == 0 for other in CollisionKind if other is not kind)


def test_two_robots_that_meet_count_as_one_collision() -> None:
    robots = [
        {"name": "learner", "at": [2.0, 1.0], "heading_deg": 90},
        {"name": "other", "at": [2.0, 3.0], "heading_deg": 90},
    ]
    simulation = simulate(robots=robots)
    referee = Referee(simulation)
    drive(simulation.robot(), 5.0, linear=0.4)
    assert {c.kind for c in referee.collisions} == {CollisionKind.ROBOT}
    assert len(referee.collisions) == 1


def test_the_minimum_distance_is_that_of_the_outlines() -> None:
    simulation = simulate(targets=[{"color": "red", "at": [2.0, 2.8]}])
    referee = Referee(simulation)
    assert referee.minimum_distance() == pytest.approx(0.8 - 0.40 - 0.10)
    simulation.move_robot((0.5, 5.0), heading_deg=180)
    assert referee.minimum_distance() == pytest.approx(0.1)


def test_trajectories_hold_one_pose_a_period() -> None:
    simulation = simulate()
    referee = Referee(simulation)
    drive(simulation.robot(), 1.0, linear=0.3)
    path = referee.trajectories["learner"]
    assert len(path) == 11
    assert path[0].position == (2.0, 2.0)
    assert path[-1] == referee.robot_pose()
    assert all(later.y >= earlier.y - 1e-6 for earlier, later in pairwise(path))


def test_a_target_can_be_moved_in_mid_run_and_is_sensed_there() -> None:
    simulation = simulate(targets=[{"color": "red", "at": [0.5, 0.5]}])
    robot, referee = simulation.robot(), Referee(simulation)
    assert robot.sense().scan.ranges[90] > 3.0
    simulation.move_target(Color.RED, (2.0, 3.5))
    assert referee.targets() == [Point(2.0, 3.5)]
    assert robot.sense().scan.ranges[90] == pytest.approx(1.5 - 0.10 - 0.10, abs=0.01)
    drive(robot, 5.0, linear=0.4)
    assert referee.count(CollisionKind.TARGET) == 1


def test_a_box_that_was_moved_is_solid_there() -> None:
    simulation = simulate(boxes=[{"color": "orange", "at": [0.5, 0.5]}])
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 1.0)
    simulation.move_box(Color.ORANGE, (2.0, 2.6))
    drive(robot, 4.0, linear=0.3)
    assert referee.boxes()[0].y > 3.0


def test_a_robot_can_be_moved() -> None:
    simulation = simulate()
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 1.0, linear=0.5)
    simulation.move_robot((1.0, 5.0), heading_deg=-90)
    pose = referee.robot_pose()
    assert (pose.x, pose.y, pose.heading) == pytest.approx((1.0, 5.0, -math.pi / 2))
    assert robot.sense().scan.ranges[90] == pytest.approx(4.9, abs=0.01)


@pytest.mark.parametrize(
    ("which", "to", "words"),
    [(Color.PINK, (1, 1), "no target is pink; there are: red"), (3, (1, 1), "no target 3"), (0, (9, 1), "outside")],
)
def test_impossible_interventions_are_refused(which: int | Color, to: tuple[float, float], words: str) -> None:
    simulation = simulate(targets=[{"color": "red", "at": [0.5, 0.5]}])
    with pytest.raises(WorldError, match=words):
        simulation.move_target(which, to)
