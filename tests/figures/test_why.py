"""Why a component is active or not, in plain words."""

import re

import pytest
from hypothesis import given, settings

from tests.execution.driving import controller_of, percepts_of
from tests.execution.strategies import Scenario, scenarios
from understudy.behaviors import SkillSet, installed_skills
from understudy.execution import Event, History, explain
from understudy.figures import WhyWords, numbers_of
from understudy.network import Component, Link, LinkType, Nab, Network, Timeout

ORANGE, GREEN = {"color": "orange"}, {"color": "green"}
NETWORK = Network(
    (
        Component(id="pick", behavior="PickUp", parameters=ORANGE),
        Component(id="carry", behavior="Track", parameters=GREEN, timeout=Timeout(seconds=60, then="skip")),
        Component(id="drop", behavior="Drop"),
    ),
    (
        Link(source="pick", target="carry", type=LinkType.PERMANENT),
        Link(source="carry", target="drop", type=LinkType.ENABLING),
    ),
)


def told(kind: str, time_s: float, component: str, **detail: object) -> Event:
    return Event(time_s=time_s, kind=kind, component=component, detail=detail)


CARRIED_AND_LOST = (
    told("state", 0.0, "pick", state="searching", reason="world"),
    told("state", 0.0, "carry", state="waiting", reason="permanent", **{"for": "pick"}),
    told("state", 0.0, "drop", state="waiting", reason="enabling", **{"for": "carry"}),
    told("state", 2.0, "pick", state="executing"),
    told("goal", 9.0, "pick", holds=True),
    told("achieved", 9.0, "pick", on_purpose=True),
    told("state", 9.0, "pick", state="achieved"),
    told("state", 9.0, "carry", state="executing"),
    told("goal", 12.0, "pick", holds=False),
    told("state", 12.0, "pick", state="executing"),
    told("state", 12.0, "carry", state="waiting", reason="permanent", **{"for": "pick"}),
)


def story(path: str, at_s: float, network: Network = NETWORK, events: tuple[Event, ...] = CARRIED_AND_LOST) -> str:
    return WhyWords(network, installed_skills()).story(explain(History(network, events), path, at_s))


def test_a_step_that_waits_says_for_what_and_since_when() -> None:
    assert story("carry", 13.0) == (
        "At 13.0 s step 2, go to the green target, until it is 0.60 m ahead, is not active; it waits.\n"
        "  Why:   Step 1 (pick up the orange box) was done, but does not hold any more, as it must all the while.\n"
        "  Since: 12.0 s, when what step 1 (pick up the orange box) achieves ceased to be so.\n"
        "  Acts:  If step 1 (pick up the orange box) held again.\n"
        "  And there:\n"
        "    step 1 (pick up the orange box) is active, and acts, since 12.0 s, when what it achieves ceased to be so."
    )


def test_a_step_that_acts_says_what_would_end_it() -> None:
    assert story("carry", 10.0) == (
        "At 10.0 s step 2, go to the green target, until it is 0.60 m ahead, is active, and acts.\n"
        "  Why:   All that it asks for is so, and it has the wheels.\n"
        "  Since: 9.0 s, when step 1 (pick up the orange box) was done.\n"
        "  Ends:  When it is done; or if step 1 (pick up the orange box) ceases to hold; or if the green target is not"
        " in sight or remembered; or after 60 s without success (go on without it)."
    )


@pytest.mark.parametrize(
    ("path", "at_s", "expected"),
    [
        ("pick", 1.0, "  Why:   The orange box is not in sight or remembered.\n"),
        ("pick", 1.0, "  Acts:  If it were so that the orange box is in sight or remembered."),
        ("pick", 3.0, "  Since: 2.0 s, when what it needs to act came to be there.\n"),
        ("pick", 10.0, "  Acts:  If it ceased to hold while step 2 (go to the green target) needs it."),
        ("drop", 1.0, "  Why:   Step 2 (go to the green target) is not done.\n"),
    ],
)
def test_other_states(path: str, at_s: float, expected: str) -> None:
    assert expected in story(path, at_s) + "\n"


def test_a_lock_is_of_what_both_need() -> None:
    network = Network((Component(id="a", behavior="Track", parameters=GREEN), Component(id="b", behavior="Drop")))
    events = (
        told("state", 0.0, "a", state="executing"),
        told("state", 0.0, "b", state="searching", reason="locked", by="a"),
    )
    held = story("b", 1.0, network, events)
    assert "Step 1 (go to the green target) has the wheels.\n" in held
    assert "If step 1 (go to the green target) let go of the wheels." in held


def test_a_step_is_called_by_its_number_or_its_path() -> None:
    words = WhyWords(Network((Nab.of("part", NETWORK),)), installed_skills())
    assert words.path_of("1.2") == words.path_of("part/carry") == "part/carry"
    assert words.path_of("nothing") == "nothing"


def test_the_overview_has_everything_in_short() -> None:
    history = History(NETWORK, CARRIED_AND_LOST)
    found = [explain(history, path, 13.0) for path in NETWORK.by_path]
    assert WhyWords(NETWORK, installed_skills()).overview(found) == (
        "1.  executing  since   12.0 s  pick up the orange box\n"
        "2.  waiting    since   12.0 s  go to the green target, until it is 0.60 m ahead\n"
        "                               step 1 (pick up the orange box) was done, but does not hold any more, as it"
        " must all the while\n"
        "3.  waiting    since    0.0 s  drop what the gripper holds\n"
        "                               step 2 (go to the green target) is not done"
    )


@settings(max_examples=60)
@given(scenarios(nested=True))
def test_everything_can_be_told(scenario: Scenario) -> None:
    """Whatever happens in any network: active or not is said, and everybody who is in the way is named."""
    running = controller_of(scenario)
    network = running.program.network
    history = History(network)
    words, numbers = WhyWords(network, SkillSet()), numbers_of(network)
    for number, world in enumerate(scenario.history):
        for event in running.tick(percepts_of(scenario, number), world.events).events:
            history.add(event)
        for path in network.by_path:
            found = explain(history, path, world.time_s)
            text = words.story(found)
            assert (" is active" in text.partition("\n")[0]) is found.active
            named = set(re.findall(r"step ([\w.]+)", text))
            assert {numbers[one.component] for one in found.missing if one.component} <= named
            assert all(line.endswith((".", "And there:")) for line in text.splitlines())
