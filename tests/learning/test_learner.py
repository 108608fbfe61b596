"""The whole way, from goals that come true tick by tick to the task's network."""

import importlib
import pkgutil

import pytest

from understudy import learning
from understudy.errors import LearningError
from understudy.learning import Demonstration, Instance, LearningSettings, Observer, learn
from understudy.network import Interval
from understudy.network.naming import component_ids
from understudy.robot.cues import Cue

from .build import seen, typed_links

DROP = Instance("Drop")
PICK_UP = Instance("PickUp", (("color", "orange"),))


def track(color: str) -> Instance:
    return Instance("Track", (("color", color),))


def transport(words: dict[float, Cue]) -> Demonstration:
    """A box beside green is carried past pink, a distractor, and yellow; taken away at yellow (§4.5.4.3)."""
    observer = Observer()
    for tick in range(601):
        time = round(tick * 0.1, 9)
        evaluated: dict[Instance, dict[str, float]] = {}
        if 5 <= time < 20:
            evaluated[track("light green")] = {"distance_m": max(0.4, 2.0 - 0.2 * (time - 5)), "angle_deg": 90.0}
        if 25 <= time < 30:
            evaluated[track("pink")] = {"distance_m": 1.5, "angle_deg": 30.0}
        if 35 <= time < 48:
            evaluated[track("yellow")] = {"distance_m": 1.9 - 0.1 * (time - 35), "angle_deg": 90.0}
        evaluated[PICK_UP if 15 <= time < 45 else DROP] = {}
        cues = [Cue.START] if tick == 0 else [words[time]] if time in words else []
        observer.step(time, evaluated, cues)
    return observer.finish(name="transport")


def test_a_clean_demonstration_is_learned_as_it_was_seen() -> None:
    lesson = learn(transport({60.0: Cue.DONE}))
    assert typed_links(lesson.network) == {
        ("drop-1", "track-light-green-1"): "enabling",
        ("drop-1", "pick-up-orange-1"): "enabling",
        ("track-light-green-1", "pick-up-orange-1"): "enabling",
        ("pick-up-orange-1", "track-pink-1"): "permanent",
        ("pick-up-orange-1", "track-yellow-1"): "enabling",
        ("pick-up-orange-1", "drop-2"): "enabling",
        ("track-pink-1", "track-yellow-1"): "ordering",
        ("track-yellow-1", "drop-2"): "enabling",
    }
    assert lesson.network.sinks == ("drop-2",)
    assert lesson.dropped == ()
    assert lesson.notes == ()


def test_words_leave_the_distractor_out() -> None:
    words = {8.0: Cue.TAKE, 40.0: Cue.HERE, 44.0: Cue.DROP, 55.0: Cue.HERE, 60.0: Cue.DONE}
    lesson = learn(transport(words))
    assert [component.id for component in lesson.network.components] == [
        "drop-1",
        "track-light-green-1",
        "pick-up-orange-1",
        "track-yellow-1",
        "drop-2",
    ]
    assert [(str(item.observed.instance), item.reason) for item in lesson.dropped] == [
        ("Track(color=pink)", "no cue while it was true")
    ]
    pick_up = lesson.network.by_id["pick-up-orange-1"]
    assert pick_up.occurrences[0].cues == ((8.0, "TAKE"), (40.0, "HERE"), (44.0, "DROP"))


def test_a_demonstration_that_was_cut_short_says_so() -> None:
    lesson = learn(transport({}))
    assert lesson.notes == ("No DONE: the demonstration was cut short, and counts up to 60.0 s.",)


def test_a_word_on_nothing_is_noted() -> None:
    demonstration = Demonstration(
        name="d", span=Interval(0, 50), observations=(seen(5, 9),), cues=((6.0, Cue.HERE), (30.0, Cue.HERE))
    )
    assert learn(demonstration).notes == ("HERE at 30.0 s fell on nothing that was kept.",)


def test_the_same_demonstration_gives_the_same_lesson() -> None:
    assert learn(transport({60.0: Cue.DONE})) == learn(transport({60.0: Cue.DONE}))


def test_nothing_seen_says_what_to_do() -> None:
    empty = Demonstration(name="tuesday", span=Interval(0, 12), observations=())
    with pytest.raises(LearningError, match=r"tuesday: no skill's goal came true in the 12\.0 s.*at least 2 s"):
        learn(empty)


def test_nothing_left_says_why() -> None:
    brief = Demonstration(name="d", span=Interval(0, 9), observations=tuple(seen(i, i + 0.5) for i in range(7)))
    with pytest.raises(LearningError, match=r"Visit: seen for 0\.5 s only \(at least 2 s\); .*…\).*say HERE"):
        learn(brief)
    assert len(learn(brief, LearningSettings(min_duration_s=0.5)).kept) == 7


def test_an_observation_against_the_arrow_of_time_is_refused() -> None:
    with pytest.raises(LearningError, match="from 5 to 3 s, but time runs forward only"):
        seen(5, 3)
    with pytest.raises(LearningError, match="closest at 9 s; the closest approach must lie in the interval"):
        seen(0, 3, closest_s=9.0)


def test_ids_can_be_read_and_are_unique() -> None:
    instances = [
        PICK_UP,
        track("light green"),
        PICK_UP,
        Instance("pick up", (("of", "Orange"),)),
        Instance("a"),
        Instance("a-1"),
        Instance("a"),
        Instance("Čaj nalít"),
        Instance("!"),
        Instance("GoThroughDoor"),
    ]
    assert component_ids(instances) == (
        "pick-up-orange-1",
        "track-light-green-1",
        "pick-up-orange-2",
        "pick-up-orange-3",
        "a-1",
        "a-1-1",
        "a-2",
        "čaj-nalít-1",
        "step-1",
        "go-through-door-1",
    )


def test_every_module_exports_what_it_says() -> None:
    for info in pkgutil.iter_modules(learning.__path__):
        module = importlib.import_module(f"{learning.__name__}.{info.name}")
        assert all(hasattr(module, name) for name in module.__all__)
    assert all(hasattr(learning, name) for name in learning.__all__)
