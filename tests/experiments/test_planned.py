"""The experiment with planned tasks: what is run, what is told, and that it is left out where there is no planner."""

import sys

import pytest

from understudy.experiments import Trial, planned_tables, planned_trials
from understudy.experiments.__main__ import main


def test_each_goal_is_run_in_both_rooms(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[tuple[str, str, str]] = []
    monkeypatch.setattr(
        "understudy.experiments.planned.run_trials",
        lambda goal, world, network, room, seeds: asked.append((goal, world.name, room)) or iter(()),
    )
    assert list(planned_trials([1])) == []
    assert ("carried(orange, green) and visited(pink)", "hierarchical", "changed") in asked
    assert [room for _, _, room in asked] == ["same"] * 3 + ["changed"] * 3


def test_each_goal_is_told_for_itself() -> None:
    def trial(goal: str, seed: int, *problems: str) -> Trial:
        return Trial(
            experiment=goal, room="same", seed=seed, time_s=10.0 * seed, problems=problems, collisions=0, grazes=0
        )

    lines = list(planned_tables([trial("near(red)", 1), trial("near(red)", 3, "late"), trial("near(pink)", 2)]))
    assert lines[2:] == [
        "| `near(red)` | same | 1 of 2 | 20 s | 30 s |",
        "| `near(pink)` | same | 1 of 1 | 20 s | 20 s |",
    ]


def test_without_a_planner_the_other_experiments_are_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "up_pyperplan", None)
    monkeypatch.setattr("sys.argv", ["experiments", "planned", "--trials", "1"])
    main()
    told = capsys.readouterr().out
    assert "planned was left out: planning needs up_pyperplan, which is not installed; pip install" in told
    assert "Failures: none" in told
