"""One lesson, two robots: taught to the Pioneer, done by a round one without a gripper; or refused, with the reason."""

from pathlib import Path

import numpy as np
import pytest

from understudy.behaviors import installed_skills
from understudy.errors import SkillError
from understudy.learning import learn
from understudy.robot import PIONEER, TURTLEBOT, Command
from understudy.sessions import capabilities, perform, teach, unbound
from understudy.sim import Simulation, World, load_world, world_path

SKILLS = installed_skills()


def with_turtlebot(world: World) -> World:
    robots = tuple(robot.model_copy(update={"kind": "turtlebot"}) for robot in world.robots)
    return world.model_copy(update={"robots": robots})


def test_a_visiting_task_runs_unchanged_on_another_robot() -> None:
    world = load_world(world_path("visit_targets"))
    network = learn(teach(world, SKILLS).demonstration).network
    performed = perform("visit", network, with_turtlebot(world), SKILLS, seed=1)
    assert performed.stage.robot.spec is TURTLEBOT
    assert performed.report.done
    assert performed.verdict.clean


def test_a_transport_task_is_refused_with_the_reason(tmp_path: Path) -> None:
    world = load_world(world_path("transport"))
    network = learn(teach(world, SKILLS).demonstration).network
    path = tmp_path / "run.mcap"
    with pytest.raises(SkillError, match=r"turtlebot cannot do this task \(Drop, PickUp: needs a gripper\); run it on"):
        perform("transport", network, with_turtlebot(world), SKILLS, recording=path)
    assert not path.exists()


def test_which_skills_bind() -> None:
    assert unbound(SKILLS, PIONEER) == ""
    missing = {one.skill: one.missing for one in capabilities(SKILLS, TURTLEBOT)}
    assert missing["Track"] == ""
    assert missing["PickUp"] == missing["GetBox"] == "a gripper"


def test_its_senses_and_its_body() -> None:
    world = with_turtlebot(load_world(world_path("visit_targets")))
    simulation = Simulation(world)
    robot = simulation.robot(world.robots[0].name)
    seen = robot.sense()
    assert seen.gripper is None
    assert seen.sonar.size == 0
    assert seen.scan.ranges.size == 360
    assert seen.scan.angle_min == pytest.approx(-np.pi)
    assert np.isfinite(seen.scan.ranges[[0, 90, 180, 270]]).all()  # the walls behind, right, ahead and left
    for _ in range(20):
        robot.act(Command(angular=9.0))
        robot.wait()
    assert robot.sense().odometry.angular == pytest.approx(TURTLEBOT.max_angular, rel=0.1)
