"""Every document on the page about networks is one: it can be read, run, told and drawn."""

import re
from pathlib import Path

import pytest

from understudy.behaviors import installed_skills
from understudy.execution import compile_network
from understudy.figures import describe_task, draw_network
from understudy.network import load_task

PAGE = Path(__file__).parents[2] / "docs" / "networks.md"
BLOCKS = re.findall(r"^```yaml\n(# (\S+)\n.*?)^```", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
NAMES = [name for _, name in BLOCKS]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("networks")
    for text, name in BLOCKS:
        (place / name).write_text(text, encoding="utf-8")
    return place


def test_every_block_is_a_document_of_its_own():
    text = PAGE.read_text(encoding="utf-8")
    assert text.count("```yaml") == len(BLOCKS) == len(set(NAMES)) >= 6


@pytest.mark.parametrize("name", NAMES)
def test_a_documented_network(name, folder):
    task, network = load_task(folder / name)
    skills = installed_skills()
    compile_network(network, skills)
    assert describe_task(task.name, network, skills).startswith(f"{task.name}: ")
    draw_network(network, None, skills, title=task.name)


def test_the_pictures_are_there_and_small():
    pictures = re.findall(r"!\[[^]]+\]\((\S+\.png)\)", PAGE.read_text(encoding="utf-8"))
    assert len(pictures) == 3
    for picture in pictures:
        assert 0 < (PAGE.parent / picture).stat().st_size < 200_000
