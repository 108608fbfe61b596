"""A run that is put aside and gone on with, in another process: nothing is lost, and nothing else fits."""

import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from understudy.behaviors import Skill, SkillSet
from understudy.documents import parse_text
from understudy.errors import ContextError
from understudy.execution import ComponentState, Context, Controller, SavedContext, load_context
from understudy.network import Component, LinkType, Network, relinked
from understudy.robot import PIONEER

from .driving import controller_of, percepts_of
from .strategies import Scenario, scenarios
from .test_controller import Scripted, controller, ticks


def written(saved: SavedContext) -> SavedContext:
    """As it comes back from a file."""
    text = json.dumps(saved.model_dump(by_alias=True, exclude_defaults=True))
    return SavedContext.model_validate(parse_text(text, source="", as_json=True))


@settings(max_examples=150)
@given(scenarios() | scenarios(nested=True) | scenarios(alternatives=True), st.data())
def test_what_comes_back_goes_on_as_if_nothing_had_been(scenario: Scenario, data: st.DataObject) -> None:
    pause = data.draw(st.integers(0, len(scenario.history)))
    undisturbed, paused, resumed = controller_of(scenario), controller_of(scenario), controller_of(scenario)
    for number, world in enumerate(scenario.history):
        if number == pause:
            saved = SavedContext.of(paused.context, paused.program, "scenario")
            resumed.resume(written(saved).restored(resumed.program))
            assert_equal(resumed.context, paused.context)
        percepts = percepts_of(scenario, number)
        told = undisturbed.tick(percepts, world.events)
        going_on = paused if number < pause else resumed
        again = going_on.tick(percepts, world.events)
        assert (again.command, again.events, again.complete) == (told.command, told.events, told.complete)
        assert_equal(going_on.context, undisturbed.context)


def assert_equal(one: Context, other: Context) -> None:
    assert one == other
    assert one.random.getstate() == other.random.getstate()


LINKS = (("a", "b", LinkType.ENABLING),)


def saved_run() -> tuple[Controller, SavedContext]:
    running = controller(Scripted("A", [2]), Scripted("B", []), links=LINKS)
    ticks(running, 4)
    return running, SavedContext.of(running.context, running.program, "errand", recording="errand.mcap")


def test_a_saved_run_is_readable(tmp_path: Path) -> None:
    running, saved = saved_run()
    saved.save(tmp_path / "errand.json")
    data = json.loads((tmp_path / "errand.json").read_text())
    assert data["components"]["a"]["achieved"] is True
    assert data["executing"] == ["b"]
    assert load_context(tmp_path / "errand.json").restored(running.program) == running.context
    with pytest.raises(ContextError, match="exists already"):
        saved.save(tmp_path / "errand.json")


def other(network: Network) -> Controller:
    skills = [Scripted(name, []) for name in "ABC"]
    return Controller(network, SkillSet(*(Skill(skill, skill) for skill in skills)), PIONEER)


def test_another_definition_is_refused_and_the_difference_named() -> None:
    running, saved = saved_run()
    changed = relinked(running.program.network, "a", "b", LinkType.ORDERING)
    with pytest.raises(
        ContextError, match="the link a -> b is ordering, and was enabling; go on with the task as it was"
    ):
        saved.restored(other(changed).program, source="errand.json")
    more = Network((*changed.components, Component(id="c", behavior="C")), changed.links)
    with pytest.raises(ContextError, match=r"errand.json: .*c \(C\) is new, and 1 more"):
        saved.restored(other(more).program, source="errand.json")


def broken(**changes: object) -> SavedContext:
    return saved_run()[1].model_copy(update=changes)


@pytest.mark.parametrize(
    ("saved", "problem"),
    [
        (broken(executing=("z",)), "no component of the task is called 'z'"),
        (broken(inhibited=("a",)), "'a' is inhibited by '', which is not there"),
        (broken(chance=(3, (1, 2), None)), "this is no state of chance"),
        (broken(components={"a": ComponentState(case="x")}), "it has no case 'x'; it has: none"),
        (broken(taken=("b",)), "taken: no way leads from START to b"),
    ],
)
def test_what_does_not_fit_is_refused(saved: SavedContext, problem: str) -> None:
    running, _ = saved_run()
    saved = SavedContext.model_validate(saved.model_dump(by_alias=True))
    with pytest.raises(ContextError, match=problem):
        saved.restored(running.program)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("{", "this is no JSON"),
        ('{"understudy": "task/1"}', "this is no context document: expected 'context/1'"),
        ('{"understudy": "context/1"}', "task: this key is required"),
        ('{"understudy": "context/1", "tick": 1, "tack": 2}', "unknown key 'tack'; did you mean"),
    ],
)
def test_a_malformed_document_is_refused(tmp_path: Path, text: str, problem: str) -> None:
    (tmp_path / "c.json").write_text(text)
    with pytest.raises(ContextError, match=problem):
        load_context(tmp_path / "c.json")


def test_a_memory_that_is_no_plain_data_is_named(tmp_path: Path) -> None:
    _, saved = saved_run()
    saved = saved.model_copy(update={"wander": {"place": object()}})
    with pytest.raises(ContextError, match="no plain data"):
        saved.save(tmp_path / "c.json")
