"""The page on formats says what the code does: every key, default and limit, and examples that can be loaded."""

import re
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Union, get_args, get_origin

import pytest
import yaml
from pydantic import BaseModel, TypeAdapter

from tests.sim.support import world_data
from understudy.behaviors import installed_skills
from understudy.documents import Part
from understudy.experiments import ExperimentDocument
from understudy.learning import demonstrate, learn, parse_intervals
from understudy.network import LinkType, parse_task
from understudy.robot import Color, Cue
from understudy.sim import LEVELS, Habits, Referee, Simulation, World
from understudy.sim.script import DEFAULT_TIMEOUT_S, Saying, ScriptItem, Waiting, Walk
from understudy.sim.world import Box

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "formats.md").read_text(encoding="utf-8")
EXAMPLES: list[Any] = [yaml.safe_load(text) for text in re.findall(r"^```yaml\n(.*?)^```", PAGE, re.S | re.M)]


def example(kind: str, number: int = 0) -> Any:
    return [data for data in EXAMPLES if isinstance(data, dict) and data["understudy"] == kind][number]


def rows(header: str) -> list[list[str]]:
    """The cells of the table that begins with this row."""
    lines = PAGE[PAGE.index(header) :].split("\n\n", maxsplit=1)[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


# -- the examples ---------------------------------------------------------------------------------------------------


def test_there_are_examples_of_everything() -> None:
    kinds = [data["understudy"] if isinstance(data, dict) else "script" for data in EXAMPLES]
    assert sorted(set(kinds)) == ["experiment/1", "intervals/1", "script", "task/1", "world/1"]


@pytest.mark.parametrize("data", EXAMPLES, ids=range(len(EXAMPLES)))
def test_an_example_is_valid(data: Any) -> None:
    if isinstance(data, list):
        World.from_data(world_data(teacher={"at": [1.0, 3.0], "script": data}))
        return
    match data["understudy"]:
        case "world/1":
            World.from_data(data)
        case "task/1":
            for component in parse_task(data)[1].components:
                installed_skills()[component.behavior].complete(component.parameters)
        case "intervals/1":
            parse_intervals(data)
        case "experiment/1":
            ExperimentDocument.model_validate(data)
        case kind:
            pytest.fail(f"there is no such document: {kind}")


def test_the_world_teaches_what_its_script_means() -> None:
    simulation = Simulation(World.from_data(example("world/1")))
    referee = Referee(simulation)
    lesson = learn(demonstrate(simulation.robot(), installed_skills(), name="example", limit_s=120.0))
    assert [str(observed.instance) for observed in lesson.kept] == [
        "Drop",
        "Track(color=green)",
        "PickUp(color=orange)",
        "Drop",
    ]
    assert not simulation.teacher_complaints
    assert not referee.collisions


def test_the_intervals_show_every_kind_of_link_and_lose_no_step() -> None:
    demonstration = parse_intervals(example("intervals/1"))
    assert demonstration.cues
    lesson = learn(demonstration)
    assert not lesson.dropped
    links = {(link.source, link.target): link.type for link in lesson.network.links}
    assert links == {
        ("lid-off-1", "pour-pot-1"): LinkType.PERMANENT,
        ("lid-off-1", "stir-1"): LinkType.ENABLING,
        ("pour-pot-1", "stir-1"): LinkType.ORDERING,
    }


def test_the_intervals_that_are_skills_can_be_executed() -> None:
    network = learn(parse_intervals(example("intervals/1", 1))).network
    assert len(network.components) == 5
    for component in network.components:
        installed_skills()[component.behavior].complete(component.parameters)
    links = {(link.source, link.target): link.type for link in network.links}
    assert links["pick-up-orange-1", "track-pink-1"] is LinkType.PERMANENT


# -- the tables -----------------------------------------------------------------------------------------------------


def parts_in(annotation: Any) -> Iterator[type[Part]]:
    if isinstance(annotation, type) and issubclass(annotation, Part):
        yield annotation
    elif get_origin(annotation) in (tuple, Union, types.UnionType):
        for inner in get_args(annotation):
            yield from parts_in(inner)


def keys(model: type[BaseModel], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Every key of a world down to the script, ``targets[].color``, with its field."""
    for name, field in model.model_fields.items():
        path = prefix + (field.alias or name)
        inner = next(parts_in(field.annotation), None)
        if inner is None or inner is ScriptItem:
            yield path, field
        else:
            many = get_origin(field.annotation) is tuple
            yield from keys(inner, f"{path}[]." if many else f"{path}.")


SCHEMA = World.json_schema()
WORLD_KEYS = dict(keys(World))
WORLD_ROWS = {key: row for row in rows("| key | meaning | default | range |") for key in re.findall(r"`(.*?)`", row[0])}


def test_the_table_of_world_keys_is_complete_and_has_no_others() -> None:
    assert len(WORLD_KEYS) > 30
    assert list(WORLD_ROWS) == list(WORLD_KEYS)


@pytest.mark.parametrize("key", WORLD_KEYS)
def test_a_default_is_as_the_table_says(key: str) -> None:
    field, said = WORLD_KEYS[key], WORLD_ROWS[key][2]
    if field.is_required():
        assert said == "required"
    elif isinstance(field.default, int | float):
        assert float(said) == field.default
    elif isinstance(field.default, str):
        assert said == field.default
    else:
        assert field.default in (None, ())
        assert said in ("none", "nothing", "the first", "none: without end")


@pytest.mark.parametrize("key", WORLD_KEYS)
def test_a_range_is_as_the_table_says(key: str) -> None:
    said, schema = WORLD_ROWS[key][3], SCHEMA
    for step in key.replace("[]", "").split("."):
        schema = entry(schema, step)
    limits, signs = numbers(schema), [(">", "exclusiveMinimum"), ("≥", "minimum"), ("≤", "maximum")]
    wanted = [f"{sign} {limits[name]:g}" for sign, name in signs if name in limits]
    assert re.findall(r"[>≥≤] -?[\d.]+", said) == wanted
    if "maxLength" in str(schema):
        assert "1 to 80 characters" in said or key == "teacher.leads"


def entry(schema: dict[str, Any], name: str) -> dict[str, Any]:
    """The schema of one key of a mapping, or of the mappings in a list."""
    found: dict[str, Any] = resolved(schema)["properties"][name]
    return found


def resolved(schema: dict[str, Any]) -> dict[str, Any]:
    while "properties" not in schema:
        if "$ref" in schema:
            schema = SCHEMA["$defs"][schema["$ref"].rsplit("/", 1)[1]]
        elif "anyOf" in schema:
            schema = next(
                one for one in schema["anyOf"] if {"$ref", "properties"} & one.keys()
            )  # not the shorthand, nor nothing
        else:
            schema = schema["items"]
    return schema


def numbers(schema: dict[str, Any]) -> dict[str, Any]:
    """Where the limits are: at the key, or, of a pair of numbers, at the first."""
    first: dict[str, Any] = schema.get("prefixItems", schema.get("anyOf", [schema]))[0]
    return first


@pytest.mark.parametrize("model", [World, Box, ScriptItem, Saying, Walk, Waiting])
def test_every_field_is_mentioned(model: type[Part]) -> None:
    quoted = set(re.findall(r"\w+", " ".join(re.findall(r"`(.*?)`", PAGE))))
    for name, field in model.model_fields.items():
        assert (field.alias or name) in quoted


def test_the_long_form_of_say_has_its_defaults() -> None:
    table = {key: row for row in rows("| key | meaning | default |\n") for key in re.findall(r"`(.*?)`", row[0])}
    assert set(table) == set(Saying.model_fields)
    assert float(table["timeout"][2]) == Saying(word=Cue.HERE).timeout == DEFAULT_TIMEOUT_S
    assert float(table["delay"][2]) == Saying(word=Cue.HERE).delay
    assert f"after `timeout` seconds ({DEFAULT_TIMEOUT_S:g} if left out)" in PAGE
    assert Waiting(condition="robot_near").timeout == DEFAULT_TIMEOUT_S


def test_every_condition_every_word_and_every_color_is_told() -> None:
    conditions = TypeAdapter(Waiting).json_schema()["anyOf"][0]["enum"]
    assert [row[0].strip("`") for row in rows("| `condition` | true when |")] == conditions
    assert all(re.search(rf"\b{word}\b", PAGE) for word in [*Cue, *Color])


def test_the_levels_of_skill_are_as_the_table_says() -> None:
    table = {row[0].strip("`"): row[1:4] for row in rows("| habit | experienced |")}
    assert set(table) == {name for keys in LEVELS.values() for name in keys}
    for name, told in table.items():
        true = [getattr(Habits.model_validate(level), name) for level in LEVELS]
        assert ["none" if value is None else f"{value:g}" for value in true] == [
            number if number == "none" else f"{float(number):g}" for number in told
        ]


def test_the_table_of_skills_is_that_of_the_skills() -> None:
    table = rows("| skill | parameter | meaning |")
    told = {(row[0].strip("`"), row[1].strip("`")): row[3:] for row in table}
    true = {}
    for name, skill in installed_skills().items():
        for parameter in skill.abstract.parameters:
            limits = [f"{parameter.low:.2f}–{parameter.high:.2f}", f"{parameter.tolerance:.2f}"]
            if parameter.name == "angle_deg":
                limits = [f"{parameter.low:g}–{parameter.high:g}", f"{parameter.tolerance:g}"]
            if parameter.kind == "color":
                limits = ["a color", ""]
            if parameter.kind == "word":
                limits = [", ".join(f"`{word}`" for word in parameter.words), ""]
            default = parameter.default if isinstance(parameter.default, str | None) else f"{parameter.default:g}"
            true[name, parameter.name] = [default or "required", *limits]
        if not skill.abstract.parameters:
            true[name, ""] = ["", "", ""]
    normal = {key: [f"{float(row[0]):g}" if re.match(r"\d", row[0]) else row[0], *row[1:]] for key, row in told.items()}
    assert normal == true


@pytest.mark.parametrize("page", ["formats.md", "manual.md"])
def test_text_is_wrapped(page: str) -> None:
    for line in (DOCS / page).read_text(encoding="utf-8").splitlines():
        assert line.startswith("|") or len(line) <= 118, line


def test_the_manual_says_what_blue_is_and_how_a_drop_ends() -> None:
    manual = " ".join((DOCS / "manual.md").read_text(encoding="utf-8").split())
    assert re.search(r"no target and no box may be blue", manual)
    assert re.search(r"DROP\*\*\. Wait until the robot .* closed and lifted the gripper again", manual)
