import re
from dataclasses import replace

import pytest

from tests.figures.samples import (
    component,
    demonstration,
    layered,
    loose,
    network,
    pancakes,
    tracked,
    transport,
    visit,
)
from understudy.behaviors import installed_skills
from understudy.figures import describe_lesson, describe_task, draw_network, draw_observations
from understudy.learning import learn

TRANSPORT = """\
fetch: 7 steps

  1. drop what the gripper holds
  2. go to the green target, until it is 0.52 m ahead
       step 1 must hold all the while
  3. pick up the orange box
       start while step 1 (drop what the gripper holds) and step 2 still hold
  4. go to the yellow target, to pass it on your left at 0.50 m
       step 3 must hold all the while
  5. go to the light orange target, to pass it on your right at 0.41 m
       start while step 4 still holds
       step 3 (pick up the orange box) must hold all the while
  6. go to the orange target, until it is 0.61 m ahead
       step 3 (pick up the orange box) must hold all the while
  7. drop what the gripper holds
       start while step 3 (pick up the orange box) still holds

A step holds while what it achieved is still true. One that is needed and no longer holds is done again."""

PANCAKES = """\
pancakes: 6 steps

  1. Take out a blender from the cupboard under the sink
     then, in any order:
  2. Add-1 cup flour to a blender
  3. Add-1/2 tsp baking powder to a blender
  4. Add-1 pinch of salt to a blender
     then:
  5. blend for 10 seconds
       start while step 4 still holds
  6. Pour batter into the hot pan
       step 5 must hold all the while

A step holds while what it achieved is still true. One that is needed and no longer holds is done again."""


def test_the_transport_task():
    assert describe_task("fetch", transport(), installed_skills()) == TRANSPORT


def test_steps_without_an_order_and_labels_of_unknown_behaviors():
    assert describe_task("pancakes", pancakes(), installed_skills()) == PANCAKES


def test_a_mere_sequence_needs_no_conditions():
    lines = describe_task("visit", visit(), installed_skills()).splitlines()
    assert lines[0] == "visit: 6 steps"
    assert lines[2] == "  1. go to the yellow target, until it is 0.50 m ahead"
    assert len(lines) == 2 + 6


def test_steps_without_any_links_are_in_any_order():
    lines = describe_task("all of them", loose(3), installed_skills()).splitlines()
    assert lines[0] == "all of them: 3 steps, in any order"
    assert len(lines) == 2 + 3


def test_a_single_step_is_no_sequence():
    text = describe_task("one", loose(1), {})
    assert text == "one: 1 step\n\n  1. Track yellow"


def test_an_order_that_is_not_plain_is_told_step_by_step():
    steps = [component(name, name.upper()) for name in "abcd"]
    made = network(steps, [("a", "c", "ordering"), ("b", "d", "ordering"), ("a", "d", "ordering")])
    assert describe_task("zigzag", made, {}).splitlines()[2:] == [
        "     in any order, except as noted:",
        "  1. A",
        "  2. B",
        "  3. C",
        "       after step 1 (A)",
        "  4. D",
        "       after step 1 (A) and step 2 (B)",
    ]


def test_every_step_is_told_once():
    text = describe_task("many", layered(), installed_skills())
    assert re.findall(r"^ *(\d+)\. ", text, flags=re.MULTILINE) == [str(step) for step in range(1, 16)]


def test_a_lesson_says_what_was_left_out_and_why():
    text = describe_lesson(learn(demonstration()), installed_skills())
    assert text.startswith("fetch: 6 of 8 observations became steps\n")
    assert "   5.1 to 20.3 s  go to the green target, until it is 0.52 m ahead – HERE 12.8 s, TAKE 14.0 s\n" in text
    left_out = text.split("Left out:\n")[1].splitlines()
    assert [line.split(" – ")[1] for line in left_out] == [
        "seen for 1.2 s only (at least 2 s)",
        "no cue while it was true",
    ]


@pytest.mark.parametrize("seen_m", [0.54496, 0.54504, 0.5444, 0.8649999])
def test_a_goal_reads_the_same_wherever_it_is_told(seen_m):
    """The component has it with three decimals, and people are told two."""
    given = demonstration()
    green = tracked("green", 5.1, 20.3, seen_m, 88.0)
    lesson = learn(
        replace(given, observations=tuple(green if "green" in str(one.instance) else one for one in given.observations))
    )
    skills = installed_skills()
    (step,) = [one for one in lesson.network.components if one.parameters.get("color") == "green"]
    told = f"{step.parameters['distance_m']:.2f} m"
    assert told in describe_task("fetch", lesson.network, skills).split("green target")[1].splitlines()[0]
    assert told in describe_lesson(lesson, skills).split("green target")[1].splitlines()[0]
    for figure in (draw_network(lesson.network), draw_observations(lesson)):
        assert f"{told}, 88°" in [text.get_text() for text in figure.axes[0].texts]
