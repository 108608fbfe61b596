"""Campaigns: kept as they come, gone on with after any end, the same trials whoever makes them."""

import logging
import signal
import sqlite3
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import psutil
import pytest
from distributed import LocalCluster

from understudy.errors import CampaignError, MissingExtraError
from understudy.experiments import (
    Alone,
    Campaign,
    DaskWorkers,
    Experiment,
    Made,
    Standing,
    Trial,
    Unit,
    load_experiment,
    make,
    workforce,
)
from understudy.recording import read_recording

from .campaigns import SEEDS, write_tiny


@pytest.fixture(scope="module")
def tiny(tmp_path_factory: pytest.TempPathFactory) -> Experiment:
    return load_experiment(write_tiny(tmp_path_factory.mktemp("tiny")))


@pytest.fixture(scope="module")
def undisturbed(tiny: Experiment, tmp_path_factory: pytest.TempPathFactory) -> list[Trial]:
    with campaign(tiny, tmp_path_factory.mktemp("whole")) as whole:
        whole.go_on(Alone())
        return whole.trials


def campaign(experiment: Experiment, folder: Path, seeds: Sequence[int] = SEEDS) -> Campaign:
    return Campaign(experiment, experiment.document.rows, seeds, folder)


class Fake:
    """Makes trials at no cost; those with a seed in ``failing`` fail."""

    size = 2

    def __init__(self, *failing: int) -> None:
        self.asked: list[tuple[str, int]] = []
        self.failing = failing

    def made(self, units: Sequence[Unit]) -> Iterator[Made]:
        for unit in units:
            self.asked.append((unit.row.name, unit.seed))
            problems = ("it did not",) if unit.seed in self.failing else ()
            recordings = ((f"{unit.stem}-run.mcap", b"all of it"),) if problems else ()
            trial = unit.trial(ending="complete", time_s=1.0, problems=problems)
            yield Made(trial=trial, took_s=float(unit.seed), recordings=recordings)

    def __enter__(self) -> "Fake":
        return self

    def __exit__(self, *error: object) -> None: ...


def test_every_trial_succeeds_and_is_there_once(undisturbed: list[Trial]) -> None:
    assert [trial.problems for trial in undisturbed] == [()] * 12
    assert [(trial.row, trial.seed) for trial in undisturbed] == [
        (row, seed) for row in ("taught", "elsewhere", "both") for seed in SEEDS
    ]
    taught, elsewhere, both = undisturbed[0], undisturbed[4], undisturbed[8]
    assert (taught.ending, elsewhere.ending, both.ending) == ("taught", "complete", "complete")
    assert "track-green-1" in taught.learned
    assert both.order == ("track-green-1",)
    assert len({trial.path[0][1:] for trial in undisturbed[4:8]}) == 4, "every seed has a room of its own"


def test_a_campaign_goes_on_where_it_was_stopped(tiny: Experiment, tmp_path: Path) -> None:
    def stop(standing: Standing) -> None:
        if standing.done == 5:
            raise KeyboardInterrupt

    first, second = Fake(), Fake()
    with campaign(tiny, tmp_path) as begun, pytest.raises(KeyboardInterrupt):
        begun.go_on(first, stop)
    with campaign(tiny, tmp_path) as again:
        assert again.standing(2) == Standing(done=5, total=12, failed=0, left_s=4.5)
        again.go_on(second)
        assert len(again.trials) == 12
    assert len(first.asked) == 5
    assert len(set(first.asked + second.asked)) == len(first.asked + second.asked) == 12


def test_more_trials_and_other_seeds_are_added(tiny: Experiment, tmp_path: Path) -> None:
    force = Fake()
    for seeds in (range(1, 3), range(1, 4), range(7, 8)):
        with campaign(tiny, tmp_path, seeds) as one:
            one.go_on(force)
            assert {trial.seed for trial in one.trials} == set(seeds)
    assert [seed for row, seed in force.asked if row == "both"] == [1, 2, 3, 7]


def test_recordings_of_failed_trials_are_kept(tiny: Experiment, tmp_path: Path) -> None:
    with campaign(tiny, tmp_path) as one:
        one.go_on(Fake(2))
        assert one.standing().failed == 3
        failed = [trial for trial in one.trials if not trial.success]
        assert [one.recordings_of(trial) for trial in failed] == [
            (f"recordings/{row}-seed-2-run.mcap",) for row in ("taught", "elsewhere", "both")
        ]
    assert (tmp_path / "recordings" / "both-seed-2-run.mcap").read_bytes() == b"all of it"


def test_a_failed_trial_is_made_again_with_a_recording(tiny: Experiment, tmp_path: Path) -> None:
    late = replace(tiny, document=tiny.document.model_copy(update={"limit_s": 0.5}))
    made = make(Unit(experiment=late, row=late.row("both"), seed=1))
    assert made.trial.problems == ("time limit; missing track-green-1",)
    assert made.note == ""
    assert [name for name, _ in made.recordings] == ["both-seed-1-demonstration.mcap", "both-seed-1-run.mcap"]
    for name, content in made.recordings:
        (tmp_path / name).write_bytes(content)
        assert read_recording(tmp_path / name).info.metadata["seed"] == "1"
    assert make(Unit(experiment=tiny, row=tiny.row("both"), seed=1)).recordings == ()


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"limit_s": 31.0}, "experiment: limit_s was 30.0, and is 31.0"),
        ({"rows": [{"name": "taught", "kind": "run"}]}, "row taught: kind was 'teach', and is 'run'"),
        ({"world": "visit_targets"}, "experiment: world was 'room.yaml', and is 'visit_targets'"),
    ],
)
def test_trials_of_another_experiment_are_not_mixed_in(
    tiny: Experiment, changes: dict[str, object], told: str, tmp_path: Path
) -> None:
    campaign(tiny, tmp_path).__exit__(None, None, None)
    changed = load_experiment(write_tiny(tmp_path, **changes))
    with pytest.raises(CampaignError) as caught:
        campaign(changed, tmp_path)
    assert told in str(caught.value)
    assert "--fresh" in str(caught.value)


def test_what_is_only_told_may_change_and_rows_may_be_added(tiny: Experiment, tmp_path: Path) -> None:
    campaign(tiny, tmp_path).__exit__(None, None, None)
    rows = [row.model_dump(by_alias=True, exclude_defaults=True) for row in tiny.document.rows]
    rows[0] |= {"goal": 0.9, "dissertation": "5 of 5"}
    more = {"name": "here", "kind": "run", "world": "visit_targets"}
    changed = load_experiment(write_tiny(tmp_path, title="Tiny", rows=[*rows, more]))
    with campaign(changed, tmp_path) as one:
        assert one.standing().total == 16


def test_another_state_of_the_program_is_refused(
    tiny: Experiment, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    campaign(tiny, tmp_path).__exit__(None, None, None)
    monkeypatch.setattr("understudy.experiments.store.fingerprint", lambda: {"understudy": "0.0.1"})
    with pytest.raises(CampaignError, match=r"program: mujoco-core was '.*', and is not given"):
        campaign(tiny, tmp_path)


def test_two_campaigns_on_one_folder_are_refused(tiny: Experiment, tmp_path: Path) -> None:
    refused = pytest.raises(CampaignError, match="database is locked; another campaign has it open")
    with campaign(tiny, tmp_path), refused:
        campaign(tiny, tmp_path)
    with campaign(tiny, tmp_path) as after:
        assert after.standing().done == 0


def test_a_file_that_is_none_of_ours_is_refused(tiny: Experiment, tmp_path: Path) -> None:
    (tmp_path / "trials.db").write_text("no database at all, " * 100, encoding="utf-8")
    with pytest.raises(CampaignError, match="file is not a database; it is none of ours; begin anew with --fresh"):
        campaign(tiny, tmp_path)


def test_a_full_disk_is_said(tiny: Experiment, tmp_path: Path) -> None:
    with campaign(tiny, tmp_path) as one:
        pages = one._store._connection.exec_driver_sql("PRAGMA page_count").scalar()
        one._store._connection.exec_driver_sql(f"PRAGMA max_page_count={pages}")
        trial = Unit(experiment=tiny, row=tiny.row("both"), seed=1).trial(ending="", learned="x" * 99_999)
        with pytest.raises(CampaignError, match="database or disk is full; what was stored until now is kept; make"):
            one._store.add(trial, 1.0)


def test_workers_that_cannot_be_had(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workforce, "_ANSWER_S", 0.5)
    with pytest.raises(CampaignError, match=r"no Dask scheduler answers at tcp://127.0.0.1:1 .*; start one with"):
        DaskWorkers(1, "tcp://127.0.0.1:1").__enter__()
    with pytest.raises(CampaignError, match=r"no Dask scheduler answers at nonsense://a"):
        DaskWorkers(1, "nonsense://a").__enter__()
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'understudy\[campaign\]', or make the trials in this"):
        DaskWorkers(1).__enter__()


def test_a_worker_with_another_program_makes_nothing(tiny: Experiment) -> None:
    unit = Unit(experiment=tiny, row=tiny.row("both"), seed=1)
    with pytest.raises(CampaignError, match=r"another state of the program: source \w+ instead of older; install"):
        workforce._make(unit, workforce.fingerprint() | {"source": "older"})


def scheduler(workers: int) -> LocalCluster:
    """One that runs already, its workers in this process."""
    return LocalCluster(
        n_workers=workers, threads_per_worker=1, processes=False, protocol="tcp://", host="127.0.0.1",
        dashboard_address="127.0.0.1:0", silence_logs=logging.CRITICAL,
    )  # fmt: skip


def test_a_scheduler_without_workers_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workforce, "_ANSWER_S", 0.5)
    with (
        scheduler(0) as cluster,
        pytest.raises(CampaignError, match="has no workers; start some with `dask worker tcp"),
    ):
        DaskWorkers(1, cluster.scheduler_address).__enter__()


def test_any_scheduler_will_do_and_one_that_goes_away_costs_nothing_that_was_made(
    tiny: Experiment, undisturbed: list[Trial], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(workforce, "_ANSWER_S", 5.0)
    with campaign(tiny, tmp_path) as disturbed, scheduler(1) as cluster:
        address = cluster.scheduler_address
        gone = pytest.raises(CampaignError, match="the Dask scheduler is gone; give the same command again to go on")
        with gone, DaskWorkers(1, address) as force:
            disturbed.go_on(force, lambda standing: cluster.close() if standing.done == 2 else None)
        assert 2 <= len(disturbed.trials) < 12
        assert [trial for trial in undisturbed if trial in disturbed.trials] == disturbed.trials


def worker_processes(process: psutil.Process) -> list[psutil.Process]:
    return [child for child in process.children(recursive=True) if "spawn_main" in " ".join(child.cmdline())]


def test_a_worker_that_is_killed_costs_nothing_but_its_running_trial(
    tiny: Experiment, undisturbed: list[Trial], tmp_path: Path
) -> None:
    killed: list[int] = []

    def kill_one(standing: Standing) -> None:
        if standing.done == 2:
            victim = worker_processes(psutil.Process())[0]
            killed.append(victim.pid)
            victim.send_signal(signal.SIGKILL)

    with campaign(tiny, tmp_path) as disturbed, DaskWorkers(2) as force:
        disturbed.go_on(force, kill_one)
        assert disturbed.trials == undisturbed
    assert len(killed) == 1
    with sqlite3.connect(tmp_path / "trials.db") as file:
        assert file.execute("select count(*) from trials").fetchone() == (12,)


PROGRAM = """
import sys
from pathlib import Path
from understudy.experiments import Campaign, DaskWorkers, load_experiment

if __name__ == "__main__":
    tiny = load_experiment(sys.argv[1])
    with Campaign(tiny, tiny.document.rows, range(1, 5), Path(sys.argv[2])) as campaign, DaskWorkers(1) as force:
        campaign.go_on(force, lambda standing: print(standing.done, flush=True))
"""


def test_a_campaign_that_is_killed_is_gone_on_with(tiny: Experiment, undisturbed: list[Trial], tmp_path: Path) -> None:
    (tmp_path / "program.py").write_text(PROGRAM, encoding="utf-8")
    command = [sys.executable, tmp_path / "program.py", write_tiny(tmp_path), tmp_path / "campaign"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True) as process:
        assert process.stdout is not None
        made = next(line for line in process.stdout if int(line) >= 3)
        workers = worker_processes(psutil.Process(process.pid))
        process.kill()
    assert process.returncode == -signal.SIGKILL
    assert workers, "there was a worker"
    psutil.wait_procs(workers)  # they end by themselves, as nobody is there to work for
    with campaign(tiny, tmp_path / "campaign") as again:
        assert int(made) <= len(again.trials) < 12
        again.go_on(Alone())
        assert again.trials == undisturbed
