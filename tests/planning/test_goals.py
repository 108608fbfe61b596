"""Goals in a person's words, and what is said when there is no way to them."""

import pytest

from understudy.behaviors import Fact, SkillSet, Way, installed_skills
from understudy.errors import NoPlanError, PlanningError
from understudy.planning import domain_of, goal_name, plan_task, planning_problem, read_goal

from .made_up import mute, skill
from .strategies import THINGS

SKILLS = SkillSet(*(installed_skills()[name] for name in ("Drop", "PickUp", "Track")))
DOMAIN = domain_of(SKILLS, THINGS)


@pytest.mark.parametrize(
    "text", ["carried(light-green, pink)", "Carried( Light_Green ,PINK )", "carried(light  green, pink)"]
)
def test_a_color_can_be_written_in_several_ways(text):
    assert read_goal(text, domain_of(SKILLS)) == (Fact("carried", ("light green", "pink")),)


def test_what_is_said_twice_counts_once():
    assert read_goal("near(pink), near(pink) and near(green)", DOMAIN) == (
        Fact("near", ("pink",)),
        Fact("near", ("green",)),
    )


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "no goal is given"),
        ("carried(orange; pink)", "said of 1, and not of 2; write carried(box, target)"),
        ("carried(orange pink", "cannot be read as a goal"),
        ("caried(orange, pink)", "did you mean 'carried'?"),
        (
            "happy",
            "what can be said is: carried(box, target), gripper_empty, holding(box), near(target), visited(target)",
        ),
        ("holding", "holding is said of 0, and not of 1; write holding(box)"),
        ("holding(green)", "there is no 'green' box; there are: orange, pink"),
        ("near(purple)", "there is no 'purple' target; there are: green, pink"),
    ],
)
def test_a_goal_without_meaning(text, complaint):
    with pytest.raises(PlanningError) as caught:
        read_goal(text, DOMAIN)
    assert complaint in str(caught.value)


def test_skills_that_say_nothing_are_named_where_a_word_is_not_known():
    domain = domain_of(SkillSet(*SKILLS.values(), mute("Whistle"), mute("Hum")), THINGS)
    with pytest.raises(
        PlanningError, match=r"nothing can be planned with Hum, Whistle: they do not say what they need$"
    ):
        read_goal("whistled", domain)


def test_a_name_for_the_task():
    facts = [Fact("near", (color,)) for color in ("red", "green", "pink", "blue", "yellow")]
    assert goal_name((Fact("carried", ("light green", "pink")), *facts[:1])) == "carried light green pink and near red"
    assert goal_name(tuple(facts[:4])) == "near red and near green and near pink and near blue"
    assert goal_name(tuple(facts)) == "near red and near green and near pink and 2 more"


def test_two_boxes_in_one_gripper():
    with pytest.raises(NoPlanError) as caught:
        plan_task(planning_problem("visited(green), holding(orange), holding(pink)", SKILLS))
    assert caught.value.missing == ("holding(orange) and holding(pink) cannot be so together, though each of them can",)


def test_three_that_cannot_be_so_together_though_two_can():
    hands = [
        skill(name.title(), *(Way(goal=name, needs=hand, ends=hand) for hand in ("left", "right")))
        for name in ("cup", "plate", "spoon")
    ]
    with pytest.raises(NoPlanError) as caught:
        plan_task(planning_problem("cup, plate, spoon", SkillSet(*hands), given="left and right"))
    assert caught.value.missing == ("cup and plate and spoon cannot be so together, though any 2 of them can",)


def test_a_skill_that_needs_what_cannot_be_so_together():
    clap = skill("Clap", Way(of={"one": "box", "other": "box"}, goal="clapped", needs="holding(one), holding(other)"))
    skills, things = SkillSet(*SKILLS.values(), clap), {"box": ("pink", "red"), "target": ("red",)}
    plan_task(planning_problem("clapped", skills, things))  # with one box, which is both
    strict = skill("Clap", Way(goal="clapped", needs="in_left and in_right"))
    hands = [skill(f"Put{hand}", Way(goal=hand, ends="in_left, in_right")) for hand in ("in_left", "in_right")]
    with pytest.raises(NoPlanError) as caught:
        plan_task(planning_problem("clapped", SkillSet(strict, *hands)))
    assert caught.value.missing == (
        "clapped is given by Clap, and what it needs cannot be so together: in_left and in_right",
    )


def test_a_skill_that_is_missing():
    without = SkillSet(SKILLS["Drop"], SKILLS["Track"], mute("Whistle"))
    with pytest.raises(NoPlanError) as caught:
        plan_task(planning_problem("visited(pink) and carried(orange, pink)", without))
    assert str(caught.value).splitlines() == [
        "there is no plan for visited(pink) and carried(orange, pink):",
        "  carried(orange, pink) is given by Drop, which needs holding(orange)",
        "  no skill gives holding(orange)",
        "  nothing can be planned with Whistle: it does not say what it needs and gives",
    ]


def test_skills_that_wait_for_each_other():
    egg = skill("Hatch", Way(goal="egg", needs="hen"))
    hen = skill("Lay", Way(goal="hen", needs="egg"))
    with pytest.raises(NoPlanError) as caught:
        plan_task(planning_problem("egg", SkillSet(egg, hen)))
    assert caught.value.missing == (
        "egg is given by Hatch, which needs hen",
        "hen is given by Lay, which needs egg",
    )


def test_of_several_ways_the_one_that_lacks_least_is_told():
    hatch = skill("Hatch", Way(goal="egg", needs="hen, cock, nest"), Way(goal="egg", needs="hen"), Way(goal="nest"))
    with pytest.raises(NoPlanError) as caught:
        plan_task(planning_problem("egg", SkillSet(hatch)))
    assert caught.value.missing == ("egg is given by Hatch, which needs hen", "no skill gives hen")
