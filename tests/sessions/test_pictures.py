"""What pictures and words say of demonstrations and of recorded runs, and what ``show`` refuses."""

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from matplotlib.figure import Figure
from typer.testing import CliRunner

from understudy.cli.app import app
from understudy.errors import NetworkError, WorldError
from understudy.geometry import Pose
from understudy.network import Component, Link, LinkType, Network, Task, task_text
from understudy.recording import Recorder, read_recording
from understudy.robot import PIONEER, Cue, Observation, Odometry, Scan
from understudy.sessions import pictures
from understudy.sim import World

from .conftest import Demonstrated

WORLD = {
    "understudy": "world/1",
    "name": "room",
    "seed": 0,
    "arena": {"size": [4.0, 4.0]},
    "targets": [{"color": "green", "at": [3.0, 2.0]}],
    "boxes": [{"color": "orange", "at": [1.0, 3.0]}],
    "robots": [{"name": "learner", "at": [1.0, 1.0]}],
}
NETWORK = Network(
    (
        Component(id="go", behavior="Track", parameters={"color": "green", "distance_m": 0.545, "angle_deg": 90.0}),
        Component(id="drop", behavior="Drop"),
    ),
    (Link(source="go", target="drop", type=LinkType.ORDERING),),
)
DOCUMENTS = {"world.yaml": yaml.safe_dump(WORLD).encode(), "task.yaml": task_text(Task.of("fetch", NETWORK)).encode()}
ACHIEVED = {"time_s": 0.5, "kind": "achieved", "component": "go", "on_purpose": True}
STOPPED = {"time_s": 2.0, "kind": "stopped", "reason": "the time limit of 2 s"}
COMPLETE = {"time_s": 2.0, "kind": "complete"}


def recorded(path: Path, *events: Mapping[str, Any], kind: Any = "run", documents: Any = DOCUMENTS) -> Path:
    """Two seconds of driving straight on."""
    with Recorder(path, kind=kind, name="fetch", spec=PIONEER, attachments=documents) as into:
        for step in range(21):
            into.observation(
                Observation(
                    time_s=step / 10,
                    scan=Scan(ranges=np.full(181, 2.0, np.float32)),
                    odometry=Odometry(pose=Pose(0.03 * step, 0.0, 0.0)),
                    cues=(Cue.START,) if step == 0 and kind == "demonstration" else (),
                )
            )
        for event in events:
            into.event(event)
    return path


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> dict[str, list[str]]:
    """The texts of every picture, by its file's name, instead of files."""
    texts: dict[str, list[str]] = {}

    def look(figure: Figure, path: Path) -> list[Path]:
        texts[path.name] = [text.get_text() for text in figure.axes[0].texts]
        return []

    monkeypatch.setattr(pictures, "save", look)
    return texts


def picture(path: Path) -> None:
    pictures.picture_recording(read_recording(path), World.from_data(WORLD), NETWORK, Path("rec"))


@pytest.mark.parametrize(
    ("events", "ending"),
    [
        ((ACHIEVED, STOPPED), "Not done: the time limit of 2 s."),
        ((ACHIEVED, COMPLETE), "Done after 2.0 s."),
        ((ACHIEVED,), "Not done: it breaks off at 2.0 s."),
    ],
)
def test_pictures_of_a_run_say_how_it_ended(
    tmp_path: Path, drawn: dict[str, list[str]], events: tuple[Mapping[str, Any], ...], ending: str
) -> None:
    picture(recorded(tmp_path / "a.mcap", *events))
    assert drawn.keys() == {"rec-room", "rec-progress"}
    assert f"{ending} The robot's way as its wheels counted it." in " ".join(drawn["rec-room"])
    assert ending in drawn["rec-progress"]


def test_boxes_of_a_recording_are_where_they_stood_at_the_start(tmp_path: Path, drawn: dict[str, list[str]]) -> None:
    picture(recorded(tmp_path / "a.mcap"))
    assert "orange box, at the start" in drawn["rec-room"]
    assert "orange box" not in drawn["rec-room"]


def test_a_whole_demonstration_has_nothing_to_be_done(tmp_path: Path, drawn: dict[str, list[str]]) -> None:
    path = recorded(tmp_path / "a.mcap", kind="demonstration")
    picture(path)
    assert drawn["rec-room"][:2] == ["fetch", "The robot's way as its wheels counted it."]
    path.write_bytes(path.read_bytes()[:-100])
    picture(path)
    assert drawn["rec-room"][1].startswith("It breaks off at 2.0 s. The robot's way")


def test_a_demonstration_shows_where_the_box_was_taken(
    demonstrated: Callable[[str], Demonstrated], drawn: dict[str, list[str]]
) -> None:
    shown = demonstrated("transport")
    pictures.picture_demonstration(shown.taught, shown.lesson, Path("demo"))
    # Its name stands beside it, and beside its path's sample.
    assert drawn["demo-room"].count("orange box") == 2
    assert "Numbers: where the robot was when the teacher spoke." in " ".join(drawn["demo-room"])


def test_a_silent_demonstration_has_no_numbers(
    demonstrated: Callable[[str], Demonstrated], drawn: dict[str, list[str]]
) -> None:
    shown = demonstrated("transport")
    silent = replace(shown.taught, demonstration=replace(shown.taught.demonstration, cues=()))
    pictures.picture_demonstration(silent, shown.lesson, Path("demo"))
    assert drawn["demo-room"][:2] == ["transport: the demonstration", "The robot follows its teacher."]


def show(*arguments: object, refused: bool = False) -> str:
    """What ``understudy show`` prints; or its refusal, of which nothing else may be printed."""
    done = CliRunner().invoke(app, ["show", *map(str, arguments)])
    if refused:
        assert done.exit_code == 2
        assert done.stdout == ""
        return " ".join(done.stderr.split())
    assert done.exit_code == 0, done.output
    return done.stdout


def test_show_tells_how_a_run_ended_and_what_was_missing(tmp_path: Path) -> None:
    lines = show(recorded(tmp_path / "late.mcap", ACHIEVED, STOPPED)).splitlines()
    assert lines[:4] == [
        "fetch: a run of 2.0 s",
        "  Not done: the time limit of 2 s",
        "     0.5 s  go",
        "  not achieved: drop",
    ]
    done = show(recorded(tmp_path / "done.mcap", ACHIEVED, ACHIEVED | {"component": "drop"}, COMPLETE))
    assert "  Done after 2.0 s\n" in done
    assert "not achieved" not in done
    told = show(recorded(tmp_path / "demo.mcap", kind="demonstration")).splitlines()
    assert told[0] == "fetch: a demonstration of 2.0 s"
    assert told[1].startswith("  topics: ")


def test_show_tells_other_programs_the_same(tmp_path: Path) -> None:
    record = json.loads(show(recorded(tmp_path / "late.mcap", ACHIEVED, STOPPED), "--json"))
    assert (record["done"], record["reason"]) == (False, "the time limit of 2 s")
    assert record["achieved"] == [{"component": "go", "time_s": 0.5}]
    assert record["missing"] == ["drop"]
    record = json.loads(show(recorded(tmp_path / "done.mcap", COMPLETE, documents={}), "--json"))
    assert (record["done"], record["reason"], record["achieved"], record["missing"]) == (True, None, [], None)
    record = json.loads(show(recorded(tmp_path / "demo.mcap", kind="demonstration"), "--json"))
    assert "done" not in record
    assert "achieved" not in record


@pytest.mark.parametrize("given", ["pictures/a.b", "pictures/a.b.png", "pictures/a.b.SVG"])
def test_a_pictures_name_may_have_the_suffix_of_one_of_its_files(tmp_path: Path, given: str) -> None:
    (tmp_path / "fetch.yaml").write_bytes(DOCUMENTS["task.yaml"])
    show(tmp_path / "fetch.yaml", "-p", tmp_path / given)
    assert sorted(file.name for file in (tmp_path / "pictures").iterdir()) == ["a.b.png", "a.b.svg"]


@pytest.mark.parametrize("given", ["a.pdf", "a.JPG"])
def test_another_kind_of_picture_is_refused(tmp_path: Path, given: str) -> None:
    (tmp_path / "fetch.yaml").write_bytes(DOCUMENTS["task.yaml"])
    message = show(tmp_path / "fetch.yaml", "-p", tmp_path / given, refused=True)
    assert "pictures are written as PNG and SVG" in message
    assert [file.name for file in tmp_path.iterdir()] == ["fetch.yaml"]


def test_a_recording_without_a_room_and_a_task_has_no_pictures(tmp_path: Path) -> None:
    path = recorded(tmp_path / "a.mcap", documents={})
    done = CliRunner().invoke(app, ["show", str(path), "-p", str(tmp_path / "a")])
    assert done.exit_code == 0
    assert "neither a world nor a task is attached" in done.stderr


def test_only_one_thing_can_be_printed(tmp_path: Path) -> None:
    (tmp_path / "fetch.yaml").write_bytes(DOCUMENTS["task.yaml"])
    assert "give one of them" in show(tmp_path / "fetch.yaml", "--dot", "--json", refused=True)
    message = show(recorded(tmp_path / "a.mcap"), "--dot", refused=True)
    assert "--dot prints the network of a task, and this is a recording" in message


@pytest.mark.parametrize(
    ("name", "kind"), [("world.yaml", WorldError), ("task.yaml", NetworkError)], ids=["world", "task"]
)
@pytest.mark.parametrize(
    ("content", "problem"), [(b"a: [", "this is no YAML"), (b"\xff\xfe", "no text in UTF-8"), (b"x: 1", "x")]
)
def test_a_broken_attachment_is_named(tmp_path: Path, name: str, kind: type, content: bytes, problem: str) -> None:
    path = recorded(tmp_path / "a.mcap", documents=DOCUMENTS | {name: content})
    done = CliRunner().invoke(app, ["show", str(path), "-p", str(tmp_path / "a")])
    assert isinstance(done.exception, kind)
    message = str(done.exception)
    assert message.startswith(f"{path}: {name}: ")
    assert problem in message
    assert "\n" not in message
    assert [file.name for file in tmp_path.iterdir()] == ["a.mcap"]
