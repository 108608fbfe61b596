"""``understudy demo``"""

from pathlib import Path
from typing import Annotated

import typer

from understudy.cli.options import Seed
from understudy.cli.progress import progress
from understudy.cli.worlds import find_world

__all__ = ["command"]

_CHANGED_ROOM = 3
"""The seed by which the demo's changed room is drawn; any other one does as well: ``--changed-room``."""


def command(
    world: Annotated[str, typer.Argument(help="A world with a scripted teacher.")] = "transport",
    workspace: Annotated[Path, typer.Option("--workspace", "-o", help="The folder to be made.")] = Path("demo-output"),
    seed: Seed = None,
    changed_room: Annotated[int, typer.Option(min=0, help="The seed by which the room is rearranged.")] = _CHANGED_ROOM,
) -> None:
    """Teaches a task once, shows what was learned, and lets the robot do it, in the same room and in another one."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.figures import describe_lesson, describe_task  # noqa: PLC0415
    from understudy.learning import learn  # noqa: PLC0415
    from understudy.network import Task, save_task  # noqa: PLC0415
    from understudy.sessions import Workspace, perform, recorded_demonstration, teach  # noqa: PLC0415
    from understudy.sessions.pictures import picture_demonstration, picture_run, picture_task  # noqa: PLC0415
    from understudy.sim import rearranged  # noqa: PLC0415

    room = find_world(world)
    number, target = 1, workspace
    while target.exists():
        number, target = number + 1, workspace.with_name(f"{workspace.name}-{number + 1}")
    folder = Workspace(target).folder
    skills = installed_skills()
    written: list[Path] = []

    typer.echo("1. A teacher leads the robot through the task, once.")
    recording = folder / "1-demonstration.mcap"
    with progress("   teaching") as say:
        taught = teach(
            room,
            skills,
            seed=seed,
            recording=recording,
            watch=lambda percepts, observer: say(percepts.time_s, f"{len(observer.observations)} goals observed"),
        )
    span = taught.demonstration.span
    typer.echo(f"   {span.duration:.0f} s, from START to DONE; everything the robot sensed is recorded.\n")

    typer.echo("2. The robot learns from the recording.\n")
    lesson = learn(recorded_demonstration(recording, skills))
    name = lesson.demonstration
    typer.echo(describe_task(name, lesson.network, skills))
    typer.echo(describe_lesson(lesson, skills) + "\n")
    task = folder / "2-task.yaml"
    save_task(task, Task.of(name, lesson.network, note=f"learned from {recording.name}"))
    written += [recording, task]
    with progress("   drawing") as say:
        say(0, "")
        written += picture_demonstration(taught, lesson, folder / "1-demonstration")
        written += picture_task(name, lesson.network, skills, folder / "2-network")

    done = True
    places = (("same", room, "the same room"), ("changed", rearranged(room, changed_room), "a rearranged room"))
    for number, (label, place, words) in enumerate(places, start=3):
        typer.echo(f"{number}. The robot does it on its own, in {words}.")
        stem = folder / f"{number}-{label}-room"
        with progress("   running", 300.0) as say:
            performed = perform(
                name,
                lesson.network,
                place,
                skills,
                seed=seed,
                recording=stem.with_suffix(".mcap"),
                watch=lambda percepts, decision: say(percepts.time_s, ""),
            )
        done = done and performed.report.done and performed.verdict.clean
        outcome = "Done" if performed.report.done else "NOT done"
        bumps = (
            "without a collision" if performed.verdict.clean else f"collisions: {dict(performed.verdict.collisions)}"
        )
        typer.echo(f"   {outcome} after {performed.report.duration_s:.0f} s, {bumps}.\n")
        written += [stem.with_suffix(".mcap"), *picture_run(performed, lesson.network, stem)]

    typer.echo(f"In {folder}:")
    for file in written:
        if file.suffix != ".svg":  # each picture is there as PNG and as SVG
            typer.echo(f"  {file.name}")
    raise typer.Exit(0 if done else 1)
