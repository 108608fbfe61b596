"""``understudy practice``"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from understudy.cli import onboard
from understudy.cli.corrections import say_correction, write_corrected
from understudy.cli.keeping import Ran, edits_of, keeping
from understudy.cli.options import DEFAULT_WORKSPACE, Json, LibraryPlace, Misfits, Seed, WorkspaceFolder
from understudy.cli.progress import progress
from understudy.cli.rules import broken_rules
from understudy.cli.tasks import named_task
from understudy.cli.worlds import find_world

if TYPE_CHECKING:
    from understudy.perception import Percepts
    from understudy.practice import Practice

__all__ = ["command"]


def command(
    task: Annotated[Path, typer.Argument(help="A task document, or a task by its name.")],
    world: Annotated[
        str | None,
        typer.Option("--world", "-w", help="A world whose teacher says BAD, or COME and GO; or a bundled one."),
    ] = None,
    robot: onboard.Robot = None,
    at_once: onboard.AtOnce = False,
    workspace: WorkspaceFolder = DEFAULT_WORKSPACE,
    seed: Seed = None,
    limit: Annotated[float, typer.Option(min=0.1, help="Seconds of simulated time allowed.")] = 600.0,
    misfits: Misfits = None,
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """Executes a task under the teacher's feedback, and writes the corrected one. Exit code 1 if it was not done."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415 - help must come at once
    from understudy.documents import write_new  # noqa: PLC0415
    from understudy.execution import compile_network  # noqa: PLC0415
    from understudy.sessions import Workspace, practise  # noqa: PLC0415

    named = named_task(task, library, workspace)
    document, network = named.task, named.network
    skills = installed_skills()
    compile_network(network, skills, source=named.source)
    if robot is not None:
        if world is not None:
            raise typer.BadParameter("in a world, or with a robot? Give either --world or --robot")
        onboard.practise(
            robot,
            document,
            network,
            workspace=workspace,
            seed=seed,
            limit_s=limit,
            at_once=at_once,
            as_json=as_json,
        )
    if world is None:
        raise typer.BadParameter("in which world, or with which robot? Name one with --world or --robot")
    room = find_world(world)
    place = Workspace(workspace)
    stem = place.free(f"{document.name} practice", ".mcap", ".json", ".yaml")
    keep = keeping(named, None, library, workspace)
    latest: list[Practice] = []

    def watch(percepts: "Percepts", practice: "Practice") -> None:
        latest[:] = [practice]
        say(percepts.time_s, f"{len(practice.corrections)} corrections")

    with progress(f"practising {document.name}", limit) as say:
        try:
            practised = practise(
                document.name,
                network,
                room,
                skills,
                seed=seed,
                limit_s=limit,
                recording=stem.with_suffix(".mcap"),
                watch=watch,
            )
        except BaseException:
            # What the teacher has said until now must not be lost, whatever stopped the robot.
            if latest and (saved := write_corrected(latest[0].network, network, document, stem)) is not None:
                typer.echo(f"Corrected task so far in {saved}", err=True)
                edits = edits_of(latest[0].corrections, document)
                keep.edit(edits, misfits=bool(misfits), quiet=True).say(err=True)
            raise
    report = practised.report
    corrected = write_corrected(report.network, network, document, stem)
    record = practised.as_record() | {"corrected": str(corrected) if corrected is not None else None}
    write_new(stem.with_suffix(".json"), json.dumps(record, indent=2) + "\n")
    if not as_json:
        for correction in report.corrections:
            say_correction(correction, skills)
        for complaint in practised.complaints:
            typer.echo(f"  The teacher: {complaint}")
    ended = f"{'Done' if report.done else f'Not done ({report.ending})'} after {report.duration_s:.1f} s."
    ran = Ran(kind="practice", recording=stem.with_suffix(".mcap"), name=document.name, done=report.done, outcome=ended)
    kept = keep.edit(edits_of(report.corrections, document), run=ran, misfits=misfits, quiet=as_json)
    if as_json:
        typer.echo(json.dumps(record | kept.as_record()))
    else:
        typer.echo(ended)
        if not practised.verdict.clean:
            hits = ", ".join(f"{count} × {what}" for what, count in practised.verdict.collisions.items())
            typer.echo(f"The robot bumped into things: {hits}")
        typer.echo(f"Recorded in {practised.recording}, report in {stem.with_suffix('.json')}")
        typer.echo(f"Corrected task in {corrected}" if corrected is not None else "The task is as it was.")
        kept.say()
        for problem in broken_rules(report.network):
            typer.echo(f"It is not run as it is: {problem}. Practise it again, or mend the document", err=True)
    raise typer.Exit(0 if report.done else 1)
