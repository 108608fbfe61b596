"""Teachers of other habits: what each habit does, and that the careful teacher is the one without slips."""

from typing import Any

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from tests.sim.support import QUIET, drive, make_world, toward
from understudy.geometry import Point
from understudy.robot import Cue
from understudy.sim import LEVELS, Habits, Referee, Simulation, World, load_world, world_path
from understudy.sim.script import ScriptItem
from understudy.sim.slips import Slip, slipped

SCRIPT: list[Any] = [
    {"say": "START"},
    {"walk": {"to": [2.0, 3.5], "say": {"word": "HERE", "when_robot_within": 1.0, "of": [2.7, 3.5]}}},
    {"step_aside": [1.2, 3.6]},
    {"walk": {"to": [2.0, 4.5], "say": {"word": "DROP", "when_robot_past": [1.4, 4.0]}}},
    {"say": "HERE"},
    {"wait": 1.0},
    {"say": "DONE"},
]
ITEMS = tuple(ScriptItem.model_validate(item) for item in SCRIPT)
SPEED = 0.4

habits = st.builds(
    Habits,
    late=st.floats(-3, 3),
    timing=st.floats(0, 3),
    forgets=st.sampled_from([0.0, 0.3, 1.0]),
    strays=st.sampled_from([0.0, 0.3, 1.0]),
)


def played(habits: Habits, seed: int = 0, *, free: bool = True) -> tuple[tuple[ScriptItem, ...], tuple[Slip, ...]]:
    random = np.random.default_rng(seed)
    return slipped(ITEMS, habits, random, start=Point(2.0, 2.8), speed=SPEED, free=lambda spot: free)


def taught_by(habits: Any, seed: int = 3, **changes: Any) -> World:
    teacher = {"at": [2.0, 2.8], "script": SCRIPT, "habits": habits}
    return make_world(teacher=teacher, seed=seed, **changes)


def followed(simulation: Simulation, seconds: float = 400.0, *, speed: float = 0.5) -> list[tuple[float, Cue]]:
    """Follows the teacher on true positions as long as it is in view, up to the script's end."""
    robot, referee, heard = simulation.robot(), Referee(simulation), []
    while not simulation.teacher_done:
        assert simulation.time_s < seconds, simulation.teacher_at
        observation = robot.sense()
        heard += [(observation.time_s, cue) for cue in observation.cues]
        goal, pose = referee.teacher(), referee.robot_pose()
        assert goal is not None
        command = toward(pose, goal, 0.65)
        if pose.to_local(goal).distance < 2.0:
            robot.act(type(command)(linear=min(speed, command.linear), angular=command.angular))
        robot.wait()
    return heard


# -- the document ---------------------------------------------------------------------------------------------------


def test_a_level_fills_in_what_is_left_out() -> None:
    assert Habits.model_validate("experienced") == Habits() == Habits.model_validate({})
    for level, keys in LEVELS.items():
        known = Habits.model_validate(level)
        assert known == Habits.model_validate({"like": level, **keys})
        assert Habits.model_validate({"like": level, "heeds": 0.5}) == known.model_copy(update={"heeds": 0.5})
        assert Habits.model_validate({"like": level, "forgets": 0.0}).forgets == 0.0


def test_each_level_errs_more_than_the_one_before() -> None:
    careful, instructed, inexperienced = (Habits.model_validate(level) for level in LEVELS)
    for name in LEVELS["inexperienced"]:
        if name != "patience":
            assert getattr(careful, name) < getattr(instructed, name) < getattr(inexperienced, name)


@pytest.mark.parametrize("given_as", ["inexperienced", {"like": "instructed", "heeds": 1.0}, {"late": -0.5}])
def test_a_world_with_habits_can_be_written_and_read_again(given_as: Any) -> None:
    world = taught_by(given_as)
    assert World.from_data(yaml.safe_load(world.to_yaml())) == world


# -- slips ----------------------------------------------------------------------------------------------------------


@given(st.integers(0, 1000), st.booleans())
def test_an_experienced_teacher_plays_the_script_as_it_is(seed: int, free: bool) -> None:
    assert played(Habits.model_validate("experienced"), seed, free=free) == (ITEMS, ())


@given(habits, st.integers(0, 1000), st.booleans())
def test_every_departure_from_the_script_is_told_and_nothing_else_departs(
    habits: Habits, seed: int, free: bool
) -> None:
    script, slips = played(habits, seed, free=free)
    assert len(script) == len(ITEMS)
    assert {slip.item for slip in slips} == {
        index for index, (one, other) in enumerate(zip(script, ITEMS, strict=True)) if one != other
    }
    assert all(slip.word is Cue.HERE for slip in slips if slip.kind == "forgotten")
    assert free or not any(slip.kind == "aside" for slip in slips)


@given(habits, st.integers(0, 1000))
def test_one_habit_does_not_change_what_the_others_do(habits: Habits, seed: int) -> None:
    def slips_without(kind: str, habits: Habits) -> list[tuple[int, str]]:
        return [(slip.item, slip.kind) for slip in played(habits, seed)[1] if slip.kind != kind]

    steady = habits.model_copy(update={"strays": 0.0})
    assert slips_without("aside", steady) == slips_without("aside", habits)


def test_who_forgets_says_here_never_and_all_else() -> None:
    script, slips = played(Habits(forgets=1.0))
    said = [item.say or (item.walk.say if item.walk is not None else None) for item in script]
    assert [one.word for one in said if one is not None] == [Cue.START, Cue.DROP, Cue.DONE]
    assert [str(slip) for slip in slips] == ["script[1]: HERE was forgotten", "script[4]: HERE was forgotten"]


def test_a_late_word_is_delayed_and_an_early_one_comes_so_much_farther_off() -> None:
    late, _ = played(Habits(late=1.5))
    assert late[0].say is not None
    assert late[0].say.delay == 1.5
    early, slips = played(Habits(late=-1.5))
    here, drop = early[1].walk, early[3].walk
    assert here is not None
    assert here.say is not None
    assert here.say.when_robot_within == pytest.approx(1.0 + 1.5 * SPEED)
    assert drop is not None
    assert drop.say is not None
    assert drop.say.when_robot_past is not None
    moved = Point(*drop.say.when_robot_past)
    assert moved.distance_to(Point(1.4, 4.0)) == pytest.approx(1.5 * SPEED)
    assert moved.y < 4.0  # against the direction of the walk
    assert [slip.item for slip in slips] == [1, 3]  # what waits for nothing cannot come too early


def test_words_are_as_late_as_their_mean_and_spread_say() -> None:
    late = []
    for seed in range(300):
        by_item = {slip.item: slip for slip in played(Habits(late=2.0, timing=0.5), seed)[1]}
        slip = by_item[1]
        late.append(slip.amount if slip.kind == "late" else -slip.amount)
    assert np.mean(late) == pytest.approx(2.0, abs=0.1)
    assert np.std(late) == pytest.approx(0.5, abs=0.06)


def test_a_walk_that_strays_ends_aside_of_where_it_should_to_either_side() -> None:
    ends = set()
    for seed in range(20):
        walk = played(Habits(strays=1.0, strays_by=0.5), seed)[0][1].walk
        assert walk is not None
        ends.add(tuple(round(number, 9) for number in walk.to))
    assert ends == {(1.5, 3.5), (2.5, 3.5)}


def test_the_robots_noise_does_not_depend_on_the_teacher() -> None:
    noisy = {**QUIET, "laser": 0.02}
    scans = [
        Simulation(taught_by(level, noise=noisy)).robot().sense().scan.ranges.tolist()
        for level in ("experienced", "inexperienced")
    ]
    assert scans[0] == scans[1]


# -- walking --------------------------------------------------------------------------------------------------------


def test_with_another_pace_the_teacher_walks_faster() -> None:
    times = []
    for pace in (1.0, 2.0):
        world = make_world(
            teacher={
                "at": [2.0, 2.8],
                "habits": {"pace": pace},
                "script": [{"step_aside": [2.0, 5.3]}, {"say": "DONE"}],
            }
        )
        simulation = Simulation(world)
        while not simulation.teacher_done:
            simulation.step()
        times.append(simulation.time_s)
    assert times[1] < 0.7 * times[0]


@pytest.mark.parametrize("lead", [1.2, 2.0])
def test_the_teacher_waits_so_far_ahead(lead: float) -> None:
    simulation = Simulation(
        make_world(teacher={"at": [2.0, 2.8], "habits": {"lead": lead}, "script": [{"walk": [2.0, 5.5]}]})
    )
    drive(simulation.robot(), 20.0)
    at = Referee(simulation).teacher()
    assert at is not None
    assert at.distance_to(Point(2.0, 2.0)) == pytest.approx(lead, abs=0.15)


def test_who_seldom_looks_back_gets_farther_ahead() -> None:
    away = []
    for seconds in (0.0, 4.0):
        simulation = Simulation(
            make_world(teacher={"at": [2.0, 2.8], "habits": {"looks_back": seconds}, "script": [{"walk": [2.0, 5.5]}]})
        )
        drive(simulation.robot(), 20.0)
        at = Referee(simulation).teacher()
        assert at is not None
        away.append(at.distance_to(Point(2.0, 2.0)))
    assert away[0] < 1.3
    assert away[1] > 2.0


def test_whose_patience_ends_goes_on_without_the_robot() -> None:
    walk = [{"walk": {"to": [2.0, 5.0], "say": {"word": "HERE", "when_robot_within": 0.5, "of": [2.0, 5.0]}}}]
    simulation = Simulation(
        make_world(teacher={"at": [2.0, 2.8], "habits": {"patience": 40.0}, "script": [*walk, {"say": "DONE"}]})
    )
    while not simulation.teacher_done:
        simulation.step()
        assert simulation.time_s < 60.0
    sentences = [sentence for _, sentence in simulation.teacher_complaints]
    assert sentences[0].startswith("went on without the robot, which cost 40 s on the walk to (2.0, 5.0)")
    assert len(sentences) == 2  # and the word was said in vain


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("seed", range(4))
def test_the_script_of_every_level_ends_with_done(level: str, seed: int) -> None:
    heard = followed(Simulation(taught_by(level, seed)))
    assert [cue for _, cue in heard][-1] is Cue.DONE


@pytest.mark.parametrize("level", ["instructed", "inexperienced"])
def test_a_script_ends_also_without_a_robot_that_follows(level: str) -> None:
    world = load_world(world_path("errand"))
    assert world.teacher is not None
    teacher = world.teacher.model_copy(update={"habits": Habits.model_validate(level)})
    simulation = Simulation(world.model_copy(update={"teacher": teacher}))
    while not simulation.teacher_done:
        simulation.step()
        assert simulation.time_s < 1500.0
