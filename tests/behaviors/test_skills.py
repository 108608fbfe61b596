"""Skills: their parameters, goals and observations, and the registry."""

import math
from importlib.metadata import EntryPoint

import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.behaviors import Instance, SkillSet, installed_skills, registry, unknown_skill
from understudy.behaviors.drop import DROP
from understudy.behaviors.pick_up import PICK_UP
from understudy.behaviors.track import TRACK
from understudy.errors import SkillError
from understudy.geometry import Point
from understudy.perception import GripperState, Percepts, Thing
from understudy.robot import Color


def target(distance: float, angle_deg: float, color: Color = Color.GREEN, **more: object) -> Thing:
    """A target whose surface is at a distance and angle."""
    bearing, reach = math.radians(angle_deg - 90), distance + 0.1
    values = {"id": 1, "radius": 0.1, "sensed": True, "seen_s": 0.0} | more
    return Thing(color=color, position=Point(reach * math.cos(bearing), reach * math.sin(bearing)), **values)  # type: ignore[arg-type]


def sees(*targets: Thing) -> Percepts:
    return Percepts(time_s=0.0, targets=targets)


def holds(color: Color | None, *, blocked: bool = True) -> Percepts:
    gripper = GripperState(holding=blocked, empty=not blocked, color=color, open=False, raised=True, blocked=blocked)
    return Percepts(time_s=0.0, gripper=gripper)


def test_defaults_are_filled_in_and_colors_checked() -> None:
    assert TRACK.complete({"color": "light orange", "distance_m": 1}) == {
        "color": Color.LIGHT_ORANGE,
        "distance_m": 1.0,
        "angle_deg": 90.0,
    }


@pytest.mark.parametrize(
    ("given_", "message"),
    [
        ({"color": "mauve"}, "'mauve' is no trained color; color is one of: red, orange"),
        ({}, "needs a value for 'color'"),
        ({"color": "red", "distance": 1}, "has no parameter 'distance'; it takes color, distance_m, angle_deg"),
        ({"color": "red", "distance_m": 2.5}, "distance_m is 2.5; it is a number from 0.3 to 2"),
        ({"color": "red", "distance_m": True}, "distance_m is True"),
        ({"color": "red", "angle_deg": "left"}, "angle_deg is 'left'"),
        ({"color": "red", "angle_deg": float("nan")}, "angle_deg is nan"),
    ],
)
def test_what_a_skill_does_not_take(given_: dict[str, object], message: str) -> None:
    with pytest.raises(SkillError, match=r"^Track") as caught:
        TRACK.complete(given_)
    assert message in str(caught.value)


@given(st.floats(0.3, 2.0), st.floats(0, 180), st.floats(0.3, 2.0), st.floats(0, 180))
def test_the_goal_of_track_is_distance_and_angle_within_tolerance(
    wanted: float, angle: float, distance: float, at: float
) -> None:
    parameters = TRACK.complete({"color": "green", "distance_m": wanted, "angle_deg": angle})
    holds_ = abs(distance - wanted) <= 0.1 and abs(at - angle) <= 10
    close_call = abs(abs(distance - wanted) - 0.1) < 1e-6 or abs(abs(at - angle) - 10) < 1e-6
    assert close_call or TRACK.abstract.goal(sees(target(distance, at)), parameters) is holds_


def test_a_target_of_another_color_or_from_memory_does_not_count() -> None:
    parameters = TRACK.complete({"color": "green", "distance_m": 0.6})
    assert TRACK.abstract.goal(sees(target(0.6, 90)), parameters)
    assert not TRACK.abstract.goal(sees(target(0.6, 90, Color.RED)), parameters)
    assert not TRACK.abstract.goal(sees(target(0.6, 90, sensed=False)), parameters)
    assert TRACK.abstract.precondition(sees(target(0.6, 90, sensed=False)), parameters)
    assert not TRACK.abstract.precondition(sees(), parameters)


@given(st.floats(0.3, 1.99), st.floats(0, 180))  # at 2 m sharp it is rounding that decides
def test_the_values_observed_would_make_the_goal_true(distance: float, angle: float) -> None:
    """Semantics §1: "which parameter values would make me true right now?"."""
    percepts = sees(target(distance, angle))
    [(instance, values)] = TRACK.abstract.observe(percepts).items()
    assert instance == Instance("Track", (("color", "green"),))
    assert TRACK.abstract.goal(percepts, TRACK.complete({**dict(instance.parameters), **values}))


def test_of_two_targets_of_one_color_the_nearer_one_is_meant() -> None:
    [(_, values)] = TRACK.abstract.observe(sees(target(0.5, 90), target(1.5, 60))).items()
    assert values["distance_m"] == pytest.approx(0.5)


@pytest.mark.parametrize(
    "thing",
    [target(2.2, 90), target(1.0, 190), target(1.0, 90, followed=False), target(1.0, 90, sensed=False)],
    ids=["too far", "behind", "laser alone", "from memory"],
)
def test_goals_that_cannot_be_evaluated_are_not_observed(thing: Thing) -> None:
    assert TRACK.abstract.observe(sees(thing)) == {}


def test_the_gripper_tells_pick_up_and_drop() -> None:
    orange = PICK_UP.complete({"color": "orange"})
    assert PICK_UP.abstract.goal(holds(Color.ORANGE), orange)
    assert not PICK_UP.abstract.goal(holds(Color.RED), orange)
    assert not PICK_UP.abstract.goal(holds(None, blocked=False), orange)
    assert DROP.abstract.goal(holds(None, blocked=False), {})
    assert not DROP.abstract.goal(holds(Color.RED), {})
    assert PICK_UP.abstract.observe(holds(Color.RED)) == {Instance("PickUp", (("color", "red"),)): {}}
    assert PICK_UP.abstract.observe(holds(None)) == {}
    assert DROP.abstract.observe(holds(None, blocked=False)) == {Instance("Drop"): {}}


def test_a_robot_without_a_gripper_has_no_goals_for_it() -> None:
    bare = Percepts(time_s=0.0)
    assert not PICK_UP.abstract.goal(bare, PICK_UP.complete({"color": "red"}))
    assert not PICK_UP.abstract.precondition(bare, PICK_UP.complete({"color": "red"}))
    assert not DROP.abstract.goal(bare, {})
    assert PICK_UP.abstract.observe(bare) == DROP.abstract.observe(bare) == {}


def test_skills_come_through_entry_points() -> None:
    assert set(installed_skills()) >= {"Track", "PickUp", "Drop"}


def test_an_unknown_skill_is_answered_with_those_that_exist() -> None:
    expected = "there is no skill called 'Trak', did you mean 'Track'?; installed are: Track, Drop"
    assert unknown_skill("Trak", SkillSet(TRACK, DROP)) == expected
    assert SkillSet(TRACK).get("Drop") is None


def test_two_skills_of_one_name_are_refused() -> None:
    with pytest.raises(SkillError, match="two skills are called 'Drop'"):
        SkillSet(DROP, DROP)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("understudy.behaviors.nowhere:X", "cannot be loaded: No module named"),
        ("understudy.behaviors.track:NOTHING", "cannot be loaded"),
        ("understudy.behaviors.track:COLOR", "is no understudy Skill"),
    ],
)
def test_a_broken_entry_point_is_named(monkeypatch: pytest.MonkeyPatch, value: str, message: str) -> None:
    broken = EntryPoint("mine", value, registry.ENTRY_POINT_GROUP)
    monkeypatch.setattr(registry, "entry_points", lambda group: [broken])
    installed_skills.cache_clear()
    try:
        with pytest.raises(SkillError, match=message) as caught:
            installed_skills()
        assert "'mine'" in str(caught.value)
    finally:
        installed_skills.cache_clear()
