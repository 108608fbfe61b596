"""``understudy experiment`` as a user meets it."""

import json
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from understudy.cli import main
from understudy.experiments import Alone, Unit, load_experiment, make

from ..experiments.campaigns import write_tiny

Command = Callable[..., tuple[int, str, str]]


@pytest.fixture
def experiment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Command:
    """Runs the command in a folder with an experiment; returns exit code, stdout and stderr."""
    write_tiny(tmp_path)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("understudy.experiments.reports.contents.pictures_of", lambda campaign: ())  # they take long

    def run(*arguments: object) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["understudy", "experiment", *map(str, arguments)])
        with pytest.raises(SystemExit) as caught:
            main()
        told = capsys.readouterr()
        return int(caught.value.code or 0), told.out, told.err

    return run


def test_without_a_name_it_lists_the_experiments(experiment: Command) -> None:
    code, out, _ = experiment()
    assert code == 0
    assert "visit_targets: Six targets in a given order (§4.5.4.1)\n  taught\n  same\n  changed\n" in out
    named = json.loads(experiment("--json")[1])
    assert {
        "name": "visit_targets",
        "title": "Six targets in a given order",
        "rows": ["taught", "same", "changed"],
    } in named


def test_a_campaign_and_the_same_command_again(
    experiment: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, out, err = experiment("tiny.yaml", "--trials", 2, "--workers", 0, "--row", "elsewhere", "--row", "taught")
    assert (code, err) == (0, "")
    assert "| taught | 2 of 2 | 16% to 100% |  | 50% |" in out
    assert out.splitlines()[-1] == "Wrote understudy-out/tiny-campaign/report.html"
    made = {path.name for path in (tmp_path / "understudy-out" / "tiny-campaign").iterdir()}
    assert made == {"trials.db", "report.md", "report.html"}
    monkeypatch.setattr(Alone, "made", lambda self, units: pytest.fail(f"made again: {units}"))
    again = experiment("tiny.yaml", "--trials", 2, "--workers", 0, "--row", "elsewhere", "--row", "taught")
    assert again == (0, out, "")


def test_a_goal_that_is_missed_exits_with_1(experiment: Command, tmp_path: Path) -> None:
    rows = [{"name": "late", "kind": "run", "goal": 0.5}]
    write_tiny(tmp_path, rows=rows, limit_s=0.5)
    code, out, _ = experiment("tiny.yaml", "--trials", 1, "--workers", 0)
    assert code == 1
    assert "- tiny, late, seed 1: time limit; missing track-green-1" in out
    assert "Below its goal: late: 0 of 1, and the goal is 50%" in out
    assert (tmp_path / "understudy-out/tiny-campaign/recordings/late-seed-1-run.mcap").exists()
    assert experiment("tiny.yaml", "--trials", 1, "--workers", 0, "--json")[0] == 1


def test_one_trial_alone_is_what_it_is_in_a_campaign(experiment: Command, tmp_path: Path) -> None:
    code, out, _ = experiment("tiny.yaml", "--row", "both", "--seed", 3, "--trials", 1, "--json")
    assert code == 0
    record = json.loads(out)
    recordings = record.pop("recordings")
    tiny = load_experiment(tmp_path / "tiny.yaml")
    same = make(Unit(experiment=tiny, row=tiny.row("both"), seed=3)).trial
    assert record == json.loads(json.dumps(same.as_record()))
    assert recordings == [
        f"understudy-out/tiny-both-seed-3/both-seed-3-{what}.mcap" for what in ("demonstration", "run")
    ]
    _, out, _ = experiment("tiny.yaml", "--row", "both", "--seed", 3, "--trials", 1)
    assert "tiny, both, seed 3: success; complete after " in out
    assert "Recorded in understudy-out/tiny-both-seed-3-2/" in out


def test_ctrl_c_keeps_what_was_made(experiment: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Unit] = []

    def stopped(unit: Unit) -> object:
        if len(made) == 2:
            raise KeyboardInterrupt
        made.append(unit)
        return make(unit)

    monkeypatch.setattr("understudy.experiments.workforce.make", stopped)
    code, _, err = experiment("tiny.yaml", "--trials", 2, "--workers", 0)
    assert code == 130
    assert err.startswith("2 of 6 trials are kept; give the same command again to go on\n")
    monkeypatch.setattr("understudy.experiments.workforce.make", make)
    code, out, _ = experiment("tiny.yaml", "--trials", 2, "--workers", 0)
    assert (code, out.count("2 of 2")) == (0, 3)


def test_another_experiment_is_refused_until_it_is_begun_anew(experiment: Command, tmp_path: Path) -> None:
    command: Sequence[object] = ("tiny.yaml", "--trials", 2, "--workers", 0, "--row", "taught")
    experiment(*command)
    write_tiny(tmp_path, learning={"min_duration_s": 1.5})
    code, _, err = experiment(*command)
    assert code == 2
    assert "trials of another experiment or program: experiment: learning was not given, and is {'min_durat" in err
    code, _, err = experiment(*command, "--fresh")
    assert (code, err) == (0, "What was made until now is in understudy-out/tiny-campaign-before\n")
    assert (tmp_path / "understudy-out" / "tiny-campaign-before" / "trials.db").exists()


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("tea",), "tea: there is no such file, and no such experiment among: clutter, delivery, "),
        (("tiny.yaml", "--row", "x"), "tiny: there is no row 'x'; choose one of: taught, elsewhere, both"),
        (("tiny.yaml", "--workers", "2", "--scheduler", "tcp://a:1"), "give one of them"),
        (("tiny.yaml", "--trials", "0"), "Invalid value for '--trials'"),
    ],
)
def test_what_is_wrong_is_said(experiment: Command, arguments: tuple[str, ...], told: str) -> None:
    code, _, err = experiment(*arguments)
    assert code == 2
    assert told in err
