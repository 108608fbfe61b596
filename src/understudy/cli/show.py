"""``understudy show``"""

import json
from pathlib import Path
from typing import Annotated

import typer

from understudy.cli.options import Json

__all__ = ["command"]

_Picture = Annotated[
    Path | None, typer.Option("--picture", "-p", help="Write PICTURE.png and PICTURE.svg; nothing is overwritten.")
]


def command(
    source: Annotated[Path, typer.Argument(help="A task document, or a recording (.mcap).")],
    picture: _Picture = None,
    dot: Annotated[bool, typer.Option("--dot", help="Print the task's network as Graphviz DOT.")] = False,
    as_json: Json = False,
) -> None:
    """A task in plain words, as a picture or as DOT; or what a recording holds, and its pictures."""
    if source.suffix.lower() == ".mcap":
        _recording(source, picture, as_json)
    else:
        _task(source, picture, dot, as_json)


def _task(source: Path, picture: Path | None, dot: bool, as_json: bool) -> None:
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.figures import describe_task, to_dot  # noqa: PLC0415
    from understudy.network import load_task  # noqa: PLC0415

    task, network = load_task(source)
    skills = installed_skills()
    if dot:
        typer.echo(to_dot(network, name=task.name), nl=False)
    elif as_json:
        typer.echo(task.model_dump_json(by_alias=True))
    else:
        typer.echo(describe_task(task.name, network, skills))
    if picture is not None:
        from understudy.sessions.pictures import picture_task  # noqa: PLC0415

        _say_written(picture_task(task.name, network, skills, picture), quiet=dot or as_json)


def _recording(source: Path, picture: Path | None, as_json: bool) -> None:
    from understudy.recording import read_recording  # noqa: PLC0415

    recording = read_recording(source)
    info = recording.info
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
        typer.echo(json.dumps(record))
    else:
        whole = "" if info.complete else "; it breaks off, and was read as far as it goes"
        typer.echo(f"{info.name}: a {info.kind} of {info.duration_s:.1f} s{whole}")
        typer.echo("  topics: " + ", ".join(sorted(info.topics)))
        for time_s, word in cues:
            typer.echo(f"  {time_s:6.1f} s  {word}")
    if picture is not None:
        import yaml  # noqa: PLC0415

        from understudy.network import parse_task  # noqa: PLC0415
        from understudy.sessions.pictures import picture_recording  # noqa: PLC0415
        from understudy.sim import World  # noqa: PLC0415

        world = network = None
        if "world.yaml" in info.attachments:
            world = World.from_data(yaml.safe_load(recording.attachment("world.yaml")), source=f"{source}: world.yaml")
        if "task.yaml" in info.attachments:
            _, network = parse_task(yaml.safe_load(recording.attachment("task.yaml")), source=f"{source}: task.yaml")
        _say_written(picture_recording(recording, world, network, picture), quiet=as_json)


def _say_written(files: list[Path], *, quiet: bool) -> None:
    for file in files:
        typer.echo(f"Wrote {file}", err=quiet)
