"""Nothing is lost and nothing is changed, whoever writes, dies, or fails meanwhile."""

import random
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path

import pytest
from sqlalchemy import text
from sqlalchemy.dialects import postgresql
from sqlalchemy.schema import CreateTable

from understudy.errors import LibraryError
from understudy.library import Library, name_and_number, network_of
from understudy.library.opening import open_engine, reading, writing
from understudy.library.schema import METADATA

from .tasks import clock, library_in, text_of, visiting


def test_a_revision_comes_back_as_it_was(tmp_path: Path) -> None:
    library = library_in(tmp_path)
    with library.writing() as add:
        first = add.revision("visits", text_of("green"), cause="learned", evidence={"demonstrations": ["one – é"]})
        second = add.revision("visits", text_of("red"), cause="BAD", parent=1, note="why", accepted=False)
    again = library_in(tmp_path)
    assert again.history("visits") == (first, second)
    assert network_of(again.revision("visits", 1))[1] == visiting("green")
    assert again.revision("visits").number == 1, "a proposal is not what the name stands for"
    assert str(again.revision("visits", 2)) == "visits@2"


def test_what_is_not_there_is_said_with_what_is(tmp_path: Path) -> None:
    library = library_in(tmp_path)
    with pytest.raises(LibraryError, match="no task 'visits'; there are: none"):
        library.history("visits")
    with library.writing() as add:
        add.revision("visits", text_of("green"), cause="learned", accepted=False)
    with pytest.raises(LibraryError, match="did you mean 'visits'"):
        library.history("visit")
    with pytest.raises(LibraryError, match="has no revision 2; there are visits@1 to visits@1"):
        library.revision("visits", 2)
    with pytest.raises(LibraryError, match="nothing of visits was accepted yet"):
        library.revision("visits")
    with pytest.raises(LibraryError, match="no revision 7 from which"), library.writing() as add:
        add.revision("visits", text_of("red"), cause="learned", parent=7)
    with pytest.raises(LibraryError, match="cannot be a run of it"), library.writing() as add:
        add.sitting("visits", "run", name="visits", revision=7)
    with pytest.raises(LibraryError, match="holds no file"), library.writing() as add:
        add.sitting("visits", "run", name="visits", revision=1, file="0" * 64)
    assert len(library.history("visits")) == 1
    assert library.sittings("visits") == ()


@pytest.mark.parametrize("name", ["", " ", "a/b", "a@2", "a\\b", "x" * 81, "delivery"])
def test_what_cannot_be_a_name_is_refused(name: str, tmp_path: Path) -> None:
    library = library_in(tmp_path)
    with pytest.raises(LibraryError, match="name of a task"), library.writing() as add:
        add.revision(name, text_of("green"), cause="learned")
    assert library.names() == ()


def test_names_with_revisions_are_taken_apart() -> None:
    assert name_and_number("fetch") == ("fetch", None)
    assert name_and_number("fetch@12") == ("fetch", 12)
    for wrong in ("fetch@", "fetch@x", "fetch@0", "fetch@-1"):
        with pytest.raises(LibraryError, match="as in fetch@3"):
            name_and_number(wrong)


def test_a_transaction_is_kept_whole_or_not_at_all(tmp_path: Path) -> None:
    library = library_in(tmp_path)

    def interrupted() -> None:
        with library.writing() as add:
            add.revision("visits", text_of("green"), cause="learned")
            add.file(b"recorded", ".mcap")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        interrupted()
    assert library.names() == ()
    with library.writing() as add:
        one, other = add.file(b"recorded", ".mcap"), add.file(b"recorded", ".mcap")
    assert one == other
    assert library.file(one) == (".mcap", b"recorded")


def test_no_row_can_be_changed_or_taken_out(tmp_path: Path) -> None:
    library = library_in(tmp_path)
    with library.writing() as add:
        sha256 = add.file(b"recorded", ".mcap")
        add.revision("visits", text_of("green"), cause="learned")
        add.sitting("visits", "run", name="visits", revision=1, file=sha256)
    for table in METADATA.tables:
        for verb in (f"DELETE FROM {table}", f"UPDATE {table} SET rowid = rowid + 1"):
            with (
                pytest.raises(LibraryError, match="forgets nothing"),
                writing(open_engine(library.location)) as connection,
            ):
                connection.execute(text(verb))


def test_a_damaged_recording_is_noticed(tmp_path: Path) -> None:
    library = library_in(tmp_path)
    with library.writing() as add:
        sha256 = add.file(b"recorded", ".mcap")
    raw = sqlite3.connect(library.location)
    raw.execute("DROP TRIGGER files_no_update")
    raw.execute("UPDATE files SET content = x'00'")
    raw.commit()
    raw.close()
    with pytest.raises(LibraryError, match="damaged"):
        library.file(sha256)


def test_every_refusal_of_the_database_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "note.db").write_text("not a database at all, but more than a hundred characters " * 3)
    (tmp_path / "empty.db").touch()
    sqlite3.connect(tmp_path / "other.db").execute("CREATE TABLE things (id INTEGER)").connection.close()
    library_in(tmp_path, "newer.db")
    raw = sqlite3.connect(tmp_path / "newer.db")
    raw.execute("INSERT INTO understudy_library VALUES (2)")
    raw.execute("DROP TRIGGER understudy_library_no_delete")
    raw.execute("DELETE FROM understudy_library WHERE version = 1")
    raw.commit()
    raw.close()
    (tmp_path / "file").touch()
    for location, problem in (
        ("note.db", "no library; name another one with --library"),
        ("empty.db", "no library of Understudy; name another one with --library"),
        ("other.db", "no library of Understudy"),
        ("newer.db", "version 2, and this Understudy reads up to 1; upgrade understudy"),
        ("file/library.db", "no library can be made there"),
        (".", "cannot be opened; name a file in a folder that you may write to"),
    ):
        with pytest.raises(LibraryError, match=problem) as caught:
            library_in(tmp_path, location)
        assert "\n" not in str(caught.value)
        assert str(tmp_path) in str(caught.value)


@pytest.mark.parametrize(
    ("url", "problem"),
    [
        ("postgresql+psycopg2://robot@nowhere/library", "driver 'psycopg2' of this database is not installed; pip"),
        ("gramophone://library", "knows no database 'gramophone'"),
        ("://", "no URL of a database"),
        ("sqlite://", "would be forgotten"),
        ("sqlite:///:memory:", "would be forgotten"),
    ],
)
def test_a_url_that_cannot_be_used_is_refused(url: str, problem: str) -> None:
    with pytest.raises(LibraryError, match=problem):
        Library(url, now=clock())


def test_a_library_can_be_named_by_url(tmp_path: Path) -> None:
    library = Library(f"sqlite:///{tmp_path}/by-url.db", now=clock())
    with library.writing() as add:
        add.revision("visits", text_of("green"), cause="learned")
    assert library_in(tmp_path, "by-url.db").names() == ("visits",)


def test_the_tables_can_be_made_in_another_database() -> None:
    for table in METADATA.sorted_tables:
        assert str(CreateTable(table).compile(dialect=postgresql.dialect()))


def test_one_that_may_only_be_read_can_be_read(tmp_path: Path) -> None:
    library = library_in(tmp_path)
    with library.writing() as add:
        add.revision("visits", text_of("green"), cause="learned")
    read_only = Library(f"sqlite:///file:{tmp_path}/library.db?mode=ro&uri=true", now=clock())
    assert read_only.revision("visits").number == 1
    with pytest.raises(LibraryError, match="may only be read"), read_only.writing() as add:
        add.revision("visits", text_of("red"), cause="learned")


def test_a_full_disk_keeps_what_there_was(tmp_path: Path) -> None:
    library = library_in(tmp_path)
    with library.writing() as add:
        add.revision("visits", text_of("green"), cause="learned")

    def fill() -> None:
        with library.writing() as add:
            add._connection.exec_driver_sql("PRAGMA max_page_count = 40")
            add.revision("visits", text_of("red"), cause="learned", parent=1)
            add.file(bytes(1_000_000), ".mcap")

    with pytest.raises(LibraryError, match="the disk is full, and nothing of this was kept"):
        fill()
    assert len(library.history("visits")) == 1


def test_a_lock_that_is_never_given_back_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("understudy.library.opening.PATIENCE_S", 0.0)
    library = library_in(tmp_path)
    with library.writing() as add:
        add.revision("visits", text_of("green"), cause="learned")
        with pytest.raises(LibraryError, match="another program has been writing"), library.writing():
            pass
        assert library.names() == (), "whoever reads does not wait, and sees what was kept"
    assert library.names() == ("visits",)


WRITER = """
import os, signal, sys
from tests.library.tasks import library_in, text_of
from pathlib import Path

folder, count, who, fatal = Path(sys.argv[1]), int(sys.argv[2]), sys.argv[3], int(sys.argv[4])
library = library_in(folder)
if fatal:
    # Dies at one of the statements that are put to the database, be it within a transaction.
    from sqlalchemy import event
    left = fatal
    def strike(connection, cursor, statement, *more):
        global left
        left -= 1
        if not left:
            os.kill(os.getpid(), signal.SIGKILL)
    event.listen(library._engine, "after_cursor_execute", strike)
parent = None
for number in range(count):
    with library.writing() as add:
        made = add.revision("visits", text_of("green"), cause=who, parent=parent, note=str(number))
        content = f"{who} {number} ".encode() * 20_000
        add.sitting("visits", "run", name=who, revision=made.number, file=add.file(content, ".mcap"))
    parent = made.number
    print(number, flush=True)
"""


def writer(folder: Path, count: int, who: str, fatal: int = 0) -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-c", WRITER, str(folder), str(count), who, str(fatal)],
        stdout=subprocess.PIPE,
        text=True,
        cwd=Path(__file__).parents[2],
    )


def check_consistent(library: Library) -> int:
    """Everything that is spoken of is there, and every file is what it was; so many revisions."""
    with reading(open_engine(library.location)) as connection:
        assert connection.exec_driver_sql("PRAGMA integrity_check").scalar_one() == "ok"
        assert connection.exec_driver_sql("PRAGMA foreign_key_check").all() == []
    if not library.names():
        return 0
    history = library.history("visits")
    assert [one.number for one in history] == list(range(1, len(history) + 1))
    for one in history:
        assert one.parent is None or one.parent < one.number
        assert one.document == text_of("green")
    sittings = library.sittings("visits")
    assert [one.revision for one in sittings] == [one.number for one in history], "both, or neither"
    for one in sittings:
        number = history[one.revision - 1].note
        assert library.file(one.file)[1] == f"{one.name} {number} ".encode() * 20_000
    return len(history)


def test_two_that_write_at_once_lose_nothing(tmp_path: Path) -> None:
    both = [writer(tmp_path, 50, who) for who in ("one", "two")]
    for process in both:
        process.communicate()
        assert process.returncode == 0
    library = library_in(tmp_path)
    assert check_consistent(library) == 100
    history = library.history("visits")
    for who in ("one", "two"):
        mine = [one for one in history if one.cause == who]
        assert [one.note for one in mine] == [str(number) for number in range(50)]
        assert [one.parent for one in mine] == [None, *(one.number for one in mine[:-1])]


def test_one_that_is_killed_leaves_a_whole_library(tmp_path: Path) -> None:
    chance = random.Random(7)
    kept = 0
    for _ in range(3):
        process = writer(tmp_path, 1000, "killed", fatal=chance.randrange(20, 120))
        said = process.communicate()[0].splitlines()
        assert process.returncode == -signal.SIGKILL
        now = check_consistent(library_in(tmp_path))
        assert now - kept in (len(said), len(said) + 1), "what was said to be kept is kept"
        kept = now
    for _ in range(2):
        process = writer(tmp_path, 1000, "killed")
        assert process.stdout is not None
        said = [process.stdout.readline() for _ in range(chance.randrange(1, 15))]
        process.kill()
        said += process.communicate()[0].splitlines()
        now = check_consistent(library_in(tmp_path))
        assert now - kept in (len(said), len(said) + 1)
        kept = now
