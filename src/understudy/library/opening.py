"""Opening the database of a library; whatever it refuses becomes one line that says how to mend it.

SQLite is set so that several processes can write at once, and one that is killed leaves nothing half done: a log
written ahead (WAL), which readers do not wait for; the writer's lock is taken when a transaction begins and not in the
middle of it; and a transaction has gone to the disk when it is over.
"""

import os
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path
from typing import Any, Final

from sqlalchemy import URL, Connection, Engine, NullPool, create_engine, event, inspect, make_url, select
from sqlalchemy.exc import ArgumentError, DBAPIError, NoSuchModuleError, SQLAlchemyError

from understudy.errors import LibraryError
from understudy.library.schema import METADATA, SCHEMA_VERSION, VERSIONS

__all__ = ["exists", "open_engine", "reading", "writing"]

PATIENCE_S: Final = 30.0
"""So long a writer waits for the others. To store a recording takes well under a second."""

_MENDS: Final = (
    (
        ("database is locked", "database table is locked", "busy"),
        f"another program has been writing to it for more than {PATIENCE_S:g} s; try again when it is done",
    ),
    (("readonly database",), "it may only be read; name another one with --library, or mend the file's permissions"),
    (("disk is full",), "the disk is full, and nothing of this was kept; make room, and do it again"),
    (("not a database",), "this file is no library; name another one with --library"),
    (("unable to open",), "it cannot be opened; name a file in a folder that you may write to"),
    (
        ("malformed", "disk i/o error"),
        "the file is damaged, or its disk is; go on with a copy of it, or import what was exported before",
    ),
)


def open_engine(location: str) -> Engine:
    """The database of a library, made if it is not there yet.

    Args:
        location: a file, or the URL of a database.

    Raises:
        LibraryError: it cannot be opened or made, it is no library, or a newer Understudy made it.
    """
    url = _url(location)
    file = _file(url)
    with _told(location):
        if file is not None and not file.exists():
            _make(file, location)
        engine = _engine(url, location)
        with reading(engine) as connection:
            there = inspect(connection).has_table(VERSIONS.name)
        if not there and url.get_backend_name() != "sqlite":
            with engine.begin() as connection:
                _make_tables(connection)
        elif not there:
            raise LibraryError(f"{location} is no library of Understudy; name another one with --library")
        with reading(engine) as connection:
            version = connection.execute(select(VERSIONS.c.version)).scalar_one()
        if version > SCHEMA_VERSION:
            raise LibraryError(
                f"{location} is a library of version {version}, and this Understudy reads up to {SCHEMA_VERSION};"
                " upgrade understudy"
            )
    return engine


def exists(location: str) -> bool:
    """Whether there is something to be opened. Of a database that is no file nobody knows before it is asked."""
    file = _file(_url(location))
    return file is None or file.exists()


@contextmanager
def reading(engine: Engine) -> Iterator[Connection]:
    """A transaction that only reads: all of it sees one state."""
    with _told(_name(engine)), engine.connect() as connection, connection.begin():
        yield connection


@contextmanager
def writing(engine: Engine) -> Iterator[Connection]:
    """A transaction that writes: all of it is kept, or nothing. No other one writes meanwhile."""
    with (
        _told(_name(engine)),
        engine.connect().execution_options(understudy_writes=True) as connection,
        connection.begin(),
    ):
        yield connection


def _url(location: str) -> URL:
    if "://" not in location:
        return URL.create("sqlite", database=location)
    try:
        url = make_url(location)
    except ArgumentError:
        raise LibraryError(f"{location!r} is no URL of a database; one looks like sqlite:///folder/file.db") from None
    if url.get_backend_name() == "sqlite" and url.database in (None, "", ":memory:"):
        raise LibraryError(f"{location} would be forgotten with the program; name a file: sqlite:///folder/file.db")
    return url


def _file(url: URL) -> Path | None:
    """The file of an SQLite database; None for any other, and where SQLite gets an address of its own (``file:``)."""
    if url.get_backend_name() != "sqlite" or url.database is None or url.database.startswith("file:"):
        return None
    return Path(url.database)


def _engine(url: URL, location: str) -> Engine:
    sqlite = url.get_backend_name() == "sqlite"
    try:
        # A connection for each transaction: nothing stays open, and none is shared with a process that forks.
        engine = create_engine(url, poolclass=NullPool, connect_args={"timeout": PATIENCE_S} if sqlite else {})
    except NoSuchModuleError:
        raise LibraryError(
            f"{location}: SQLAlchemy knows no database {url.drivername!r}; one looks like sqlite:///folder/file.db"
        ) from None
    except ModuleNotFoundError as error:
        raise LibraryError(
            f"{location}: the driver {error.name!r} of this database is not installed; pip install {error.name}"
        ) from None
    engine = engine.execution_options(understudy_location=location)
    if sqlite:
        event.listen(engine, "connect", _prepare)
        event.listen(engine, "begin", _begin)
    return engine


def _prepare(connection: Any, _: object) -> None:
    connection.isolation_level = None  # Python's sqlite3 does not begin transactions by itself then; _begin does
    connection.execute("PRAGMA foreign_keys = ON")
    connection.execute("PRAGMA synchronous = FULL")


def _begin(connection: Connection) -> None:
    writes = connection.get_execution_options().get("understudy_writes", False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")


def _make(file: Path, location: str) -> None:
    """A new library, whole or not at all: two processes may make it at once, and either may be killed."""
    part = file.with_name(f".{file.name}.{os.getpid()}.part")
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        part.unlink(missing_ok=True)
    except OSError as error:
        raise LibraryError(f"{location}: no library can be made there: {error.strerror}") from None
    try:
        engine = _engine(URL.create("sqlite", database=str(part)), location)
        with writing(engine) as connection:
            _make_tables(connection)
        with closing(engine.raw_connection()) as raw:
            raw.cursor().execute("PRAGMA journal_mode = WAL")  # stays with the file; not within a transaction
        with suppress(FileExistsError):  # somebody else was faster
            os.link(part, file)
    except OSError as error:
        raise LibraryError(f"{location}: no library can be made there: {error.strerror}") from None
    finally:
        part.unlink(missing_ok=True)


def _make_tables(connection: Connection) -> None:
    METADATA.create_all(connection)
    connection.execute(VERSIONS.insert(), {"version": SCHEMA_VERSION})


def _name(engine: Engine) -> str:
    return str(engine.get_execution_options().get("understudy_location", engine.url))


@contextmanager
def _told(location: str) -> Iterator[None]:
    """Makes one line of what the database says."""
    try:
        yield
    except DBAPIError as error:
        said = " ".join(str(error.orig).split())
        mend = next((mend for words, mend in _MENDS if any(word in said.lower() for word in words)), "")
        raise LibraryError(f"{location}: {mend or 'the database refuses'} ({said})") from None
    except SQLAlchemyError as error:
        raise LibraryError(f"{location}: {' '.join(str(error).split())}") from None
