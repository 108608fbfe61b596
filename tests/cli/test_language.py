"""The language of a task on the command line; every command and every line of code on its page is run."""

import json
import re
import shlex
from pathlib import Path

import pytest
import yaml

from .program import understudy

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "language.md").read_text(encoding="utf-8")

TWICE = {
    "understudy": "task/1",
    "name": "twice",
    "components": [
        {"id": "empty", "behavior": "Drop"},
        {"id": "carry", "network": {"components": [
            {"id": "box", "behavior": "PickUp", "parameters": {"color": "orange"}},
            {"id": "other", "behavior": "PickUp", "parameters": {"color": "red"}},
        ]}},
    ],
    "links": [{"from": "empty", "to": "carry", "type": "ordering"}],
}  # fmt: skip


def blocks(page: str, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page, flags=re.MULTILINE | re.DOTALL)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("language")
    for text in blocks((DOCS / "networks.md").read_text(encoding="utf-8"), "yaml"):
        name = re.match(r"# (\S+)", text)
        assert name is not None
        (place / name[1]).write_text(text, encoding="utf-8")
    (place / "twice.yaml").write_text(yaml.safe_dump(TWICE), encoding="utf-8")
    return place


COMMANDS = [line.split("#")[0].strip() for block in blocks(PAGE, "sh") for line in block.splitlines()]


@pytest.mark.parametrize("line", COMMANDS)
def test_a_documented_command(line: str, folder: Path) -> None:
    program, *arguments = shlex.split(line)
    assert program == "understudy"
    expect = 1 if "--contains" in arguments else 0
    told = understudy(*arguments, folder=folder, expect=expect).stdout
    if "--words" in arguments:
        assert told.startswith("hierarchical: 24 words, of 11 steps each\n\n  Drop ")
        assert "\n   24. Drop, Track(light green)" in told
        assert "  Track(light green)   go to the light green target\n" in told
    if "--compare" in arguments:
        assert told.startswith("hierarchical and an errand can be done in just the same orders.\n  both: Drop, ")


def test_the_code_on_the_page_prints_what_it_says(capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = blocks(PAGE, "python")
    expected = [line.split("# ")[1] for line in code.splitlines() if line.startswith("print(")]
    exec(code, {})
    assert capsys.readouterr().out.splitlines() == expected


def test_an_order_that_is_none(folder: Path) -> None:
    told = understudy("language", "hierarchical", "--contains", "drop, pickup(orange)", folder=folder, expect=1).stdout
    assert told in blocks(PAGE, "text")
    early = understudy("language", "fetch.yaml", "--contains", "Drop, Track(green)", folder=folder, expect=1).stdout
    assert early == "No: after Drop, Track(green) the task is not done yet; what can come next: PickUp(orange).\n"
    late = "Drop, Track(green), PickUp(orange), Track(yellow), Drop"
    over = understudy("language", "fetch.yaml", "--contains", late, "--json", folder=folder, expect=1).stdout
    assert json.loads(over) | {"word": None} == {
        "word": None, "member": False, "begins": 4, "allowed": [], "complete": True
    }  # fmt: skip
    member = late.rpartition(",")[0]
    assert understudy("language", "fetch.yaml", "--contains", member, folder=folder).stdout.startswith("Yes:")


def test_words_as_data(folder: Path) -> None:
    told = json.loads(understudy("language", "hierarchical", "--words", 2, "--json", folder=folder).stdout)
    assert (told["count"], told["finite"], len(told["words"]), len(told["symbols"])) == (24, True, 2, 8)
    bounded = ("language", "deliver.yaml", "--length", 9)
    told = json.loads(understudy(*bounded, "--sample", 5, "--seed", 3, "--json", folder=folder).stdout)
    assert told["finite"] is False
    assert all(len(word) <= 9 for word in told["words"])
    again = json.loads(understudy(*bounded, "--sample", 5, "--seed", 3, "--json", folder=folder).stdout)
    assert again == told
    refused = understudy("language", "deliver.yaml", "--sample", 1, folder=folder, expect=2).stderr
    assert "no end to the words of this task; say how long they may be at most" in refused


def test_one_question_at_a_time(folder: Path) -> None:
    refused = understudy("language", "hierarchical", "--check", "--sample", 1, folder=folder, expect=2).stderr
    assert "ask one of them" in refused


def test_a_task_that_can_break_a_rule_is_not_run(folder: Path) -> None:
    told = understudy("language", "twice.yaml", "--check", folder=folder, expect=1).stdout
    problem = "'carry/other' can follow 'carry/box' without it: Drop, PickUp(orange), PickUp(red)"
    assert problem in told
    assert " ".join(told.split()) in [" ".join(block.split()) for block in blocks(PAGE, "text")]
    data = json.loads(understudy("language", "twice.yaml", "--check", "--json", folder=folder, expect=1).stdout)
    assert data["violations"][0]["components"] == ["empty", "carry/box", "carry/other"]
    assert (data["violations"][0]["offender"], data["violations"][0]["since"]) == ("carry/other", "carry/box")
    assert problem in understudy("show", "twice.yaml", folder=folder).stderr
    refused = understudy("run", "twice.yaml", "--world", "hierarchical", folder=folder, expect=2).stderr
    assert refused.startswith("understudy: twice.yaml: before every PickUp there is a Drop")
    assert problem in refused
    assert not (folder / "understudy-out").exists()
    unchecked = ("run", "twice.yaml", "--world", "hierarchical", "--unchecked", "--limit", 1)
    assert "Not done: time limit" in understudy(*unchecked, folder=folder, expect=1).stdout


def test_a_lesson_that_breaks_a_rule_is_told(folder: Path) -> None:
    intervals = {
        "understudy": "intervals/1",
        "name": "full hands",
        "intervals": [
            {"label": "PickUp", "start": 0, "end": 14, "parameters": {"color": "orange"}},
            {"label": "Track", "start": 5, "end": 9, "parameters": {"color": "green", "distance_m": 0.6}},
        ],
    }
    (folder / "intervals.yaml").write_text(yaml.safe_dump(intervals), encoding="utf-8")
    done = understudy("learn", "intervals.yaml", folder=folder)
    assert "It cannot be run as it is: before every PickUp" in done.stderr
    assert "Next: understudy run" not in done.stdout
    told = json.loads(understudy("learn", "intervals.yaml", "--json", folder=folder).stdout)
    assert len(told["broken_rules"]) == 1
    assert (folder / "understudy-out" / "full-hands.yaml").exists()
