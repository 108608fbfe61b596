"""``understudy explain``"""

import json
from pathlib import Path
from typing import Annotated

import typer

from understudy.cli.options import Json

__all__ = ["command"]


def command(
    run: Annotated[Path, typer.Argument(help="The recording of a run (.mcap).")],
    at: Annotated[
        float | None,
        typer.Option("--at", "-t", help="The moment, in seconds on the robot's clock; the end if left out."),
    ] = None,
    component: Annotated[
        str | None,
        typer.Option(
            "--component", "-c", help="A step, by its path or its number; one line for every step if left out."
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
    end_s = history.end_s
    if at is None:
        at = end_s
    elif at > end_s:
        typer.echo(f"The last thing that happened was at {end_s:.1f} s, and so it has stayed", err=True)
    words = WhyWords(network, installed_skills())
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
