"""Experiment documents: what is read, what is refused and how, and what each row of one means."""

from pathlib import Path
from typing import Any

import pytest
import yaml

from understudy.errors import ExperimentError, NetworkError, UnderstudyError, WorldError
from understudy.experiments import (
    ExperimentDocument,
    Row,
    Unit,
    conduct,
    experiment_names,
    experiment_schema,
    find_experiment,
    load_experiment,
)
from understudy.sim import load_world, rearranged, world_path

PLAIN: dict[str, Any] = {
    "understudy": "experiment/1",
    "name": "mine",
    "world": "visit_targets",
    "rows": [{"name": "taught", "kind": "teach"}, {"name": "elsewhere", "kind": "run", "room": "changed"}],
}


def written(folder: Path, **changes: Any) -> Path:
    path = folder / "mine.yaml"
    path.write_text(yaml.safe_dump(PLAIN | changes), encoding="utf-8")
    return path


def row(**changes: Any) -> dict[str, Any]:
    return {"rows": [{"name": "a", "kind": "run", **changes}]}


def test_every_bundled_experiment_can_be_read_and_cites_its_section() -> None:
    for name in experiment_names():
        document = find_experiment(name).document
        assert document.name == name
        assert document.title
        assert document.source.startswith("§")


def test_the_schema_has_the_keys_of_the_parser() -> None:
    schema = experiment_schema()
    definitions = [schema, *schema["$defs"].values()]
    assert all(definition["additionalProperties"] is False for definition in definitions)
    for model, keys in ((ExperimentDocument, schema["properties"]), (Row, schema["$defs"]["Row"]["properties"])):
        assert set(keys) == {field.alias or name for name, field in model.model_fields.items()}


@pytest.mark.parametrize(
    ("changes", "error", "told"),
    [
        ({"row": []}, ExperimentError, "row: unknown key 'row'; did you mean 'rows'?"),
        ({"rows": []}, ExperimentError, "rows: this is empty; it takes at least one"),
        (row(kind="walk"), ExperimentError, "rows[0].kind: 'walk' is unknown here; choose one of: teach, run, "),
        (row(room="other"), ExperimentError, "rows[0].room: 'other' is unknown here; choose one of: same, changed"),
        (row(limits={"spacing": 1}), ExperimentError, "rows[0]: `limits` are those of a changed room; add `room: chan"),
        (row(**{"with": {"moved": "box"}}), ExperimentError, "rows[0].with.moved: unknown key 'moved'; allowed here: "),
        (row(kind="run planned"), ExperimentError, "rows[0].with.plan: this key is required and missing"),
        ({"rows": PLAIN["rows"] * 2}, ExperimentError, "two rows are called 'taught'; rename one of them"),
        (row(goal=98), ExperimentError, "rows[0].goal: the goal of this kind is a rate of successes, a number f"),
        ({"tables": ["chairs"]}, ExperimentError, "tables[0]: 'chairs' is unknown here; choose one of: orders, "),
        ({"world": "moon"}, ExperimentError, "names the world 'moon', and there is no such file beside it, and no suc"),
        ({"task": "moon"}, ExperimentError, "it names the task 'moon', and there is no such file beside it, and no su"),
        ({"teacher": {"speed": -1}}, WorldError, "teacher.speed: this must be a number of m/s above 0"),
        ({"noise": {"laser": "much"}}, WorldError, "noise.laser: this must be a number"),
        ({"understudy": "world/1"}, ExperimentError, "use it with `understudy teach`"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_with_its_place(
    changes: dict[str, Any], error: type[UnderstudyError], told: str, tmp_path: Path
) -> None:
    with pytest.raises(error) as caught:
        load_experiment(written(tmp_path, **changes))
    assert told in str(caught.value)


def test_a_task_that_does_not_fit_the_skills_is_refused(tmp_path: Path) -> None:
    task = {"understudy": "task/1", "name": "t", "components": [{"id": "a", "behavior": "Fly"}], "links": []}
    (tmp_path / "flying.yaml").write_text(yaml.safe_dump(task), encoding="utf-8")
    with pytest.raises(NetworkError, match="Fly"):
        load_experiment(written(tmp_path, task="flying.yaml"))


def test_an_experiment_that_is_not_there() -> None:
    with pytest.raises(ExperimentError, match="no such experiment among: clutter, delivery, "):
        find_experiment("tea")


def test_files_are_looked_for_beside_the_document(tmp_path: Path) -> None:
    world = load_world(world_path("visit_targets")).model_copy(update={"name": "here"})
    (tmp_path / "here.yaml").write_text(world.to_yaml(), encoding="utf-8")
    experiment = load_experiment(written(tmp_path, world="here.yaml"))
    assert experiment.place(experiment.row("taught")) == world


def test_teacher_and_noise_of_a_row_go_before_those_of_the_experiment(tmp_path: Path) -> None:
    changes: dict[str, Any] = row(teacher={"speed": 0.6}) | {"teacher": {"speed": 0.2, "radius": 0.2}}
    experiment = load_experiment(written(tmp_path, noise={"laser": 0.0}, **changes))
    place, world = experiment.place(experiment.row("a")), experiment.world(experiment.row("a"))
    assert place.teacher is not None
    assert world.teacher is not None
    assert (place.teacher.speed, place.teacher.radius, place.noise.laser) == (0.6, 0.2, 0.0)
    assert place.teacher.script == world.teacher.script
    assert place.targets == world.targets


def test_a_changed_room_is_drawn_by_the_seed_within_the_limits(tmp_path: Path) -> None:
    experiment = load_experiment(written(tmp_path, **row(room="changed", limits={"spacing": 0.3})))
    rooms = [Unit(experiment=experiment, row=experiment.row("a"), seed=seed).room for seed in (1, 2, 1)]
    assert rooms[0] == rooms[2] != rooms[1]
    assert rooms[0] == rearranged(load_world(world_path("visit_targets")), 1, spacing=0.3)


def test_a_room_that_cannot_be_drawn_is_a_failed_trial(tmp_path: Path) -> None:
    experiment = load_experiment(
        written(tmp_path, task="hierarchical", **row(room="changed", limits={"robot_clearance": 9}))
    )
    trial = conduct(Unit(experiment=experiment, row=experiment.row("a"), seed=1))
    assert (trial.ending, trial.success) == ("error", False)
    assert "no free arrangement found" in trial.problems[0]
