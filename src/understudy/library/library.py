"""The library: every task with all that it ever was, and with the demonstrations and runs that speak of it."""

import hashlib
import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import datetime
from difflib import get_close_matches
from typing import Any

from sqlalchemy import Connection, Row, func, select

from understudy.errors import LibraryError
from understudy.library.opening import open_engine, reading, writing
from understudy.library.records import Entry, Revision, Sitting, SittingKind
from understudy.library.schema import FILES, REVISIONS, SITTINGS, TASKS
from understudy.library.writing import Writing

__all__ = ["Library"]


class Library:
    """The library at one place. Several processes may use one at once.

    Every method raises :class:`~understudy.errors.LibraryError` where the database refuses, besides what it says
    itself.

    Args:
        location: a file, made if it is not there, or the URL of a database.
        now: tells the time, with its zone.

    Raises:
        LibraryError: it cannot be opened or made, it is no library, or a newer Understudy made it.
    """

    def __init__(self, location: str, *, now: Callable[[], datetime]) -> None:
        self.location = location
        self._engine = open_engine(location)
        self._now = now

    def tasks(self) -> tuple[Entry, ...]:
        """All tasks, by name."""
        with reading(self._engine) as connection:
            names = connection.execute(select(TASKS.c.id, TASKS.c.name).order_by(TASKS.c.name)).all()
            return tuple(_entry(connection, id_, name) for id_, name in names)

    def names(self) -> tuple[str, ...]:
        """The names of all tasks."""
        with reading(self._engine) as connection:
            return tuple(connection.scalars(select(TASKS.c.name).order_by(TASKS.c.name)))

    def history(self, task: str) -> tuple[Revision, ...]:
        """All revisions of a task, the first one first.

        Raises:
            LibraryError: there is no such task; the message names those that there are.
        """
        with reading(self._engine) as connection:
            rows = connection.execute(
                select(REVISIONS).where(REVISIONS.c.task == self._id(connection, task)).order_by(REVISIONS.c.number)
            ).all()
        return tuple(_revision(task, row) for row in rows)

    def revision(self, task: str, number: int | None = None) -> Revision:
        """One revision of a task.

        Args:
            task: its name.
            number: which; if left out, the one that the task's name stands for, which is the accepted one with the
                highest number.

        Raises:
            LibraryError: there is no such task or revision; the message names those that there are.
        """
        with reading(self._engine) as connection:
            mine = select(REVISIONS).where(REVISIONS.c.task == self._id(connection, task))
            if number is None:
                mine = mine.where(REVISIONS.c.accepted).order_by(REVISIONS.c.number.desc()).limit(1)
            else:
                mine = mine.where(REVISIONS.c.number == number)
            row = connection.execute(mine).one_or_none()
        if row is None:
            count = len(self.history(task))
            if number is None:
                raise LibraryError(f"nothing of {task} was accepted yet; name a revision, {task}@1 to {task}@{count}")
            raise LibraryError(f"{task} has no revision {number}; there are {task}@1 to {task}@{count}")
        return _revision(task, row)

    def sittings(self, task: str, kind: SittingKind | None = None) -> tuple[Sitting, ...]:
        """The demonstrations, runs and practice runs of a task, as they came; or those of one kind.

        Raises:
            LibraryError: there is no such task.
        """
        with reading(self._engine) as connection:
            mine = select(SITTINGS).where(SITTINGS.c.task == self._id(connection, task)).order_by(SITTINGS.c.id)
            rows = connection.execute(mine if kind is None else mine.where(SITTINGS.c.kind == kind)).all()
        return tuple(_sitting(task, row) for row in rows)

    def file(self, sha256: str) -> tuple[str, bytes]:
        """What the name of a file ends in, and what is in it.

        Raises:
            LibraryError: there is no such file, or it is not any more what it was.
        """
        with reading(self._engine) as connection:
            row = connection.execute(select(FILES).where(FILES.c.sha256 == sha256)).one_or_none()
        if row is None:
            raise LibraryError(f"{self.location} holds no file {sha256}")
        content = bytes(row.content)
        if hashlib.sha256(content).hexdigest() != sha256:
            raise LibraryError(f"{self.location} is damaged: the file {sha256} is not what it was when it was put in")
        return str(row.suffix), content

    def suffix(self, sha256: str) -> str:
        """What the name of a file ends in.

        Raises:
            LibraryError: there is no such file.
        """
        with reading(self._engine) as connection:
            found = connection.scalar(select(FILES.c.suffix).where(FILES.c.sha256 == sha256))
        if found is None:
            raise LibraryError(f"{self.location} holds no file {sha256}")
        return str(found)

    @contextmanager
    def writing(self) -> Iterator[Writing]:
        """A transaction: what is added in the block is kept when it ends well, and nothing of it otherwise."""
        with writing(self._engine) as connection:
            yield Writing(connection, self._now)

    def _id(self, connection: Connection, task: str) -> int:
        found = connection.scalar(select(TASKS.c.id).where(TASKS.c.name == task))
        if found is not None:
            return int(found)
        names = list(connection.scalars(select(TASKS.c.name).order_by(TASKS.c.name)))
        close = get_close_matches(task, names, n=1)
        hint = f"did you mean {close[0]!r}? " if close else ""
        raise LibraryError(f"{self.location} has no task {task!r}; {hint}there are: {', '.join(names) or 'none'}")


def _entry(connection: Connection, id_: int, name: str) -> Entry:
    mine = REVISIONS.c.task == id_
    counts = (
        select(SITTINGS.c.kind, func.count().label("times")).where(SITTINGS.c.task == id_).group_by(SITTINGS.c.kind)
    )
    kinds: dict[str, int] = {row.kind: row.times for row in connection.execute(counts)}
    last = select(REVISIONS.c.made_at).where(mine).order_by(REVISIONS.c.number.desc()).limit(1)
    return Entry(
        name=name,
        head=connection.scalar(select(func.max(REVISIONS.c.number)).where(mine, REVISIONS.c.accepted)),
        revisions=connection.scalar(select(func.count()).select_from(REVISIONS).where(mine)) or 0,
        demonstrations=kinds.get("demonstration", 0),
        runs=kinds.get("run", 0),
        practices=kinds.get("practice", 0),
        changed_at=datetime.fromisoformat(connection.scalars(last).one()),
    )


def _revision(task: str, row: Row[Any]) -> Revision:
    return Revision(
        task=task,
        number=row.number,
        parent=row.parent,
        cause=row.cause,
        note=row.note,
        made_at=datetime.fromisoformat(row.made_at),
        accepted=row.accepted,
        evidence=json.loads(row.evidence),
        document=row.document,
    )


def _sitting(task: str, row: Row[Any]) -> Sitting:
    return Sitting(
        task=task,
        kind=row.kind,
        number=row.number,
        name=row.name,
        revision=row.revision,
        made_at=datetime.fromisoformat(row.made_at),
        file=row.file or "",
        shown=row.shown or "",
        achieved=tuple(json.loads(row.achieved)),
        done=row.done,
        outcome=row.outcome,
    )
