"""A run is judged by the truth, not by what the robot says of it; the counting is exact."""

from dataclasses import replace

import numpy as np
import pytest

from understudy.execution import RunReport
from understudy.experiments import Trial, problems_of, summarise
from understudy.network import Component, Link, LinkType, Network
from understudy.sessions import Performed, Stage, Verdict
from understudy.sim import World

WORLD = World.from_data(
    {
        "understudy": "world/1",
        "name": "w",
        "seed": 0,
        "arena": {"size": [4.0, 4.0]},
        "targets": [{"color": "green", "at": [2.0, 1.0]}],
        "boxes": [{"color": "orange", "at": [2.0, 1.8]}],
        "robots": [{"name": "learner", "at": [1.2, 1.0]}],
    }
)
VISIT = Network(
    (
        Component(id="fetch", behavior="PickUp", parameters={"color": "orange"}),
        Component(id="visit", behavior="Track", parameters={"color": "green", "distance_m": 0.7}),
        Component(id="drop", behavior="Drop"),
    ),
    (Link(source="visit", target="drop", type=LinkType.ORDERING),),
)


def performed(**changes: object) -> Performed:
    stage = Stage(WORLD)
    report = RunReport(
        done=True,
        ending="complete",
        duration_s=1.0,
        achieved=(("fetch", 0.0), ("visit", 0.0), ("drop", 0.0)),
        events=(),
    )
    whole = Performed(task="t", report=report, recording=None, stage=stage, verdict=stage.verdict())
    return replace(whole, **changes)  # type: ignore[arg-type]


def asking(**parameters: float) -> Network:
    fetch, visit, drop = VISIT.components
    return Network((fetch, replace(visit, parameters={"color": "green", **parameters}), drop), VISIT.links)


def test_a_true_report_passes() -> None:
    assert problems_of(performed(), VISIT) == []


def test_a_visit_that_was_none_is_found() -> None:
    assert problems_of(performed(), asking(distance_m=1.6)) == ["visit: 0.90 m from where it should have been"]


def test_a_target_on_the_wrong_side_is_found() -> None:
    assert problems_of(performed(), asking(distance_m=0.7, angle_deg=180.0)) == ["visit: 90° off"]


def test_steps_in_the_wrong_order_are_found() -> None:
    report = replace(performed().report, achieved=(("fetch", 0.0), ("drop", 0.0), ("visit", 0.1)))
    assert problems_of(performed(report=report), VISIT)[0] == "drop was achieved before visit"


def test_another_box_does_not_do() -> None:
    other = Network((replace(VISIT.components[0], parameters={"color": "pink"}), *VISIT.components[1:]), VISIT.links)
    assert problems_of(performed(), other) == ["the pink box lies inf m from where it was to be brought"]


def test_a_box_left_elsewhere_is_found() -> None:
    run = performed()
    run.stage.simulation.move_box(0, (3.5, 3.5))
    lost = replace(run, verdict=run.stage.verdict())
    assert problems_of(lost, VISIT) == ["the orange box lies 2.92 m from where it was to be brought"]


def test_steps_that_are_missing_and_collisions_are_named() -> None:
    report = RunReport(done=False, ending="time limit", duration_s=300.0, achieved=(("visit", 0.0),), events=())
    verdict = Verdict(collisions={"wall": 2}, grazes={"target": 1}, boxes=())
    assert problems_of(performed(report=report, verdict=verdict), VISIT) == [
        "time limit; missing fetch, drop",
        "ran into a wall (2 ×)",
    ]


def trial(success: bool) -> Trial:
    problems = () if success else ("x",)
    return Trial(experiment="e", row="same", seed=0, ending="complete", time_s=10.0, problems=problems)


def test_the_interval_is_exact() -> None:
    """17 of 20, as in Table 4.2: Clopper and Pearson give 62.1 % to 96.8 %."""
    found = summarise([trial(success) for success in [True] * 17 + [False] * 3])
    assert (found.trials, found.successes) == (20, 17)
    assert (found.low, found.high) == (pytest.approx(0.621, abs=1e-3), pytest.approx(0.968, abs=1e-3))
    assert summarise([trial(True)] * 20).high == 1.0
    assert np.isclose(summarise([trial(True)] * 20).low, 0.025 ** (1 / 20))
