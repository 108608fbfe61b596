"""What is exported comes in again as it was; what does not agree with itself is refused whole."""

import json
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from understudy.errors import DocumentError, LibraryError, UnderstudyError
from understudy.library import Archive, Library, export_task

from .tasks import library_in, text_of


def filled(folder: Path) -> Library:
    library = library_in(folder)
    with library.writing() as add:
        add.revision("visits", text_of("green", "red"), cause="learned", evidence={"demonstrations": ["one"]})
        add.sitting(
            "visits",
            "demonstration",
            name="one",
            revision=1,
            file=add.file(b"shown", ".mcap"),
            shown=text_of("green", "red"),
        )
        add.revision("visits", text_of("green"), cause="BAD", parent=1)
        add.revision("visits", text_of("red"), cause="BAD", parent=1, accepted=False)
        run = add.file(b"done", ".mcap")
        add.sitting("visits", "run", name="visits", revision=2, file=run, achieved=["track-green-1"], outcome="done")
    return library


def everything(library: Library, name: str = "visits") -> tuple[object, ...]:
    sittings = library.sittings(name)
    return library.history(name), sittings, tuple(library.file(one.file) for one in sittings)


def test_a_task_comes_into_another_library_as_it_was(tmp_path: Path) -> None:
    library, other = filled(tmp_path), library_in(tmp_path, "other.db")
    export_task(library, "visits", tmp_path / "visits.zip")
    archive = Archive.read(tmp_path / "visits.zip")
    assert archive.head.number == 2
    archive.add_to(other, "visits", accepted=False)
    assert everything(other) == everything(library)
    assert archive.add_to(other, "visits", accepted=True) == ((), ()), "what is the same is recognised"
    assert everything(other) == everything(library)


def test_the_same_task_gives_the_same_archive(tmp_path: Path) -> None:
    library = filled(tmp_path)
    for name in ("one.zip", "two.zip"):
        export_task(library, "visits", tmp_path / name)
    assert (tmp_path / "one.zip").read_bytes() == (tmp_path / "two.zip").read_bytes()
    with pytest.raises(DocumentError, match="nothing is overwritten"):
        export_task(library, "visits", tmp_path / "one.zip")
    with pytest.raises(LibraryError, match="there are: visits"):
        export_task(library, "fetch", tmp_path / "three.zip")
    assert not (tmp_path / "three.zip").exists()


@pytest.mark.parametrize("accepted", [True, False])
def test_histories_that_parted_come_together_as_branches(tmp_path: Path, accepted: bool) -> None:
    library, other = filled(tmp_path), library_in(tmp_path, "other.db")
    export_task(library, "visits", tmp_path / "begin.zip")
    Archive.read(tmp_path / "begin.zip").add_to(other, "visits", accepted=True)
    with library.writing() as add:
        mine = add.revision("visits", text_of("pink"), cause="edited by hand", parent=2)
    with other.writing() as add:
        add.revision("visits", text_of("yellow"), cause="edited by hand", parent=2, note="elsewhere")
        add.revision("visits", text_of("orange"), cause="edited by hand", parent=4, note="elsewhere")
        add.sitting("visits", "run", name="elsewhere", revision=5, achieved=["track-orange-1"])
    export_task(other, "visits", tmp_path / "their.zip")
    before = library.history("visits")
    revisions, sittings = Archive.read(tmp_path / "their.zip").add_to(library, "visits", accepted=accepted)
    assert [(one.number, one.parent, one.accepted) for one in revisions] == [(5, 2, False), (6, 5, accepted)]
    assert [(str(one), one.revision) for one in sittings] == [("run 2", 6)]
    assert library.history("visits")[:4] == before
    assert library.revision("visits").number == (6 if accepted else mine.number)


def edited(change: Callable[[dict[str, bytes]], None]) -> Callable[[Path], None]:
    def apply(path: Path) -> None:
        with zipfile.ZipFile(path) as packed:
            content = {name: packed.read(name) for name in packed.namelist()}
        change(content)
        with zipfile.ZipFile(path, "w") as packed:
            for name, data in content.items():
                packed.writestr(name, data)

    return apply


def in_index(change: Callable[[dict[str, object]], object]) -> Callable[[Path], None]:
    def apply(content: dict[str, bytes]) -> None:
        index = json.loads(content["index.json"])
        change(index)
        content["index.json"] = json.dumps(index).encode()

    return edited(apply)


def recording(content: dict[str, bytes]) -> str:
    return next(name for name in content if name.startswith("files/"))


def flipped(path: Path) -> None:
    whole = bytearray(path.read_bytes())
    whole[whole.index(b"done")] ^= 1
    path.write_bytes(whole)


@pytest.mark.parametrize(
    ("damage", "problem"),
    [
        (lambda path: path.write_bytes(path.read_bytes()[:-40]), "no archive of a task, or it breaks off"),
        (lambda path: path.write_text("understudy: task/1"), "no archive of a task"),
        (flipped, "the file is damaged here"),
        (edited(lambda content: content.pop("index.json")), "index.json: it is missing"),
        (edited(lambda content: content.pop("revisions/2.yaml")), "revisions/2.yaml: it is missing"),
        (edited(lambda content: content.pop(recording(content))), "it is missing"),
        (edited(lambda content: content.update({recording(content): b"else"})), "not what its name says"),
        (edited(lambda content: content.update({"index.json": b"{"})), "no JSON"),
        (edited(lambda content: content.update({"index.json": b"\xff"})), "no text in UTF-8"),
        (edited(lambda content: content.update({"revisions/1.yaml": b"understudy: world/1"})), "visits@1"),
        (edited(lambda content: content.update({"shown/1.yaml": b"no task"})), "demonstration 1"),
        (in_index(lambda index: index.update(understudy="archive/2")), "no archive document"),
        (in_index(lambda index: index.update(extra=1)), "unknown key 'extra'"),
        (in_index(lambda index: index["revisions"][1].update(parent=3)), "revision 2 is there twice, or stands"),
        (in_index(lambda index: index["revisions"][1].update(number=1)), "revision 1 is there twice"),
        (in_index(lambda index: index["sittings"][1].update(revision=9)), "run 1 is of revision 9"),
        (in_index(lambda index: index["sittings"][1].update(achieved=["drop-1"])), "no such step"),
        (in_index(lambda index: index["revisions"][0].update(made_at="2000-01-01T00:00:00")), "timezone"),
    ],
)
def test_what_is_damaged_or_foreign_is_refused_whole(
    tmp_path: Path, damage: Callable[[Path], None], problem: str
) -> None:
    path, other = tmp_path / "visits.zip", library_in(tmp_path, "other.db")
    export_task(filled(tmp_path), "visits", path)
    damage(path)
    with pytest.raises(UnderstudyError, match=problem):
        Archive.read(path).add_to(other, "visits", accepted=True)
    assert other.names() == ()
