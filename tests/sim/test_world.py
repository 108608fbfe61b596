"""World documents: what is refused, where, and in which words."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from tests.sim.support import world_data
from understudy.errors import WorldError
from understudy.robot import Color, Cue
from understudy.sim import World, load_world, world_names, world_path

TEACHER = {"at": [1.0, 1.0]}

FAULTS: list[tuple[str, dict[str, Any], str, str]] = [
    ("color", {"targets": [{"color": "purple", "at": [1, 1]}]}, "targets[0].color", "light orange"),
    ("key", {"targets": [{"colour": "red", "at": [1, 1]}]}, "targets[0].colour", "did you mean 'color'"),
    ("top key", {"bxoes": []}, "bxoes", "did you mean 'boxes'"),
    ("missing", {"targets": [{"color": "red"}]}, "targets[0].at", "required"),
    ("version", {"understudy": "world/2"}, "understudy", "world/1"),
    ("point", {"targets": [{"color": "red", "at": [1]}]}, "targets[0].at", "[1]"),
    ("number", {"targets": [{"color": "red", "at": [1, "far"]}]}, "targets[0].at[1]", "far"),
    ("outside", {"targets": [{"color": "red", "at": [3.95, 1]}]}, "targets[0].at", "outside the arena"),
    (
        "overlap",
        {"targets": [{"color": "red", "at": [1, 1]}, {"color": "blue", "at": [1.1, 1]}]},
        "targets[1].at",
        "overlaps targets[0]",
    ),
    ("robot in wall", {"walls": [{"from": [1, 2], "to": [3, 2]}]}, "robots[0].at", "overlaps walls[0]"),
    ("robot in target", {"targets": [{"color": "red", "at": [2, 2.3]}]}, "robots[0].at", "overlaps targets[0]"),
    ("no robot", {"robots": []}, "robots", "at least one robot"),
    ("two names", {"robots": [{"name": "a", "at": [1, 1]}, {"name": "a", "at": [3, 3]}]}, "robots[1].name", "'a'"),
    ("kind", {"robots": [{"name": "a", "at": [1, 1], "kind": "turtle"}]}, "robots[0].kind", "pioneer"),
    ("noise", {"noise": {"laser": -1}}, "noise.laser", "-1"),
    ("rate", {"noise": {"false_blobs": 2}}, "noise.false_blobs", "2"),
    ("script verb", {"teacher": {**TEACHER, "script": [{"shout": "HERE"}]}}, "teacher.script[0].shout", "say, walk"),
    ("script item", {"teacher": {**TEACHER, "script": ["DONE"]}}, "teacher.script[0]", "mapping"),
    ("two verbs", {"teacher": {**TEACHER, "script": [{"say": "HERE", "wait": 1}]}}, "teacher.script[0]", "exactly one"),
    ("word", {"teacher": {**TEACHER, "script": [{"say": "HELLO"}]}}, "teacher.script[0].say.word", "START"),
    (
        "half condition",
        {"teacher": {**TEACHER, "script": [{"say": {"word": "HERE", "when_robot_within": 1}}]}},
        "teacher.script[0].say",
        "'of'",
    ),
    (
        "condition",
        {"teacher": {**TEACHER, "script": [{"wait_for": "robot_sleeps"}]}},
        "teacher.script[0].wait_for.condition",
        "robot_holds_box",
    ),
    ("walk outside", {"teacher": {**TEACHER, "script": [{"walk": [5, 1]}]}}, "teacher.script[0].walk", "outside"),
    (
        "walk into a target",
        {"targets": [{"color": "red", "at": [1, 4]}], "teacher": {**TEACHER, "script": [{"walk": [1.1, 4]}]}},
        "teacher.script[0].walk",
        "targets[0]",
    ),
    (
        "blue target",
        {"teacher": TEACHER, "targets": [{"color": "red", "at": [3, 3]}, {"color": "blue", "at": [3, 4]}]},
        "targets[1].color",
        "the teacher's color",
    ),
    ("blue box", {"teacher": TEACHER, "boxes": [{"color": "blue", "at": [3, 4]}]}, "boxes[0].color", "light orange"),
    ("seed", {"seed": -1}, "seed", "this must be a whole number, 0 or more, given -1"),
    ("half a seed", {"seed": 1.5}, "seed", "this must be a whole number, 0 or more, given 1.5"),
    ("no name", {"name": ""}, "name", "this must be text of 1 to 80 characters that are not all blank, given ''"),
    ("blank name", {"name": "  "}, "name", "not all blank, given '  '"),
    ("long name", {"name": 81 * "x"}, "name", "this must be text of 1 to 80 characters"),
    ("numeric name", {"name": 7}, "name", "this must be text of 1 to 80 characters"),
    ("no radius", {"targets": [{"color": "red", "at": [1, 1], "radius": 0}]}, "targets[0].radius", "above 0, at most"),
    ("big box", {"boxes": [{"color": "red", "at": [1, 1], "size": 0.5}]}, "boxes[0].size", "from 0.03 to 0.14, given"),
    ("speed", {"teacher": {**TEACHER, "speed": 3}}, "teacher.speed", "m/s above 0, at most 2, given 3"),
    ("patience", {"teacher": {**TEACHER, "script": [{"wait": -1}]}}, "teacher.script[0].wait", "seconds, 0 or more"),
    ("leads nobody", {"teacher": {**TEACHER, "leads": "rex"}}, "teacher.leads", "learner"),
    ("not finite", {"targets": [{"color": "red", "at": [float("nan"), 1]}]}, "targets[0].at[0]", "finite"),
]


@pytest.mark.parametrize(("changes", "path", "words"), [fault[1:] for fault in FAULTS], ids=[f[0] for f in FAULTS])
def test_a_fault_is_refused_with_its_path(changes: dict[str, Any], path: str, words: str) -> None:
    with pytest.raises(WorldError) as caught:
        World.from_data(world_data(**changes), source="room.yaml")
    assert caught.value.path == path
    assert words in caught.value.problem
    assert str(caught.value).startswith(f"room.yaml: {path}: ")
    assert "\n" not in str(caught.value)
    # The words of a library for programmers: nobody who writes a world has to know them.
    assert not re.search(r"input should|string should|valid (integer|number|string)", str(caught.value).lower())


def test_an_unknown_color_is_answered_with_all_eight() -> None:
    with pytest.raises(WorldError) as caught:
        World.from_data(world_data(boxes=[{"color": "mauve", "at": [1, 1]}]))
    assert all(color.value in caught.value.problem for color in Color)


@pytest.fixture
def write(tmp_path: Path) -> Callable[[str], Path]:
    def to_file(text: str) -> Path:
        path = tmp_path / "room.yaml"
        path.write_text(text)
        return path

    return to_file


def test_what_is_no_yaml_is_refused_with_line_and_column(write: Callable[[str], Path]) -> None:
    with pytest.raises(WorldError, match=r"room\.yaml: line 3, column 1"):
        load_world(write("understudy: world/1\nname: [a\n"))


def test_a_key_that_is_given_twice_is_refused(write: Callable[[str], Path]) -> None:
    with pytest.raises(WorldError, match="'seed' is given twice"):
        load_world(write("understudy: world/1\nseed: 1\nseed: 2\n"))


@pytest.mark.parametrize("text", ["", "- 1\n", "hello"])
def test_a_document_that_is_no_mapping_is_refused(write: Callable[[str], Path], text: str) -> None:
    with pytest.raises(WorldError, match="mapping"):
        load_world(write(text))


def test_a_missing_file_is_one_clear_error(tmp_path: Path) -> None:
    with pytest.raises(WorldError, match="cannot be read"):
        load_world(tmp_path / "nowhere.yaml")


def test_an_unknown_bundled_world_is_answered_with_those_that_exist() -> None:
    with pytest.raises(WorldError, match="visit_targets"):
        world_path("visit_target")


def test_shorthands_mean_the_same_as_the_long_forms() -> None:
    short = world_data(teacher={**TEACHER, "script": [{"say": "HERE"}, {"walk": [1, 3]}, {"wait_for": "robot_empty"}]})
    long = world_data(
        teacher={
            **TEACHER,
            "script": [{"say": {"word": "HERE"}}, {"walk": {"to": [1, 3]}}, {"wait_for": {"condition": "robot_empty"}}],
        }
    )
    assert World.from_data(short) == World.from_data(long)


def test_blue_is_free_where_nobody_teaches() -> None:
    blue = {"targets": [{"color": "blue", "at": [3, 4]}], "boxes": [{"color": "blue", "at": [3, 5]}]}
    assert World.from_data(world_data(**blue)).targets[0].color is Color.BLUE


def test_a_world_needs_no_seed() -> None:
    data = world_data()
    del data["seed"]
    assert World.from_data(data).seed == 0


@pytest.mark.parametrize("word", ["take", "Take", {"word": "take"}])
def test_words_need_no_capitals(word: object) -> None:
    world = World.from_data(world_data(teacher={**TEACHER, "script": [{"say": word}]}))
    assert world.teacher is not None
    assert world.teacher.script[0].say is not None
    assert world.teacher.script[0].say.word is Cue.TAKE


def test_an_unknown_word_is_shown_as_it_was_written() -> None:
    with pytest.raises(
        WorldError, match=r"'tkae' is unknown here; choose one of: START, HERE, TAKE, DROP, REPEAT, UNTIL, DONE"
    ):
        World.from_data(world_data(teacher={**TEACHER, "script": [{"say": "tkae"}]}))


@pytest.mark.parametrize("name", world_names())
def test_a_bundled_world_loads_and_survives_being_written(name: str) -> None:
    world = load_world(world_path(name))
    data = world.model_dump(mode="json", by_alias=True, exclude_defaults=True)
    assert World.from_data({"understudy": "world/1", **data}) == world


def test_the_schema_is_as_closed_as_the_parser() -> None:
    schema = World.json_schema()
    definitions = [schema, *schema["$defs"].values()]
    mappings = [part for entry in definitions for part in entry.get("anyOf", [entry]) if "properties" in part]
    assert len(mappings) >= 11
    assert all(part["additionalProperties"] is False for part in mappings)
    assert set(schema["required"]) == {"understudy", "name", "arena", "robots"}
    assert set(schema["$defs"]["Color"]["enum"]) == {color.value for color in Color}
    assert set(schema["$defs"]["Wall"]["properties"]) == {"from", "to"}
    short, long = schema["$defs"]["Saying"]["anyOf"]
    assert short == long["properties"]["word"]


@pytest.mark.parametrize("name", world_names())
def test_a_world_comes_back_from_its_text(name: str) -> None:
    world = load_world(world_path(name))
    assert World.from_data(yaml.safe_load(world.to_yaml())) == world
