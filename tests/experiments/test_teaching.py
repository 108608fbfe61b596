"""What is learned anew is compared with the reference, and what differs is said."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from understudy.experiments import Experiment, Unit, conduct, executed, load_experiment, reference, teaching
from understudy.network import Component, Link, LinkType, Network
from understudy.sessions import Taught, teach

from .campaigns import write_tiny

GREEN = Component(id="track-green-1", behavior="Track", parameters={"color": "green", "angle_deg": 1.0})
RED = Component(id="track-red-1", behavior="Track", parameters={"color": "red", "angle_deg": 90.0})


@pytest.fixture(scope="module")
def tiny(tmp_path_factory: pytest.TempPathFactory) -> Experiment:
    return load_experiment(write_tiny(tmp_path_factory.mktemp("tiny")))


@pytest.mark.parametrize(
    ("task", "told"),
    [
        (Network((RED,)), "without track-red-1 (ahead); with track-green-1 (left)"),
        (
            Network((GREEN, RED), (Link(source=GREEN.id, target=RED.id, type=LinkType.ENABLING),)),
            "without track-green-1 (right), track-red-1 (ahead), track-green-1 → track-red-1 (enabling);"
            " with track-green-1 (left)",
        ),
    ],
)
def test_what_was_learned_otherwise_is_said(
    tiny: Experiment, task: Network, told: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(teaching, "reference", lambda unit: task)
    trial = conduct(Unit(experiment=tiny, row=tiny.row("taught"), seed=1))
    assert trial.problems == (f"another task was learned: {told}",)
    both = conduct(Unit(experiment=tiny, row=tiny.row("both"), seed=1))
    assert both.problems == (f"taught: another task was learned: {told}",)
    assert both.order == ("track-green-1",), "it is executed all the same"


def test_the_reference_is_taught_in_the_world_as_it_stands(tiny: Experiment, tmp_path: Path) -> None:
    silent = {"script": [{"say": "START"}, {"wait": 3.0}, {"say": "DONE"}]}
    rows = [{"name": "taught", "kind": "teach", "teacher": silent}]
    odd = load_experiment(write_tiny(tmp_path, rows=rows))
    unit = Unit(experiment=odd, row=odd.row("taught"), seed=1)
    assert reference(unit) == reference(Unit(experiment=tiny, row=tiny.row("taught"), seed=1))
    assert conduct(unit).problems == (
        "another task was learned: without track-green-1 (left); with track-green-1 (ahead)",
    )


def test_a_demonstration_without_an_end_is_no_success(tiny: Experiment, monkeypatch: pytest.MonkeyPatch) -> None:
    complaints = ("HERE was said in vain", "DONE was never said")

    def endless(*arguments: Any, **options: Any) -> Taught:
        return replace(teach(*arguments, **options), finished=False, complaints=complaints)

    monkeypatch.setattr(teaching, "teach", endless)
    trial = conduct(Unit(experiment=tiny, row=tiny.row("taught"), seed=1))
    assert (trial.ending, trial.problems) == ("unfinished", ("DONE was never said",))


def test_a_witness_is_shown_the_run(tiny: Experiment) -> None:
    seen = []
    unit = Unit(experiment=tiny, row=tiny.row("elsewhere"), seed=1)
    network = reference(unit)
    executed(replace(unit, witness=lambda what, task: seen.append((what.stage.simulation.seed, task))), network)
    assert seen == [(1, network)]
