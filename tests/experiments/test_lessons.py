"""Lessons by people (§4.5.6): what was meant is learned from the careful teacher; and why it was not, from others."""

from dataclasses import replace

import pytest

from understudy.behaviors import installed_skills
from understudy.experiments import Trial, Unit, find_experiment
from understudy.experiments.lessons import causes_of, causes_table, lesson_trial
from understudy.learning import Instance, Observed, learn
from understudy.network import Component, Interval, Network
from understudy.robot import Cue
from understudy.sessions import Taught, teach
from understudy.sim import Slip

EXPERIMENT = find_experiment("people")
TEXT = ["Drop", "light green", "PickUp orange", "yellow", "pink", "Drop", "light orange", "light green"]
"""§4.5.6; before it the robot's empty gripper, as in §4.5.4.3."""


@pytest.fixture(scope="module")
def taught() -> Taught:
    return teach(EXPERIMENT.place(EXPERIMENT.row("experienced")), installed_skills())


@pytest.fixture(scope="module")
def meant(taught: Taught) -> Network:
    return learn(taught.demonstration).network


def named(component: object) -> str:
    assert isinstance(component, Component)
    color = str(component.parameters.get("color", ""))
    return color if component.behavior == "Track" else f"{component.behavior} {color}".strip()


def with_steps(*components: Component) -> Network:
    return Network(components=components)


def steps(network: Network) -> list[Component]:
    return [part for part in network.components if isinstance(part, Component)]


def seen(color: str, start: float, end: float) -> Observed:
    return Observed(instance=Instance("Track", (("color", color),)), interval=Interval(start, end))


def test_the_careful_teacher_teaches_what_the_text_asks_for(taught: Taught, meant: Network) -> None:
    assert [named(component) for component in meant.components] == TEXT
    assert taught.slips == taught.complaints == ()
    assert taught.verdict.clean
    assert list(causes_of(taught, meant, meant)) == []


def test_without_a_lesson_everything_is_missing(taught: Taught, meant: Network) -> None:
    assert "the box was not picked up" in causes_of(taught, None, meant)


def test_a_forgotten_word_and_one_at_the_wrong_time(taught: Taught, meant: Network) -> None:
    learned = with_steps(*(step for step in steps(meant) if step.id != "track-yellow-1"))
    assert list(causes_of(taught, learned, meant)) == ["HERE came when the target was out of view"]
    forgotten = replace(taught, slips=(Slip(item=8, kind="forgotten", word=Cue.HERE),))
    assert list(causes_of(forgotten, learned, meant)) == ["HERE was forgotten"]
    other = replace(taught, slips=(Slip(item=11, kind="forgotten", word=Cue.HERE),))
    assert list(causes_of(other, learned, meant)) == ["HERE came when the target was out of view"]


def test_a_target_that_was_not_seen(taught: Taught, meant: Network) -> None:
    learned = with_steps(*(step for step in steps(meant) if step.id != "track-light-green-2"))
    watched = replace(taught.demonstration, observations=(seen("light green", 1, 9), seen("light green", 60, 61)))
    unseen = replace(taught, demonstration=watched)
    assert list(causes_of(unseen, learned, meant)) == ["the robot was led where it did not see the target"]
    lost = replace(unseen, remarks=((50.0, "I have lost you"),))
    assert list(causes_of(lost, learned, meant)) == ["the robot lost its teacher, and did not see the target"]


@pytest.mark.parametrize(
    ("color", "cause"),
    [
        ("red", "a distractor was learned"),
        ("blue", "a color was learned that is not there"),
        ("pink", "a visit was learned twice"),
    ],
)
def test_steps_too_many(taught: Taught, meant: Network, color: str, cause: str) -> None:
    surplus = Component(id="surplus", behavior="Track", parameters={"color": color})
    assert list(causes_of(taught, with_steps(*steps(meant), surplus), meant)) == [cause]


def test_another_order(taught: Taught, meant: Network) -> None:
    assert list(causes_of(taught, with_steps(*reversed(steps(meant))), meant)) == [
        "the steps were learned in another order"
    ]


def test_a_trial_is_the_same_again_and_tells_why_it_failed() -> None:
    unit = Unit(experiment=EXPERIMENT, row=EXPERIMENT.row("inexperienced"), seed=1000)
    trial = lesson_trial(unit)
    assert trial.problems[0] == "the box was not picked up"
    assert trial.ending == "taught"
    assert lesson_trial(unit) == trial
    told = causes_table(EXPERIMENT, [trial, replace(trial, row="instructed", problems=("executed: too late",))])
    counts = {cells[0]: cells[1:] for cells in told.rows}
    assert counts["the box was not picked up"] == ("0", "0", "1", "0", "0")
    assert counts["executed"] == ("0", "1", "0", "0", "0")


def test_who_listens_is_helped() -> None:
    """A seed with which an inexperienced teacher says HERE too early, and a distractor is in view."""
    deaf, listening = (
        lesson_trial(Unit(experiment=EXPERIMENT, row=EXPERIMENT.row(row), seed=1002))
        for row in ("inexperienced", "inexperienced, who listens")
    )
    assert "a distractor was learned" in deaf.problems
    assert isinstance(listening, Trial)
    assert listening.problems == ()
    assert listening.details["links"] in ("the reference's", "others")
