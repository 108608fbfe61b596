"""``understudy experiment``"""

import json
import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from understudy.cli.options import DEFAULT_WORKSPACE, Json, WorkspaceFolder
from understudy.cli.progress import progress
from understudy.errors import MissingExtraError

if TYPE_CHECKING:
    from understudy.experiments import Experiment, Row, Standing, Unit

__all__ = ["command"]


def command(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME]...", help="Experiments, or files of experiments. None: which there are."),
    ] = None,
    trials: Annotated[int | None, typer.Option(min=1, help="In each row; as the document says if left out.")] = None,
    seed: Annotated[
        int | None, typer.Option(min=0, help="Of the first trial in each row; the next ones count up.")
    ] = None,
    row: Annotated[list[str] | None, typer.Option(help="Only this row; can be given several times.")] = None,
    workers: Annotated[
        int | None,
        typer.Option(
            min=0, help="Local processes, one trial each at a time; as many as cores if left out. 0: this one."
        ),
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(help="The address of a Dask scheduler, whose workers make the trials.")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Put aside what was made until now, and begin anew.")] = False,
    workspace: WorkspaceFolder = DEFAULT_WORKSPACE,
    as_json: Json = False,
) -> None:
    """Makes the trials of experiments, keeps them, and writes a report. The same command again goes on.

    One row with --trials 1 is one trial alone: made at once, recorded, and not kept. Exit code 1 if a goal is missed.
    """
    from understudy.experiments import Unit, find_experiment  # noqa: PLC0415

    if not names:
        _list(as_json)
        return
    if workers is not None and scheduler is not None:
        raise typer.BadParameter("--workers are local processes, and --scheduler has its own; give one of them")
    good = True
    for experiment in [find_experiment(name) for name in names]:
        document = experiment.document
        rows = [experiment.row(name) for name in row] if row else document.rows
        first, count = document.seed if seed is None else seed, trials or document.trials
        if row and len(rows) == count == 1:
            good &= _alone(Unit(experiment=experiment, row=rows[0], seed=first), workspace, as_json)
        else:
            folder = _folder(experiment, workspace, fresh)
            seeds = range(first, first + count)
            good &= _campaign(experiment, rows, seeds, folder, workers, scheduler, as_json)
    raise typer.Exit(0 if good else 1)


def _campaign(
    experiment: "Experiment",
    rows: "Sequence[Row]",
    seeds: range,
    folder: Path,
    workers: int | None,
    scheduler: str | None,
    as_json: bool,
) -> bool:
    """Makes what is left of a campaign, and tells what came out; True if no goal is missed."""
    from understudy.experiments import Alone, Campaign, DaskWorkers  # noqa: PLC0415
    from understudy.experiments.reports import report_of, write_markdown, write_page  # noqa: PLC0415

    with Campaign(experiment, rows, seeds, folder) as campaign:
        if campaign.left:
            force = Alone() if workers == 0 else DaskWorkers(workers or os.cpu_count() or 1, scheduler)
            total = campaign.standing().total
            with progress(f"{experiment.name}: starting", total, unit="trials") as say, force:

                def tell(standing: "Standing") -> None:
                    say(standing.done, _standing_in_words(standing))

                tell(campaign.standing(force.size))
                try:
                    campaign.go_on(force, tell)
                except KeyboardInterrupt:
                    made = campaign.standing().done
                    typer.echo(f"{made} of {total} trials are kept; give the same command again to go on", err=True)
                    raise
        with progress(f"{experiment.name}: writing the report"):
            report = report_of(campaign)
            pages = [write_markdown(report, folder)]
            try:
                pages.append(write_page(report, folder))
            except MissingExtraError as error:
                typer.echo(error, err=True)
        trials, missed = campaign.trials, report.missed
        for note in campaign.notes:
            typer.echo(note, err=True)
    if as_json:
        record = {
            "experiment": experiment.name,
            "trials": [trial.as_record() for trial in trials],
            "missed": missed,
            "report": list(map(str, pages)),
        }
        typer.echo(json.dumps(record))
        return not missed
    typer.echo("\n".join((report.rows.title, "", *report.rows.markdown(), "")))
    for trial in trials:
        if not trial.success:
            typer.echo(f"- {trial}: {'; '.join(trial.problems)}")
    for line in missed:
        typer.echo(f"Below its goal: {line}")
    for page in pages:
        typer.echo(f"Wrote {page}")
    return not missed


def _alone(unit: "Unit", workspace: Path, as_json: bool) -> bool:
    """Makes one trial with a recording; True if it succeeds."""
    from understudy.experiments import conduct  # noqa: PLC0415
    from understudy.sessions import Workspace  # noqa: PLC0415

    place = Workspace(workspace).free(f"{unit.experiment.name} {unit.stem}", "")
    place.mkdir()
    with progress(f"{unit.experiment.name}: {unit.row.name}, seed {unit.seed}"):
        trial = conduct(replace(unit, folder=place))
    files = [str(file) for file in sorted(place.glob("*.mcap"))]
    if as_json:
        typer.echo(json.dumps(trial.as_record() | {"recordings": files}))
        return trial.success
    typer.echo(f"{trial}: {'success' if trial.success else 'failure'}; {trial.ending} after {trial.time_s:.0f} s")
    for problem in trial.problems:
        typer.echo(f"  {problem}")
    for file in files:
        typer.echo(f"Recorded in {file}")
    return trial.success


def _folder(experiment: "Experiment", workspace: Path, fresh: bool) -> Path:
    """The folder of a campaign; with ``fresh``, what is there gets another name."""
    from understudy.sessions import Workspace, file_stem  # noqa: PLC0415

    place = Workspace(workspace)
    folder = place.folder / f"{file_stem(experiment.name)}-campaign"
    if fresh and folder.exists():
        aside = place.free(f"{experiment.name} campaign before", "")
        folder.rename(aside)
        typer.echo(f"What was made until now is in {aside}", err=True)
    return folder


def _standing_in_words(standing: "Standing") -> str:
    """``2 failed, about 3 min left``"""
    failed = f"{standing.failed} failed, " if standing.failed else ""
    if standing.left_s is None:
        return failed.removesuffix(", ")
    if standing.left_s < 90:
        return f"{failed}about {standing.left_s:.0f} s left"
    return f"{failed}about {standing.left_s / 60:.0f} min left"


def _list(as_json: bool) -> None:
    """Which experiments there are, and their rows."""
    from understudy.experiments import experiment_names, find_experiment  # noqa: PLC0415

    documents = [find_experiment(name).document for name in experiment_names()]
    if as_json:
        found = [{"name": one.name, "title": one.title, "rows": [row.name for row in one.rows]} for one in documents]
        typer.echo(json.dumps(found))
        return
    for one in documents:
        source = f" ({one.source})" if one.source else ""
        typer.echo(f"{one.name}: {one.title}{source}")
        for row in one.rows:
            typer.echo(f"  {row.name}")
