"""All that a report says, before it is put into a form."""

import shlex
from dataclasses import dataclass

from understudy.experiments.campaign import Campaign
from understudy.experiments.experiment import Experiment
from understudy.experiments.fingerprint import fingerprint
from understudy.experiments.reports.pictures import Picture, pictures_of
from understudy.experiments.reports.rows import missed_goals, rows_table
from understudy.experiments.summary import Table
from understudy.experiments.tables import TABLES
from understudy.experiments.trial import Trial

__all__ = ["Failure", "Report", "report_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Failure:
    """A trial that failed.

    Attributes:
        trial: which.
        problems: what was wrong.
        recordings: of it, beside the report.
        again: the command that makes it again.
    """

    trial: str
    problems: tuple[str, ...]
    recordings: tuple[str, ...]
    again: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Report:
    """A campaign as it stands.

    Attributes:
        experiment: what was tried.
        standing: how many trials there are, with which seeds.
        rows: the table.
        missed: the rows below their goals, in words.
        failures: every trial that failed.
        tables: what else there is to tell.
        pictures: of all rows.
        program: what the trials were made by.
    """

    experiment: Experiment
    standing: str
    rows: Table
    missed: tuple[str, ...]
    failures: tuple[Failure, ...]
    tables: tuple[Table, ...]
    pictures: tuple[Picture, ...]
    program: str


def report_of(campaign: Campaign) -> Report:
    """The report of the trials that are made; there is at least one."""
    experiment, trials, standing = campaign.experiment, campaign.trials, campaign.standing()
    whole = (
        f"{standing.done} trials" if standing.done == standing.total else f"{standing.done} of {standing.total} trials"
    )
    simulated_min = sum(trial.time_s for trial in trials) / 60
    seeds = (
        f"seeds {campaign.seeds[0]} to {campaign.seeds[-1]}" if len(campaign.seeds) > 1 else f"seed {campaign.seeds[0]}"
    )
    tables = (TABLES[name](experiment, trials) for name in experiment.document.tables)
    failed = [trial for trial in trials if not trial.success]
    return Report(
        experiment=experiment,
        standing=f"{whole}, with {seeds} in each row; {simulated_min:.0f} minutes of simulated time",
        rows=rows_table(experiment, trials),
        missed=tuple(missed_goals(experiment, trials)),
        failures=tuple(
            Failure(
                trial=str(trial),
                problems=trial.problems,
                recordings=campaign.recordings_of(trial),
                again=_again(experiment, trial),
            )
            for trial in failed
        ),
        tables=tuple(table for table in tables if table.rows),
        pictures=tuple(pictures_of(campaign)),
        program=", ".join(f"{what} {which}" for what, which in fingerprint().items()),
    )


def _again(experiment: Experiment, trial: Trial) -> str:
    name, row = shlex.quote(experiment.called), shlex.quote(trial.row)
    return f"understudy experiment {name} --row {row} --seed {trial.seed} --trials 1"
