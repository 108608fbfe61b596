"""``understudy show``"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from understudy.cli.options import Json, LibraryPlace
from understudy.cli.rules import broken_rules
from understudy.cli.tasks import named_task

if TYPE_CHECKING:
    from understudy.recording import Outcome

__all__ = ["command"]

_WRITTEN = (".png", ".svg")
_NOT_WRITTEN = (".bmp", ".eps", ".gif", ".jpeg", ".jpg", ".pdf", ".ps", ".tif", ".tiff", ".webp")

_Picture = Annotated[
    Path | None,
    typer.Option(
        "--picture",
        "-p",
        help="Of a task, write PICTURE.png and PICTURE.svg; of a recording, PICTURE-room and PICTURE-progress, each as"
        " .png and .svg. Nothing is overwritten.",
    ),
]


def command(
    source: Annotated[
        Path, typer.Argument(help="A task document, a bundled task, a task of the library, or a recording (.mcap).")
    ],
    picture: _Picture = None,
    depth: Annotated[
        int | None,
        typer.Option(
            min=0, help="How many networks in each other a task's picture shows from inside; all if left out."
        ),
    ] = None,
    dot: Annotated[bool, typer.Option("--dot", help="Print the task's network as Graphviz DOT.")] = False,
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """A task in plain words, as a picture or as DOT; or what a recording holds, and its pictures."""
    recorded = source.suffix.lower() == ".mcap"
    if dot and as_json:
        raise typer.BadParameter("--dot and --json both say what is printed; give one of them")
    if dot and recorded:
        raise typer.BadParameter("--dot prints the network of a task, and this is a recording; name a task document")
    if depth is not None and (recorded or picture is None):
        raise typer.BadParameter("--depth says how a task's picture is drawn; name a task, and give --picture")
    stem = None if picture is None else _stem(picture)
    if recorded:
        _recording(source, stem, as_json)
    else:
        _task(source, stem, depth, library, dot, as_json)


def _stem(picture: Path) -> Path:
    """What people write for a picture, without the suffix that both of its files get."""
    if not picture.name:
        raise typer.BadParameter("a picture needs a name; give for example --picture network", param_hint="'--picture'")
    suffix = picture.suffix.lower()
    if suffix in _NOT_WRITTEN:
        raise typer.BadParameter(
            f"{picture}: pictures are written as PNG and SVG, not as {suffix[1:].upper()}; name it {picture.stem}",
            param_hint="'--picture'",
        )
    return picture.with_suffix("") if suffix in _WRITTEN else picture


def _task(source: Path, picture: Path | None, depth: int | None, library: str | None, dot: bool, as_json: bool) -> None:
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.errors import UnderstudyError  # noqa: PLC0415
    from understudy.execution import compile_network  # noqa: PLC0415
    from understudy.figures import describe_task, to_dot  # noqa: PLC0415

    named = named_task(source, library)
    task, network = named.task, named.network
    skills = installed_skills()
    if dot:
        typer.echo(to_dot(network, name=task.name, skills=skills), nl=False)
    elif as_json:
        typer.echo(task.model_dump_json(by_alias=True))
    else:
        typer.echo(describe_task(task.name, network, skills))
        try:
            compile_network(network, skills, source=str(source))
        except UnderstudyError as error:
            # Labels that are no skills can be shown all the same.
            typer.echo(f"It cannot be run as it is: {error}", err=True)
        for problem in broken_rules(network):
            typer.echo(f"This is not run as it is: {problem}.", err=True)
    if picture is not None:
        from understudy.sessions.pictures import picture_task  # noqa: PLC0415

        _say_written(picture_task(task.name, network, skills, picture, depth=depth), quiet=dot or as_json)


def _recording(source: Path, picture: Path | None, as_json: bool) -> None:
    from understudy.execution import Event, Tally  # noqa: PLC0415
    from understudy.recording import outcome_of, read_recording  # noqa: PLC0415
    from understudy.sessions.recorded import task_of, world_of  # noqa: PLC0415

    recording = read_recording(source)
    info = recording.info
    outcome = missing = None
    attached = task_of(recording)
    network = attached[1] if attached else None
    if info.kind == "run":
        outcome = outcome_of(recording)
        if network is not None:
            missing = Tally(network, map(Event.from_record, recording.events())).missing
    cues = [(time_s, cue.value) for time_s, cue in recording.cues()]
    if as_json:
        record = {
            "kind": info.kind,
            "name": info.name,
            "duration_s": info.duration_s,
            "complete": info.complete,
            "metadata": dict(info.metadata),
            "topics": sorted(info.topics),
            "cues": cues,
        }
        if outcome is not None:
            record |= {
                "done": outcome.done,
                "reason": outcome.reason or None,
                "achieved": [{"component": id_, "time_s": time_s} for id_, time_s in outcome.achieved],
                "missing": missing,
            }
        typer.echo(json.dumps(record))
    else:
        whole = "" if info.complete else "; it breaks off, and was read as far as it goes"
        typer.echo(f"{info.name}: a {info.kind} of {info.duration_s:.1f} s{whole}")
        if outcome is not None:
            _say_outcome(outcome, missing)
        typer.echo("  topics: " + ", ".join(sorted(info.topics)))
        for time_s, word in cues:
            typer.echo(f"  {time_s:6.1f} s  {word}")
    if picture is not None:
        from understudy.sessions.pictures import picture_recording  # noqa: PLC0415

        world = world_of(recording)
        if world is None and network is None:
            typer.echo("No picture: neither a world nor a task is attached to the recording", err=True)
        _say_written(picture_recording(recording, world, network, picture), quiet=as_json)


def _say_outcome(outcome: "Outcome", missing: "tuple[str, ...] | None") -> None:
    words = str(outcome)
    typer.echo(f"  {words[0].upper()}{words[1:]}")
    for id_, time_s in outcome.achieved:
        typer.echo(f"  {time_s:6.1f} s  {id_}")
    if missing:
        typer.echo(f"  not achieved: {', '.join(missing)}")


def _say_written(files: list[Path], *, quiet: bool) -> None:
    for file in files:
        typer.echo(f"Wrote {file}", err=quiet)
