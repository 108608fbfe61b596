"""The library as a user meets it: what is kept, what is asked, what is refused."""

import json
import shlex
import sys
from pathlib import Path

import pytest
import yaml

from tests.tiny import TINY
from understudy.cli.app import main
from understudy.library import Library
from understudy.network import Task, task_text

from ..library.tasks import clock, text_of, visiting


class Terminal:
    """Commands in one folder, in this process: its own takes a second to start."""

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
        self.folder, self._monkeypatch, self._capsys = folder, monkeypatch, capsys
        monkeypatch.chdir(folder)
        monkeypatch.delenv("UNDERSTUDY_LIBRARY", raising=False)

    def __call__(self, command: str, *, expect: int = 0) -> str:
        """What a command prints; of one that is to fail, what it complains of."""
        self._monkeypatch.setattr(sys, "argv", ["understudy", *shlex.split(command)])
        with pytest.raises(SystemExit) as ended:
            main()
        said = self._capsys.readouterr()
        assert ended.value.code == expect, said.out + said.err
        return said.err if expect == 2 else said.out

    def json(self, command: str) -> dict[str, object]:
        found: dict[str, object] = json.loads(self(f"{command} --json"))
        return found

    def shown(self, name: str, *colors: str) -> None:
        """Writes a document of targets, visited one after the other."""
        intervals = [
            {
                "label": "Track",
                "start": 10 * place,
                "end": 10 * place + 8,
                "parameters": {"color": color, "distance_m": 0.6, "angle_deg": 90},
            }
            for place, color in enumerate(colors)
        ]
        data = {"understudy": "intervals/1", "name": name, "intervals": intervals}
        (self.folder / f"{name}.yaml").write_text(yaml.safe_dump(data), encoding="utf-8")

    def library(self) -> Library:
        return Library(str(self.folder / "understudy-out" / "library.db"), now=clock())

    def answers(self, answer: bool) -> list[str]:
        """From now on somebody sits there, and says yes or no; the questions are collected."""
        asked: list[str] = []

        def confirm(question: str, **more: object) -> bool:
            asked.append(question)
            return answer

        self._monkeypatch.setattr("understudy.cli.replaying._attended", lambda: True)
        self._monkeypatch.setattr("typer.confirm", confirm)
        return asked


@pytest.fixture
def terminal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Terminal:
    return Terminal(tmp_path, monkeypatch, capsys)


def test_nothing_is_kept_unless_a_name_is_given(terminal: Terminal) -> None:
    terminal.shown("one", "green", "red")
    terminal("learn one.yaml")
    assert "understudy tasks [OPTIONS] COMMAND" in terminal("tasks")
    assert not list(terminal.folder.rglob("*.db"))
    assert "nothing in understudy-out/library.db yet" in terminal("tasks list")
    for command in ("history one", "show one", "diff one", "revert one 1", "export one one.zip"):
        assert "there is no library in understudy-out/library.db yet" in terminal(f"tasks {command}", expect=2)
    assert "no library in understudy-out/library.db" in terminal("show one", expect=2)
    assert not list(terminal.folder.rglob("*.db")), "looking makes none"


def test_a_lesson_is_kept_with_what_it_was_learned_from(terminal: Terminal) -> None:
    terminal.shown("one", "green", "red")
    told = terminal("learn one.yaml --save visits")
    assert "Kept in the library: demonstration 1 of visits@1" in told
    assert told.endswith("Next: understudy run visits --world WORLD\n")
    library = terminal.library()
    (shown,) = library.sittings("visits")
    assert library.file(shown.file) == (".yaml", (terminal.folder / "one.yaml").read_bytes())
    assert library.revision("visits").document == (terminal.folder / "understudy-out" / "visits.yaml").read_text()
    terminal("tasks recording visits demonstration 1 again.yaml")
    assert (terminal.folder / "again.yaml").read_bytes() == (terminal.folder / "one.yaml").read_bytes()
    assert "nothing is overwritten" in terminal("tasks recording visits demonstration 1 again.yaml", expect=2)
    assert "has no run 1; there are: none" in terminal("tasks recording visits run 1 run.mcap", expect=2)
    assert terminal("tasks show visits --document") == library.revision("visits").document
    assert terminal("tasks show visits").startswith("visits@1: learned from one, ")
    assert terminal("tasks list").startswith("  visits  @1  1 revision, 1 demonstration, 0 runs, 0 practice runs  ")
    assert terminal.json("tasks history visits")["revisions"][0]["evidence"] == {"demonstrations": ["one"]}


def test_a_name_stands_wherever_a_task_is_taken(terminal: Terminal) -> None:
    terminal.shown("one", "green", "red")
    terminal.shown("two", "green", "pink")
    terminal("learn one.yaml --save visits")
    terminal("generalize visits two.yaml")
    assert terminal("show visits@1").startswith("visits: 2 steps")
    assert "4 steps" not in terminal("show visits")
    assert terminal("language visits --compare visits@1").startswith("Whatever visits")
    Path("visits").write_text(text_of("yellow"))
    assert "yellow" in terminal("show visits"), "a file goes first"
    assert "there are visits@1 to visits@2" in terminal("show visits@7", expect=2)
    assert "among those in the library understudy-out/library.db: visits" in terminal("show fetch", expect=2)
    assert "name of a task that comes with the program" in terminal("learn one.yaml --save delivery", expect=2)


def test_another_demonstration_fits_with_the_first(terminal: Terminal) -> None:
    terminal.shown("one", "green", "red")
    terminal.shown("two", "green", "pink", "red")
    terminal("learn one.yaml --save visits")
    kept = terminal.json("generalize visits two.yaml")["kept"]
    assert kept == {
        "revisions": ["visits@2"],
        "sittings": ["demonstration 2 of visits@2"],
        "accepted": True,
        "misfits": [],
    }
    assert "1 demonstration fits" not in terminal("tasks history visits")
    assert terminal("tasks history visits").splitlines()[2].startswith("→   2  ")


def edited(terminal: Terminal, *colors: str) -> None:
    """Somebody writes another task of the same name."""
    terminal.shown("one", "green", "red")
    terminal("learn one.yaml --save visits")
    text = task_text(Task.of("visits", visiting(*colors)))
    (terminal.folder / "hand.yaml").write_text(text, encoding="utf-8")


@pytest.mark.parametrize("flag", ["", " --refuse-misfits"])
def test_what_no_longer_fits_makes_a_proposal_of_an_edit(terminal: Terminal, flag: str) -> None:
    edited(terminal, "green")
    told = terminal(f"tasks import hand.yaml --name visits{flag}")
    assert told.splitlines() == [
        "demonstration 1 (one) no longer fits: not in the task: go to the red target",
        "Kept in the library: visits@2 (edited by hand), as a proposal",
        "visits is as it was. To take it: understudy tasks revert visits 2",
    ]
    library = terminal.library()
    assert library.revision("visits").number == 1
    assert "(a proposal)" in terminal("tasks history visits")
    terminal("tasks revert visits 2")
    assert library.revision("visits").document == library.revision("visits", 2).document
    again = terminal("tasks import hand.yaml --name visits")
    assert again == "All of it is in the library already.\n"


@pytest.mark.parametrize("answer", [True, False])
def test_whoever_sits_there_is_asked(terminal: Terminal, answer: bool) -> None:
    edited(terminal, "green")
    asked = terminal.answers(answer)
    kept = terminal.json("tasks import hand.yaml --name visits")["kept"]
    assert asked == ["Shall visits be so all the same?"]
    assert kept["accepted"] is answer  # type: ignore[index]
    assert kept["misfits"] == [{"what": "demonstration 1", "why": "not in the task: go to the red target"}]  # type: ignore[index]


def test_nobody_is_asked_who_has_said_yes_or_where_all_fits(terminal: Terminal) -> None:
    edited(terminal, "green")
    asked = terminal.answers(False)
    terminal("tasks import hand.yaml --name visits --yes")
    assert terminal.library().revision("visits").number == 2
    (terminal.folder / "same.yaml").write_text(text_of("green"), encoding="utf-8")
    terminal("tasks import same.yaml --name visits")
    assert asked == []


def test_a_difference_is_named(terminal: Terminal) -> None:
    edited(terminal, "green")
    terminal("tasks import hand.yaml --name visits --yes")
    told = terminal("tasks diff visits").splitlines()
    assert told[:2] == ["From visits@1 to visits@2:", "  track-red-1 is gone"]
    assert "    track-red-1: go to the red target, until it is 0.60 m ahead" in told
    assert "track-red-1 (Track) is new" in terminal.json("tasks diff visits 2 1")["differences"]  # type: ignore[operator]
    assert terminal("tasks diff visits 2 2").splitlines()[1] == "  nothing; both do the same"
    terminal("learn one.yaml --save alone")
    assert "was made from none before it; name two revisions" in terminal("tasks diff alone", expect=2)


def test_an_archive_goes_to_another_library_and_comes_back(terminal: Terminal) -> None:
    edited(terminal, "green")
    terminal("tasks export visits visits.zip")
    assert "nothing is overwritten" in terminal("tasks export visits visits.zip", expect=2)
    assert terminal("tasks import visits.zip") == "All of it is in the library already.\n"
    told = terminal("tasks import visits.zip --library other.db")
    assert told.splitlines() == [
        "Kept in the library: demonstration 1 of visits@1",
        "Kept in the library: visits@1 (learned)",
    ]
    terminal("tasks import hand.yaml --name visits --yes --library other.db")
    terminal("tasks export visits their.zip --library other.db")
    assert "no longer fits" in terminal("tasks import their.zip")
    assert terminal.library().revision("visits").number == 1
    assert "cannot be read" in terminal("tasks import one.zip", expect=2)


def test_an_archive_of_another_task_gets_another_name(terminal: Terminal) -> None:
    edited(terminal, "green")
    terminal("tasks import hand.yaml --name visits --library other.db")
    terminal("tasks export visits other.zip --library other.db")
    assert "visits is another task" in terminal("tasks import other.zip --name visits", expect=2)
    assert "visits-2@1 (imported)" in terminal("tasks import other.zip")
    assert terminal("tasks import other.zip --name third").endswith("third@1 (imported)\n")


def test_a_library_can_be_named(terminal: Terminal, monkeypatch: pytest.MonkeyPatch) -> None:
    terminal.shown("one", "green")
    monkeypatch.setenv("UNDERSTUDY_LIBRARY", "mine.db")
    terminal("learn one.yaml --save visits")
    assert terminal("tasks list --library sqlite:///mine.db") == terminal("tasks list")
    assert not (terminal.folder / "understudy-out" / "library.db").exists()
    assert "mine.db" in terminal("show fetch", expect=2)
    for place, problem in (
        ("one.yaml", "no library; name another"),
        ("postgresql+psycopg2://robot@nowhere/tasks", "driver 'psycopg2' of this database is not installed"),
    ):
        said = terminal(f"tasks list --library {place}", expect=2)
        assert problem in said
        assert said.count("\n") == 1


def test_what_was_planned_is_kept(terminal: Terminal) -> None:
    kept = terminal.json('plan "visited(green)" --save visits')["kept"]
    assert kept["revisions"] == ["visits@1"]  # type: ignore[index]
    assert terminal.json("tasks show visits")["evidence"] == {"goal": "visited(green)"}


def test_a_lesson_that_is_taken_back_leaves_the_robot_as_it_was(terminal: Terminal) -> None:
    """The document is the earlier one to the byte; and so is what the robot does with it, sensed tick by tick."""
    (terminal.folder / "tiny.yaml").write_text(yaml.safe_dump(TINY), encoding="utf-8")
    (terminal.folder / "hand.yaml").write_text(text_of("green"), encoding="utf-8")
    terminal("tasks import hand.yaml --name visits")

    def run() -> tuple[str, bytes]:
        kept = terminal.json("run visits --world tiny.yaml --seed 5")["kept"]
        sitting = terminal.library().sittings("visits", "run")[-1]
        assert kept["sittings"] == [f"{sitting} of visits@{sitting.revision}"]  # type: ignore[index]
        assert sitting.achieved == ("track-green-1",)
        return terminal("tasks show visits --document"), terminal.library().file(sitting.file)[1]

    before = run()
    farther = text_of("green").replace("0.5", "0.8")
    assert farther != text_of("green")
    (terminal.folder / "far.yaml").write_text(farther, encoding="utf-8")
    terminal("tasks import far.yaml --name visits --yes")
    between = run()
    terminal("tasks revert visits 1")
    after = run()
    assert before == after
    assert between[1] != before[1]
    assert [one.revision for one in terminal.library().sittings("visits")] == [1, 2, 3]
    told = terminal("tasks revert visits 3", expect=2)
    assert "there is nothing to go back to" in told


def test_every_correction_of_a_practice_run_is_a_revision(terminal: Terminal) -> None:
    terminal("tasks import practice --name visits")
    kept = terminal.json("practice visits --world practice")["kept"]
    assert kept == {
        "revisions": ["visits@2", "visits@3"],
        "sittings": ["practice run 1 of visits@1"],
        "accepted": True,
        "misfits": [],
    }
    bad, come = terminal.library().history("visits")[1:]
    assert (bad.cause, bad.parent, come.cause, come.parent) == ("BAD", 1, "COME … GO", 2)
    assert bad.evidence["component"] == "track-red-1"
    assert terminal("tasks diff visits 2 3").splitlines()[1] == "  track-light-orange-1 (Track) is new"
