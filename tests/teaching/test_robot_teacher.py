"""What a robot does and says that shows its task, alone in a room; a function stands for the bit of its follower."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from understudy.behaviors import installed_skills
from understudy.network import Component, Link, LinkType, Network
from understudy.robot import PIONEER, Cue
from understudy.sim import Simulation, World
from understudy.teaching import CAREFUL, NAIVE, Manner, RobotTeacher

from .support import room

PASS_GREEN = Component(
    id="track-green-1", behavior="Track", parameters={"color": "green", "distance_m": 0.5, "angle_deg": 180.0}
)
VISIT = Network(components=(PASS_GREEN,))
GREEN = {"targets": [{"color": "green", "at": [2.4, 2.6]}]}


@dataclass
class Shown:
    """What was seen of a teacher: its way after every period, when it said what, and when it achieved what."""

    teacher: RobotTeacher
    way_m: list[float] = field(default_factory=lambda: [0.0])
    turned: list[float] = field(default_factory=lambda: [0.0])
    words: list[tuple[int, Cue]] = field(default_factory=list)

    def tick_of(self, word: Cue) -> int:
        return next(tick for tick, said in self.words if said is word)

    @property
    def achieved(self) -> list[int]:
        return [round(10 * event.time_s) for event in self.teacher.events if event.kind == "achieved"]


def shown(
    network: Network,
    world: World,
    manner: Manner,
    followed: Callable[[int], bool] = lambda tick: True,
    ticks: int = 600,
) -> Shown:
    simulation = Simulation(world)
    robot = simulation.robot()
    found = Shown(RobotTeacher(network, installed_skills(), PIONEER, manner=manner))
    before = robot.sense().odometry.pose
    for tick in range(ticks):
        observation = robot.sense()
        command, words = found.teacher.step(observation, followed(tick))
        robot.act(command)
        found.words += [(tick, word) for word in words]
        if found.teacher.phase == "over":
            break
        simulation.step()
        pose = robot.sense().odometry.pose
        found.way_m.append(found.way_m[-1] + pose.position.distance_to(before.position))
        found.turned.append(found.turned[-1] + abs(math.remainder(pose.heading - before.heading, math.tau)))
        before = pose
    return found


def test_a_naive_teacher_speaks_at_once_and_cares_for_nobody() -> None:
    seen = shown(VISIT, room(**GREEN), NAIVE, followed=lambda tick: False)
    assert [word for _, word in seen.words] == [Cue.START, Cue.HERE, Cue.DONE]
    assert seen.tick_of(Cue.START) == 0
    assert [seen.tick_of(Cue.HERE)] == seen.achieved
    assert seen.teacher.complete


def test_a_careful_one_looks_around_first_and_begins_when_it_is_followed() -> None:
    seen = shown(VISIT, room(**GREEN), CAREFUL, followed=lambda tick: tick > 150)
    start = seen.tick_of(Cue.START)
    assert start == 151
    assert seen.turned[start] >= math.tau
    assert seen.way_m[start] < 0.1


def test_where_there_is_no_room_to_turn_it_begins_none_the_less() -> None:
    walls = [{"from": [0.6, y], "to": [1.8, y]} for y in (1.72, 2.28)]
    seen = shown(VISIT, room(**GREEN, walls=walls), CAREFUL, ticks=130)
    assert 100 < seen.tick_of(Cue.START) < 125
    assert seen.turned[-1] < math.tau


def test_the_word_comes_when_the_follower_stands_where_it_stood() -> None:
    seen = shown(VISIT, room(**GREEN), CAREFUL)
    [at], here, done = seen.achieved, seen.tick_of(Cue.HERE), seen.tick_of(Cue.DONE)
    assert at < here < done
    assert CAREFUL.shows_m <= seen.way_m[here] - seen.way_m[at] < CAREFUL.shows_m + 0.1
    assert seen.way_m[done] - seen.way_m[here] > 0.3


def test_it_waits_for_a_follower_that_is_lost_but_not_for_ever() -> None:
    lost = 130
    seen = shown(VISIT, room(**GREEN), CAREFUL, followed=lambda tick: tick < lost, ticks=400)
    assert seen.way_m[lost + 190] - seen.way_m[lost + 15] < 0.01
    assert seen.teacher.phase == "over"


def test_where_there_is_no_room_to_lead_on_the_words_are_said_all_the_same() -> None:
    corner = room(targets=[{"color": "green", "at": [4.4, 3.4]}])
    step = Component(id="track-green-1", behavior="Track", parameters={"color": "green", "distance_m": 0.6})
    seen = shown(Network(components=(step,)), corner, CAREFUL, ticks=900)
    assert [word for _, word in seen.words] == [Cue.START, Cue.HERE, Cue.DONE]


def test_picking_up_is_take_dropping_is_drop_and_an_empty_gripper_is_nothing_to_speak_of() -> None:
    first, last = (Component(id=f"drop-{number}", behavior="Drop") for number in (1, 2))
    fetch = Component(id="pick-up-orange-1", behavior="PickUp", parameters={"color": "orange"})
    links = tuple(Link(source=a.id, target=b.id, type=LinkType.ORDERING) for a, b in ((first, fetch), (fetch, last)))
    world = room(boxes=[{"color": "orange", "at": [2.4, 2.0]}])
    seen = shown(Network(components=(first, fetch, last), links=links), world, NAIVE)
    assert [word for _, word in seen.words] == [Cue.START, Cue.TAKE, Cue.DROP, Cue.DONE]
