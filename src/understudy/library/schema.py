"""The tables of the library. Rows are only ever added: none is changed, and none is taken out."""

from typing import Final

from sqlalchemy import (
    DDL,
    Boolean,
    Column,
    ForeignKey,
    ForeignKeyConstraint,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    Text,
    UniqueConstraint,
    event,
)

__all__ = ["FILES", "METADATA", "REVISIONS", "SCHEMA_VERSION", "SITTINGS", "TASKS", "VERSIONS"]

SCHEMA_VERSION: Final = 1
"""Raised when an older Understudy would misread a newer library, or write into it what does not belong there."""

METADATA: Final = MetaData()

VERSIONS: Final = Table(
    "understudy_library",
    METADATA,
    Column("version", Integer, primary_key=True),
)
"""One row: by which version of this schema the library was made."""

TASKS: Final = Table(
    "tasks",
    METADATA,
    Column("id", Integer, primary_key=True),
    Column("name", String(80), nullable=False, unique=True),
)

REVISIONS: Final = Table(
    "revisions",
    METADATA,
    Column("id", Integer, primary_key=True),
    Column("task", Integer, ForeignKey("tasks.id"), nullable=False),
    Column("number", Integer, nullable=False),
    Column("parent", Integer),
    Column("cause", String(40), nullable=False),
    Column("note", Text, nullable=False),
    Column("made_at", String(40), nullable=False),
    Column("accepted", Boolean, nullable=False),
    Column("evidence", Text, nullable=False),
    Column("document", Text, nullable=False),
    UniqueConstraint("task", "number"),
    ForeignKeyConstraint(["task", "parent"], ["revisions.task", "revisions.number"]),
)
"""Every state of every task, whole. The accepted one with the highest number is what the task's name stands for."""

FILES: Final = Table(
    "files",
    METADATA,
    Column("sha256", String(64), primary_key=True),
    Column("suffix", String(16), nullable=False),
    Column("content", LargeBinary, nullable=False),
)
"""Recordings and documents of observed intervals, by what is in them: each is stored once."""

SITTINGS: Final = Table(
    "sittings",
    METADATA,
    Column("id", Integer, primary_key=True),
    Column("task", Integer, ForeignKey("tasks.id"), nullable=False),
    Column("kind", String(20), nullable=False),
    Column("number", Integer, nullable=False),
    Column("name", Text, nullable=False),
    Column("revision", Integer, nullable=False),
    Column("made_at", String(40), nullable=False),
    Column("file", String(64), ForeignKey("files.sha256")),
    Column("shown", Text),
    Column("achieved", Text, nullable=False),
    Column("done", Boolean, nullable=False),
    Column("outcome", Text, nullable=False),
    UniqueConstraint("task", "kind", "number"),
    ForeignKeyConstraint(["task", "revision"], ["revisions.task", "revisions.number"]),
)
"""Demonstrations, runs and practice runs of a task, numbered each for itself."""

# Whoever opens the file with another program cannot rewrite history by mistake either.
for _table in METADATA.tables.values():
    for _verb in ("UPDATE", "DELETE"):
        _refuse = DDL(  # type: ignore[no-untyped-call]  # SQLAlchemy leaves it so
            f"CREATE TRIGGER {_table.name}_no_{_verb.lower()} BEFORE {_verb} ON {_table.name} "
            "BEGIN SELECT RAISE(ABORT, 'the library only adds, and forgets nothing'); END"
        )
        event.listen(_table, "after_create", _refuse.execute_if(dialect="sqlite"))
