"""What commands put into the library: the revisions of an edit, the demonstrations behind it, and runs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import typer

from understudy.cli.replaying import decide, replayed, say_replayed
from understudy.cli.tasks import NamedTask, open_library, place_of
from understudy.errors import UnderstudyError

if TYPE_CHECKING:
    from understudy.library import Cause, Library, Regression, Revision, Sitting, SittingKind, Writing
    from understudy.network import Task
    from understudy.practice import Correction

__all__ = ["Edit", "Keeping", "Kept", "Ran", "Shown", "edits_of", "keeping"]

_FEW = 5
"""More demonstrations and runs than these are counted and not listed: an archive may bring hundreds."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Edit:
    """One revision to be."""

    task: "Task"
    cause: "Cause"
    note: str = ""
    evidence: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """A demonstration: what was learned from it alone, and the file that holds it."""

    task: "Task"
    file: Path
    done: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Ran:
    """A run or a practice run; as :class:`understudy.library.Sitting`."""

    kind: "SittingKind"
    recording: Path
    name: str
    done: bool
    outcome: str
    achieved: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Kept:
    """What is in the library now.

    Attributes:
        revisions: that were added, in their order.
        sittings: that were added.
        regression: what became of what was there before; None if nothing was edited.
    """

    revisions: "tuple[Revision, ...]" = ()
    sittings: "tuple[Sitting, ...]" = ()
    regression: "Regression | None" = None

    @property
    def called(self) -> str:
        """How the last revision is named on the command line: by the task's name if it is taken; empty without one."""
        if not self.revisions:
            return ""
        last = self.revisions[-1]
        return last.task if last.accepted else str(last)

    @property
    def accepted(self) -> bool:
        """Whether the task's name stands for the edited task now."""
        return not self.revisions or any(one.accepted for one in self.revisions)

    def as_record(self) -> dict[str, Any]:
        """The same in plain data, under one key; nothing if nothing is kept."""
        if not self.revisions and not self.sittings:
            return {}
        from understudy.behaviors import installed_skills  # noqa: PLC0415
        from understudy.figures import describe_misfit  # noqa: PLC0415 - help must come at once

        skills = installed_skills()
        broken = self.regression.broken if self.regression is not None else ()
        record = {
            "revisions": [str(one) for one in self.revisions],
            "sittings": [f"{one} of {one.task}@{one.revision}" for one in self.sittings],
            "accepted": self.accepted,
            "misfits": [{"what": str(one.sitting), "why": describe_misfit(one, skills)} for one in broken],
        }
        return {"kept": record}

    def say(self, *, err: bool = False) -> None:
        """Tells it in words."""
        from understudy.figures import sittings_in_words  # noqa: PLC0415

        if len(self.sittings) > _FEW:
            typer.echo(f"Kept in the library: {sittings_in_words(self.sittings)} of {self.sittings[0].task}", err=err)
        else:
            for one in self.sittings:
                typer.echo(f"Kept in the library: {one} of {one.task}@{one.revision}", err=err)
        for revision in self.revisions:
            proposed = "" if revision.accepted else ", as a proposal"
            typer.echo(f"Kept in the library: {revision} ({revision.cause}){proposed}", err=err)
        if not self.accepted:
            last = self.revisions[-1]
            typer.echo(
                f"{last.task} is as it was. To take it: understudy tasks revert {last.task} {last.number}", err=err
            )


def keeping(named: NamedTask | None, save: str | None, library: str | None, workspace: Path) -> "Keeping":
    """Where a command keeps what it makes: in the task of the library that was given or named; else nowhere.

    Args:
        named: the task that was given, if any.
        save: as it was given with ``--save``.
        library: as it was given with ``--library``.
        workspace: in which the library is otherwise.

    Raises:
        LibraryError: the library cannot be opened, or the name cannot be a task's.
    """
    from understudy.library import check_name  # noqa: PLC0415

    kept = named.kept if named is not None else None
    name = save or (kept.task if kept is not None else None)
    if name is None:
        return Keeping()
    opened = open_library(place_of(library, workspace))
    if kept is None or kept.task != name:
        if name in opened.names():
            kept = opened.revision(name)
        else:
            check_name(name)
            kept = None
    return Keeping(library=opened, task=name, base=kept)


@dataclass(frozen=True, slots=True, kw_only=True)
class Keeping:
    """One task of the library, to which something is added; or none, and then nothing is kept.

    Attributes:
        library: which; None keeps nothing.
        task: the name of the task.
        base: the revision that edits begin from; None for a task that is not there yet.
    """

    library: "Library | None" = None
    task: str = ""
    base: "Revision | None" = None

    def outset(self, named: NamedTask) -> list[Edit]:
        """The task that was given, as an edit of what the library has of it; none if it has just that."""
        from understudy.library import network_of  # noqa: PLC0415
        from understudy.network import Task  # noqa: PLC0415

        # Tasks that stand in it as files of their own are written out: the library knows no files.
        task = Task.of(named.task.name, named.network, note=named.task.note)
        if self.base is not None and network_of(self.base) == (task, named.network):
            return []
        cause: Cause = "imported" if self.base is None else "edited by hand"
        return [Edit(task=task, cause=cause, evidence={"from": named.source})]

    def edit(
        self,
        edits: Sequence[Edit],
        shown: Sequence[Shown] = (),
        *,
        misfits: bool | None,
        run: Ran | None = None,
        quiet: bool = False,
    ) -> Kept:
        """Adds revisions, each made from the one before, and the demonstrations that they were made from.

        Args:
            edits: what was made; the last one is the task as it shall be.
            shown: new demonstrations.
            misfits: whether to take the edit if something no longer fits; None asks.
            run: the practice run in which they were made, of the revision that they begin from.
            quiet: whoever reads the output is a program; what no longer fits is told on stderr.
        """
        from understudy.network import task_text  # noqa: PLC0415

        if self.library is None:
            return Kept()
        if not edits:
            return Kept() if run is None else self.run(run)
        found = replayed(self.library, self.task, edits[-1].task.network(), self.base)
        say_replayed(found, err=quiet)
        accepted = decide(found, self.task, misfits)
        with self.library.writing() as add:
            revisions: list[Revision] = []
            parent = self.base.number if self.base is not None else None
            for one in edits:
                made = add.revision(
                    self.task,
                    task_text(one.task),
                    cause=one.cause,
                    parent=parent,
                    note=one.note,
                    evidence=one.evidence,
                    accepted=accepted,
                )
                revisions.append(made)
                parent = made.number
            sittings = [
                add.sitting(
                    self.task,
                    "demonstration",
                    name=one.task.name,
                    revision=revisions[-1].number,
                    file=add.file(_content(one.file), one.file.suffix.lower()),
                    shown=task_text(one.task),
                    done=one.done,
                )
                for one in shown
            ]
            if run is not None:
                sittings.append(self._sit(add, run))
        return Kept(revisions=tuple(revisions), sittings=tuple(sittings), regression=found)

    def run(self, run: Ran) -> Kept:
        """Adds a run of the revision."""
        if self.library is None:
            return Kept()
        with self.library.writing() as add:
            return Kept(sittings=(self._sit(add, run),))

    def _sit(self, add: "Writing", run: Ran) -> "Sitting":
        assert self.base is not None, "what was executed is in the library"
        return add.sitting(
            self.task,
            run.kind,
            name=run.name,
            revision=self.base.number,
            file=add.file(_content(run.recording), run.recording.suffix.lower()),
            achieved=run.achieved,
            done=run.done,
            outcome=run.outcome,
        )


def edits_of(corrections: "Sequence[Correction]", task: "Task") -> list[Edit]:
    """A revision for every correction of a practice run that changed the task, with the step that it was about."""
    from understudy.network import Task, differences  # noqa: PLC0415

    found = []
    for one in corrections:
        if one.after == one.before:
            continue
        evidence: dict[str, Any] = {"time_s": one.time_s, "changes": list(differences(one.before, one.after))}
        if one.meant:
            first, *others = one.meant
            evidence |= {
                "component": first.component,
                "how": first.told(one.time_s),
                "others": [other.component for other in others],
            }
        cause: Cause = "BAD" if one.piece is None else "COME … GO"
        found.append(Edit(task=Task.of(task.name, one.after, note=task.note), cause=cause, evidence=evidence))
    return found


def _content(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except OSError as error:
        raise UnderstudyError(f"{file}: the file cannot be read again, to be kept: {error.strerror}") from None
