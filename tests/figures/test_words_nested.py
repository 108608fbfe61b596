"""Networks in networks, controls and conditions in plain words."""

import re

import pytest
from hypothesis import given, settings

from tests.execution.strategies import hierarchies
from tests.figures import nested
from understudy.behaviors import installed_skills
from understudy.figures import condition_in_words, describe_task, numbers_of
from understudy.network import (
    Achieved,
    After,
    AllOf,
    AnyOf,
    Complete,
    Happened,
    Holds,
    Not,
    Possible,
    TimedOut,
)

HIERARCHICAL = """\
errand: 2 steps, of 10 in all

  1. Object transport:
     1.1. go to the light green target, until it is 0.60 m ahead
     1.2. pick up the orange box
            start while step 1.1 still holds
     1.3. GoThroughGate:
            step 1.2 must hold all the while
          1.3.1. go to the yellow target, to pass it on your left at 0.50 m
          1.3.2. go to the light orange target, to pass it on your right at 0.50 m
                   start while step 1.3.1 still holds
     1.4. go to the green target, until it is 0.60 m ahead
            step 1.2 (pick up the orange box) must hold all the while
     1.5. drop what the gripper holds
            start while step 1.4 still holds
  2. Visit targets, in any order:
     2.1. go to the pink target, until it is 0.60 m ahead
     2.2. go to the light green target, until it is 0.60 m ahead
     2.3. go to the yellow target, until it is 0.60 m ahead
     2.4. go to the orange target, until it is 0.60 m ahead

A step holds while what it achieved is still true. One that is needed and no longer holds is done again."""

DELIVERY = """\
  2. Deliver a box, 3 times:
     case a (loaded), if the orange box is in the gripper:
     2a.1. go to the yellow target, until it is 0.60 m ahead
     2a.2. go to the pink target, until it is 0.60 m ahead
             start while step 2a.1 still holds
     2a.3. drop what the gripper holds
             start while step 2a.2 still holds
     case b (empty), otherwise:
     2b.1. go to the green target, until it is 0.60 m ahead
     2b.2. pick up the orange box
             start while step 2b.1 still holds
     in case b, when it is done: go over to case a
     in case a, when the orange box is not in the gripper and step 2a.3 is not done: go over to case b
  3. go to the blue target, until it is 0.60 m ahead
       after 60 s without success: go on without it"""

CONTROLS = """\
  1. go to the green target, until it is 0.60 m ahead
       done, too, as soon as “come” is signalled
       after 45 s without success: go on without it
  2. patrol, again until the orange box is in sight or remembered, at most 5 times:
       keep still while step 4 (go to the yellow target) is under way
       after 120 s without success: signal “late”, and try on
     2.1. go to the pink target, until it is 0.60 m ahead
     2.2. go to the red target, until it is 0.60 m ahead
  3. pick up the orange box
       start while step 2 still holds
       after 90 s without success: give the task up
     beside that:
  4. every 30 s: go to the yellow target, until it is 0.60 m ahead
  5. whenever “bell” is signalled: greet:
     5.1. go to the blue target, until it is 0.60 m ahead
     5.2. drop what the gripper holds"""


def test_networks_in_networks():
    assert describe_task("errand", nested.hierarchical(), installed_skills()) == HIERARCHICAL


@pytest.mark.parametrize(("name", "text"), [("delivery", DELIVERY), ("controls", CONTROLS)])
def test_cases_loops_timeouts_duties_and_rivals(name, text):
    assert text in describe_task(name, getattr(nested, name)(), installed_skills())


def test_cases_that_are_reached_otherwise_or_not_at_all():
    told = describe_task("choose", nested.branches(), installed_skills())
    assert "     case d (give up), only by a switch:\n" in told
    assert "     in case a, when step 1a.1 has run out of time: go over to case d\n" in told
    assert "     in case c, when “again, please” is signalled: begin it anew\n" in told
    assert told.endswith("     otherwise there is nothing to do")


def test_rivals_keep_still():
    told = describe_task("rivals", nested.rivals(), installed_skills())
    assert told.count("keep still while step") == 5


@given(hierarchies())
@settings(max_examples=60)
def test_every_step_is_told_once_under_its_number(made):
    numbers = numbers_of(made)
    assert set(numbers) == set(made.by_path)
    assert len(set(numbers.values())) == len(numbers)
    told = re.findall(r"^ *(\d[\w.]*)\. ", describe_task("made", made, {}), flags=re.MULTILINE)
    assert told == list(numbers.values())


HELD = Holds(behavior="PickUp", parameters={"color": "orange"})
SEEN = Possible(behavior="Track", parameters={"color": "green"})


@pytest.mark.parametrize(
    ("condition", "words"),
    [
        (HELD, "the orange box is in the gripper"),
        (Not(of=HELD), "the orange box is not in the gripper"),
        (Not(of=Not(of=HELD)), "the orange box is in the gripper"),
        (SEEN, "the green target is in sight or remembered"),
        (Holds(behavior="Track", parameters={"color": "green"}), "the green target is 0.60 m ahead"),
        (Holds(behavior="Drop"), "the gripper is empty"),
        (Holds(behavior="Lid", parameters={"of": "pot"}), "“Lid pot” is achieved now"),
        (Not(of=Possible(behavior="Lid")), "“Lid” is not possible"),
        (Happened(event="bell"), "“bell” is signalled"),
        (Not(of=Achieved(component="a")), "step a is not done"),
        (TimedOut(component="a"), "step a has run out of time"),
        (Complete(), "it is done"),
        (Not(of=After(seconds=7.5)), "7.5 s have not passed"),
        (AllOf(of=(Complete(), AnyOf(of=(HELD, Happened(event="x"))))),
         "it is done and (the orange box is in the gripper or “x” is signalled)"),
        (Not(of=AllOf(of=(Complete(), Happened(event="x")))), "it is not done or “x” is not signalled"),
        (AllOf(of=(AnyOf(of=(Complete(), HELD)),)), "it is done or the orange box is in the gripper"),
    ],
)  # fmt: skip
def test_conditions_read_as_something_that_is_so(condition, words):
    assert condition_in_words(condition, installed_skills(), lambda id_: f"step {id_}") == words
