"""A teacher who listens: what a remark of the robot's makes it do."""

from typing import Any

import numpy as np
import pytest

from tests.sim.support import drive, make_world
from understudy.geometry import Point
from understudy.robot import Color, Cue
from understudy.sim import Referee, Simulation
from understudy.sim.listening import Listener, meant_by
from understudy.sim.script import ScriptItem

TARGETS = [(Color.RED, Point(1.0, 1.0)), (Color.GREEN, Point(3.0, 3.0)), (Color.PINK, Point(3.0, 5.0))]
SCRIPT = [
    ScriptItem.model_validate(item)
    for item in (
        {"say": "START"},
        {"walk": {"to": [2.4, 3.0], "say": {"word": "HERE", "when_robot_within": 1.0, "of": [3.0, 3.0]}}},
        {"walk": {"to": [2.4, 5.0], "say": {"word": "DROP", "when_robot_past": [3.0, 4.5]}}},
    )
]


def listener(heeds: float = 1.0) -> Listener:
    return Listener(SCRIPT, TARGETS, heeds, np.random.default_rng(1))


def remark(about: str, *noted: str, cue: str = "HERE") -> dict[str, Any]:
    return {"about": about, "cue": cue, "noted": list(noted)}


def test_a_word_is_about_the_target_at_its_place() -> None:
    assert [meant_by(item, TARGETS) for item in SCRIPT] == [None, Color.GREEN, Color.PINK]
    assert meant_by(SCRIPT[1], TARGETS[2:]) is None


@pytest.mark.parametrize(
    ("heard", "behind", "answer", "reaction"),
    [
        (remark("noted", "green"), False, 0, None),
        (remark("nothing"), False, 0, "say again"),
        (remark("nothing"), True, 0, "lead again"),
        (remark("noted", "green", "red"), False, 1, None),
        (remark("noted", "red", "green"), False, 2, "say again"),
        (remark("noted", "green", "pink"), False, 1, None),  # its turn has not come
        (remark("noted", "red", cue="TAKE"), False, 0, None),  # of an earlier word
        (remark("missed"), False, 0, "lead again"),
        ({"about": "lost"}, False, 0, "come back"),
    ],
)
def test_what_is_done_at_a_remark(heard: dict[str, Any], behind: bool, answer: int, reaction: str | None) -> None:
    ear = listener()
    ear.spoke(1, Cue.HERE)
    assert ear.hears(heard, at=1, behind=behind) == ((Cue.BAD,) * answer, reaction)


def test_a_word_is_mended_twice_at_most_and_the_second_time_by_leading_there() -> None:
    ear = listener()
    ear.spoke(1, Cue.HERE)
    assert [ear.hears(remark("nothing"), at=1, behind=False)[1] for _ in range(3)] == ["say again", "lead again", None]


def test_drop_is_not_said_again_but_what_it_pointed_at_wrongly_is_taken_back() -> None:
    ear = listener()
    ear.spoke(2, Cue.DROP)
    assert ear.hears(remark("noted", "red", cue="DROP"), at=2, behind=False) == ((Cue.BAD,), None)


def test_here_is_said_if_asked_about_what_was_to_be_shown_by_now_and_only_once() -> None:
    ear = listener()
    passed = remark("passed", "green")
    assert ear.hears(passed, at=0, behind=False) == ((), None)
    assert ear.hears(remark("passed", "red"), at=2, behind=False) == ((), None)
    assert ear.hears(passed, at=2, behind=False) == ((Cue.HERE,), None)
    assert ear.hears(remark("noted", "green"), at=2, behind=False) == ((), None)
    assert ear.hears(passed, at=2, behind=False) == ((), None)


def test_only_the_share_is_heeded() -> None:
    deaf, half = listener(0.0), listener(0.5)
    assert all(deaf.hears({"about": "lost"}, at=1, behind=False)[1] is None for _ in range(50))
    heeded = sum(half.hears({"about": "lost"}, at=1, behind=False)[1] is not None for _ in range(400))
    assert heeded == pytest.approx(200, abs=40)


def taught(*script: Any, **teacher: Any) -> Simulation:
    habits = {"like": "inexperienced", "heeds": 1.0, "forgets": 0, "strays": 0, "late": 0, "timing": 0}
    return Simulation(
        make_world(
            teacher={"at": [2.0, 2.8], "habits": habits, "script": list(script), **teacher},
            targets=[{"color": "green", "at": [2.9, 3.2]}],
        )
    )


def test_the_teacher_comes_back_to_a_robot_that_has_lost_it() -> None:
    simulation = taught({"walk": [2.0, 5.6]})
    drive(simulation.robot(), 10.0)
    referee, teacher = Referee(simulation), simulation.teacher
    assert teacher is not None
    at = referee.teacher()
    assert at is not None
    assert at.distance_to(Point(2.0, 2.0)) > 1.8
    teacher.hear({"about": "lost"})
    nearest = 9.0
    for _ in range(60):
        drive(simulation.robot(), 0.1)
        at = referee.teacher()
        assert at is not None
        nearest = min(nearest, at.distance_to(Point(2.0, 2.0)))
    assert nearest < 1.25


def test_the_teacher_says_here_again_and_then_leads_there_again() -> None:
    here = {"word": "HERE", "when_robot_within": 1.6, "of": [2.9, 3.2]}
    simulation = taught({"walk": {"to": [2.0, 3.1], "say": here}}, {"say": "DONE"})
    robot, teacher = simulation.robot(), simulation.teacher
    assert teacher is not None
    heard: list[tuple[float, Cue]] = []
    while not simulation.teacher_done:
        assert simulation.time_s < 60.0
        observation = robot.sense()
        heard += [(observation.time_s, cue) for cue in observation.cues]
        if Cue.HERE in observation.cues and [cue for _, cue in heard].count(Cue.HERE) <= 2:
            teacher.hear(remark("nothing"))
        robot.wait()
    words = [cue for _, cue in heard]
    assert words == [Cue.HERE, Cue.HERE, Cue.HERE, Cue.DONE]
    assert heard[1][0] - heard[0][0] == pytest.approx(2.1, abs=0.15)
