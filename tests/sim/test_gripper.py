"""The gripper holds a box by friction alone: picked up, carried, turned with, put down."""

import math
from typing import Any

import pytest

from tests.sim.support import drive, grasp, simulate
from understudy.geometry import Point
from understudy.robot import Command, GripperReading
from understudy.sim import Referee, SimRobot, Simulation


def reading(robot: SimRobot) -> GripperReading:
    gripper = robot.sense().gripper
    assert gripper is not None
    return gripper


def before_a_box(aside: float = 0.0, heading_deg: float = 0.0, **changes: Any) -> Simulation:
    box = {"color": "orange", "at": [6.0 + aside, 6.65], "heading_deg": heading_deg}
    robot = {"name": "learner", "at": [6.0, 6.0], "heading_deg": 90}
    return simulate(arena={"size": [12.0, 12.0]}, boxes=[box], robots=[robot], **changes)


def test_it_is_switched_on_closed_raised_and_empty() -> None:
    gripper = reading(simulate().robot())
    assert gripper.aperture == pytest.approx(0.0, abs=0.02)
    assert gripper.lift == pytest.approx(1.0, abs=0.02)
    assert not gripper.beam_broken


def test_paddles_and_lift_go_where_they_are_told_and_stay_there() -> None:
    robot = simulate().robot()
    drive(robot, 1.5, paddles="open", lift="down")
    drive(robot, 1.0)
    assert reading(robot).aperture == pytest.approx(1.0, abs=0.02)
    assert reading(robot).lift == pytest.approx(0.0, abs=0.02)


@pytest.mark.parametrize(("aside", "heading_deg"), [(0.0, 0.0), (0.02, 20.0), (-0.03, 45.0), (0.01, -70.0)])
def test_a_box_is_grasped_lifted_carried_and_released(aside: float, heading_deg: float) -> None:
    simulation = before_a_box(aside, heading_deg)
    robot, referee = simulation.robot(), Referee(simulation)
    grasp(robot)
    assert referee.held_box() == 0
    gripper = reading(robot)
    assert gripper.beam_broken
    assert 0.2 < gripper.aperture < 0.8
    assert gripper.lift > 0.9
    held_at = referee.robot_pose().to_local(referee.boxes()[0])
    for linear, angular, seconds in [(0.5, 1.5, 3.0), (0.0, -1.5, 3.0), (0.5, -1.0, 3.0), (-0.3, 0.8, 2.0)] * 4:
        drive(robot, seconds, linear=linear, angular=angular)
    assert referee.held_box() == 0
    assert reading(robot).beam_broken
    slipped = referee.robot_pose().to_local(referee.boxes()[0]).distance_to(held_at)
    assert slipped < 0.02
    drive(robot, 1.2, lift="down")
    drive(robot, 1.2, paddles="open")
    drive(robot, 1.5, linear=-0.3)
    assert referee.held_box() is None
    assert not reading(robot).beam_broken
    assert referee.robot_pose().position.distance_to(referee.boxes()[0]) > 0.5
    assert simulation.truth.box_height(0) == pytest.approx(0.05, abs=0.002)


def test_closing_on_nothing_is_felt() -> None:
    robot = simulate().robot()
    drive(robot, 1.2, paddles="open", lift="down")
    drive(robot, 1.2, paddles="close")
    assert reading(robot).aperture < 0.05
    assert not reading(robot).beam_broken


def test_the_beam_breaks_only_while_the_box_is_between_the_paddles() -> None:
    simulation = before_a_box()
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 1.2, paddles="open", lift="down")
    beam_x = 0.33
    for _ in range(25):
        drive(robot, 0.1, linear=0.15)
        box = referee.robot_pose().to_local(referee.boxes()[0])
        if abs(abs(box.x - beam_x) - 0.045) > 0.005:
            assert reading(robot).beam_broken == (abs(box.x - beam_x) < 0.045)
    assert reading(robot).beam_broken


def test_a_box_can_be_pushed() -> None:
    simulation = before_a_box()
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 5.0, linear=0.3)
    box = referee.boxes()[0]
    assert box.y > 7.4
    assert not referee.collisions  # boxes are there to be touched


def test_a_raised_gripper_passes_over_a_box() -> None:
    simulation = before_a_box()
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 1.3, linear=0.3)
    assert referee.robot_pose().to_local(referee.boxes()[0]).x < 0.38
    assert referee.boxes()[0] == pytest.approx((6.0, 6.65), abs=0.001)


def test_the_beam_errs_as_often_as_it_should() -> None:
    simulation = simulate(noise={"beam_misreads": 0.2})
    robot = simulation.robot()
    wrong = 0
    for _ in range(200):
        wrong += int(reading(robot).beam_broken)
        robot.wait()
    assert 20 <= wrong <= 60


def test_what_was_taken_out_of_the_gripper_is_noticed() -> None:
    simulation = before_a_box()
    robot, referee = simulation.robot(), Referee(simulation)
    grasp(robot)
    simulation.move_box(0, (3.0, 3.0), heading_deg=30)
    drive(robot, 1.0)
    assert referee.held_box() is None
    assert not reading(robot).beam_broken
    assert reading(robot).aperture < 0.05
    assert referee.boxes()[0] == pytest.approx((3.0, 3.0), abs=0.001)


def test_a_robot_that_is_carried_elsewhere_keeps_its_box() -> None:
    simulation = before_a_box()
    robot, referee = simulation.robot(), Referee(simulation)
    grasp(robot)
    odometry = robot.sense().odometry.pose
    simulation.move_robot((3.0, 9.0), heading_deg=-45)
    assert referee.robot_pose().position == Point(3.0, 9.0)
    assert referee.robot_pose().heading == pytest.approx(-math.pi / 4)
    for _ in range(30):
        robot.act(Command(angular=0.5))
        robot.wait()
    assert referee.held_box() == 0
    reckoned = robot.sense().odometry.pose
    assert reckoned.position.distance_to(odometry.position) < 0.05  # its wheels noticed the turn alone
    assert reckoned.heading - odometry.heading == pytest.approx(1.5, abs=0.15)
