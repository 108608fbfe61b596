"""``understudy run``"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from understudy.cli.options import DEFAULT_WORKSPACE, Json, Seed, WorkspaceFolder
from understudy.cli.progress import progress
from understudy.cli.tasks import find_task
from understudy.cli.worlds import find_world

if TYPE_CHECKING:
    from understudy.execution import Decision
    from understudy.perception import Percepts

__all__ = ["command"]


def command(
    task: Annotated[Path, typer.Argument(help="A task document, or a bundled task by its name.")],
    world: Annotated[str, typer.Option("--world", "-w", help="A world document, or a bundled one.")],
    workspace: WorkspaceFolder = DEFAULT_WORKSPACE,
    seed: Seed = None,
    rearrange: Annotated[
        int | None,
        typer.Option(
            min=0,
            help="Change the room first: everything gets another place, drawn by this seed (which is the run's, too).",
        ),
    ] = None,
    limit: Annotated[float, typer.Option(min=0.1, help="Seconds of simulated time allowed.")] = 300.0,
    as_json: Json = False,
) -> None:
    """Executes a task. Exit code 0 if it was done, 1 if not."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.documents import write_new  # noqa: PLC0415
    from understudy.execution import Tally, compile_network  # noqa: PLC0415
    from understudy.figures import goal_in_words, numbers_of  # noqa: PLC0415
    from understudy.network import load_task  # noqa: PLC0415
    from understudy.sessions import Workspace, perform  # noqa: PLC0415
    from understudy.sim import rearranged  # noqa: PLC0415

    task = find_task(task)
    document, network = load_task(task)
    skills = installed_skills()
    compile_network(network, skills, source=str(task))  # what does not fit is refused with the file's name
    room = find_world(world)
    if rearrange is not None:
        room = rearranged(room, rearrange)
    place = Workspace(workspace)
    stem = place.free(f"{document.name} run", ".mcap", ".json")
    tally = Tally(network)
    with progress(f"running {document.name}", limit) as say:

        def watch(percepts: "Percepts", decision: "Decision") -> None:
            for event in decision.events:
                tally.add(event)
            say(percepts.time_s, str(tally))

        performed = perform(
            document.name,
            network,
            room,
            skills,
            seed=seed,
            limit_s=limit,
            recording=stem.with_suffix(".mcap"),
            watch=watch,
        )
    record = performed.as_record() | {"rearranged": rearrange}
    report = stem.with_suffix(".json")
    write_new(report, json.dumps(record, indent=2) + "\n")
    if as_json:
        typer.echo(json.dumps(record))
    else:
        numbers = numbers_of(network)
        for path, time_s in performed.report.achieved:
            number = "" if network.flat else f"{numbers[path]}. "
            typer.echo(f"  achieved at {time_s:6.1f} s: {number}{goal_in_words(network.by_path[path], skills)}")
        if performed.report.done:
            typer.echo(f"Done after {performed.report.duration_s:.1f} s.")
        else:
            left = f"missing: {', '.join(tally.missing)}" if tally.missing else "the last step was still being finished"
            stopped_by = performed.report.stopped_by
            why = f"{stopped_by} ran out of time" if stopped_by else f"time limit of {limit:g} s"
            typer.echo(f"Not done: {why}; {left}")
        if not performed.verdict.clean:
            hits = ", ".join(f"{count} × {what}" for what, count in performed.verdict.collisions.items())
            typer.echo(f"The robot bumped into things: {hits}")
        typer.echo(f"Recorded in {performed.recording}, report in {report}")
    raise typer.Exit(0 if performed.report.done else 1)
