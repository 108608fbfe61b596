"""``understudy experiment``"""

import json
from typing import Annotated

import typer

from understudy.cli.options import Json

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
    as_json: Json = False,
) -> None:
    """Makes the trials of experiments. Exit code 1 if a goal is missed."""
    from understudy.experiments import Unit, conduct, find_experiment  # noqa: PLC0415
    from understudy.experiments.reports import missed_goals, rows_table  # noqa: PLC0415

    if not names:
        _list_experiments(as_json)
        return
    missed: list[str] = []
    for experiment in [find_experiment(name) for name in names]:
        document = experiment.document
        first = document.seed if seed is None else seed
        rows = [experiment.row(name) for name in row] if row else document.rows
        seeds = range(first, first + (trials or document.trials))
        made = [conduct(Unit(experiment=experiment, row=row, seed=seed)) for row in rows for seed in seeds]
        missed += missed_goals(experiment, made)
        if as_json:
            typer.echo(json.dumps([trial.as_record() for trial in made]))
            continue
        table = rows_table(experiment, made)
        typer.echo("\n".join((f"{table.title}", "", *table.markdown(), "")))
        for trial in made:
            if not trial.success:
                typer.echo(f"- {trial}: {'; '.join(trial.problems)}")
    for line in missed:
        typer.echo(line, err=True)
    raise typer.Exit(1 if missed else 0)


def _list_experiments(as_json: bool) -> None:
    """Which experiments there are, and their rows."""
    from understudy.experiments import experiment_names, find_experiment  # noqa: PLC0415

    documents = [find_experiment(name).document for name in experiment_names()]
    if as_json:
        rows = [{"name": one.name, "title": one.title, "rows": [row.name for row in one.rows]} for one in documents]
        typer.echo(json.dumps(rows))
        return
    for one in documents:
        typer.echo(f"{one.name}: {one.title} ({one.source})")
        for row in one.rows:
            typer.echo(f"  {row.name}")
