"""``understudy tasks export`` and ``import``."""

import json
import zipfile
from pathlib import Path
from typing import Annotated

import typer

from understudy.cli.keeping import Kept, keeping
from understudy.cli.options import DEFAULT_WORKSPACE, Json, LibraryPlace, Misfits
from understudy.cli.replaying import decide, replayed, say_replayed
from understudy.cli.tasks import named_task, open_library, place_of
from understudy.errors import LibraryError

__all__ = ["export", "import_"]


def export(
    task: Annotated[str, typer.Argument(help="A task of the library.")],
    file: Annotated[Path, typer.Argument(help="The archive to be written, a ZIP. Nothing is overwritten.")],
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """Writes a task with its revisions, demonstrations and runs into one file."""
    from understudy.library import exists, export_task  # noqa: PLC0415 - help must come at once

    place = place_of(library)
    if not exists(place):
        raise LibraryError(f"there is no library in {place} yet, so there is nothing to export")
    export_task(open_library(place), task, file)
    if as_json:
        typer.echo(json.dumps({"task": task, "archive": str(file)}))
    else:
        typer.echo(f"Wrote {file}. To take it in elsewhere: understudy tasks import {file}")


def import_(
    file: Annotated[str, typer.Argument(help="An archive, a task document, or a bundled task by its name.")],
    name: Annotated[str | None, typer.Option("--name", help="What the task shall be called here.")] = None,
    misfits: Misfits = None,
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """Adds an archive, or a task document, to the library. What is there already is recognised; nothing is replaced."""
    kept = (
        _archive(Path(file), name, misfits, library, as_json)
        if zipfile.is_zipfile(file) or file.lower().endswith(".zip")
        else _document(file, name, misfits, library, as_json)
    )
    if as_json:
        typer.echo(json.dumps(kept.as_record()))
    elif not kept.revisions and not kept.sittings:
        typer.echo("All of it is in the library already.")
    else:
        kept.say()


def _document(file: str, name: str | None, misfits: bool | None, library: str | None, quiet: bool) -> Kept:
    """A task that somebody wrote, or edited by hand."""
    named = named_task(file, library)
    keep = keeping(None, name or named.task.name, library, DEFAULT_WORKSPACE)
    return keep.edit(keep.outset(named), misfits=misfits, quiet=quiet)


def _archive(path: Path, name: str | None, misfits: bool | None, library: str | None, quiet: bool) -> Kept:
    from understudy.library import Archive, network_of  # noqa: PLC0415
    from understudy.network import task_names  # noqa: PLC0415

    archive = Archive.read(path)
    opened = open_library(place_of(library))
    names = opened.names()
    target, number = name or archive.task, 1
    while (target in names and not archive.known(opened.history(target))) or target in task_names():
        if name is not None:
            raise LibraryError(f"{name} is another task; give this one a name of its own with --name")
        number += 1
        target = f"{archive.task}-{number}"
    if target not in names:
        revisions, sittings = archive.add_to(opened, target, accepted=True)
        return Kept(revisions=revisions, sittings=sittings)
    if archive.head.number in archive.known(opened.history(target)):
        revisions, sittings = archive.add_to(opened, target, accepted=False)
        return Kept(revisions=revisions, sittings=sittings)
    found = replayed(opened, target, network_of(archive.head)[1], opened.revision(target))
    say_replayed(found, err=quiet)
    revisions, sittings = archive.add_to(opened, target, accepted=decide(found, target, misfits))
    return Kept(revisions=revisions, sittings=sittings, regression=found)
