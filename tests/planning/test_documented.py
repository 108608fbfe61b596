"""Every command and every piece of Python on the page about planning does what stands there."""

import re
import shlex
from pathlib import Path

import pytest

from understudy.behaviors import installed_skills
from understudy.cli.app import app
from understudy.figures import draw_network
from understudy.network import load_task
from understudy.planning import domain_of

PAGE = Path(__file__).parents[2] / "docs" / "planning.md"
TEXT = PAGE.read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```(\w+)\n(.*?)^```", TEXT, flags=re.MULTILINE | re.DOTALL)


def test_the_commands(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    said, refused = "", 0
    for kind, block in BLOCKS:
        if kind == "sh":
            said = ""
            for line in block.splitlines():
                program, *arguments = shlex.split(line)
                assert program == "understudy"
                code = app(arguments, standalone_mode=False)
                printed = capsys.readouterr()
                said += printed.out + printed.err
                assert (code or 0) == ("there is no plan" in printed.err), line
                refused += code or 0
        elif kind == "text" and "True" not in block:
            assert block in said
    assert refused == 1
    assert len(list(tmp_path.glob("pddl/*.pddl"))) == 2
    task, network = load_task(tmp_path / "understudy-out" / "fetch.yaml")
    assert task.note == "planned for carried(orange, pink)"
    draw_network(network, None, installed_skills(), title=task.name)


def test_the_python(capsys):
    names: dict[str, object] = {}
    for kind, block in BLOCKS:
        if kind == "python":
            exec(block, names)
    expected = next(block for kind, block in BLOCKS if kind == "text" and "True" in block)
    assert capsys.readouterr().out == expected


def test_every_fact_is_on_the_page():
    words = domain_of(installed_skills()).words
    told = re.findall(r"^\| `(\w+)[^`]*` \| .* \|$", TEXT, flags=re.MULTILINE)
    assert set(words) <= set(told)


@pytest.mark.parametrize("picture", re.findall(r"!\[[^]]+\]\((\S+\.png)\)", TEXT))
def test_its_picture_is_small(picture):
    assert 0 < (PAGE.parent / picture).stat().st_size < 200_000
