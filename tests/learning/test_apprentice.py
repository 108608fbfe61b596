"""The robot in its learning mode: when it follows, when it obeys, when it stands still (§4.1, §4.2, A.5)."""

from collections.abc import Iterable

import numpy as np
import pytest

from understudy.behaviors import Instance, SkillSet
from understudy.behaviors.drop import DROP
from understudy.behaviors.pick_up import PICK_UP
from understudy.behaviors.track import TRACK
from understudy.geometry import Point
from understudy.learning import Apprentice, demonstrate, evaluate
from understudy.perception import GripperState, Percepts, Thing
from understudy.robot import PIONEER, STOP, Color, Command, Cue, GripperReading, Observation, Scan

SKILLS = SkillSet(TRACK, PICK_UP, DROP)
TEACHER = Thing(id=1, color=Color.BLUE, position=Point(1.5, 0.0), radius=0.15, sensed=True, seen_s=0.0)
EMPTY = GripperState(holding=False, empty=True, color=None, open=True, raised=False, blocked=False)
HOLDING = GripperState(holding=True, empty=False, color=Color.RED, open=False, raised=True, blocked=True)


def box(x: float, seen_s: float = 0.0, color: Color = Color.RED) -> Thing:
    return Thing(id=2, color=color, position=Point(x, 0.0), radius=0.05, sensed=True, seen_s=seen_s)


def percepts(
    time_s: float = 0.0, *, boxes: Iterable[Thing] = (), gripper: GripperState = EMPTY, teacher: Thing | None = TEACHER
) -> Percepts:
    return Percepts(time_s=time_s, boxes=tuple(boxes), teacher=teacher, gripper=gripper)


def started() -> Apprentice:
    apprentice = Apprentice(SKILLS, PIONEER)
    apprentice.step(percepts(), [Cue.START])
    return apprentice


def test_it_stands_still_until_start_and_after_done() -> None:
    apprentice = Apprentice(SKILLS, PIONEER)
    assert apprentice.step(percepts(), [])[0] == STOP
    command, _ = apprentice.step(percepts(0.1), [Cue.START])
    assert command.linear > 0
    assert apprentice.step(percepts(0.2), [Cue.DONE])[0] == STOP
    assert apprentice.mode == "done"


def test_every_word_heard_is_told() -> None:
    _, news = Apprentice(SKILLS, PIONEER).step(percepts(1.0), [Cue.START, Cue.HERE])
    assert news == [
        {"time_s": 1.0, "kind": "heard", "cue": "START"},
        {"time_s": 1.0, "kind": "heard", "cue": "HERE"},
    ]


def test_it_keeps_its_distance_from_the_teacher() -> None:
    near = Thing(id=1, color=Color.BLUE, position=Point(0.7, 0.0), radius=0.15, sensed=True, seen_s=0.0)
    command, _ = started().step(percepts(0.1, teacher=near), [])
    assert command.linear == pytest.approx(0.0)


def test_take_picks_up_the_box_that_was_shown_and_then_it_follows_again() -> None:
    apprentice = started()
    _, news = apprentice.step(percepts(1.0, boxes=[box(0.9, 0.9)]), [Cue.TAKE])
    assert news[-1] == {"time_s": 1.0, "kind": "errand", "skill": "PickUp", "what": "pick up the red box"}
    assert apprentice.mode == "busy"
    for tick in range(11, 60):
        _, news = apprentice.step(percepts(tick / 10, gripper=HOLDING), [])
        if news:
            break
    assert news[0]["kind"] == "errand-done"
    assert apprentice.mode == "following"


def test_take_waits_for_a_box_and_gives_up_with_a_word() -> None:
    apprentice = started()
    assert apprentice.step(percepts(1.0), [Cue.TAKE])[0] == STOP
    assert apprentice.mode == "looking"
    _, news = apprentice.step(percepts(17.0), [])
    assert news == [{"time_s": 17.0, "kind": "missed", "what": "no box in view after TAKE"}]
    assert apprentice.mode == "following"


def test_a_box_seen_long_ago_or_far_off_is_not_the_one_that_is_meant() -> None:
    for other in (box(0.9, seen_s=1.0), box(2.5, seen_s=9.9)):
        apprentice = started()
        apprentice.step(percepts(10.0, boxes=[other]), [Cue.TAKE])
        assert apprentice.mode == "looking"


def test_drop_lets_go_and_backs_off() -> None:
    apprentice = started()
    _, news = apprentice.step(percepts(1.0, gripper=HOLDING), [Cue.DROP])
    assert news[-1]["skill"] == "Drop"
    commands = [apprentice.step(percepts(1.0 + tick / 10), [])[0] for tick in range(1, 60)]
    assert any(command.paddles == "open" for command in commands)
    assert any(command.linear < 0 for command in commands)
    assert apprentice.mode == "following"


def test_words_before_start_do_nothing_and_are_told_to_do_nothing() -> None:
    apprentice = Apprentice(SKILLS, PIONEER)
    command, news = apprentice.step(percepts(boxes=[box(0.9)]), [Cue.TAKE, Cue.DROP, Cue.DONE])
    assert command == STOP
    assert apprentice.mode == "idle"
    assert [event["what"] for event in news if event["kind"] == "ignored"] == [
        "no demonstration is going on",
        "no demonstration is going on",
        "a demonstration has not begun",
    ]


@pytest.mark.parametrize(
    ("cue", "gripper", "why"),
    [
        (Cue.DROP, EMPTY, "there is nothing in the gripper"),
        (Cue.TAKE, HOLDING, "there is something in the gripper already"),
        (Cue.START, EMPTY, "a demonstration is going on"),
    ],
)
def test_what_cannot_be_obeyed_is_said(cue: Cue, gripper: GripperState, why: str) -> None:
    apprentice = started()
    _, news = apprentice.step(percepts(1.0, gripper=gripper), [cue])
    assert news[-1] == {"time_s": 1.0, "kind": "ignored", "cue": cue.value, "what": why}
    assert apprentice.mode == "following"


class Clock:
    """A robot that sees nothing, hears START, and whose clock began long ago."""

    spec = PIONEER

    def __init__(self) -> None:
        self.ticks = 0

    def sense(self) -> Observation:
        scan = Scan(ranges=np.full(181, 3.0, np.float32))
        cues = (Cue.START,) if self.ticks == 0 else ()
        return Observation(time_s=1e6 + self.ticks / 10, scan=scan, gripper=GripperReading(), cues=cues)

    def act(self, command: Command) -> None:
        pass

    def wait(self) -> None:
        self.ticks += 1

    def stop(self) -> None:
        pass


def test_a_demonstration_without_done_is_ended_in_time_whatever_the_clock_says() -> None:
    robot = Clock()
    found = demonstrate(robot, SKILLS, limit_s=5.0)
    assert robot.ticks == 50
    assert not found.done


def test_done_ends_an_errand() -> None:
    apprentice = started()
    apprentice.step(percepts(1.0, boxes=[box(0.9, 0.9)]), [Cue.TAKE])
    command, _ = apprentice.step(percepts(1.1, boxes=[box(0.9, 0.9)]), [Cue.DONE])
    assert command == STOP


def test_an_errand_that_fails_is_told_and_ended() -> None:
    apprentice = started()
    apprentice.step(percepts(1.0, boxes=[box(0.9, 0.9)]), [Cue.TAKE])
    _, news = apprentice.step(percepts(47.0, boxes=[box(0.9, 46.9)]), [])
    assert news == [{"time_s": 47.0, "kind": "errand-failed", "skill": "PickUp"}]
    assert apprentice.mode == "following"


def test_all_skills_are_asked_what_they_see() -> None:
    target = Thing(id=3, color=Color.PINK, position=Point(0.9, 0.0), radius=0.1, sensed=True, seen_s=0.0)
    seen = Percepts(time_s=0.0, targets=(target,), gripper=EMPTY)
    assert evaluate(seen, SKILLS) == {
        Instance("Track", (("color", "pink"),)): {"distance_m": pytest.approx(0.8), "angle_deg": pytest.approx(90.0)},
        Instance("Drop"): {},
    }
