"""The command line as a user meets it: in a process of its own, exit codes, one clear line for every mistake."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import yaml

from tests.cli.program import understudy
from tests.tiny import TINY, world
from understudy.network import load_task
from understudy.recording import Recorder, read_recording
from understudy.robot import PIONEER, Cue, Observation, Scan


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a world, its recording and the task learned from it."""
    folder = tmp_path_factory.mktemp("cli")
    (folder / "tiny.yaml").write_text(yaml.safe_dump(TINY), encoding="utf-8")
    understudy("teach", "tiny.yaml", folder=folder)
    understudy("learn", "understudy-out/tiny.mcap", folder=folder)
    return folder


def test_help_names_every_command(tmp_path: Path) -> None:
    help_ = understudy("--help", folder=tmp_path).stdout
    commands = (
        "demo", "teach", "learn", "plan", "generalize", "run", "practice", "show", "explain", "language", "tasks",
        "experiment", "schema", "doctor", "sim", "calibrate", "export",
    )  # fmt: skip
    for command in commands:
        assert f"\n  {command}" in help_
        assert "Usage:" in understudy(command, "--help", folder=tmp_path).stdout


def test_without_a_command_it_helps(tmp_path: Path) -> None:
    assert understudy(folder=tmp_path).stdout == understudy("--help", folder=tmp_path).stdout


def test_help_imports_nothing_heavy() -> None:
    code = (
        "import sys, understudy.cli.app as a\n"
        "heavy = {'numpy', 'cv2', 'mujoco', 'matplotlib', 'pydantic', 'rosbags', 'scipy', 'rich.console'}\n"
        "heavy |= {'sqlalchemy'}\n"
        "print(sorted(heavy & sys.modules.keys()))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_teachers_of_other_habits_and_what_the_robot_says_to_them(tmp_path: Path) -> None:
    spoken = [{"say": "START"}, {"walk": [2.2, 0.9]}, {"say": "HERE"}, {"wait": 3.0}, {"say": "DONE"}]
    room = TINY | {"teacher": {"at": [1.3, 0.9], "script": spoken}}
    (tmp_path / "w.yaml").write_text(yaml.safe_dump(room), encoding="utf-8")
    told = understudy("teach", "w.yaml", "--habits", "instructed", "--heeds", "1", "--json", folder=tmp_path)
    record = json.loads(told.stdout)
    assert record["slips"]
    assert any(remark["what"].startswith("HERE: I ") for remark in record["remarks"])
    plain = understudy("teach", "w.yaml", folder=tmp_path).stdout
    assert "What the robot said:\n" in plain
    assert "HERE: I took note of green\n" in plain
    assert "slipped" not in plain
    refused = understudy("teach", "w.yaml", "--habits", "careless", folder=tmp_path, expect=2)
    assert "inexperienced" in refused.stderr


def test_teach_learn_run(workspace: Path) -> None:
    task, network = load_task(workspace / "understudy-out" / "tiny.yaml")
    assert task.name == "tiny"
    assert [component.id for component in network.components] == ["track-green-1"]
    done = understudy(
        "run", "understudy-out/tiny.yaml", "--world", "tiny.yaml", "-o", "runs", "--json", folder=workspace
    )
    report = json.loads(done.stdout)
    assert report["done"] is True
    assert report["rearranged"] is None
    assert report["collisions"] == {}
    assert json.loads((workspace / "runs" / "tiny-run.json").read_text()) == report
    assert read_recording(workspace / "runs" / "tiny-run.mcap").info.kind == "run"


def test_a_task_that_was_not_done_exits_with_1(workspace: Path) -> None:
    done = understudy(
        "run", "understudy-out/tiny.yaml", "-w", "tiny.yaml", "-o", "late", "--limit", "0.5", folder=workspace, expect=1
    )
    assert "Not done: time limit of 0.5 s; missing: track-green-1" in done.stdout


def test_a_run_explains_itself(workspace: Path) -> None:
    understudy("run", "understudy-out/tiny.yaml", "-w", "tiny.yaml", "-o", "why", folder=workspace)
    run = "why/tiny-run.mcap"
    every = understudy("explain", run, folder=workspace).stdout
    assert "1.  achieved" in every
    one = understudy("explain", run, "--at", "1", "--component", "1", folder=workspace).stdout
    assert one.startswith("At 1.0 s step 1, go to the green target")
    found = json.loads(understudy("explain", run, "-t", "1", "-c", "track-green-1", "--json", folder=workspace).stdout)
    assert (found["component"], found["active"]) == ("track-green-1", True)
    late = understudy("explain", run, "-t", "999", folder=workspace)
    assert "so it has stayed" in late.stderr
    unknown = understudy("explain", run, "-c", "7", folder=workspace, expect=2)
    assert "no component of this task is called '7'; there are: track-green-1" in unknown.stderr
    wrong = understudy("explain", "understudy-out/tiny.mcap", folder=workspace, expect=2)
    assert "is the recording of a demonstration; name one that understudy run has made" in wrong.stderr


def test_what_if_a_link_were_another(tmp_path: Path) -> None:
    understudy("run", "hierarchical", "-w", "hierarchical", "--limit", "6", folder=tmp_path, expect=1)
    run = "understudy-out/hierarchical-run.mcap"
    asked = ("explain", run, "--at", "1", "--what-if", "1 -> 2: none")
    told = understudy(*asked, folder=tmp_path).stdout
    assert "Had the link from step 1 (object-transport) to step 2 (visit-targets) been left out from 1.0 s on" in told
    assert "step 2 (visit-targets) would have been searching, and was waiting" in told
    record = json.loads(understudy(*asked, "--json", folder=tmp_path).stdout)
    assert (record["was"], record["instead"], record["was_done"]) == ("ordering", None, False)
    nothing = understudy("explain", run, "--at", "1", "--what-if", "1 to 2", folder=tmp_path, expect=2)
    assert "names no link and type" in nothing.stderr
    when = understudy("explain", run, "--what-if", "1 -> 2: none", folder=tmp_path, expect=2)
    assert "give --at" in when.stderr


def test_what_cannot_be_run_is_said_before(tmp_path: Path) -> None:
    task = {"understudy": "task/1", "name": "wrong", "components": [{"id": "a", "behavior": "Trak"}]}
    (tmp_path / "wrong.json").write_text(json.dumps(task), encoding="utf-8")
    shown = understudy("show", "wrong.json", folder=tmp_path)
    assert "1. Trak" in shown.stdout
    assert "It cannot be run as it is: wrong.json: components[0] (a): there is no skill called 'Trak'" in shown.stderr
    late = understudy("run", "hierarchical", "-w", "transport", "--limit", "0.2", folder=tmp_path, expect=1)
    assert "Nothing in this world is pink; the robot will search for it in vain" in late.stderr
    unnamed = understudy("show", "hierarchical", "--picture", "", folder=tmp_path, expect=2)
    assert "a picture needs a name" in unnamed.stderr


def test_a_run_is_put_aside_and_gone_on_with(workspace: Path) -> None:
    task = "understudy-out/tiny.yaml"
    understudy("run", task, "-w", "tiny.yaml", "-o", "whole", folder=workspace)
    first = understudy("run", task, "-w", "tiny.yaml", "-o", "aside", "--pause-at", "2", folder=workspace, expect=1)
    aside = "aside/tiny-run.context.json"
    assert f"Go on with: understudy run {task} --resume {aside}" in first.stdout
    done = understudy("run", task, "--resume", aside, "-o", "aside", folder=workspace)
    assert "Done after" in done.stdout
    whole = (workspace / "whole" / "tiny-run.mcap").read_bytes()
    assert (workspace / "aside" / "tiny-run-2.mcap").read_bytes() == whole
    (workspace / "cut.mcap").write_bytes(whole[: len(whole) // 2])
    understudy("run", task, "--resume", "cut.mcap", "-o", "cut", folder=workspace)
    assert (workspace / "cut" / "tiny-run.mcap").read_bytes() == whole
    other = understudy("run", "hierarchical", "--resume", aside, folder=workspace, expect=2)
    assert "was saved in another task than the one that is to go on: track-green-1 is gone" in other.stderr
    twice = understudy("run", task, "-w", "tiny.yaml", "--resume", aside, folder=workspace, expect=2)
    assert "give neither" in twice.stderr
    where = understudy("run", task, folder=workspace, expect=2)
    assert "in which world?" in where.stderr


def test_a_picture_can_be_of_the_outside_only(tmp_path: Path) -> None:
    for depth, name in (("0", "outside"), ("9", "inside")):
        understudy("show", "hierarchical", "-p", name, "--depth", depth, folder=tmp_path)
    assert (tmp_path / "outside.svg").stat().st_size < (tmp_path / "inside.svg").stat().st_size
    refused = understudy("show", "hierarchical", "--depth", "1", folder=tmp_path, expect=2)
    assert "give --picture" in refused.stderr


def test_a_demonstration_without_done_says_where_it_stopped(tmp_path: Path) -> None:
    script = [{"say": "START"}, {"say": {"word": "HERE", "when_robot_within": 0.1, "of": [2.9, 2.9], "timeout": 3}}]
    (tmp_path / "stuck.yaml").write_text(world(teacher={"at": [1.3, 0.9], "script": script}), encoding="utf-8")
    done = understudy("teach", "stuck.yaml", "--json", folder=tmp_path, expect=1)
    told = json.loads(done.stdout)
    assert told["finished"] is False
    assert "HERE was said after 3 s in vain" in told["complaints"][0]
    assert "DONE was never said" in told["complaints"][-1]


def test_the_demo_writes_where_it_is_told_to(tmp_path: Path) -> None:
    (tmp_path / "tiny.yaml").write_text(yaml.safe_dump(TINY), encoding="utf-8")
    (tmp_path / "My.Output").mkdir()
    told = understudy("demo", "tiny.yaml", "-o", "My.Output", folder=tmp_path).stdout
    assert "In My.Output-2:" in told
    assert {path.name for path in (tmp_path / "My.Output-2").glob("*.png")} == {
        "1-demonstration-room.png",
        "1-demonstration-observations.png",
        "2-network.png",
        "3-same-room-room.png",
        "3-same-room-progress.png",
        "4-changed-room-room.png",
        "4-changed-room-progress.png",
    }
    assert list((tmp_path / "My.Output").iterdir()) == []


def test_nothing_is_overwritten(workspace: Path) -> None:
    before = (workspace / "understudy-out" / "tiny.mcap").read_bytes()
    understudy("teach", "tiny.yaml", folder=workspace)
    assert (workspace / "understudy-out" / "tiny.mcap").read_bytes() == before
    assert (workspace / "understudy-out" / "tiny-2.mcap").exists()


def test_show(workspace: Path) -> None:
    words = understudy("show", "understudy-out/tiny.yaml", "--picture", "pictures/tiny", folder=workspace).stdout
    assert "go to the green target" in words
    for suffix in (".png", ".svg"):
        assert (workspace / "pictures" / f"tiny{suffix}").stat().st_size > 1000
    assert understudy("show", "understudy-out/tiny.yaml", "--dot", folder=workspace).stdout.startswith("digraph")
    told = understudy("show", "understudy-out/tiny.mcap", "--picture", "pictures/shown", folder=workspace).stdout
    assert "a demonstration of" in told
    assert "START" in told
    assert (workspace / "pictures" / "shown-room.png").exists()


@pytest.mark.parametrize("document", ["world", "task", "intervals"])
def test_schema(tmp_path: Path, document: str) -> None:
    schema = json.loads(understudy("schema", document, folder=tmp_path).stdout)
    assert schema["properties"]["understudy"]["const"] == f"{document}/1"


def test_doctor(tmp_path: Path) -> None:
    findings = json.loads(understudy("doctor", "--json", folder=tmp_path).stdout)
    assert all(finding["ok"] for finding in findings)
    assert {"simulated robot", "skills", "mujoco-core", "up-pyperplan"} <= {finding["what"] for finding in findings}


def test_a_document_of_intervals(tmp_path: Path) -> None:
    (tmp_path / "tea.yaml").write_text(
        "understudy: intervals/1\nname: tea\nintervals:\n"
        "  - {label: boil, start: 0, end: 60}\n  - {label: pour, start: 61, end: 70}\n",
        encoding="utf-8",
    )
    done = understudy("learn", "tea.yaml", "--json", folder=tmp_path)
    assert json.loads(done.stdout)["links"] == [["boil-1", "pour-1", "ordering"]]


MISTAKES = {
    "no such world": (
        ["teach", "nowhere"],
        {},
        "nowhere: there is no such file, and no such world among: ",
    ),
    "malformed world": (["teach", "w.yaml"], {"w.yaml": "arena: ["}, "w.yaml: line 2, column 1: this is no YAML"),
    "unknown key": (["teach", "w.yaml"], {"w.yaml": world(tragets=[])}, "tragets: unknown key 'tragets'; did you mean"),
    "unknown color": (
        ["teach", "w.yaml"],
        {"w.yaml": world(targets=[{"color": "mauve", "at": [1, 1]}])},
        "targets[0].color: 'mauve' is unknown here; choose one of: red, orange",
    ),
    "no teacher": (["teach", "w.yaml"], {"w.yaml": world(teacher=None)}, "no teacher with a script"),
    "DONE without START": (
        ["teach", "w.yaml"],
        {"w.yaml": world(teacher={"at": [1.3, 0.9], "script": [{"say": "DONE"}]})},
        "START was never said",
    ),
    "empty demonstration": (
        ["learn", "i.yaml"],
        {
            "i.yaml": "understudy: intervals/1\nname: n\nintervals: [{label: a, start: 0, end: 1}]\n"
            "cues: [{time: 9, cue: HERE}]\n"
        },
        "every observation was left out",
    ),
    "unknown skill": (
        ["run", "t.yaml", "-w", "transport"],
        {"t.yaml": "understudy: task/1\nname: t\ncomponents: [{id: a, behavior: Dance}]\n"},
        "t.yaml: components[0] (a): there is no skill called 'Dance'; installed are: Drop",
    ),
    "unknown color in a task": (
        ["run", "t.yaml", "-w", "transport"],
        {
            "t.yaml": "understudy: task/1\nname: t\n"
            "components: [{id: a, behavior: PickUp, parameters: {color: mauve}}]\n"
        },
        "components[0] (a): PickUp: 'mauve' is no trained color",
    ),
    "cyclic network": (
        ["show", "t.yaml"],
        {
            "t.yaml": "understudy: task/1\nname: t\n"
            "components: [{id: a, behavior: Drop}, {id: b, behavior: Drop}]\n"
            "links: [{from: a, to: b, type: ordering}, {from: b, to: a, type: ordering}]\n"
        },
        "links: the links run in a circle",
    ),
    "no recording": (["learn", "gone.mcap"], {}, "gone.mcap"),
    "a recording that is none": (["learn", "x.mcap"], {"x.mcap": "hello"}, "x.mcap"),
    "an empty file": (["learn", "x.mcap"], {"x.mcap": ""}, "x.mcap"),
    "a task that is a world": (["show", "w.yaml"], {"w.yaml": world()}, "expected 'task/1', given 'world/1'"),
    "no intervals": (
        ["learn", "i.yaml"],
        {"i.yaml": "understudy: intervals/1\nname: n\nintervals: []\n"},
        "nothing to learn from",
    ),
    "a workspace that is a file": (
        ["teach", "transport", "-o", "file"],
        {"file": "x"},
        "the workspace file cannot be made",
    ),
    "an unknown option": (["teach", "transport", "--sped", "3"], {}, "No such option"),
    "a number that is none": (["teach", "transport", "--seed", "x"], {}, "Invalid value for '--seed'"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_gets_one_clear_message(tmp_path: Path, name: str) -> None:
    arguments, files, message = MISTAKES[name]
    for file, content in files.items():
        (tmp_path / file).write_text(content, encoding="utf-8")
    before = {path: path.read_bytes() for path in tmp_path.iterdir() if path.is_file()}
    done = understudy(*arguments, folder=tmp_path, expect=2)
    assert message in done.stderr
    assert len(done.stderr.strip().splitlines()) <= 4
    assert {path: path.read_bytes() for path in before} == before


def test_a_truncated_recording_is_learned_from_as_far_as_it_goes(workspace: Path, tmp_path: Path) -> None:
    content = (workspace / "understudy-out" / "tiny.mcap").read_bytes()
    (tmp_path / "cut.mcap").write_bytes(content[: int(len(content) * 0.9)])
    done = understudy("learn", "cut.mcap", folder=tmp_path)
    assert "cut short" in done.stdout
    assert "go to the green target" in done.stdout


def test_a_recording_without_usable_readings(tmp_path: Path) -> None:
    blind = Observation(time_s=0.0, scan=Scan(ranges=np.full(181, np.nan, np.float32)), cues=(Cue.START,))
    with Recorder(tmp_path / "blind.mcap", kind="demonstration", name="blind", spec=PIONEER) as recorder:
        recorder.observation(blind)
    done = understudy("learn", "blind.mcap", folder=tmp_path, expect=2)
    assert "181 of 181 laser rays are unusable (NaN) at t=0.0 s" in done.stderr
