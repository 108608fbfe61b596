"""Planned tasks: a row of them is planned and executed; without a planner it is said what is missing."""

import sys

import pytest

from understudy.errors import MissingExtraError
from understudy.experiments import Unit, conduct, find_experiment, planned


def test_the_goal_of_the_row_is_planned_and_executed_in_the_row_s_room(monkeypatch: pytest.MonkeyPatch) -> None:
    experiment = find_experiment("planned")
    row = experiment.document.rows[-1]
    unit = Unit(experiment=experiment, row=row, seed=1)
    made = []
    monkeypatch.setattr(planned, "executed", lambda unit, network: made.append((unit.room.name, network)))
    planned.planned_trial(unit)
    [(room, network)] = made
    assert room == "hierarchical"
    assert sorted(part.behavior for part in network.components) == ["Drop", "Drop", "PickUp", "Track", "Track"]


def test_without_a_planner_nothing_is_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    experiment = find_experiment("planned")
    monkeypatch.setitem(sys.modules, "up_pyperplan", None)
    planned._planned.cache_clear()
    with pytest.raises(MissingExtraError, match="planning needs up_pyperplan, which is not installed; pip install"):
        conduct(Unit(experiment=experiment, row=experiment.document.rows[0], seed=1))
