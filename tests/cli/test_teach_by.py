"""``understudy teach WORLD --by TASK``: a robot teaches, and what cannot be meant is refused in a line."""

import json
from pathlib import Path

import pytest
import yaml
from typer.testing import CliRunner

from understudy.cli.app import app
from understudy.errors import UnderstudyError

WORLD = {
    "understudy": "world/1",
    "name": "tiny",
    "seed": 1,
    "arena": {"size": [5.0, 3.0]},
    "targets": [{"color": "green", "at": [3.0, 2.1]}],
    "robots": [{"name": "learner", "at": [0.5, 1.5]}],
    "teacher": {"at": [1.5, 1.5]},
}
TASK = """understudy: task/1
name: pass green
components:
  - {id: go, behavior: Track, parameters: {color: green, distance_m: 0.5, angle_deg: 180}}
links: []
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "tiny.yaml").write_text(yaml.safe_dump(WORLD), encoding="utf-8")
    (tmp_path / "task.yaml").write_text(TASK, encoding="utf-8")
    return tmp_path


def test_a_robot_teaches_what_it_knows(folder: Path) -> None:
    done = CliRunner().invoke(app, ["teach", "tiny.yaml", "--by", "task.yaml", "--json"])
    assert done.exit_code == 0, done.output
    record = json.loads(done.output.splitlines()[-1])
    assert record["finished"]
    assert not record["complaints"]
    assert record["recording"] == str(Path("understudy-out", "pass-green.mcap"))
    learned = CliRunner().invoke(app, ["learn", record["recording"]])
    assert learned.exit_code == 0, learned.output
    assert "go to the green target, to pass it on your left" in learned.output


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["tiny.yaml", "--naive"], "say which task it knows with --by TASK"),
        (["tiny.yaml", "--by", "nothing.yaml"], "nothing.yaml"),
        (["bare.yaml", "--by", "task.yaml"], "no robot can teach in this world"),
    ],
)
def test_what_cannot_be_meant_is_refused(folder: Path, arguments: list[str], told: str) -> None:
    (folder / "bare.yaml").write_text(
        yaml.safe_dump({key: value for key, value in WORLD.items() if key != "teacher"}), encoding="utf-8"
    )
    done = CliRunner().invoke(app, ["teach", *arguments])
    assert done.exit_code != 0
    assert told in done.output + str(done.exception)
    assert isinstance(done.exception, UnderstudyError | SystemExit)
    assert not list(folder.glob("understudy-out/*"))
