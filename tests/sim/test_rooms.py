"""The bundled demonstrations run to their end; rearranged rooms are valid; several robots share a world."""

import math
from itertools import combinations, pairwise

import numpy as np
import pytest

from tests.sim.support import make_world, simulate, toward
from understudy.errors import WorldError
from understudy.geometry import Point
from understudy.robot import Command, Cue
from understudy.sim import Referee, Simulation, World, load_world, rearranged, world_path
from understudy.sim.layout import check_layout


def demonstrate(name: str) -> tuple[Simulation, Referee, list[tuple[float, Cue]]]:
    """Plays a bundled script with a follower that knows the truth, and that picks up and drops when told."""
    simulation = Simulation(load_world(world_path(name)))
    robot, referee = simulation.robot(), Referee(simulation)
    heard: list[tuple[float, Cue]] = []
    told: Cue | None = None
    since = 0.0
    while not simulation.teacher_done and simulation.time_s < 180.0:
        observation = robot.sense()
        for cue in observation.cues:
            heard.append((observation.time_s, cue))
            told, since = cue, observation.time_s
        pose, goal = referee.robot_pose(), referee.teacher()
        assert goal is not None
        command = Command()
        if told is Cue.TAKE and referee.held_box() is None:
            box = referee.boxes()[0]
            if pose.to_local(box).x > 0.33:
                approach = toward(pose, box, 0.2)
                command = Command(
                    linear=min(0.2, approach.linear), angular=approach.angular, paddles="open", lift="down"
                )
                since = observation.time_s
            else:
                command = Command(paddles="close", lift="up" if observation.time_s > since + 1.5 else None)
        elif told is Cue.DROP:
            command = Command(lift="down", paddles="open" if observation.time_s > since + 1.0 else None)
        elif told is not None:
            command = toward(pose, goal, 0.65)
        robot.act(command)
        robot.wait()
    return simulation, referee, heard


def test_visiting_targets_runs_to_its_end() -> None:
    simulation, referee, heard = demonstrate("visit_targets")
    assert simulation.teacher_done
    assert [cue for _, cue in heard] == [Cue.START, Cue.DONE]
    assert 30.0 < simulation.time_s < 120.0
    assert not referee.collisions
    path = np.array([(pose.x, pose.y) for pose in referee.trajectories["learner"]])
    nearest = [np.hypot(*(path - target).T) for target in referee.targets()]
    assert all(0.45 < gaps.min() < 0.85 for gaps in nearest)
    assert [int(gaps.argmin()) for gaps in nearest] == sorted(int(gaps.argmin()) for gaps in nearest)
    # Every target is passed on the right, and the last one is behind at the end.
    for target, gaps in zip(referee.targets(), nearest, strict=True):
        pose = referee.trajectories["learner"][int(gaps.argmin())]
        assert pose.to_local(target).bearing == pytest.approx(-math.pi / 2, abs=0.4)
    assert referee.robot_pose().to_local(referee.targets()[-1]).x < 0.0
    assert all(a.distance_to(b) >= 2.1 for a, b in combinations(referee.targets(), 2))


def test_transport_runs_to_its_end() -> None:
    simulation, referee, heard = demonstrate("transport")
    assert simulation.teacher_done
    assert [cue for _, cue in heard] == [Cue.START, Cue.TAKE, Cue.DROP, Cue.DONE]
    assert 20.0 < simulation.time_s < 120.0
    assert not referee.collisions
    _, yellow, light_orange, orange = referee.targets()
    assert referee.boxes()[0].distance_to(orange) < 1.0
    crossing = [(a.x + b.x) / 2 for a, b in pairwise(referee.trajectories["learner"]) if a.y < yellow.y <= b.y]
    assert len(crossing) == 1
    assert yellow.x + 0.35 < crossing[0] < light_orange.x - 0.35
    told_to_drop = next(time for time, cue in heard if cue is Cue.DROP)
    pose = referee.trajectories["learner"][round(told_to_drop * 10)]
    assert pose.to_local(orange).bearing == pytest.approx(math.pi / 2, abs=0.3)


def test_at_take_the_box_is_in_view_and_the_teacher_in_the_lasers_field() -> None:
    simulation = Simulation(load_world(world_path("transport")))
    robot, referee = simulation.robot(), Referee(simulation)
    while Cue.TAKE not in robot.sense().cues:
        goal = referee.teacher()
        assert goal is not None
        robot.act(toward(referee.robot_pose(), goal, 0.65))
        robot.wait()
        assert simulation.time_s < 30
    box = referee.robot_pose().to_local(referee.boxes()[0])
    assert 0.7 < box.distance < 1.25
    assert abs(box.bearing) < math.radians(24)
    teacher = referee.teacher()
    assert teacher is not None
    assert abs(referee.robot_pose().to_local(teacher).bearing) < math.radians(70)


@pytest.mark.parametrize("name", ["visit_targets", "transport"])
def test_fifty_rearranged_rooms_are_valid_and_different(name: str) -> None:
    world = load_world(world_path(name))
    rooms = [rearranged(world, seed) for seed in range(50)]
    for room in rooms:
        check_layout(room)
        assert room.teacher is None
        assert [target.color for target in room.targets] == [target.color for target in world.targets]
        assert all(0.6 - 1e-3 <= target.at[0] <= 4.0 - 0.6 + 1e-3 for target in room.targets)
        for a, b in combinations(range(len(room.targets)), 2):
            if room.targets[a].group is None or room.targets[a].group != room.targets[b].group:
                assert distance(room, a, b) >= 0.8 + 0.2 - 0.01
            else:
                assert distance(room, a, b) == pytest.approx(distance(world, a, b), abs=0.003)
    assert len({room.targets for room in rooms}) == 50
    assert rearranged(world, 17) == rooms[17]
    assert World.from_data(rooms[3].model_dump(mode="json", by_alias=True)) == rooms[3]


def distance(world: World, a: int, b: int) -> float:
    return Point(*world.targets[a].at).distance_to(Point(*world.targets[b].at))


def test_a_box_stays_with_its_group_when_a_room_is_rearranged() -> None:
    world = load_world(world_path("transport"))

    def offset(room: World) -> float:
        return Point(*room.boxes[0].at).distance_to(Point(*room.targets[0].at))

    assert all(offset(rearranged(world, seed)) == pytest.approx(offset(world), abs=0.003) for seed in range(10))


def test_an_impossible_rearrangement_is_refused_with_a_way_out() -> None:
    world = load_world(world_path("visit_targets"))
    with pytest.raises(WorldError, match="make them smaller or the arena larger"):
        rearranged(world, 1, spacing=5.0)


def test_two_robots_and_a_teacher_share_a_world() -> None:
    simulation = simulate(
        robots=[
            {"name": "learner", "at": [1.0, 1.0], "heading_deg": 90},
            {"name": "guide", "at": [3.0, 1.0], "heading_deg": 90, "marker": "pink"},
        ],
        teacher={"at": [1.0, 2.0], "leads": "learner", "script": [{"say": "START"}, {"walk": [1.0, 3.0]}]},
    )
    learner, guide, referee = simulation.robot("learner"), simulation.robot("guide"), Referee(simulation)
    assert learner is not guide
    heard: dict[str, list[Cue]] = {"learner": [], "guide": []}
    for _ in range(40):
        learner.act(Command(linear=0.2))
        guide.act(Command(linear=0.4))
        simulation.step()
        for robot in (learner, guide):
            observation = robot.sense()
            assert observation.time_s == simulation.time_s
            heard[robot.name] += observation.cues
    assert heard == {"learner": [Cue.START], "guide": [Cue.START]}
    assert referee.robot_pose("learner").y == pytest.approx(1.0 + 0.2 * 4.0, abs=0.05)
    assert referee.robot_pose("guide").y == pytest.approx(1.0 + 0.4 * 4.0, abs=0.15)
    assert not referee.collisions


def test_the_other_robots_noise_is_its_own() -> None:
    robots = [{"name": "a", "at": [1.0, 3.0], "heading_deg": 90}, {"name": "b", "at": [3.0, 3.0], "heading_deg": 90}]
    simulation = Simulation(make_world(robots=robots, noise={}))
    error_a = simulation.robot("a").sense().scan.ranges[90] - 2.9
    error_b = simulation.robot("b").sense().scan.ranges[90] - 2.9
    assert error_a != error_b
