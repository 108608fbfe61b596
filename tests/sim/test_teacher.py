"""The scripted teacher: leads, waits, comes back, speaks at the right moment, and pushes nobody."""

import math
import re
from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import pytest

from tests.sim.support import drive, grasp, simulate, toward
from understudy.behaviors import installed_skills
from understudy.geometry import Point
from understudy.learning import demonstrate, learn
from understudy.robot import Color, Cue, NoJournal
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
    drive(robot, 0.3)
    assert robot.sense().cues == (Cue.DONE,)


def before_a_box(*script: Any) -> Simulation:
    return scripted(*script, at=(3.5, 2.0), boxes=[{"color": "orange", "at": [2.0, 2.65]}])


def test_a_box_is_held_only_when_it_is_lifted() -> None:
    simulation = before_a_box({"wait_for": "robot_holds_box"}, {"say": "HERE"})
    robot = simulation.robot()
    drive(robot, 1.2, paddles="open", lift="down")
    drive(robot, 2.3, linear=0.15)
    drive(robot, 2.0, paddles="close")
    assert simulation.truth.gripped_box(0) == 0
    assert robot.sense().cues == ()
    drive(robot, 1.2, lift="up")
    assert robot.sense().cues == (Cue.HERE,)


def test_the_robot_is_empty_only_when_it_has_put_its_gripper_away() -> None:
    simulation = before_a_box({"wait_for": "robot_holds_box"}, {"wait_for": "robot_empty"}, {"say": "DONE"})
    robot = simulation.robot()
    grasp(robot)
    steps: list[dict[str, Any]] = [
        {"lift": "down"},
        {"paddles": "open"},
        {"linear": -0.15},
        {"paddles": "close"},  # not yet lifted
        {"paddles": "open", "lift": "up"},  # lifted, but open
    ]
    for step in steps:
        drive(robot, 2.0, **step)
        assert robot.sense().cues == (), step
        assert not simulation.teacher_done, step
    assert simulation.truth.gripped_box(0) is None
    drive(robot, 1.0, paddles="close")
    assert robot.sense().cues == (Cue.DONE,)


def test_a_drop_is_learned_when_done_comes_as_soon_as_the_robot_is_empty() -> None:
    simulation = scripted(
        {"say": "START"},
        {"wait": 2.0},
        {"say": "TAKE"},
        {"wait_for": "robot_holds_box"},
        {"wait": 3.0},
        {"say": "DROP"},
        {"wait_for": "robot_empty"},
        {"say": "DONE"},
        at=(2.6, 2.9),
        boxes=[{"color": "orange", "at": [2.0, 2.9]}],
    )
    robot = simulation.robot()
    news: list[str] = []

    class Listener(NoJournal):
        def event(self, event: Mapping[str, Any]) -> None:
            news.append(f"{event['kind']} {event.get('skill', event.get('cue', ''))}")

    lesson = learn(demonstrate(robot, installed_skills(), name="drop", limit_s=60.0, journal=Listener()))
    assert [str(observed.instance) for observed in lesson.kept][-2:] == ["PickUp(color=orange)", "Drop"]
    assert news[-2:] == ["errand-done Drop", "heard DONE"]
    assert not simulation.teacher_complaints


def test_the_teacher_complains_of_what_never_came() -> None:
    simulation = scripted(
        {"say": {"word": "HERE", "when_robot_within": 1.2, "of": [0.4, 5.2], "timeout": 3.0}},
        {"say": {"word": "DROP", "when_robot_past": [2.0, 5.0], "timeout": 1.5}},
        {"wait_for": {"condition": "robot_holds_box", "timeout": 2.0}},
        {"wait_for": "robot_empty"},
        {"say": "DONE"},
    )
    while not simulation.teacher_done:
        simulation.step()
    times, sentences = zip(*simulation.teacher_complaints, strict=True)
    assert sentences == (
        "HERE was said after 3 s in vain: the robot never came within 1.2 m of (0.4, 5.2)",
        "DROP was said after 1.5 s in vain: the robot never got past (2.0, 5.0)",
        "waited 2 s in vain for: robot_holds_box",
    )
    assert times == pytest.approx((3.0, 4.5, 6.5), abs=0.25)


def test_the_default_patience_is_thirty_seconds() -> None:
    simulation = scripted({"wait_for": "robot_holds_box"})
    drive(simulation.robot(), 29.9)
    assert not simulation.teacher_complaints
    drive(simulation.robot(), 0.3)
    assert [sentence for _, sentence in simulation.teacher_complaints] == ["waited 30 s in vain for: robot_holds_box"]


def test_a_word_on_a_walk_is_complained_of_at_its_end() -> None:
    saying = {"word": "HERE", "when_robot_within": 0.5, "of": [0.5, 0.5], "timeout": 1.0}
    simulation = scripted({"walk": {"to": [2.0, 3.4], "say": saying}}, {"wait": 1.0})
    follow(simulation, 20.0)
    ((time_s, sentence),) = simulation.teacher_complaints
    assert sentence.endswith("in vain: the robot never came within 0.5 m of (0.5, 0.5)")
    assert time_s > 1.5  # not in the middle of the walk, when its patience was over


def test_a_blocked_walk_is_complained_of_once() -> None:
    wall = {"from": [0.0, 3.5], "to": [4.0, 3.5]}
    simulation = scripted({"step_aside": [2.0, 4.5]}, {"say": "DONE"}, at=(2.0, 3.0), walls=[wall])
    while not simulation.teacher_done:
        simulation.step()
        assert simulation.time_s < 60
    ((_, sentence),) = simulation.teacher_complaints
    assert re.fullmatch(r"gave up walking 1\.\d m before \(2\.0, 4\.5\): something is in the way", sentence)


def test_where_the_teacher_is_can_be_asked() -> None:
    of = {"when_robot_within": 1.2, "of": [0.4, 5.25]}
    simulation = scripted(
        {"say": "START"},
        {"wait": 0.3},
        {"step_aside": [2.1, 2.8]},
        {"wait_for": {"condition": "robot_holds_box", "timeout": 0.3}},
        {"say": {"word": "DROP", "when_robot_past": [2, 5], "timeout": 0.3}},
        {"say": {"word": "HERE", "timeout": 0.3, **of}},
        {"walk": {"to": [2.4, 5.0], "say": {"word": "TAKE", **of}}},
    )
    told = [simulation.teacher_at]
    for _ in range(100):
        simulation.step()
        if simulation.teacher_at != told[-1]:
            told.append(simulation.teacher_at)
    assert told == [
        "script[0]: say START",
        "script[1]: wait 0.3 s",
        "script[2]: step aside to (2.1, 2.8)",
        "script[3]: wait for robot_holds_box",
        "script[4]: say DROP when the robot is past (2.0, 5.0)",
        "script[5]: say HERE when the robot is within 1.2 m of (0.4, 5.25)",
        "script[6]: walk to (2.4, 5.0), saying TAKE when the robot is within 1.2 m of (0.4, 5.25)",
    ]


def test_nobody_is_nowhere_and_has_no_complaints() -> None:
    assert simulate().teacher_at == ""
    assert simulate().teacher_complaints == []
    simulation = scripted({"say": "DONE"})
    drive(simulation.robot(), 0.2)
    assert simulation.teacher_at == ""


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
