"""The scripted teacher: leads, waits, comes back, speaks at the right moment, and pushes nobody."""

import math
from itertools import pairwise
from typing import Any

import pytest

from tests.sim.support import drive, grasp, simulate, toward
from understudy.geometry import Point
from understudy.robot import Color, Cue
from understudy.sim import Referee, Simulation


def scripted(*script: Any, at: tuple[float, float] = (2.0, 2.8), **changes: Any) -> Simulation:
    return simulate(teacher={"at": list(at), "script": list(script)}, **changes)


def place(simulation: Simulation) -> Point:
    at = Referee(simulation).teacher()
    assert at is not None
    return at


def follow(simulation: Simulation, seconds: float, keep: float = 0.65) -> list[tuple[float, Cue]]:
    """Follows the teacher on true positions, and returns what was heard when."""
    robot, referee = simulation.robot(), Referee(simulation)
    heard = []
    for _ in range(round(seconds * 10)):
        observation = robot.sense()
        heard += [(observation.time_s, cue) for cue in observation.cues]
        if simulation.teacher_done:
            break
        goal = referee.teacher()
        assert goal is not None
        robot.act(toward(referee.robot_pose(), goal, keep))
        robot.wait()
    return heard


def test_a_world_without_a_teacher_is_done_and_an_empty_script_too() -> None:
    assert simulate().teacher_done
    assert scripted().teacher_done


def test_words_are_heard_exactly_once_and_the_last_one_before_the_end() -> None:
    simulation = scripted({"say": "START"}, {"wait": 1.0}, {"say": "HERE"}, {"say": "DONE"})
    robot = simulation.robot()
    heard = []
    while not simulation.teacher_done:
        observation = robot.sense()
        heard += [(observation.time_s, cue) for cue in observation.cues]
        robot.wait()
    assert heard == [(0.1, Cue.START), (1.1, Cue.HERE), (1.1, Cue.DONE)]


def test_the_teacher_walks_smoothly_and_arrives() -> None:
    simulation = scripted({"walk": [2.0, 4.0]}, {"wait": 10.0})
    referee, robot = Referee(simulation), simulation.robot()
    speeds, last = [], place(simulation)
    for _ in range(120):
        goal = referee.teacher()
        assert goal is not None
        robot.act(toward(referee.robot_pose(), goal, 0.65))
        robot.wait()
        now = referee.teacher()
        assert now is not None
        speeds.append(now.distance_to(last) / 0.1)
        last = now
    assert last.distance_to(Point(2.0, 4.0)) < 0.05
    assert 0.3 < max(speeds) < 0.36
    assert max(abs(b - a) for a, b in pairwise(speeds)) < 0.09


def test_the_teacher_waits_for_a_robot_that_stands_still() -> None:
    simulation = scripted({"walk": [2.0, 5.5]})
    drive(simulation.robot(), 20.0)
    away = place(simulation).distance_to(Point(2.0, 2.0))
    assert 0.95 < away < 1.25
    assert not simulation.teacher_done
    follow(simulation, 20.0)
    assert place(simulation).distance_to(Point(2.0, 5.5)) < 0.1


def test_the_teacher_comes_back_before_a_robot_that_looks_elsewhere() -> None:
    simulation = scripted({"walk": [2.0, 5.5]}, robots=[{"name": "learner", "at": [2.0, 2.0], "heading_deg": -20}])
    robot, referee = simulation.robot(), Referee(simulation)
    bearings = []
    for _ in range(120):
        robot.wait()
        bearings.append(abs(referee.robot_pose().to_local(place(simulation)).bearing))
    assert bearings[0] > math.radians(100)
    assert min(bearings) < math.radians(40)
    assert not referee.collisions


def test_stepping_aside_needs_no_robot() -> None:
    simulation = scripted({"step_aside": [3.5, 4.5]}, {"wait": 1})
    drive(simulation.robot(), 10.0)
    assert place(simulation).distance_to(Point(3.5, 4.5)) < 0.05


def test_a_word_waits_for_its_place() -> None:
    condition = {"word": "HERE", "when_robot_within": 1.0, "of": [2.0, 4.5]}
    simulation = scripted({"walk": {"to": [2.0, 5.0], "say": condition}}, {"say": "DONE"})
    robot, referee = simulation.robot(), Referee(simulation)
    for _ in range(300):
        before = referee.robot_pose().y
        goal = referee.teacher()
        assert goal is not None
        robot.act(toward(referee.robot_pose(), goal, 0.65))
        robot.wait()
        if Cue.HERE in robot.sense().cues:
            break
    assert before == pytest.approx(3.5, abs=0.06)


def test_a_word_waits_until_a_place_is_past() -> None:
    saying = {"word": "DROP", "when_robot_past": [2.6, 3.0]}
    simulation = scripted({"walk": {"to": [2.0, 5.0], "say": saying}}, {"wait": 1})
    robot, referee = simulation.robot(), Referee(simulation)
    heard_at = None
    for _ in range(300):
        goal = referee.teacher()
        assert goal is not None
        robot.act(toward(referee.robot_pose(), goal, 0.65))
        robot.wait()
        if Cue.DROP in robot.sense().cues:
            heard_at = referee.robot_pose()
            break
    assert heard_at is not None
    assert heard_at.to_local(Point(2.6, 3.0)).bearing == pytest.approx(-math.pi / 2, abs=0.1)


def test_a_condition_that_never_comes_ends_with_its_timeout() -> None:
    never = {"word": "HERE", "when_robot_within": 0.1, "of": [0.5, 0.5], "timeout": 3.0}
    simulation = scripted({"say": never}, {"wait_for": {"condition": "robot_holds_box", "timeout": 2.0}})
    robot = simulation.robot()
    heard = []
    while not simulation.teacher_done:
        heard += [(robot.sense().time_s, cue) for cue in robot.sense().cues]
        robot.wait()
        assert simulation.time_s < 10.0
    assert simulation.time_s == pytest.approx(5.2, abs=0.15)


def test_waiting_for_the_robot_to_be_near_and_facing() -> None:
    simulation = scripted({"wait_for": "robot_near"}, {"say": "TAKE"}, at=(2.0, 3.5))
    robot = simulation.robot()
    drive(robot, 3.0)
    assert not simulation.teacher_done
    drive(robot, 3.0, linear=0.3)
    assert Cue.TAKE in robot.sense().cues


def test_waiting_for_a_box_to_be_held_and_let_go() -> None:
    simulation = scripted(
        {"wait_for": "robot_holds_box"},
        {"say": "HERE"},
        {"wait_for": "robot_empty"},
        {"say": "DONE"},
        at=(3.5, 2.0),
        boxes=[{"color": "orange", "at": [2.0, 2.65]}],
    )
    robot = simulation.robot()
    drive(robot, 1.0)
    assert robot.sense().cues == ()
    grasp(robot)
    drive(robot, 0.3)
    assert robot.sense().cues == (Cue.HERE,)
    drive(robot, 1.0)
    assert robot.sense().cues == ()
    simulation.move_box(Color.ORANGE, (1.0, 1.0))
    drive(robot, 0.2)
    assert robot.sense().cues == (Cue.DONE,)


def test_the_teacher_never_walks_into_the_robot_a_target_or_a_box() -> None:
    targets = [{"color": "red", "at": [2.0, 3.6]}, {"color": "green", "at": [3.0, 3.0]}]
    boxes = [{"color": "orange", "at": [1.2, 3.2]}]
    robot_at = Point(2.0, 2.0)
    simulation = scripted(
        *[{"step_aside": [x, y]} for x, y in [(2.0, 1.2), (2.0, 4.6), (3.4, 2.6), (0.6, 3.5), (2.0, 0.5)]],
        at=(2.0, 4.2),
        targets=targets,
        boxes=boxes,
    )
    referee = Referee(simulation)
    while not simulation.teacher_done:
        simulation.step()
        here = place(simulation)
        assert here.distance_to(robot_at) > 0.5
        assert all(here.distance_to(target) > 0.25 for target in referee.targets())
        assert here.distance_to(referee.boxes()[0]) > 0.2
        assert simulation.time_s < 90
    assert not referee.collisions
    assert referee.boxes()[0] == pytest.approx((1.2, 3.2), abs=0.002)


def test_the_teacher_can_be_walked_by_hand() -> None:
    simulation = scripted({"say": "START"})
    teacher = simulation.teacher
    assert teacher is not None
    teacher.drive(Point(0.3, 0.0))
    for _ in range(20):
        simulation.step()
    assert place(simulation).x > 2.4
    assert not simulation.teacher_done
    teacher.drive(None)
    simulation.step()
    assert simulation.robot().sense().cues == (Cue.START,)
