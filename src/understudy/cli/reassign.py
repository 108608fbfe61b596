"""``understudy reassign``"""

import json
from pathlib import Path
from typing import Annotated

import typer

from understudy.cli.corrections import say_correction, write_corrected
from understudy.cli.options import DEFAULT_WORKSPACE, Json, WorkspaceFolder

__all__ = ["command"]


def command(
    report: Annotated[Path, typer.Argument(help="The report of a practice run (.json).")],
    meant: Annotated[
        list[str],
        typer.Argument(
            metavar="WORD=STEP…",
            help="Which word was about which step: 1=track-green-1, or 1=2, the step's number as it then was; END for"
            " steps that were shown to come after everything else.",
        ),
    ],
    workspace: WorkspaceFolder = DEFAULT_WORKSPACE,
    as_json: Json = False,
) -> None:
    """Makes the corrections of a practice run again, with words that were about other steps; writes the new task."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415 - help must come at once
    from understudy.documents import read_data, write_new  # noqa: PLC0415
    from understudy.figures import WhyWords  # noqa: PLC0415
    from understudy.network import Task  # noqa: PLC0415
    from understudy.practice import minutes_of, read_minutes, reassigned  # noqa: PLC0415
    from understudy.sessions import Workspace  # noqa: PLC0415

    skills = installed_skills()
    data = read_data(report)
    name, network, corrections = read_minutes(data, source=str(report))
    for one in meant:
        word, _, step = one.partition("=")
        if not (word.isdecimal() and step):
            raise typer.BadParameter(f"{one!r}: write WORD=STEP, as in 1=track-green-1")
        number = int(word)
        task = corrections[number - 1].before if 1 <= number <= len(corrections) else network
        corrections = reassigned(corrections, number, WhyWords(task, skills).path_of(step))
    corrected = corrections[-1].after
    stem = Workspace(workspace).free(f"{name} practice", ".mcap", ".json", ".yaml")
    written = write_corrected(corrected, network, Task.of(name, network), stem)
    record = data | minutes_of(name, network, corrections) | {"corrected": str(written) if written else None}
    write_new(stem.with_suffix(".json"), json.dumps(record, indent=2) + "\n")
    if as_json:
        typer.echo(json.dumps(record))
        return
    for correction in corrections:
        say_correction(correction, skills)
    typer.echo(f"Report in {stem.with_suffix('.json')}")
    typer.echo(f"Corrected task in {written}" if written else "The task is as it was.")
