"""The delivery task (§3.5.2): the document, the rooms that are drawn, a run from the worst beginning, a recovery."""

from typing import Any

import numpy as np
import pytest
import yaml

from understudy.behaviors import installed_skills
from understudy.execution import compile_network
from understudy.experiments import CONDITIONS, TABLES, Condition, Trial, Unit, conduct, find_experiment
from understudy.experiments.delivery_rooms import draw_room
from understudy.geometry import Point
from understudy.learning import observe
from understudy.network import load_task, parse_task, task_path
from understudy.perception import Attention
from understudy.robot import PIONEER, Color, Command, Cue
from understudy.sessions import perform
from understudy.sim import Simulation, World, load_world, world_path

EXPERIMENT = find_experiment("delivery")


def test_the_bundled_task_watches_the_bundled_rooms_landmarks() -> None:
    _, network = load_task(task_path("delivery"))
    program = compile_network(network, installed_skills())
    world = load_world(world_path("delivery"))
    assert program.attention.colors == {target.color for target in world.targets}
    assert program.attention.doorways == {(Color.GREEN, Color.YELLOW)}


@pytest.mark.parametrize("condition", CONDITIONS, ids=str)
def test_rooms_are_drawn_as_the_condition_says(condition: Condition) -> None:
    world = EXPERIMENT.worlds["delivery"]
    drawn = [draw_room(world, condition, np.random.default_rng(seed), door_open=seed == 0) for seed in range(5)]
    for world in drawn:
        robot, box = world.robots[0], world.boxes[0]
        assert (robot.at[1] < 3.5) is (condition.robot == "home")
        assert (box.at[1] < 3.5) is (condition.box == "home")
        assert Point(*robot.at).distance_to(Point(*box.at)) >= 0.7
        assert World.from_data({"understudy": "world/1", **world.model_dump(mode="json", by_alias=True)}) == world
    assert [abs(world.doors[0].open_deg) for world in drawn] == [80, 0, 0, 0, 0]
    assert len({world.robots[0].at for world in drawn}) == 5


def delivered(row: str, seed: int) -> Trial:
    return conduct(Unit(experiment=EXPERIMENT, row=EXPERIMENT.row(row), seed=seed))


def test_from_the_other_room_through_a_closed_door_with_the_box() -> None:
    trial = delivered("undisturbed", 7)
    assert trial.problems == ()
    assert (trial.details["at first"], trial.details["door"]) == ("robot other, box other", "closed")


def test_a_robot_that_is_carried_away_in_mid_run_recovers() -> None:
    trial = delivered("robot moved", 4)
    assert trial.problems == ()
    assert trial.details["at first"] == "robot home, box home"
    assert trial.details["moved"].startswith("the robot to (")


def test_nothing_rests_on_the_bundled_rooms() -> None:
    """Another building, in other colors, with the home room on another side of the door."""
    building = {
        "understudy": "world/1",
        "name": "other rooms",
        "seed": 1,
        "arena": {"size": [7.0, 5.0]},
        "walls": [{"from": [3.2, 0.0], "to": [3.2, 1.85]}, {"from": [3.2, 3.45], "to": [3.2, 5.0]}],
        "doors": [{"hinge": [3.2, 3.2], "to": [3.2, 2.1]}],
        "targets": [
            {"color": "red", "at": [3.2, 1.98]},
            {"color": "light green", "at": [3.2, 3.32]},
            {"color": "yellow", "at": [6.0, 4.0]},
        ],
        "boxes": [{"color": "pink", "at": [1.2, 1.5], "heading_deg": 30, "size": 0.13}],
        "robots": [{"name": "robot", "at": [5.5, 1.5], "heading_deg": 100}],
    }
    recolored = painted(yaml.safe_load(task_path("delivery").read_text(encoding="utf-8")))
    performed = perform(
        "delivery", parse_task(recolored)[1], World.from_data(building), installed_skills(), limit_s=600.0
    )
    assert performed.report.done
    assert performed.verdict.boxes[0].distance_to(Point(6.0, 4.0)) < 0.9
    assert not performed.verdict.collisions


def painted(part: Any) -> Any:
    """The task for a red and a light green post, a yellow beacon and a pink box."""
    posts = {"left_post": "red", "right_post": "light green"}
    colors = dict.fromkeys(("Localize", "OpenDoor", "GoThroughDoor"), posts)
    colors |= {"GoTo": posts | {"beacon": "yellow"}, "GetBox": {"color": "pink"}}
    if isinstance(part, list):
        return [painted(each) for each in part]
    if not isinstance(part, dict):
        return part
    inside = {key: painted(value) for key, value in part.items()}
    if "behavior" in inside:
        inside["parameters"] = inside.get("parameters", {}) | colors[inside["behavior"]]
    return inside


def test_the_conditions_are_told() -> None:
    def made(row: str, seed: int, *problems: str) -> Trial:
        details = {"at first": str(CONDITIONS[seed % 4]), "switches": 1}
        return Trial(
            experiment="delivery", row=row, seed=seed, ending="", time_s=10.0 + seed, problems=problems, details=details
        )

    trials = [made("undisturbed", 2), made("undisturbed", 6, "x"), made("box moved", 3)]
    assert TABLES["conditions"](EXPERIMENT, trials).rows == (
        ("undisturbed", "robot other, box home", "1 of 2", "14 s", "16 s", "2"),
        ("box moved", "robot other, box other", "1 of 1", "13 s", "13 s", "1"),
    )


def test_going_through_a_door_can_be_observed_where_the_landmarks_are_known() -> None:
    world = load_world(world_path("delivery"))
    start = world.robots[0].model_copy(update={"at": (2.1, 1.0), "heading_deg": 90.0})
    opened = world.doors[0].model_copy(update={"open_deg": 85.0})
    simulation = Simulation(world.model_copy(update={"robots": (start,), "doors": (opened,)}))
    robot, seen = simulation.robot(), []
    for tick in range(120):
        if tick in (5, 115):
            simulation.say(Cue.START if tick == 5 else Cue.DONE)
        seen.append(robot.sense())
        robot.act(Command(linear=0.4 if tick > 10 else 0.0))
        robot.wait()
    watched = Attention(doorways=frozenset({(Color.GREEN, Color.YELLOW)}))
    skills = installed_skills()
    found = observe(seen, PIONEER, skills, name="through", attention=watched).observations
    ends = {str(each.instance): each.interval for each in found}
    posts = "left_post=green, right_post=yellow"
    home, other = ends[f"GoThroughDoor(room=home, {posts})"], ends[f"GoThroughDoor(room=other, {posts})"]
    assert home.end < other.start
    assert ends[f"OpenDoor({posts})"].start < home.end
    assert f"Localize(room=either, {posts})" in ends
    unwatched = observe(seen, PIONEER, skills, name="through").observations
    assert {each.instance.behavior for each in unwatched} <= {"Track", "Drop"}
