"""Adding to the library: several things in one transaction, so that they are all kept, or none of them."""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from datetime import datetime
from types import MappingProxyType
from typing import Any

from sqlalchemy import Connection, Table, func, insert, select

from understudy.errors import LibraryError
from understudy.library.records import Revision, Sitting, SittingKind
from understudy.library.schema import FILES, REVISIONS, SITTINGS, TASKS
from understudy.network import task_names

__all__ = ["Writing", "check_name"]

_LONGEST_NAME = 80


def check_name(name: str) -> None:
    """Refuses what cannot be the name of a new task in the library.

    Raises:
        LibraryError: it is empty or too long, has in it what has a meaning on the command line, or is that of a task
            that comes with the program.
    """
    if not name.strip() or len(name) > _LONGEST_NAME or any(sign in name for sign in "@/\\\n"):
        raise LibraryError(
            f"{name[:_LONGEST_NAME]!r} cannot be the name of a task in the library: it has 1 to {_LONGEST_NAME}"
            " characters, and no @, / or \\ among them"
        )
    if name in task_names():
        raise LibraryError(f"{name} is the name of a task that comes with the program; give yours another one")


class Writing:
    """One transaction. Made by :meth:`understudy.library.Library.writing`.

    Args:
        connection: in a transaction that writes.
        now: tells the time.
    """

    def __init__(self, connection: Connection, now: Callable[[], datetime]) -> None:
        self._connection = connection
        self._now = now

    def revision(
        self,
        task: str,
        document: str,
        *,
        cause: str,
        parent: int | None = None,
        note: str = "",
        evidence: Mapping[str, Any] = MappingProxyType({}),
        accepted: bool = True,
        made_at: datetime | None = None,
    ) -> Revision:
        """Adds a revision, and the task if it is its first.

        Args:
            task: its name.
            document: the text of the task document.
            cause: what made it out of its parent.
            parent: the number of the revision that it was made from; None if from none.
            note: anything a person should know of it.
            evidence: what the cause says of it, in plain data.
            accepted: the task's name stands for it from now on.
            made_at: of a revision that comes from another library; now, if left out.

        Raises:
            LibraryError: the name cannot be a task's, or there is no such parent.
        """
        id_ = self._task(task)
        numbers = self._connection.scalars(select(REVISIONS.c.number).where(REVISIONS.c.task == id_)).all()
        if parent is not None and parent not in numbers:
            raise LibraryError(f"{task} has no revision {parent} from which another one could be made")
        made = Revision(
            task=task,
            number=max(numbers, default=0) + 1,
            parent=parent,
            cause=cause,
            note=note,
            made_at=made_at or self._now(),
            accepted=accepted,
            evidence=evidence,
            document=document,
        )
        row = {
            "task": id_,
            "number": made.number,
            "parent": parent,
            "cause": cause,
            "note": note,
            "made_at": made.made_at.isoformat(),
            "accepted": accepted,
            "evidence": json.dumps(dict(evidence), ensure_ascii=False),
            "document": document,
        }
        self._connection.execute(insert(REVISIONS), row)
        return made

    def sitting(
        self,
        task: str,
        kind: SittingKind,
        *,
        name: str,
        revision: int,
        file: str = "",
        shown: str = "",
        achieved: Sequence[str] = (),
        done: bool = True,
        outcome: str = "",
        made_at: datetime | None = None,
    ) -> Sitting:
        """Adds a demonstration, a run or a practice run; the arguments are the attributes of :class:`.Sitting`.

        Raises:
            LibraryError: the task has no such revision, or there is no such file.
        """
        id_ = self._task(task)
        numbers = select(REVISIONS.c.number).where(REVISIONS.c.task == id_, REVISIONS.c.number == revision)
        if self._connection.scalar(numbers) is None:
            raise LibraryError(f"{task} has no revision {revision}, so this cannot be a {kind} of it")
        if file and not self._has(FILES, FILES.c.sha256 == file):
            raise LibraryError(f"the library holds no file {file}; put it in before what was recorded in it")
        last = select(func.max(SITTINGS.c.number)).where(SITTINGS.c.task == id_, SITTINGS.c.kind == kind)
        made = Sitting(
            task=task,
            kind=kind,
            number=(self._connection.scalar(last) or 0) + 1,
            name=name,
            revision=revision,
            made_at=made_at or self._now(),
            file=file,
            shown=shown,
            achieved=tuple(achieved),
            done=done,
            outcome=outcome,
        )
        row = {
            "task": id_,
            "kind": kind,
            "number": made.number,
            "name": name,
            "revision": revision,
            "made_at": made.made_at.isoformat(),
            "file": file or None,
            "shown": shown or None,
            "achieved": json.dumps(list(achieved)),
            "done": done,
            "outcome": outcome,
        }
        self._connection.execute(insert(SITTINGS), row)
        return made

    def file(self, content: bytes, suffix: str) -> str:
        """Adds a file, unless it is there already.

        Args:
            content: of it.
            suffix: what its name ends in, ``.mcap``.

        Returns:
            Its SHA-256, which is its name in the library.
        """
        sha256 = hashlib.sha256(content).hexdigest()
        if not self._has(FILES, FILES.c.sha256 == sha256):
            self._connection.execute(insert(FILES), {"sha256": sha256, "suffix": suffix, "content": content})
        return sha256

    def _task(self, name: str) -> int:
        """The task's row, made if there is none; locked, where the database locks rows, so that numbers are unique."""
        mine = select(TASKS.c.id).where(TASKS.c.name == name).with_for_update()
        found = self._connection.scalar(mine)
        if found is None:
            check_name(name)
            self._connection.execute(insert(TASKS), {"name": name})
            found = self._connection.scalar(mine)
        assert found is not None
        return int(found)

    def _has(self, table: Table, condition: Any) -> bool:
        return self._connection.scalar(select(func.count()).select_from(table).where(condition)) != 0
