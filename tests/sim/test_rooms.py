"""The bundled demonstrations run to their end; rearranged rooms are valid; several robots share a world."""

from itertools import combinations

import pytest

from tests.sim.support import make_world, simulate
from understudy.errors import WorldError
from understudy.geometry import Point
from understudy.robot import Command, Cue
from understudy.sim import Referee, Simulation, World, load_world, rearranged, world_path
from understudy.sim.layout import check_layout


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


def test_where_things_only_jitter_they_stay_near_and_keep_their_gaps() -> None:
    world = load_world(world_path("slalom"))
    assert world.jitter == 0.2
    rooms = [rearranged(world, seed) for seed in range(50)]
    moved = set()
    for room in rooms:
        check_layout(room)
        for before, after in zip((*world.targets, *world.robots), (*room.targets, *room.robots), strict=True):
            shift = [abs(a - b) for a, b in zip(before.at, after.at, strict=True)]
            assert max(shift) <= 0.2 + 1e-3
            moved.add(round(max(shift), 1))
        assert abs(room.robots[0].heading_deg - world.robots[0].heading_deg) <= 20.1
        assert [target.at[1] for target in room.targets] == sorted(target.at[1] for target in room.targets)
        for a, b in combinations(range(4), 2):
            assert distance(room, a, b) >= 0.8 + 0.2 - 0.01
    assert moved == {0.0, 0.1, 0.2}
    assert len({room.targets for room in rooms}) == 50


def test_what_only_jitters_may_stand_as_near_as_it_stood() -> None:
    world = load_world(world_path("transport")).model_copy(update={"jitter": 0.02})
    room = rearranged(world, 3, spacing=5.0, wall_margin=3.0, robot_clearance=3.0)
    assert distance(room, 1, 3) == pytest.approx(distance(world, 1, 3), abs=0.06)
    assert room.boxes[0].heading_deg == world.boxes[0].heading_deg
