"""One robot teaches another (§4.5.5.2): what is learned, and that a recording of it teaches the same."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from understudy.behaviors import installed_skills
from understudy.errors import WorldError
from understudy.experiments import steps_in_order
from understudy.figures import Trajectory
from understudy.learning import learn
from understudy.network import Network
from understudy.robot import TEACHER_COLOR, Cue
from understudy.sessions import PassedOn, pass_on, pictures, recorded_demonstration, teach, with_robot_teacher
from understudy.sim import World, load_world, world_path
from understudy.teaching import NAIVE

SKILLS = installed_skills()


@pytest.fixture(scope="module")
def world() -> World:
    return load_world(world_path("relay"))


@pytest.fixture(scope="module")
def told(world: World) -> Network:
    """What the human teacher shows."""
    return learn(teach(world, SKILLS).demonstration).network


@pytest.fixture(scope="module")
def passed(world: World, told: Network, tmp_path_factory: pytest.TempPathFactory) -> PassedOn:
    recording = tmp_path_factory.mktemp("relay") / "relay.mcap"
    return pass_on("relay", told, world, SKILLS, recording=recording)


def test_the_human_teacher_shows_the_task_of_figure_4_17(told: Network) -> None:
    assert steps_in_order(told) == (
        ("track-yellow-1", "left"),
        ("track-light-orange-1", "right"),
        ("track-light-green-1", "left"),
        ("track-pink-1", "left"),
        ("track-orange-1", "right"),
    )


def test_a_robot_passes_it_on(passed: PassedOn, told: Network) -> None:
    assert passed.finished
    assert not passed.complaints
    assert [cue for _, cue in passed.demonstration.cues] == [Cue.HERE] * 5
    assert steps_in_order(learn(passed.demonstration).network) == steps_in_order(told)
    assert passed.verdict.clean


def test_the_recording_teaches_the_same(passed: PassedOn) -> None:
    assert passed.recording is not None
    again = recorded_demonstration(passed.recording, SKILLS)
    assert learn(again).network == learn(passed.demonstration).network


def test_the_learner_goes_where_the_teacher_went(passed: PassedOn) -> None:
    learner, teacher = passed.stage.robot_path[:, 1:3], passed.teacher_path[:, 1:3]
    gaps = np.hypot(*(learner[:, None] - teacher[None]).transpose(2, 0, 1)).min(axis=1)
    moving = np.hypot(*(learner - learner[0]).T) > 1.0
    assert gaps[moving].max() < 0.35


def test_the_picture_has_both(passed: PassedOn, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[tuple[str, str, int]] = []

    def look(world: World, trajectories: Sequence[Trajectory], *rest: object, **more: object) -> Figure:
        drawn.extend((line.name, line.body, len(line.points)) for line in trajectories)
        return Figure()

    monkeypatch.setattr(pictures, "draw_arena", look)
    pictures.picture_demonstration(passed, learn(passed.demonstration), tmp_path / "relay")
    ticks = len(passed.stage.robot_path)
    assert drawn == [("learner", "robot", ticks), ("teacher", "robot", ticks)]


def test_a_teacher_that_does_not_come_to_the_end_says_what_is_missing(world: World, told: Network) -> None:
    passed = pass_on("relay", told, world, SKILLS, manner=NAIVE, limit_s=5.0)
    assert not passed.finished
    assert passed.complaints == (
        "the teacher did not come to the end of its task; missing: track-light-orange-1, track-light-green-1,"
        " track-pink-1, track-orange-1",
        "DONE was never said",
    )


def test_the_teacher_stands_where_the_person_stood(world: World) -> None:
    prepared = with_robot_teacher(world)
    assert prepared.teacher is None
    assert world.teacher is not None
    assert prepared.robots[1].at == world.teacher.at
    assert prepared.robots[1].marker is TEACHER_COLOR
    assert with_robot_teacher(prepared) == prepared


def test_a_world_in_which_no_robot_can_teach_is_refused(world: World) -> None:
    bare = world.model_copy(update={"teacher": None})
    with pytest.raises(WorldError, match="add `teacher:` with `at:`, or a second robot with `marker: blue`"):
        with_robot_teacher(bare)
