"""Driving, odometry, time, and the promise that a run can be repeated bit for bit."""

import math

import numpy as np
import pytest

from tests.sim.support import QUIET, drive, make_world, simulate
from understudy.errors import WorldError
from understudy.robot import Command, Cue, Observation, Robot
from understudy.sim import Referee, Simulation, World, load_world, world_path


def test_a_simulated_robot_is_a_robot() -> None:
    robot: Robot = simulate().robot()
    assert robot.spec.name == "pioneer"


def test_it_drives_straight_at_the_commanded_speed() -> None:
    simulation = simulate()
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 1.0, linear=0.4)
    before = referee.robot_pose()
    drive(robot, 2.0, linear=0.4)
    after = referee.robot_pose()
    assert after.y - before.y == pytest.approx(0.8, abs=0.01)
    assert after.x == pytest.approx(2.0, abs=1e-3)
    assert after.heading == pytest.approx(math.pi / 2, abs=1e-3)


def test_it_turns_on_the_spot_about_its_wheels() -> None:
    simulation = simulate()
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 0.5, angular=-0.8)
    before = referee.robot_pose()
    drive(robot, 1.0, angular=-0.8)
    after = referee.robot_pose()
    assert before.heading - after.heading == pytest.approx(0.8, abs=0.01)
    assert after.position.distance_to(before.position) < 0.002


def test_it_never_slides_sideways_in_a_fast_curve() -> None:
    simulation = simulate()
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 1.0, linear=0.5, angular=1.5)
    for _ in range(20):
        before = referee.robot_pose()
        drive(robot, 0.1, linear=0.5, angular=1.5)
        local = before.to_local(referee.robot_pose().position)
        # On a circle, the chord of one period leans by half the turn.
        assert math.atan2(local.y, local.x) == pytest.approx(0.075, abs=0.01)


def test_speeds_are_clipped_and_reached_with_limited_acceleration() -> None:
    simulation = simulate()
    robot = simulation.robot()
    speeds = []
    for _ in range(12):
        drive(robot, 0.1, linear=9.0)
        speeds.append(robot.sense().odometry.linear)
    assert max(speeds) <= robot.spec.max_linear + 0.01
    assert speeds[-1] == pytest.approx(robot.spec.max_linear, abs=0.01)
    assert np.diff([0.0, *speeds]).max() <= 0.1 * robot.spec.max_linear_acceleration + 0.005


def test_stop_brakes_at_once() -> None:
    simulation = simulate()
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 1.5, linear=0.5)
    before = referee.robot_pose()
    robot.stop()
    for _ in range(10):
        robot.wait()
    assert before.position.distance_to(referee.robot_pose().position) < 0.06
    assert abs(robot.sense().odometry.linear) < 0.005


def test_it_stalls_at_a_wall_and_can_back_off() -> None:
    simulation = simulate(robots=[{"name": "learner", "at": [2.0, 5.2], "heading_deg": 90}])
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 4.0, linear=0.5)
    stalled = referee.robot_pose()
    assert 5.55 < stalled.y < 5.65  # the gripper's tips are 0.40 m before the wheels
    drive(robot, 2.0, linear=0.5)
    assert referee.robot_pose().position.distance_to(stalled.position) < 0.01
    drive(robot, 2.0, linear=-0.3)
    assert referee.robot_pose().y < stalled.y - 0.3


def test_a_target_is_not_pushed_away() -> None:
    simulation = simulate(targets=[{"color": "red", "at": [2.0, 2.8]}])
    referee = Referee(simulation)
    drive(simulation.robot(), 4.0, linear=0.5)
    assert referee.targets()[0] == (2.0, 2.8)
    assert referee.robot_pose().y < 2.31


def odometry_error(seed: int, **noise: float) -> float:
    """Metres between dead reckoning and truth after a lap of about 8 m."""
    simulation = Simulation(make_world(noise={**QUIET, **noise}), seed=seed)
    robot, referee = simulation.robot(), Referee(simulation)
    start = referee.robot_pose()
    drive(robot, 20.0, linear=0.4, angular=0.4)
    reckoned = start.to_parent(robot.sense().odometry.pose.position)
    return reckoned.distance_to(referee.robot_pose().position)


def test_odometry_is_nearly_exact_without_noise() -> None:
    assert odometry_error(1) < 0.05  # of 8 m: in curves the wheels slip a little


def test_odometry_drifts_but_modestly() -> None:
    errors = [odometry_error(seed, odometry_scale=0.015, odometry_heading=0.01) for seed in range(8)]
    assert max(errors) < 0.6
    assert min(errors) > 0.0
    assert sum(errors) / len(errors) > 0.02


def test_time_goes_in_exact_steps() -> None:
    simulation = simulate()
    robot = simulation.robot()
    times = []
    for _ in range(7):
        times.append(robot.sense().time_s)
        robot.wait()
    assert times == [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
    assert simulation.time_s == 0.7


def test_sensing_twice_gives_the_same_observation_and_each_cue_once() -> None:
    simulation = simulate()
    robot = simulation.robot()
    first = robot.sense()
    assert robot.sense() is first
    simulation.say(Cue.HERE)
    simulation.say(Cue.TAKE)
    again = robot.sense()
    assert again.cues == (Cue.HERE, Cue.TAKE)
    assert again.scan is first.scan
    assert robot.sense().cues == ()
    robot.wait()
    assert robot.sense().cues == ()


def test_a_word_can_be_said_to_one_robot_alone() -> None:
    simulation = simulate(
        robots=[{"name": "learner", "at": [1.0, 1.0]}, {"name": "guide", "at": [3.0, 3.0], "marker": "blue"}]
    )
    simulation.say(Cue.HERE, to=["learner"])
    assert simulation.robot("learner").sense().cues == (Cue.HERE,)
    assert simulation.robot("guide").sense().cues == ()


def test_an_unknown_robot_is_answered_with_those_that_exist() -> None:
    with pytest.raises(WorldError, match="'rex'; there are: learner"):
        simulate().robot("rex")


def fingerprint(observation: Observation) -> tuple[object, ...]:
    assert observation.image is not None
    return (
        observation.time_s,
        observation.scan.ranges.tobytes(),
        observation.sonar.tobytes(),
        observation.image.tobytes(),
        observation.odometry,
        observation.gripper,
        observation.cues,
    )


def run(world: World, seed: int | None) -> list[tuple[object, ...]]:
    simulation = Simulation(world, seed=seed)
    robot = simulation.robot()
    seen = []
    for step in range(80):
        seen.append(fingerprint(robot.sense()))
        robot.act(Command(linear=0.3, angular=math.sin(step / 9), paddles="open" if step % 40 < 20 else "close"))
        robot.wait()
    return seen


@pytest.mark.parametrize("name", ["visit_targets", "transport"])
def test_the_same_seed_and_commands_give_the_same_observations_bit_for_bit(name: str) -> None:
    world = load_world(world_path(name))
    first = run(world, None)
    assert run(world, world.seed) == first
    other = run(world, world.seed + 1)
    assert all(a[1:4] != b[1:4] for a, b in zip(first, other, strict=True))
