"""The practice runs of §6.3, and the two mistakes of §6.1 that look alike: corrected, then executed as corrected."""

from functools import cache
from itertools import pairwise

import pytest

from understudy.behaviors import installed_skills
from understudy.experiments.document import Learning
from understudy.experiments.generalization import course, ways
from understudy.experiments.judging import problems_of
from understudy.network import END, Component, Link, LinkType, Network, load_task, task_path
from understudy.robot import Cue
from understudy.sessions import Practised, perform, practise
from understudy.sim import World, load_world, rearranged, world_path

SKILLS = installed_skills()


@cache
def practised(name: str) -> Practised:
    """A bundled task practised in the bundled world of its name."""
    return practise(name, load_task(task_path(name))[1], load_world(world_path(name)), SKILLS)


def done(run: Practised, *, seed: int, changed: bool = False) -> list[str]:
    """The steps of the next run, in their order, once it is certain that all of it went well."""
    network, world = run.report.network, run.stage.world
    next_ = perform(run.task, network, rearranged(world, seed) if changed else world, SKILLS, seed=seed)
    assert not problems_of(next_, network)
    return [path for path, _ in next_.report.achieved]


def test_the_tasks_are_what_the_demonstrations_teach() -> None:
    rooms = [load_world(world_path(f"generalize_{number}")) for number in (1, 2, 3)]
    first, _, third = course(rooms, Learning(heed_cues=False)).tasks
    assert ways(load_task(task_path("practice_demonstrated"))[1]) == ways(first)
    assert ways(load_task(task_path("practice_generalized"))[1]) == ways(third)


@pytest.mark.parametrize("changed", [False, True])
def test_a_missing_step_after_three_demonstrations(changed: bool) -> None:
    """§6.3.3: light orange between the drop and light green; the direct way that led past it is closed (§5.2)."""
    run = practised("practice_generalized")
    (come,) = run.report.corrections
    assert (come.word, come.meant[0].component, come.note) == (Cue.COME, "track-light-green-1", "")
    assert run.verdict.clean
    first, *steps = done(run, seed=21, changed=changed)[1:]
    assert first in ("track-green-1", "track-light-green-2")
    assert steps == [
        "pick-up-orange-1", "track-yellow-1", "track-red-1", "track-pink-1", "drop-2", "track-light-orange-2",
        "track-light-green-1",
    ]  # fmt: skip


@pytest.mark.parametrize("changed", [False, True])
def test_three_mistakes_after_one_demonstration(changed: bool) -> None:
    """§6.3.4: green becomes light green, light orange and the last green are none of the task's; all in one run."""
    run = practised("practice_demonstrated")
    assert [(one.word.value, one.meant[0].component, one.note) for one in run.report.corrections] == [
        ("BAD", "track-green-1", ""),
        ("COME", "pick-up-orange-1", ""),
        ("BAD", "track-light-orange-1", ""),
        ("BAD", "track-green-2", ""),
    ]
    assert run.verdict.clean
    assert done(run, seed=22, changed=changed)[1:] == [
        "track-light-green-2", "pick-up-orange-1", "track-yellow-1", "track-red-1", "track-pink-1", "drop-2",
        "track-light-green-1",
    ]  # fmt: skip


def room(*script: object) -> World:
    return World.from_data(
        {
            "understudy": "world/1",
            "name": "three targets",
            "seed": 5,
            "arena": {"size": [7.0, 4.0]},
            "targets": [
                {"color": "green", "at": [1.0, 0.5]},
                {"color": "red", "at": [6.4, 0.6]},
                {"color": "pink", "at": [3.0, 3.5]},
            ],
            "robots": [{"name": "learner", "at": [0.6, 1.5], "heading_deg": 0}],
            "teacher": {"at": [4.6, 2.4], "script": list(script)},
        }
    )


def visits(*colors: str) -> Network:
    ids = [f"{color}-{colors[: index + 1].count(color)}" for index, color in enumerate(colors)]
    steps = [
        Component(id=id_, behavior="Track", parameters={"color": color}) for id_, color in zip(ids, colors, strict=True)
    ]
    links = (Link(source=a, target=b, type=LinkType.ORDERING) for a, b in pairwise(ids))
    return Network(tuple(steps), tuple(links))


def colors_of(network: Network) -> list[object]:
    steps = (network.by_path[id_] for id_ in network.topological_order)
    return [step.parameters["color"] for step in steps if isinstance(step, Component)]


MEANT = ["green", "pink", "red", "green"]


def test_a_step_that_comes_twice_and_once_too_often() -> None:
    """Seen until red, this run and the next one are alike (§6.1); the teacher knows from a first run which it is."""
    bad = {"word": "BAD", "when_robot_within": 0.9, "of": [6.4, 0.6], "delay": 1.5, "timeout": 60}
    run = practise("twice", visits("green", "red", "pink", "red", "green"), room({"say": bad}), SKILLS)
    assert [one.meant[0].component for one in run.report.corrections] == ["red-1"]
    assert colors_of(run.report.network) == MEANT
    done(run, seed=31)


def test_a_step_that_is_missing_before_one_that_comes_too_early() -> None:
    run = practise(
        "missing",
        visits("green", "red", "green"),
        room(
            {"say": {"word": "COME", "when_robot_within": 1.8, "of": [6.4, 0.6], "timeout": 60}},
            {"wait": 3.0},
            {"walk": [4.0, 2.8]},
            {"walk": {"to": [2.2, 2.7], "say": {"word": "HERE", "when_robot_within": 1.3, "of": [3.0, 3.5]}}},
            {"wait": 2.0},
            {"say": "GO"},
            {"step_aside": [2.0, 3.5]},
        ),
        SKILLS,
    )
    assert [(one.meant[0].component, one.note) for one in run.report.corrections] == [("red-1", "")]
    assert colors_of(run.report.network) == MEANT
    done(run, seed=32)


def test_what_is_missing_at_the_very_end_is_shown_when_all_is_done() -> None:
    """Within ten seconds a word is about the last step, after that about the end."""
    script = [
        {"say": {"word": "COME", "when_robot_within": 1.0, "of": [1.0, 0.5], "delay": 15.0, "timeout": 60}},
        {"wait": 3.0},
        {"walk": [2.2, 2.6]},
        {"walk": {"to": [3.8, 2.8], "say": {"word": "HERE", "when_robot_within": 1.3, "of": [3.0, 3.5]}}},
        {"wait": 2.0},
        {"say": "GO"},
    ]
    run = practise("the end", visits("green"), room(*script), SKILLS)
    (come,) = run.report.corrections
    assert (come.meant[0].component, come.note) == (END, "")
    assert come.time_s > run.report.duration_s + 10.0
    assert colors_of(run.report.network) == ["green", "pink"]
    done(run, seed=33)
