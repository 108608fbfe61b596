"""A task in one file, to be kept elsewhere or given to somebody: a ZIP with an index that a person can read.

``docs/formats.md`` describes it. An archive says which revision was made from which, so it can be added to a library
that has some of them already: what is the same is recognised, the rest becomes new revisions. Nothing is replaced.
"""

import hashlib
import json
import zipfile
import zlib
from collections.abc import Mapping
from contextlib import closing
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path, PurePosixPath
from typing import Any, Final, Literal, Self

from pydantic import AwareDatetime, Field, ValidationError

from understudy.documents import Name, Part, expect_kind, first_fault, new_file, parse_text
from understudy.errors import DocumentError
from understudy.library.library import Library
from understudy.library.records import Revision, Sitting, SittingKind, network_of, shown_in

__all__ = ["Archive", "export_task"]

_INDEX: Final = "index.json"
_EPOCH: Final = (1980, 1, 1, 0, 0, 0)
"""The time of every file in the ZIP, so that the same task gives the same archive."""


class _RevisionPart(Part):
    number: int = Field(ge=1)
    parent: int | None = None
    cause: str
    note: str = ""
    made_at: AwareDatetime
    accepted: bool
    evidence: dict[str, Any] = {}
    document: str


class _SittingPart(Part):
    kind: SittingKind
    number: int = Field(ge=1)
    name: str
    revision: int
    made_at: AwareDatetime
    file: str | None = None
    shown: str | None = None
    achieved: tuple[str, ...] = ()
    done: bool
    outcome: str = ""


class _Index(Part):
    understudy: Literal["archive/1"] = "archive/1"
    task: Name
    revisions: tuple[_RevisionPart, ...] = Field(min_length=1)
    sittings: tuple[_SittingPart, ...] = ()


def export_task(library: Library, task: str, path: Path) -> None:
    """Writes a task with its whole history, its demonstrations and its runs into a new file.

    Args:
        library: that holds it.
        task: its name.
        path: of the file, which must not exist.

    Raises:
        LibraryError: there is no such task.
        DocumentError: the file exists, or cannot be written.
    """
    # In this order: a revision that is made meanwhile may be left out, but none of which something else speaks.
    sittings = library.sittings(task)
    revisions = library.history(task)
    files = {one.file: library.suffix(one.file) for one in sittings if one.file}
    index = _Index(
        task=task,
        revisions=tuple(
            _RevisionPart(
                number=one.number,
                parent=one.parent,
                cause=one.cause,
                note=one.note,
                made_at=one.made_at,
                accepted=one.accepted,
                evidence=dict(one.evidence),
                document=f"revisions/{one.number}.yaml",
            )
            for one in revisions
        ),
        sittings=tuple(
            _SittingPart(
                kind=one.kind,
                number=one.number,
                name=one.name,
                revision=one.revision,
                made_at=one.made_at,
                file=f"files/{one.file}{files[one.file]}" if one.file else None,
                shown=f"shown/{one.number}.yaml" if one.shown else None,
                achieved=one.achieved,
                done=one.done,
                outcome=one.outcome,
            )
            for one in sittings
        ),
    )
    with new_file(path) as file, zipfile.ZipFile(file, "w") as packed:
        _put(packed, _INDEX, index.model_dump_json(indent=2).encode())
        for part, revision in zip(index.revisions, revisions, strict=True):
            _put(packed, part.document, revision.document.encode())
        for shown, sitting in zip(index.sittings, sittings, strict=True):
            if shown.shown is not None:
                _put(packed, shown.shown, sitting.shown.encode())
        for sha256, suffix in files.items():
            _put(packed, f"files/{sha256}{suffix}", library.file(sha256)[1], zipfile.ZIP_STORED)


def _put(packed: zipfile.ZipFile, name: str, content: bytes, compression: int = zipfile.ZIP_DEFLATED) -> None:
    info = zipfile.ZipInfo(name, _EPOCH)
    info.external_attr = 0o644 << 16  # whoever unpacks it may read it
    packed.writestr(info, content, compression)


@dataclass(frozen=True, slots=True, kw_only=True)
class Archive:
    """What is in a file that :func:`export_task` wrote.

    Attributes:
        path: of the file.
        task: what the task was called.
        revisions: as they were there, the first one first.
        sittings: the same.
        members: for the SHA-256 of every file in it, its name there.
    """

    path: Path
    task: str
    revisions: tuple[Revision, ...]
    sittings: tuple[Sitting, ...]
    members: Mapping[str, str]

    @classmethod
    def read(cls, path: Path) -> Self:
        """Opens an archive. What was recorded is looked at only when it is added to a library.

        Raises:
            DocumentError: it cannot be read, is no archive, or does not agree with itself.
        """
        with closing(_Packed(path)) as packed:
            data = parse_text(packed.text(_INDEX), source=f"{path}: {_INDEX}", as_json=True)
            expect_kind(data, "archive/1", source=f"{path}: {_INDEX}")
            try:
                index = _Index.model_validate(data)
            except ValidationError as error:
                raise first_fault(error, f"{path}: {_INDEX}") from None
            revisions = tuple(
                Revision(task=index.task, **{**dict(part), "document": packed.text(part.document)})
                for part in index.revisions
            )
            members = {PurePosixPath(one.file).stem: one.file for one in index.sittings if one.file is not None}
            sittings = tuple(
                Sitting(
                    task=index.task,
                    **{
                        **dict(part),
                        "file": "" if part.file is None else PurePosixPath(part.file).stem,
                        "shown": "" if part.shown is None else packed.text(part.shown),
                    },
                )
                for part in index.sittings
            )
        found = cls(path=path, task=index.task, revisions=revisions, sittings=sittings, members=members)
        found._check()
        return found

    @property
    def head(self) -> Revision:
        """The revision that the task's name stood for."""
        return next((one for one in reversed(self.revisions) if one.accepted), self.revisions[-1])

    def known(self, history: tuple[Revision, ...]) -> dict[int, int]:
        """Which of its revisions are in a history already, and by which number there."""
        there = {print_: number for number, print_ in _prints(history).items()}
        return {number: there[print_] for number, print_ in _prints(self.revisions).items() if print_ in there}

    def add_to(
        self, library: Library, name: str, *, accepted: bool
    ) -> tuple[tuple[Revision, ...], tuple[Sitting, ...]]:
        """Adds what a library has not got yet, all of it or nothing.

        Args:
            library: to which.
            name: of the task there; of a new one, or of one that has revisions in common.
            accepted: where there is such a task, its name stands for the archive's head from now on.

        Returns:
            The revisions and the sittings that were added.

        Raises:
            LibraryError: the name cannot be a task's.
            DocumentError: the archive is damaged.
        """
        with closing(_Packed(self.path)) as packed, library.writing() as writing:
            history = library.history(name) if name in library.names() else ()
            numbers = self.known(history)
            added = []
            for one in self.revisions:
                if one.number in numbers:
                    continue
                made = writing.revision(
                    name,
                    one.document,
                    cause=one.cause,
                    parent=None if one.parent is None else numbers[one.parent],
                    note=one.note,
                    evidence=one.evidence,
                    accepted=one.accepted if not history else accepted and one is self.head,
                    made_at=one.made_at,
                )
                numbers[one.number] = made.number
                added.append(made)
            there = {_identity(one, one.revision) for one in (library.sittings(name) if history else ())}
            brought = []
            for sitting in self.sittings:
                if _identity(sitting, numbers[sitting.revision]) in there:
                    continue
                if sitting.file:
                    member = self.members[sitting.file]
                    if writing.file(packed.bytes(member), PurePosixPath(member).suffix) != sitting.file:
                        raise DocumentError(
                            "the file is damaged: it is not what its name says", source=str(self.path), path=member
                        )
                brought.append(
                    writing.sitting(
                        name,
                        sitting.kind,
                        name=sitting.name,
                        revision=numbers[sitting.revision],
                        file=sitting.file,
                        shown=sitting.shown,
                        achieved=sitting.achieved,
                        done=sitting.done,
                        outcome=sitting.outcome,
                        made_at=sitting.made_at,
                    )
                )
        return tuple(added), tuple(brought)

    def _check(self) -> None:
        """What the index alone does not say: that everything it speaks of is there, and is what it shall be."""
        seen: dict[int, Revision] = {}
        for revision in self.revisions:
            if revision.number in seen or (revision.parent is not None and revision.parent not in seen):
                raise DocumentError(
                    f"revision {revision.number} is there twice, or stands before the one that it was made from",
                    source=str(self.path),
                )
            seen[revision.number] = revision
        networks = {revision.number: network_of(revision)[1] for revision in self.revisions}
        for one in self.sittings:
            if one.revision not in seen:
                raise DocumentError(f"{one} is of revision {one.revision}, which is not there", source=str(self.path))
            if one.kind == "demonstration":
                shown_in(one)
            for path in one.achieved:
                if one.kind == "run" and path not in networks[one.revision].by_path:
                    raise DocumentError(
                        f"{one} achieved {path!r}, and revision {one.revision} has no such step", source=str(self.path)
                    )


class _Packed:
    """The files in a ZIP; whatever is wrong with it becomes one line."""

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._zip = zipfile.ZipFile(path)
        except zipfile.BadZipFile:
            raise DocumentError(
                "this is no archive of a task, or it breaks off; name one that `understudy tasks export` has written",
                source=str(path),
            ) from None
        except OSError as error:
            raise DocumentError(f"the file cannot be read: {error.strerror}", source=str(path)) from None

    def close(self) -> None:
        self._zip.close()

    def bytes(self, name: str) -> bytes:
        try:
            return self._zip.read(name)
        except KeyError:
            problem = "it is missing; this is no archive of a task, or not all of one"
        except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, OSError):
            # All that zipfile raises where bits have turned over: another method, a password, a place before the start.
            problem = "the file is damaged here; export the task again"
        raise DocumentError(problem, source=str(self._path), path=name)

    def text(self, name: str) -> str:
        try:
            return self.bytes(name).decode()
        except UnicodeDecodeError:
            raise DocumentError("this is no text in UTF-8", source=str(self._path), path=name) from None


def _prints(revisions: tuple[Revision, ...]) -> dict[int, str]:
    """For every revision a fingerprint of all that it is, and of all that it was made from."""
    found: dict[int, str] = {}
    for one in revisions:
        parent = found[one.parent] if one.parent is not None else ""
        made_at = one.made_at.timestamp()
        whole = [parent, one.cause, one.note, made_at, dict(one.evidence), one.document]
        found[one.number] = hashlib.sha256(json.dumps(whole, sort_keys=True).encode()).hexdigest()
    return found


def _identity(sitting: Sitting, revision: int) -> tuple[str, str, datetime, str, int]:
    return sitting.kind, sitting.name, sitting.made_at, sitting.file, revision
