"""``understudy tasks``: the library looked at, compared, taken back."""

import json
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from understudy.cli import archives
from understudy.cli.options import Json, LibraryPlace
from understudy.cli.replaying import replayed, say_replayed
from understudy.cli.tasks import open_library, place_of
from understudy.errors import LibraryError

if TYPE_CHECKING:
    from understudy.library import Library, Revision

__all__ = ["commands"]

commands = typer.Typer(rich_markup_mode=None, invoke_without_command=True)
"""The commands below ``understudy tasks``."""


@commands.callback()
def _main(context: typer.Context) -> None:
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


class SittingName(StrEnum):
    """What there are recordings of."""

    DEMONSTRATION = "demonstration"
    RUN = "run"
    PRACTICE = "practice"


_Task = Annotated[str, typer.Argument(help="A task of the library.")]


@commands.command("list")
def list_tasks(library: LibraryPlace = None, as_json: Json = False) -> None:
    """All tasks of the library."""
    from understudy.library import exists  # noqa: PLC0415 - help must come at once

    place = place_of(library)
    entries = open_library(place).tasks() if exists(place) else ()
    if as_json:
        rows = [
            {
                "task": one.name,
                "head": one.head,
                "revisions": one.revisions,
                "demonstrations": one.demonstrations,
                "runs": one.runs,
                "practices": one.practices,
                "changed_at": one.changed_at.isoformat(),
            }
            for one in entries
        ]
        typer.echo(json.dumps(rows))
        return
    if not entries:
        typer.echo(f"There is nothing in {place} yet. Keep a task: understudy learn RECORDING --save NAME")
    width = max((len(one.name) for one in entries), default=0)
    for one in entries:
        head = f"@{one.head}" if one.head is not None else "proposals only"
        counts = (
            _counted(one.revisions, "revision"),
            _counted(one.demonstrations, "demonstration"),
            _counted(one.runs, "run"),
            _counted(one.practices, "practice run"),
        )
        typer.echo(f"  {one.name:{width}}  {head}  {', '.join(counts)}  {one.changed_at:%Y-%m-%d %H:%M}")


@commands.command("history")
def history(task: _Task, library: LibraryPlace = None, as_json: Json = False) -> None:
    """Every revision of a task, and what was recorded."""
    opened = _opened(library)
    revisions, sittings = opened.history(task), opened.sittings(task)
    if as_json:
        typer.echo(
            json.dumps(
                {
                    "task": task,
                    "revisions": [_record(one) for one in revisions],
                    "sittings": [
                        {
                            "kind": one.kind,
                            "number": one.number,
                            "name": one.name,
                            "revision": one.revision,
                            "made_at": one.made_at.isoformat(),
                            "file": one.file or None,
                            "achieved": one.achieved,
                            "done": one.done,
                            "outcome": one.outcome,
                        }
                        for one in sittings
                    ],
                }
            )
        )
        return
    head = max((one.number for one in revisions if one.accepted), default=0)
    for one in revisions:
        beside = f"  (made from {one.parent})" if one.parent not in (None, one.number - 1) else ""
        state = "" if one.accepted else "  (a proposal)"
        mark = "→" if one.number == head else " "
        typer.echo(f"{mark} {one.number:>3}  {one.made_at:%Y-%m-%d %H:%M}  {_why(one)}{beside}{state}")
        for sitting in (sitting for sitting in sittings if sitting.revision == one.number):
            outcome = f": {sitting.outcome}" if sitting.outcome else f" ({sitting.name})"
            typer.echo(f"       {sitting}{outcome}")


@commands.command("show")
def show(
    task: Annotated[str, typer.Argument(help="A task of the library, or one of its revisions: fetch@3.")],
    document: Annotated[
        bool, typer.Option("--document", help="Print the whole task document, as it is kept, to the byte.")
    ] = False,
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """One revision in plain words."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.figures import describe_task  # noqa: PLC0415
    from understudy.library import network_of  # noqa: PLC0415

    if document and as_json:
        raise typer.BadParameter("--document and --json both say what is printed; give one of them")
    revision = _revision(_opened(library), task)
    if document:
        typer.echo(revision.document, nl=False)
    elif as_json:
        typer.echo(json.dumps(_record(revision) | {"document": revision.document}))
    else:
        made, network = network_of(revision)
        typer.echo(f"{revision}: {_why(revision)}, {revision.made_at:%Y-%m-%d %H:%M}")
        typer.echo(f"\n{describe_task(made.name, network, installed_skills())}")


@commands.command("diff")
def diff(
    task: Annotated[str, typer.Argument(help="A task of the library.")],
    first: Annotated[int | None, typer.Argument(help="A revision; the one before the other, if left out.")] = None,
    second: Annotated[int | None, typer.Argument(help="A revision; the task as it is, if left out.")] = None,
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """What tells two revisions apart."""
    from understudy.library import network_of  # noqa: PLC0415
    from understudy.network import differences  # noqa: PLC0415

    opened = _opened(library)
    new = opened.revision(task, second)
    if first is None:
        first = new.parent
        if first is None:
            raise LibraryError(f"{new} was made from none before it; name two revisions")
    old = opened.revision(task, first)
    sentences = differences(network_of(old)[1], network_of(new)[1])
    if as_json:
        typer.echo(json.dumps({"task": task, "from": old.number, "to": new.number, "differences": sentences}))
        return
    typer.echo(f"From {old} to {new}:")
    for sentence in sentences:
        typer.echo(f"  {sentence}")
    if not sentences:
        typer.echo("  nothing; both do the same")
    else:
        for name, words in _named_in(sentences, network_of(old)[1], network_of(new)[1]).items():
            typer.echo(f"    {name}: {words}")


@commands.command("revert")
def revert(
    task: _Task,
    number: Annotated[int, typer.Argument(help="The revision that shall be again, or a proposal to be taken.")],
    note: Annotated[str, typer.Option(help="Why, for whoever reads the history.")] = "",
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """Make the task what it was in an earlier revision.

    That is a new revision just like the earlier one. Nothing is taken out, so this can be taken back, too.
    """
    from understudy.library import network_of  # noqa: PLC0415

    opened = _opened(library)
    earlier = opened.revision(task, number)
    accepted = [one for one in opened.history(task) if one.accepted]
    head = accepted[-1] if accepted else earlier
    if accepted and head.document == earlier.document:
        raise LibraryError(f"{task} is already as it was in {earlier}; there is nothing to go back to")
    say_replayed(replayed(opened, task, network_of(earlier)[1], head), err=as_json)
    with opened.writing() as add:
        made = add.revision(
            task, earlier.document, cause="reverted", parent=head.number, note=note, evidence={"to": number}
        )
    if as_json:
        typer.echo(json.dumps(_record(made)))
    else:
        typer.echo(f"{task} is now {made}, just like {earlier}.")
        typer.echo(f"To take that back: understudy tasks revert {task} {head.number}")


@commands.command("recording")
def recording(
    task: _Task,
    kind: Annotated[SittingName, typer.Argument(help="Of what.")],
    number: Annotated[int, typer.Argument(help="Which of them, as the history tells.")],
    file: Annotated[Path, typer.Argument(help="The file to be written. Nothing is overwritten.")],
    library: LibraryPlace = None,
) -> None:
    """Write what was recorded into a file again."""
    from understudy.documents import new_file  # noqa: PLC0415

    opened = _opened(library)
    of_kind = {one.number: one for one in opened.sittings(task, kind.value)}
    if number not in of_kind:
        there = ", ".join(map(str, of_kind)) or "none"
        raise LibraryError(f"{task} has no {kind.value} {number}; there are: {there}")
    _, content = opened.file(of_kind[number].file)
    with new_file(file) as written:
        written.write(content)
    typer.echo(f"Wrote {file}")


commands.command("export", help="Write a task with all its history into one file.")(archives.export)
commands.command("import", help="Add an archive, or a task document, to the library.")(archives.import_)


def _opened(library: str | None) -> "Library":
    """The library, which is not made by looking at it."""
    from understudy.library import exists  # noqa: PLC0415

    place = place_of(library)
    if not exists(place):
        raise LibraryError(f"there is no library in {place} yet; keep a task: understudy learn RECORDING --save NAME")
    return open_library(place)


def _revision(library: "Library", text: str) -> "Revision":
    from understudy.library import name_and_number  # noqa: PLC0415

    return library.revision(*name_and_number(text))


def _record(revision: "Revision") -> dict[str, Any]:
    return {
        "task": revision.task,
        "number": revision.number,
        "parent": revision.parent,
        "cause": revision.cause,
        "note": revision.note,
        "made_at": revision.made_at.isoformat(),
        "accepted": revision.accepted,
        "evidence": dict(revision.evidence),
    }


def _why(revision: "Revision") -> str:
    """``BAD about track-red-1, finished 1.2 s ago``."""
    told = revision.cause
    evidence = revision.evidence
    if "component" in evidence:
        where = "before" if revision.cause == "COME … GO" else "about"
        told += f" {where} {evidence['component']}, {evidence['how']}"
    if "demonstrations" in evidence:
        told += f" from {', '.join(evidence['demonstrations'])}"
    if "to" in evidence:
        told += f" to {evidence['to']}"
    return f"{told}: {revision.note}" if revision.note else told


def _named_in(sentences: Any, *networks: Any) -> dict[str, str]:
    """What the steps of which sentences speak do, in words."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.figures import goal_in_words  # noqa: PLC0415

    skills = installed_skills()
    spoken = {word for sentence in sentences for word in sentence.replace(",", " ").split()}
    parts = {path: part for network in networks for path, part in network.by_path.items()}
    return {path: goal_in_words(part, skills) for path, part in parts.items() if path in spoken}


def _counted(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
