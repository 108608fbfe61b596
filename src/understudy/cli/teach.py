"""``understudy teach``"""

import json
from typing import Annotated, Literal

import typer

from understudy.cli import onboard
from understudy.cli.options import DEFAULT_WORKSPACE, Json, Name, Seed, WorkspaceFolder
from understudy.cli.progress import progress
from understudy.cli.worlds import find_world

__all__ = ["command"]


def command(
    world: Annotated[
        str | None, typer.Argument(help="A world document, or a bundled one: transport, visit_targets.")
    ] = None,
    robot: onboard.Robot = None,
    workspace: WorkspaceFolder = DEFAULT_WORKSPACE,
    name: Name = None,
    seed: Seed = None,
    habits: Annotated[
        Literal["experienced", "instructed", "inexperienced"] | None,
        typer.Option(help="How well the teacher teaches, instead of as the world says."),
    ] = None,
    heeds: Annotated[
        float | None,
        typer.Option(min=0.0, max=1.0, help="Share of the robot's remarks that the teacher heeds, instead of none."),
    ] = None,
    as_json: Json = False,
) -> None:
    """The scripted teacher of a world, or you a robot, leads through the task. Exit code 1 if DONE was never said."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.sessions import Workspace, teach  # noqa: PLC0415

    if robot is not None:
        if (world, seed) != (None, None):
            raise typer.BadParameter("in a world, or with a robot? Name either WORLD or --robot")
        onboard.teach(robot, workspace=workspace, name=name, as_json=as_json)
    if world is None:
        raise typer.BadParameter("in which world, or with which robot? Name WORLD or --robot")
    room = find_world(world)
    changed = {key: value for key, value in (("like", habits), ("heeds", heeds)) if value is not None}
    if changed:
        room = room.with_habits(**changed)
    place = Workspace(workspace)
    path = place.free(name or room.name, ".mcap").with_suffix(".mcap")
    with progress(f"teaching {name or room.name}") as say:
        taught = teach(
            room,
            installed_skills(),
            seed=seed,
            name=name,
            recording=path,
            watch=lambda percepts, observer: say(percepts.time_s, f"{len(observer.observations)} goals observed"),
        )
    span = taught.demonstration.span
    if as_json:
        record = {
            "recording": str(path),
            "name": taught.demonstration.name,
            "seed": taught.stage.simulation.seed,
            "duration_s": round(span.duration, 1),
            "observations": len(taught.demonstration.observations),
            "collisions": dict(taught.verdict.collisions),
            "finished": taught.finished,
            "complaints": list(taught.complaints),
            "remarks": [{"time_s": time_s, "what": what} for time_s, what in taught.remarks],
            "slips": [str(slip) for slip in taught.slips],
        }
        typer.echo(json.dumps(record))
        raise typer.Exit(0 if taught.finished else 1)
    count = len(taught.demonstration.observations)
    goals = "1 goal" if count == 1 else f"{count} goals"
    typer.echo(f"A demonstration of {span.duration:.0f} s, in which the robot saw {goals} come true.")
    for note in (*taught.demonstration.notes, *taught.complaints):
        typer.echo(f"  note: {note}")
    if taught.remarks:
        typer.echo("What the robot said:")
        for time_s, what in taught.remarks:
            typer.echo(f"  {time_s:5.1f} s  {what}")
    if taught.slips:
        typer.echo("Where the teacher slipped, of which the robot knows nothing:")
        for slip in taught.slips:
            typer.echo(f"  {slip}")
    if not taught.verdict.clean:
        hits = ", ".join(f"{count} × {what}" for what, count in taught.verdict.collisions.items())
        typer.echo(f"  The robot bumped into things: {hits}")
    typer.echo(f"Recorded in {path}")
    typer.echo(f"Next: understudy learn {path}")
    raise typer.Exit(0 if taught.finished else 1)
