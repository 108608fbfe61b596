"""§5.4.3 from end to end: three demonstrations, followed and observed; the task, executed; how a run is judged."""

from dataclasses import replace

import pytest

from understudy.behaviors import installed_skills
from understudy.experiments import TABLES, Course, Trial, course, find_experiment, generalization, problems_of
from understudy.network import END, START, Component, Edge, Network
from understudy.sessions import perform
from understudy.sim import load_world, rearranged, world_path

from .test_judging import performed

TEXT = [
    "Drop", "Green or Light Green", "PickUp orange", "Yellow", "Red", "Pink", "Drop", "Light Green",
]  # fmt: skip
"""What the text says that was learned; before it the robot's empty gripper, as in §4.5.4.3 and §6.3.3."""


EXPERIMENT = find_experiment("generalization")


@pytest.fixture(scope="module")
def shown() -> Course:
    worlds = [EXPERIMENT.worlds[f"generalize_{number}"] for number in (1, 2, 3)]
    return course(worlds, EXPERIMENT.document.learning)


def named(network: Network, id_: str) -> str:
    component = network.by_id[id_]
    assert isinstance(component, Component)
    color = str(component.parameters.get("color", ""))
    return color.title() if component.behavior == "Track" else f"{component.behavior} {color}".strip()


def executed(network: Network) -> list[str]:
    """The task as the text tells it: what is done, step by step."""
    steps, next_ = [], network.topology.candidates[START]
    while next_ != (END,):
        steps.append(" or ".join(named(network, id_) for id_ in next_))
        (after,) = {network.topology.candidates[id_] for id_ in next_}
        next_ = after
    return steps


def test_the_task_after_each_demonstration(shown: Course) -> None:
    assert not shown.problems
    first, second, third = shown.tasks
    assert executed(first) == [
        "Drop", "Green", "PickUp orange", "Yellow", "Red", "Light Orange", "Pink", "Drop", "Light Green", "Green",
    ]  # fmt: skip
    assert executed(second) == executed(third) == TEXT
    bypassed = [named(third, id_) for id_ in third.topology.bypassed]
    assert sorted(bypassed) == ["Green", "Light Orange", "Light Orange", "Light Orange"]
    shown = {id_: third.topology.shown_by[id_] for id_ in third.topology.bypassed}
    assert sorted(shown.values()) == [("generalize 1",)] * 2 + [("generalize 2",), ("generalize 3",)]


def test_the_generalised_task_is_done_in_a_new_room(shown: Course) -> None:
    task = shown.tasks[-1]
    run = perform("t", task, rearranged(load_world(world_path("generalize_1")), 5), installed_skills(), seed=5)
    assert problems_of(run, task) == []
    assert [named(task, id_) for id_, _ in run.report.achieved][2:] == TEXT[2:]


def test_the_ways_after_each_demonstration_are_told(shown: Course, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(generalization, "_reference", lambda worlds, learning: shown.tasks)
    trial = Trial(
        experiment="generalization", row="changed", seed=1, ending="complete",
        achieved=(("drop-1", 1.0), ("track-green-1", 2.0)),
    )  # fmt: skip
    trials = [trial, replace(trial, row="taught", achieved=())]
    told = {name: TABLES[name](EXPERIMENT, trials).rows for name in EXPERIMENT.document.tables}
    assert ("2", "track-red-1", "track-pink-1", "generalize 2") in told["ways"]
    assert ("3", "track-red-1", "track-pink-1", "generalize 2, generalize 3") in told["ways"]
    assert told["orders"] == (("changed", "drop-1, track-green-1", "1"),)


def test_a_run_that_strays_from_the_ways_is_found() -> None:
    ids = ("fetch", "visit", "drop")
    paths = tuple(Edge(source=a, target=b) for a, b in ((START, "fetch"), ("fetch", "visit"), ("fetch", "drop"),
                  ("visit", "drop"), ("drop", END)))  # fmt: skip
    behaviors = ("PickUp", "Track", "Drop")
    parameters = ({"color": "orange"}, {"color": "green", "distance_m": 0.7}, {})
    task = Network(
        tuple(Component(id=i, behavior=b, parameters=p) for i, b, p in zip(ids, behaviors, parameters, strict=True)),
        paths=paths,
    )
    report = performed().report
    direct = replace(report, achieved=(("fetch", 0.0), ("drop", 0.0)))
    assert not [one for one in problems_of(performed(report=direct), task) if "way" in one]
    assert problems_of(performed(), task)[0] == "visit was achieved after fetch, which is no way through the task"
    late = replace(report, done=False, ending="time limit", achieved=(("fetch", 0.0),))
    assert problems_of(performed(report=late), task) == ["time limit; missing drop"]
