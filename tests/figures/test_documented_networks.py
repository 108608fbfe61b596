"""Every document on the page about networks is one: it can be read, run, told and drawn."""

import json
import re
from pathlib import Path

import pytest

from understudy.behaviors import installed_skills
from understudy.execution import compile_network
from understudy.figures import describe_task, draw_network
from understudy.language import violations
from understudy.network import Task, load_task

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
    assert violations(network) == []
    assert describe_task(task.name, network, skills).startswith(f"{task.name}: ")
    draw_network(network, None, skills, title=task.name)


def without_ids(network):
    """The components in document order, everything said by their places in it, links sorted."""
    task = Task.of("x", network).model_dump(by_alias=True, exclude_defaults=True)

    def plain(part):
        rank = {component["id"]: index for index, component in enumerate(part["components"])}
        for component in part["components"]:
            del component["id"]
            component.pop("name", None)
            if "network" in component:
                plain(component["network"])
            for case in component.get("cases", ()):
                ids = plain(case["network"])
                for switch in component.get("switches", ()):
                    if switch["from"] == case["name"]:
                        text = json.dumps(switch["when"], default=str)
                        for id_, place in ids.items():
                            text = text.replace(f'"achieved": "{id_}"', f'"achieved": {place}')
                        switch["when"] = text
        for kind in ("links", "inhibitions"):
            for link in part.get(kind, ()):
                link |= {end: rank[link[end]] for end in ("from", "to")}
            part[kind] = sorted(part.get(kind, ()), key=lambda link: (link["from"], link["to"]))
        return rank

    plain(task)
    return task


def test_what_is_said_in_python_is_what_the_documents_say(folder):
    said = {}
    for block in re.findall(r"^```python\n(.*?)^```", PAGE.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL):
        exec(block, said)
    for name in ("fetch", "errand", "deliver", "patrol", "watch"):
        _, network = load_task(folder / f"{name}.yaml")
        assert without_ids(said[name]) == without_ids(network), name


def test_the_pictures_are_there_and_small():
    pictures = re.findall(r"!\[[^]]+\]\((\S+\.png)\)", PAGE.read_text(encoding="utf-8"))
    assert len(pictures) == 3
    for picture in pictures:
        assert 0 < (PAGE.parent / picture).stat().st_size < 200_000
