"""``understudy teach``"""

import json
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from understudy.cli import onboard
from understudy.cli.options import DEFAULT_WORKSPACE, Json, LibraryPlace, Name, Seed, WorkspaceFolder
from understudy.cli.progress import progress
from understudy.cli.tasks import named_task
from understudy.cli.worlds import absent_colors, find_world

if TYPE_CHECKING:
    from understudy.learning import Observer
    from understudy.perception import Percepts
    from understudy.sessions import PassedOn

__all__ = ["command"]


def command(
    world: Annotated[
        str | None, typer.Argument(help="A world document, or a bundled one: transport, visit_targets.")
    ] = None,
    robot: onboard.Robot = None,
    by: Annotated[
        str | None,
        typer.Option("--by", help="A robot that knows this task teaches, and starts where the world's teacher stands."),
    ] = None,
    naive: Annotated[
        bool, typer.Option("--naive", help="With --by: it executes its task as if nobody followed.")
    ] = False,
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
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """The scripted teacher of a world, or you a robot, or one robot another, leads through the task.

    Exit code 1 if DONE was never said, or if a robot did not come to the end of the task that it knows.
    """
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.execution import compile_network  # noqa: PLC0415
    from understudy.sessions import Taught, Workspace, pass_on, teach, with_robot_teacher  # noqa: PLC0415
    from understudy.teaching import CAREFUL, NAIVE  # noqa: PLC0415

    if naive and by is None:
        raise typer.BadParameter("--naive is a way in which a robot teaches; say which task it knows with --by TASK")
    if robot is not None:
        if (world, seed, by) != (None, None, None):
            raise typer.BadParameter("in a world, or with a robot? Name either WORLD or --robot")
        onboard.teach(robot, workspace=workspace, name=name, as_json=as_json)
    if world is None:
        raise typer.BadParameter("in which world, or with which robot? Name WORLD or --robot")
    room, skills, network = find_world(world), installed_skills(), None
    changed = {key: value for key, value in (("like", habits), ("heeds", heeds)) if value is not None}
    if changed:
        if by is not None:
            raise typer.BadParameter("--habits and --heeds are of a person who teaches, and not of a robot")
        room = room.with_habits(**changed)
    if by is not None:
        known = named_task(by, library, workspace)
        network = known.network
        compile_network(network, skills, source=known.source)
        room, name = with_robot_teacher(room), name or known.task.name
        for color in absent_colors(network, room, skills):
            typer.echo(f"Nothing in this world is {color}; the teacher will search for it in vain", err=True)
    place = Workspace(workspace)
    path = place.free(name or room.name, ".mcap").with_suffix(".mcap")
    with progress(f"teaching {name or room.name}") as say:

        def watch(percepts: "Percepts", observer: "Observer") -> None:
            say(percepts.time_s, f"{len(observer.observations)} goals observed")

        taught: Taught | PassedOn
        if network is None:
            taught = teach(room, skills, seed=seed, name=name, recording=path, watch=watch)
        else:
            manner, title = NAIVE if naive else CAREFUL, name or room.name
            taught = pass_on(title, network, room, skills, manner=manner, seed=seed, recording=path, watch=watch)
    span, slips = taught.demonstration.span, taught.slips if isinstance(taught, Taught) else ()
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
            "slips": [str(slip) for slip in slips],
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
    if slips:
        typer.echo("Where the teacher slipped, of which the robot knows nothing:")
        for slip in slips:
            typer.echo(f"  {slip}")
    if not taught.verdict.clean:
        hits = ", ".join(f"{count} × {what}" for what, count in taught.verdict.collisions.items())
        typer.echo(f"  The robot bumped into things: {hits}")
    typer.echo(f"Recorded in {path}")
    typer.echo(f"Next: understudy learn {path}")
    raise typer.Exit(0 if taught.finished else 1)
