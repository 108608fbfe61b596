"""``understudy plan``: the task it writes, and its answers when there is none."""

import json
from pathlib import Path

from understudy.network import load_task

from .program import understudy


def test_a_task_from_a_goal(tmp_path: Path) -> None:
    done = understudy("plan", "carried(orange, light-orange)", "-w", "transport", "--json", folder=tmp_path)
    record = json.loads(done.stdout)
    assert record["goal"] == "carried(orange, light orange)"
    task, network = load_task(tmp_path / record["task"])
    assert task.name == record["name"] == "carried orange light orange"
    assert [component.id for component in network.components] == record["components"]
    assert [[link.source, link.target, link.type] for link in network.links] == record["links"]
    assert ["track-light-orange-1", "drop-2", "enabling", "near(light orange) is needed"] in record["reasons"]
    assert {Path(file).suffix for file in record["written"]} == {".yaml", ".png", ".svg"}
    assert all((tmp_path / file).stat().st_size for file in record["written"])


def test_no_plan_is_an_answer(tmp_path: Path) -> None:
    done = understudy("plan", "near(red), near(green)", "--json", "--pddl", "pddl", folder=tmp_path, expect=1)
    assert json.loads(done.stdout) == {
        "goal": "near(red) and near(green)",
        "task": None,
        "missing": ["near(red) and near(green) cannot be so together, though each of them can"],
    }
    assert "there is no plan" in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["pddl"]


def test_what_is_not_in_the_world_is_no_goal(tmp_path: Path) -> None:
    done = understudy("plan", "carried(orange, pink)", "-w", "transport", folder=tmp_path, expect=2)
    assert done.stderr == (
        "understudy: carried(orange, pink): there is no 'pink' target; there are: green, yellow, light orange, orange\n"
    )
    assert not list(tmp_path.iterdir())
