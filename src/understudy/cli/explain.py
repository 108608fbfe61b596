"""``understudy explain``"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from understudy.cli.options import Json
from understudy.cli.progress import progress

if TYPE_CHECKING:
    from understudy.figures import WhyWords
    from understudy.recording import Recording

__all__ = ["command"]


def command(
    run: Annotated[Path, typer.Argument(help="The recording of a run (.mcap).")],
    at: Annotated[
        float | None,
        typer.Option("--at", "-t", help="The moment, in seconds on the robot's clock; the end if left out."),
    ] = None,
    component: Annotated[
        str | None,
        typer.Option("--component", "-c", help="A step, by its path or number; one line for every step if left out."),
    ] = None,
    what_if: Annotated[
        str | None,
        typer.Option(
            "--what-if",
            help='Run again from that moment with one link changed: "2 -> 3: ordering" (or enabling, permanent, none),'
            " steps by their paths or numbers. Needs a run in a simulated room.",
        ),
    ] = None,
    as_json: Json = False,
) -> None:
    """Why a step was active or not: what decided it, since when, by what event, and what would have to change."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415 - help must come at once
    from understudy.errors import RecordingError  # noqa: PLC0415
    from understudy.execution import Event, History, explain  # noqa: PLC0415
    from understudy.figures import WhyWords  # noqa: PLC0415
    from understudy.recording import read_recording  # noqa: PLC0415
    from understudy.sessions import task_of  # noqa: PLC0415

    recording = read_recording(run)
    attached = task_of(recording)
    if attached is None:
        raise RecordingError(
            f"{run} is the recording of a {recording.info.kind}; name one that understudy run has made"
        )
    network = attached[1]
    history = History(network, map(Event.from_record, recording.events()))
    words = WhyWords(network, installed_skills())
    if what_if is not None:
        if at is None or component is not None:
            raise typer.BadParameter("--what-if asks about one link from one moment on: give --at, and no --component")
        _what_if(recording, at, what_if, words, as_json)
        return
    end_s = history.end_s
    if at is None:
        at = end_s
    elif at > end_s:
        typer.echo(f"The last thing that happened was at {end_s:.1f} s, and so it has stayed", err=True)
    if history.suspended(at):
        typer.echo("At that moment the run was suspended: the teacher was showing something (COME … GO)", err=True)
    paths = list(network.by_path) if component is None else [words.path_of(component)]
    found = [explain(history, path, at) for path in paths]
    if as_json:
        records = [one.as_record() for one in found]
        typer.echo(json.dumps(records if component is None else records[0]))
    elif component is None:
        typer.echo(f"At {at:.1f} s:")
        typer.echo(words.overview(found))
    else:
        typer.echo(words.story(found[0]))


def _what_if(recording: "Recording", at: float, asked: str, words: "WhyWords", as_json: bool) -> None:
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.network import LinkType  # noqa: PLC0415
    from understudy.sessions import limit_of, what_if  # noqa: PLC0415

    link, _, type_ = (part.strip() for part in asked.rpartition(":"))
    source, arrow, target = (part.strip() for part in link.partition("->"))
    types = {kind.value: kind for kind in LinkType} | {"none": None}
    if not arrow or type_ not in types:
        raise typer.BadParameter(
            f'{asked!r} names no link and type; write for example "2 -> 3: ordering" (or enabling, permanent, none)',
            param_hint="'--what-if'",
        )
    source, target = words.path_of(source), words.path_of(target)
    with progress("running again", limit_of(recording)) as say:
        found = what_if(
            recording,
            at,
            source,
            target,
            types[type_],
            installed_skills(),
            watch=lambda percepts, decision: say(percepts.time_s, ""),
        )
    if as_json:
        typer.echo(json.dumps(found.as_record()))
        return
    instead = f"{type_} instead of {found.was.value}" if found.instead is not None else "left out"
    typer.echo(f"Had the link from {words.step(source)} to {words.step(target)} been {instead} from {at:.1f} s on:")
    report = found.performed.report
    if found.first is None:
        until = min(report.duration_s, found.ended_s)
        typer.echo(f"  Nothing would have been different up to {until:.1f} s.")
    else:
        typer.echo(f"  At {found.first.time_s:.1f} s the runs part:")
        typer.echo(words.parting(found.first.states))
    would = "would have been done" if report.done else f"would not have been done ({report.ending})"
    was = "was done" if found.done else f"was not done ({found.reason})"
    typer.echo(f"  The task {would} after {report.duration_s:.1f} s; it {was} after {found.ended_s:.1f} s.")
    if found.performed.verdict.collisions:
        hits = ", ".join(f"{count} x {what}" for what, count in found.performed.verdict.collisions.items())
        typer.echo(f"  The robot would have bumped into things: {hits}.")
    typer.echo("  Run again in the same simulated room, with the same chance.")
