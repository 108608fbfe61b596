"""What skills say of themselves: how it is read, what is refused, and that it agrees with what they sense."""

import re
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.behaviors import Fact, Parameter, Skill, SkillSet, Way, installed_skills, read_facts
from understudy.errors import SkillError
from understudy.network import LinkType
from understudy.planning import domain_of, plan_task, planning_problem

from .made_up import MadeUp, Still, mute, skill
from .strategies import THINGS

SKILLS = SkillSet(*(installed_skills()[name] for name in ("Drop", "PickUp", "Track")))

name = st.from_regex(r"[a-z][a-z0-9_]{0,5}", fullmatch=True).filter(lambda text: text != "and")
facts = st.lists(st.builds(Fact, name, st.lists(name, max_size=3).map(tuple)), max_size=4).map(tuple)


@given(facts, st.sampled_from([", ", " and ", ",", "  AND "]))
def test_what_is_written_is_read_again(written, joint):
    assert read_facts(joint.join(map(str, written))) == written


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("holding(orange", "before '(orange'"),
        ("holding(orange) near(pink)", "before 'near(pink)'"),
        ("holding(orange,)", "between the brackets of 'holding(orange,)'"),
        ("near(pink) and", "it breaks off"),
        ("and near(pink)", "a fact is missing at 'and near(pink)'"),
        ("near(pink),, near(red)", "a fact is missing at ', near(red)'"),
        ("(orange)", "a fact is missing at '(orange)'"),
    ],
)
def test_what_cannot_be_read(text, complaint):
    with pytest.raises(ValueError, match=re.escape(complaint)):
        read_facts(text)


def test_the_operators_of_the_robots_skills():
    domain = domain_of(SKILLS, THINGS)
    assert domain.words == {
        "carried": ("box", "target"),
        "gripper_empty": (),
        "holding": ("box",),
        "near": ("target",),
        "visited": ("target",),
    }
    assert domain.silent == ()
    by_name = {one.name: one for one in domain.operators}
    assert len(by_name) == len(domain.operators) == 1 + 2 * 2 + 2 + 2
    pick_up = by_name["PickUp(color=pink)"]
    assert pick_up.parameters == {"color": "pink"}
    assert set(map(str, pick_up.ends)) == {
        "carried(pink, green)",
        "carried(pink, pink)",
        "gripper_empty",
        "near(green)",
        "near(pink)",
    }
    track = by_name["Track(color=green)"]
    assert set(map(str, track.gives)) == {"near(green)", "visited(green)"}
    assert set(map(str, track.ends)) == {"near(pink)"}  # not what it gives itself
    drop = by_name["Drop(box=pink, target=green)"]
    assert drop.parameters == {}
    assert set(map(str, drop.needs)) == {"holding(pink)", "near(green)"}


@pytest.mark.parametrize("blocked", [False, True])
@pytest.mark.parametrize("color", ["orange", "pink"])
def test_what_a_skill_ends_is_no_longer_sensed_once_its_goal_is(blocked, color):
    """The facts about the gripper, for which one reading tells all: each is the goal of a skill."""
    gripper = SimpleNamespace(holding=blocked, empty=not blocked, color=color if blocked else None)
    percepts = SimpleNamespace(gripper=gripper)
    operators = [one for one in domain_of(SKILLS, THINGS).operators if one.skill != "Track"]

    def sensed(one):
        return SKILLS[one.skill].abstract.goal(percepts, one.parameters)

    reached = [one for one in operators if sensed(one)]
    assert reached
    for one in reached:
        assert not any(sensed(other) for other in operators if other.goal in one.ends), one.name


def way(**facts):
    return Way(of={"color": "target"}, goal="washed(color)", **facts)


@pytest.mark.parametrize(
    ("ways", "complaint"),
    [
        (
            (way(needs="near(colour)"),),
            "Wash speaks of near(colour), and 'colour' is no name in 'of'; these are: color",
        ),
        ((way(needs="near(*)"),), "'*' is no name in 'of'"),
        ((way(gives="near(color"),), "Wash: 'gives' is 'near(color', and cannot be read"),
        ((Way(goal="washed"),), "whether its parameter 'color' is a box or a target"),
        ((Way(of={"color": "door"}, goal="washed"),), "'color' is a 'door'; it is a box or a target"),
        ((Way(of={"color": "box"}, goal="washed(color), dry"),), "it is one fact"),
        ((Way(of={"color": "box"}, goal=""),), "it is one fact"),
        (
            (way(), Way(of={"color": "box"}, goal="washed(color)")),
            "Wash says washed(box), and elsewhere it is washed(target); rename one of them",
        ),
        ((way(ends="near(*, *)"),), "Wash says near(target, *), and elsewhere it is near(target)"),
        ((way(ends="carried(color, *)"),), "Wash says carried(target, target)"),
    ],
)
def test_a_declaration_without_meaning_is_refused(ways, complaint):
    with pytest.raises(SkillError) as caught:
        domain_of(SkillSet(*SKILLS.values(), skill("Wash", *ways, colors=("color",))), THINGS)
    assert complaint in str(caught.value)


def test_a_number_that_a_plan_would_have_to_choose_is_refused():
    wait = MadeUp("Wait", (Way(goal="waited"),), (Parameter(name="time_s", kind="number", high=9.0),))
    with pytest.raises(SkillError, match="Wait: a plan cannot choose 'time_s', which is no color; give it a default"):
        domain_of(SkillSet(Skill(wait, Still())), THINGS)


def test_a_skill_that_says_nothing_is_left_out():
    assert domain_of(SkillSet(*SKILLS.values(), mute("Whistle")), THINGS).silent == ("Whistle",)


def test_what_nobody_gives_can_be_ended_all_the_same():
    alone = SkillSet(SKILLS["PickUp"])
    assert set(domain_of(alone, THINGS).words) == {"gripper_empty", "holding"}


def test_somebody_elses_skill_that_keeps_what_another_gives():
    wipe = skill(
        "Wipe",
        Way(of={"color": "target", "sponge": "box"}, goal="wiped(color)", keeps="holding(sponge)", needs="near(color)"),
        colors=("color",),
    )
    network = plan_task(planning_problem("wiped(green) and wiped(red)", SkillSet(*SKILLS.values(), wipe))).network
    found = {(link.source, link.target): link.type for link in network.links}
    (pick_up,) = (component.id for component in network.components if component.behavior == "PickUp")
    for color in ("green", "red"):
        assert found[pick_up, f"wipe-{color}-1"] is LinkType.PERMANENT
        assert found[f"track-{color}-1", f"wipe-{color}-1"] is LinkType.ENABLING
        assert (pick_up, f"track-{color}-1") not in found or found[pick_up, f"track-{color}-1"] is not LinkType.ENABLING


@pytest.mark.parametrize("keeps", [False, True])
def test_only_what_a_running_task_senses_is_asked_for_again(keeps):
    """That a target was visited is known from its step alone; that the robot is near it is sensed."""
    visited = {"keeps": "visited(first)"} if keeps else {"needs": "visited(first)"}
    tell = skill("Tell", Way(of={"first": "target"}, goal="told(first)", **visited), colors=("first",))
    network = plan_task(planning_problem("told(green)", SkillSet(*SKILLS.values(), tell))).network
    assert [(link.source, link.target, link.type) for link in network.links] == [
        ("track-green-1", "tell-green-1", LinkType.ORDERING)
    ]
