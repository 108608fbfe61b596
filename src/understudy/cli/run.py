"""``understudy run``"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from understudy.cli import onboard
from understudy.cli.keeping import Ran, keeping
from understudy.cli.options import DEFAULT_WORKSPACE, Json, LibraryPlace, Seed, WorkspaceFolder
from understudy.cli.progress import progress
from understudy.cli.rules import broken_rules
from understudy.cli.tasks import named_task
from understudy.cli.worlds import absent_colors, find_world
from understudy.errors import NetworkError

if TYPE_CHECKING:
    from understudy.execution import Decision, Tally
    from understudy.perception import Percepts
    from understudy.sessions import Performed

__all__ = ["command"]


def command(
    task: Annotated[
        Path, typer.Argument(help="A task document, or a task by its name; fetch@3 is its third revision.")
    ],
    world: Annotated[str | None, typer.Option("--world", "-w", help="A world document, or a bundled one.")] = None,
    robot: onboard.Robot = None,
    at_once: onboard.AtOnce = False,
    workspace: WorkspaceFolder = DEFAULT_WORKSPACE,
    seed: Seed = None,
    rearrange: Annotated[
        int | None,
        typer.Option(
            min=0,
            help="Change the room first: everything gets another place, drawn by this seed (which is the run's, too).",
        ),
    ] = None,
    limit: Annotated[
        float, typer.Option(min=0.1, help="Seconds of simulated time allowed, from the beginning of the run.")
    ] = 300.0,
    pause_at: Annotated[
        float | None, typer.Option("--pause-at", min=0.0, help="Put the run aside after so many seconds.")
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(
            "--resume",
            help="Go on with a run that was put aside (its .context.json), or with one that broke off (its .mcap), in"
            " the room that it was in.",
        ),
    ] = None,
    unchecked: Annotated[
        bool, typer.Option("--unchecked", help="Run it even if it can break a rule (understudy language TASK --check).")
    ] = False,
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """Executes a task. Exit code 0 if it was done, 1 if not, or not yet."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.documents import write_new  # noqa: PLC0415
    from understudy.execution import Tally, compile_network  # noqa: PLC0415
    from understudy.figures import goal_in_words, numbers_of  # noqa: PLC0415
    from understudy.sessions import Workspace, perform, take_up  # noqa: PLC0415
    from understudy.sim import rearranged  # noqa: PLC0415

    named = named_task(task, library, workspace)
    document, network = named.task, named.network
    again = task if named.kept is None else named.source  # the task's name may stand for another revision then
    skills = installed_skills()
    compile_network(network, skills, source=named.source)  # what does not fit is refused with the file's name
    broken = [] if unchecked or resume is not None else broken_rules(network)
    if broken:
        raise NetworkError(f"{broken[0]}. Mend it, or run it as it is with --unchecked", source=named.source)
    if robot is not None:
        if (world, rearrange, pause_at, resume) != (None, None, None, None):
            raise typer.BadParameter("--world, --rearrange, --pause-at and --resume are for simulated rooms")
        onboard.perform(
            robot,
            document.name,
            network,
            workspace=workspace,
            seed=seed,
            limit_s=limit,
            at_once=at_once,
            as_json=as_json,
        )
    past = None
    if resume is not None:
        if (world, rearrange, seed) != (None, None, None):
            raise typer.BadParameter(
                "--resume goes on in the room that the run was in, and with its seed; give neither"
            )
        past = take_up(resume, network, skills)
        room, seed = past.world, past.seed
    elif world is None:
        raise typer.BadParameter(
            "in which world? Name one with --world, or a robot with --robot; or go on with a run by --resume"
        )
    else:
        room = find_world(world)
        if rearrange is not None:
            room = rearranged(room, rearrange)
    for color in absent_colors(network, room, skills):
        typer.echo(f"Nothing in this world is {color}; the robot will search for it in vain", err=True)
    keep = keeping(named, None, library, workspace)
    place = Workspace(workspace)
    stem = place.free(f"{document.name} run", ".mcap", ".json", ".context.json")
    recording = stem.with_suffix(".mcap")
    moments: list[float] = []
    tally = Tally(network, past.events if past is not None else ())
    with progress(f"running {document.name}", limit) as say:

        def watch(percepts: "Percepts", decision: "Decision") -> None:
            for event in decision.events:
                tally.add(event)
            moments[:] = [percepts.time_s]
            say(percepts.time_s, str(tally))

        try:
            performed = perform(
                document.name,
                network,
                room,
                skills,
                seed=seed,
                limit_s=limit,
                recording=recording,
                pause_at_s=pause_at,
                past=past,
                watch=watch,
            )
        except KeyboardInterrupt:
            # Before its first tick there is nothing to go on with but what it was to go on from.
            if (broken_off := recording if moments else resume) is not None:
                typer.echo(f"Go on with: understudy run {again} --resume {broken_off}", err=True)
            raise
    aside = None
    if performed.paused is not None:
        aside = stem.with_suffix(".context.json")
        performed.paused.save(aside)
    record = performed.as_record() | {"rearranged": rearrange, "paused": str(aside) if aside is not None else None}
    report = stem.with_suffix(".json")
    write_new(report, json.dumps(record, indent=2) + "\n")
    if not as_json:
        numbers = numbers_of(network)
        for path, time_s in performed.report.achieved:
            number = "" if network.flat else f"{numbers[path]}. "
            typer.echo(f"  achieved at {time_s:6.1f} s: {number}{goal_in_words(network.by_path[path], skills)}")
        typer.echo(_ending(performed, tally, limit, aside))
        if not performed.verdict.clean:
            hits = ", ".join(f"{count} × {what}" for what, count in performed.verdict.collisions.items())
            typer.echo(f"The robot bumped into things: {hits}")
        typer.echo(f"Recorded in {performed.recording}, report in {report}")
    ran = Ran(
        kind="run",
        recording=recording,
        name=document.name,
        achieved=tuple(path for path, _ in performed.report.achieved),
        done=performed.report.done,
        outcome=_ending(performed, tally, limit, aside),
    )
    kept = keep.run(ran)
    if as_json:
        typer.echo(json.dumps(record | kept.as_record()))
    else:
        kept.say()
        if not performed.report.done and aside is None:
            typer.echo(f"Why? understudy explain {performed.recording}")
        if aside is not None:
            typer.echo(f"Go on with: understudy run {again} --resume {aside}")
    raise typer.Exit(0 if performed.report.done else 1)


def _ending(performed: "Performed", tally: "Tally", limit_s: float, aside: Path | None) -> str:
    """How the run ended, in one line."""
    report = performed.report
    if report.done:
        return f"Done after {report.duration_s:.1f} s."
    left = f"missing: {', '.join(tally.missing)}" if tally.missing else "the last step was still being finished"
    if aside is not None:
        return f"Put aside after {report.duration_s:.1f} s; {left}"
    why = f"{report.stopped_by} ran out of time" if report.stopped_by else f"time limit of {limit_s:g} s"
    return f"Not done: {why}; {left}"
