"""The commands and the program of docs/practice.md, run as they stand there."""

import json
import re
import shlex
from pathlib import Path

import pytest

from tests.tiny import TINY

from .program import understudy

PAGE = Path(__file__).parents[2] / "docs" / "practice.md"


def test_every_command_of_the_page_does_what_it_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = PAGE.read_text(encoding="utf-8")
    lines = [line for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL) for line in block.splitlines()]
    outputs = [understudy(*shlex.split(line)[1:], folder=tmp_path).stdout for line in lines]
    (shown,) = re.findall(r"```text\n(.*?)```", text, re.DOTALL)
    # Another processor may round otherwise, and be a tenth of a second later.
    assert re.sub(r"[\d.]+ s", "T", outputs[0]) == re.sub(r"[\d.]+ s", "T", shown)
    assert "Done after" in outputs[1]
    assert "step 1 (go to the green target), finished" in outputs[2]
    again = json.loads((tmp_path / "understudy-out" / "practice-practice-2.json").read_text())
    assert again["corrections"][0]["changes"][0] == "track-green-1 is gone"
    assert Path(tmp_path / again["corrected"]).exists()
    assert ["passed by no more" in output for output in outputs[3:]] == [True, False]
    report = json.loads((tmp_path / "understudy-out" / "practice-practice.json").read_text())
    assert [one["word"] for one in report["corrections"]] == ["BAD", "COME"]
    assert report["corrections"][0]["changes"][0] == "track-red-1 is gone"
    (code,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    exec(compile(code, str(PAGE), "exec"), {})
    assert "['track-red-1', 'track-light-orange-1', 'track-pink-1']" in capsys.readouterr().out


def test_a_practice_without_a_word_leaves_the_task_as_it_is(tmp_path: Path) -> None:
    quiet = {"at": [1.3, 2.0], "script": [{"wait": 1.0}]}
    (tmp_path / "quiet.yaml").write_text(json.dumps(TINY | {"teacher": quiet}), encoding="utf-8")
    task = {
        "understudy": "task/1",
        "name": "green",
        "components": [{"id": "a", "behavior": "Track", "parameters": {"color": "green"}}],
    }
    (tmp_path / "green.json").write_text(json.dumps(task), encoding="utf-8")
    told = understudy("practice", "green.json", "--world", "quiet.yaml", folder=tmp_path).stdout
    assert "The task is as it was." in told
    assert not list((tmp_path / "understudy-out").glob("*.yaml"))
    late = understudy(
        "practice", "green.json", "-w", "quiet.yaml", "--limit", "0.3", "--json", folder=tmp_path, expect=1
    )
    assert json.loads(late.stdout)["done"] is False
    alone = understudy("practice", "green.json", "-w", "hierarchical", folder=tmp_path, expect=2)
    assert "nobody watches the practice" in alone.stderr


def test_a_word_is_reassigned_by_what_its_step_was_called(tmp_path: Path) -> None:
    practised = "understudy-out/practice-practice.json"
    understudy("practice", "practice", "--world", "practice", folder=tmp_path)
    told = json.loads(understudy("reassign", practised, "1=1", "2=END", "--json", folder=tmp_path).stdout)
    assert [one["component"] for one in told["corrections"]] == ["track-green-1", "END"]
    assert understudy("reassign", told["corrected"].replace("yaml", "json"), "1=2", folder=tmp_path).stdout
    for given, problem in (("1", "write WORD=STEP"), ("3=1", "no correction 3"), ("1=9", "no step was called '9'")):
        assert problem in understudy("reassign", practised, given, folder=tmp_path, expect=2).stderr
    (tmp_path / "x.json").write_text("{}", encoding="utf-8")
    assert "no report of a practice run" in understudy("reassign", "x.json", "1=1", folder=tmp_path, expect=2).stderr
