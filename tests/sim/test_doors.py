"""Swinging doors: the document, the hinge, what the senses make of them; and boxes that are pushed."""

import math
from typing import Any

import numpy as np
import pytest
from pytest import approx

from understudy.errors import WorldError
from understudy.geometry import Point
from understudy.robot import RGB, Color, Command
from understudy.sim import Referee, SimRobot, Simulation, World, load_world, rearranged, world_path

from .support import drive, make_world, simulate, world_data

DOOR = {"hinge": [1.4, 3.0], "to": [2.6, 3.0]}
ROBOT = [{"name": "learner", "at": [2.0, 2.0], "heading_deg": 90}]


@pytest.mark.parametrize(
    ("door", "problem", "path"),
    [
        ({"hinge": [1.4, 3.0], "to": [2.6, 3.0], "color": "red"}, "color", "doors[0].color"),
        ({"hinge": [1.4, 3.0]}, "to", "doors[0].to"),
        ({"hinge": [1.4, 3.0], "to": [1.5, 3.0]}, "0.1 m wide; it takes at least 0.2 m", "doors[0].to"),
        ({"hinge": [1.4, 3.0], "to": [2.6, 3.0], "open_deg": 120}, "from -110 to 110", "doors[0].open_deg"),
        ({"hinge": [1.4, 3.0], "to": [4.6, 3.0]}, "outside the arena", "doors[0]"),
        ({"hinge": [1.4, 2.0], "to": [2.6, 2.0]}, "overlaps", "robots[0].at"),
    ],
)
def test_a_door_that_cannot_be(door: dict[str, Any], problem: str, path: str) -> None:
    with pytest.raises(WorldError) as caught:
        World.from_data(world_data(doors=[door]))
    assert problem in str(caught.value)
    assert caught.value.path == path


def test_where_a_door_stands_open_nothing_else_may_stand() -> None:
    box = [{"color": "orange", "at": [1.4, 3.5]}]
    make_world(doors=[DOOR], boxes=box)
    with pytest.raises(WorldError, match=r"overlaps doors\[0\]"):
        make_world(doors=[DOOR | {"open_deg": 90}], boxes=box)


def test_a_door_hangs_on_a_wall_and_is_written_down_as_it_was_read() -> None:
    world = make_world(doors=[DOOR | {"open_deg": -30}], walls=[{"from": [0, 3.0], "to": [1.4, 3.0]}])
    assert World.from_data(_data(world)) == world
    assert world.doors[0].edge(-30) == approx((1.4 + 1.2 * math.cos(-math.pi / 6), 3.0 - 0.6))


def _data(world: World) -> dict[str, Any]:
    import yaml

    data: dict[str, Any] = yaml.safe_load(world.to_yaml())
    return data


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_door_is_pushed_open_from_either_side_and_stays(side: float) -> None:
    simulation = simulate(doors=[DOOR], robots=[ROBOT[0] | {"at": [2.0, 3.0 - side], "heading_deg": 90 * side}])
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 8.0, linear=0.2)
    drive(robot, 1.0)
    [opened] = referee.doors()
    assert 55 < side * opened < 85
    drive(robot, 5.0)
    assert referee.doors() == [approx(opened, abs=0.1)]
    assert referee.count() == 0, "a door is there to be pushed"
    assert [push.other for push in referee.pushes] == [0]


def test_a_door_that_nobody_touches_does_not_move() -> None:
    simulation = simulate(doors=[DOOR | {"open_deg": 40}])
    drive(simulation.robot(), 3.0)
    assert Referee(simulation).doors() == [approx(40, abs=0.01)]


def test_a_door_by_hand() -> None:
    simulation = simulate(doors=[DOOR])
    simulation.swing_door(0, 70)
    drive(simulation.robot(), 1.0)
    assert Referee(simulation).doors() == [approx(70, abs=0.1)]
    with pytest.raises(WorldError, match="there is no door 1; the world has 1"):
        simulation.swing_door(1, 0)
    with pytest.raises(WorldError, match="from -110 to 110 degrees, given 120"):
        simulation.swing_door(0, 120)


def test_laser_and_sonar_meet_a_door_until_it_is_open() -> None:
    simulation = simulate(doors=[DOOR])
    robot = simulation.robot()
    shut = robot.sense()
    assert shut.scan.ranges[90] == approx(3.0 - 0.015 - 2.1, abs=0.01)
    simulation.swing_door(0, 90)
    opened = robot.sense()
    assert opened.scan.ranges[90] == approx(6.0 - 2.1, abs=0.01)
    assert opened.sonar[4] > shut.sonar[4] + 1.0


def test_the_camera_sees_a_door_before_what_is_behind_it() -> None:
    target = [{"color": "green", "at": [2.0, 4.5]}]
    simulation = simulate(doors=[DOOR], targets=target)
    robot = simulation.robot()

    def green() -> int:
        image = robot.sense().image
        assert image is not None
        return int((np.abs(image.astype(int) - RGB[Color.GREEN]).max(axis=2) < 60).sum())

    assert green() == 0
    simulation.swing_door(0, 90)
    assert green() > 50


def test_the_bundled_room_has_two_sections_and_nothing_in_its_door() -> None:
    world = load_world(world_path("delivery"))
    robot = Simulation(world).robot().sense()
    assert float(robot.scan.ranges[np.isfinite(robot.scan.ranges)].max()) < 4.5, "the other section is not to be seen"


@pytest.mark.parametrize("turned", [0, 20, 45])
@pytest.mark.parametrize(
    "moves", [[(0.25, 0.0)], [(0.0, 1.2), (0.0, -1.2)], [(0.2, 0.4), (0.2, -0.4), (0.4, 0.8)], [(0.4, 0.0), (0.0, 0.0)]]
)
def test_a_box_stays_between_the_open_paddles_while_the_robot_drives_on_and_turns(
    moves: list[tuple[float, float]], turned: float
) -> None:
    box = {"color": "orange", "at": [2.65, 4.01], "size": 0.13, "heading_deg": turned}
    simulation = simulate(arena={"size": [8, 8]}, robots=[ROBOT[0] | {"at": [2.0, 4.0], "heading_deg": 0}], boxes=[box])
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 1.5, paddles="open", lift="down")
    drive(robot, 3.5, linear=0.12)
    for linear, angular in moves:
        drive(robot, 3.0, linear=linear, angular=angular)
        assert broken(robot)
        place = referee.robot_pose().to_local(referee.boxes()[0])
        assert 0.27 < place.x < 0.31
        assert abs(place.y) < 0.05


def test_a_pushed_box_is_left_where_the_robot_backs_off() -> None:
    box = {"color": "orange", "at": [2.0, 2.65], "size": 0.13}
    simulation = simulate(boxes=[box])
    robot, referee = simulation.robot(), Referee(simulation)
    drive(robot, 1.5, paddles="open", lift="down")
    drive(robot, 6.0, linear=0.15)
    drive(robot, 0.5)
    place = referee.boxes()[0]
    robot.act(Command(linear=-0.2))
    drive(robot, 1.5, linear=-0.2)
    assert not broken(robot)
    assert referee.boxes()[0].distance_to(Point(*place)) < 0.03


def broken(robot: SimRobot) -> bool:
    gripper = robot.sense().gripper
    assert gripper is not None
    return gripper.beam_broken


def test_a_rearranged_room_keeps_its_door() -> None:
    world = load_world(world_path("delivery"))
    rooms = set()
    for seed in range(8):
        changed = rearranged(world, seed)
        assert changed.doors == world.doors
        posts, (beacon,) = changed.targets[:2], changed.targets[2:]
        assert posts == world.targets[:2]
        assert beacon.at != world.targets[2].at
        rooms.add((beacon.at[1] < 3.5, changed.robots[0].at[1] < 3.5))
    assert len(rooms) > 2
