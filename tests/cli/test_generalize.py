"""``understudy generalize``: from tasks, intervals and recordings to a task with alternatives."""

import json
from pathlib import Path

import pytest
import yaml

from understudy.network import load_task

from .program import understudy


def intervals(name: str, *steps: tuple[str, dict[str, object]]) -> dict[str, object]:
    listed = [
        {"label": label, "start": 10 * index, "end": 10 * index + 8, "parameters": parameters}
        for index, (label, parameters) in enumerate(steps)
    ]
    return {"understudy": "intervals/1", "name": name, "intervals": listed}


GREEN, LIME = ("Track", {"color": "green"}), ("Track", {"color": "light green"})
BOX, PINK, DROP = ("PickUp", {"color": "orange"}), ("Track", {"color": "pink", "distance_m": 0.5}), ("Drop", {})


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three demonstrations as intervals, and the task that was learned from the first."""
    place = tmp_path_factory.mktemp("generalize")
    for name, steps in (("one", (GREEN, BOX, PINK, DROP)), ("two", (LIME, BOX, DROP)), ("three", (LIME, BOX, DROP))):
        (place / f"{name}.yaml").write_text(yaml.safe_dump(intervals(name, *steps)), encoding="utf-8")
    understudy("learn", "one.yaml", folder=place)
    understudy("learn", "three.yaml", folder=place)
    return place


def test_what_merged_and_what_became_an_alternative_is_told(folder: Path) -> None:
    told = understudy("generalize", "understudy-out/one.yaml", "two.yaml", "--name", "both", folder=folder).stdout
    assert "two: 2 of 3 steps were known\n" in told
    assert "before step 3: step 2 (go to the light green target), where others did step 1 (go to the green targ" in told
    assert "never done from now on, since a direct way leads past: step 5 (go to the pink target)" in told
    assert "begin with step 1 or 2, whichever comes first:" in told
    for suffix in (".yaml", ".png", ".svg"):
        assert (folder / "understudy-out" / f"both{suffix}").exists()
    task, network = load_task(folder / "understudy-out" / "both.yaml")
    assert network.topology.demonstrations == ("one", "two")
    assert task.note == "learned from one.yaml; generalised with two.yaml"


def test_several_at_once_and_learned_tasks_too(folder: Path) -> None:
    done = understudy(
        "generalize", "understudy-out/one.yaml", "two.yaml", "understudy-out/three.yaml", "--json", folder=folder
    )
    record = json.loads(done.stdout)
    assert record["demonstrations"] == ["one", "two", "three"]
    assert ["START", "track-light-green-1", ["two", "three"]] in record["paths"]
    assert record["bypassed"] == ["track-pink-1"]
    assert [one["new"] for one in record["added"]] == [["track-light-green-1"], []]
    again = understudy("generalize", record["task"], "two.yaml", "--json", folder=folder)
    assert json.loads(again.stdout)["demonstrations"] == ["one", "two", "three", "two (2)"]
    shown = understudy("show", record["task"], folder=folder).stdout
    assert "shown in 2 of 3 demonstrations" in shown


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("one.yaml", "two.yaml"), "one.yaml: understudy: this is no task document"),
        (("understudy-out/one.yaml",), "Missing argument 'sources'"),
        (("understudy-out/one.yaml", "none.yaml"), "none.yaml: the file cannot be read"),
        (("understudy-out/one.yaml", "none.mcap"), "none.mcap"),
        (("hierarchical", "two.yaml"), "only steps that are behaviors are aligned"),
    ],
)
def test_mistakes_are_told_in_a_line(folder: Path, arguments: tuple[str, ...], reason: str) -> None:
    done = understudy("generalize", *arguments, folder=folder, expect=2)
    assert reason in done.stderr
    assert done.stderr.count("\n") <= 2


def test_a_generalised_task_is_no_demonstration(folder: Path) -> None:
    record = json.loads(understudy("generalize", "understudy-out/one.yaml", "two.yaml", "--json", folder=folder).stdout)
    done = understudy("generalize", "understudy-out/one.yaml", record["task"], folder=folder, expect=2)
    assert "has alternatives, so it is not one demonstration" in done.stderr


@pytest.fixture(scope="module")
def kitchen(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Five times the same breakfast, in an order that is nearly free; once with a slip. No robot has such skills."""
    place = tmp_path_factory.mktemp("kitchen")
    days = ("boil grind pour", "grind boil pour", "boil grind pour", "grind boil pour", "boil pour")
    for number, day in enumerate(days, start=1):
        document = intervals(f"day {number}", *((label, {}) for label in day.split()))
        (place / f"day-{number}.json").write_text(json.dumps(document), encoding="utf-8")
    return place


def test_several_plain_documents_in_a_free_order(kitchen: Path) -> None:
    days = [f"day-{number}.json" for number in range(1, 6)]
    told = understudy("learn", *days, "--order", "free", "--name", "coffee", folder=kitchen).stdout
    assert "4 of 5 demonstrations are ways to do this task, and so not these:\n  day 5: it left out step 2 (g" in told
    task, network = load_task(kitchen / "understudy-out" / "coffee.yaml")
    assert task.note == "learned from day-1.json, day-2.json, day-3.json, day-4.json, day-5.json"
    assert {(link.source, link.target) for link in network.links} == {("boil-1", "pour-1"), ("grind-1", "pour-1")}
    one = json.loads(understudy("learn", days[0], "--order", "free", "--json", folder=kitchen).stdout)
    done = understudy("generalize", one["task"], *days[1:], "--order", "free", "--json", folder=kitchen)
    record = json.loads(done.stdout)
    assert record["deviations"] == [
        {"demonstration": "day 5", "left_out": ["grind-1"], "extra": [], "inverted": []},
    ]
    assert sorted(record["links"]) == [["boil-1", "pour-1", "ordering"], ["grind-1", "pour-1", "ordering"]]


def test_several_plain_documents_as_alternatives(kitchen: Path) -> None:
    record = json.loads(understudy("learn", "day-1.json", "day-2.json", "--json", folder=kitchen).stdout)
    assert [one["demonstrations"] for one in record["added"]] == [["day 2"]]
