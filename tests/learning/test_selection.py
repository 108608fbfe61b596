import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.errors import LearningError
from understudy.learning import Demonstration, Instance, LearningSettings, Observed, select
from understudy.network import Interval
from understudy.robot.cues import Cue

from .build import STEP_MS, interval, seconds, seen
from .reference import Span, is_salient


def demonstrated(*observations: Observed, cues: tuple[tuple[float, Cue], ...] = (), **changes: object) -> Demonstration:
    span = Interval(0.0, 100.0)
    return Demonstration(name="d", span=span, observations=observations, cues=cues, **changes)  # type: ignore[arg-type]


def reasons(demonstration: Demonstration, **changes: object) -> list[str]:
    settings = LearningSettings(**changes)  # type: ignore[arg-type]
    return [dropped.reason for dropped in select(demonstration, settings).dropped]


@st.composite
def long_spans(draw: st.DrawFn) -> Span:
    start, length = draw(st.integers(0, 40)), draw(st.integers(0, 30))
    return 4 * STEP_MS * start, 4 * STEP_MS * (start + length)


words = st.lists(
    st.tuples(st.integers(0, 80).map(lambda step: 4 * STEP_MS * step), st.sampled_from(["HERE", "TAKE", "DROP"])),
    max_size=4,
)


@given(
    st.lists(st.tuples(long_spans(), st.sampled_from(["Track", "PickUp", "Drop"]), st.floats(0.1, 4.0)), max_size=8),
    words,
    st.sampled_from([0, 100, 300]),
    st.sampled_from([0, 200, 1000]),
)
def test_what_is_kept_is_long_enough_near_enough_and_salient(
    shown: list[tuple[Span, str, float]], said: list[tuple[int, str]], grace: int, delay: int
) -> None:
    settings = LearningSettings(
        min_duration_s=0.4, max_distance_m=2.0, cue_grace_s=seconds(grace), cue_delay_s=seconds(delay)
    )
    observations = [seen(*interval(span), behavior, values={"distance_m": far}) for span, behavior, far in shown]
    cues = tuple((seconds(time), Cue(word)) for time, word in said)
    selection = select(demonstrated(*observations, cues=cues), settings)
    things = [span for span, _, far in shown if span[1] - span[0] >= 400 and far <= 2.0]
    expected = [
        observation
        for observation, (span, behavior, far) in zip(observations, shown, strict=True)
        if (span[1] - span[0] >= 400 or was_done_at_a_word(span, behavior, said, max(grace, delay)))
        and far <= 2.0
        and is_salient(span, behavior, said, demonstration_start=0, grace=grace, delay=delay, things=things)
    ]
    assert [(kept.instance, kept.interval) for kept in selection.kept] == [(o.instance, o.interval) for o in expected]
    assert len(selection.kept) + len(selection.dropped) == len(observations)


def was_done_at_a_word(span: Span, behavior: str, said: list[tuple[int, str]], delay: int) -> bool:
    """Whether the robot itself brought it about: such a step counts however short it was seen."""
    word = {"PickUp": "TAKE", "Drop": "DROP"}.get(behavior)
    before = [time for time, one in said if one == word and time <= span[0]]
    return bool(before) and span[0] - max(before) <= delay


def test_the_reasons_are_told() -> None:
    brief = seen(0, 0.8)
    far = seen(1, 5, values={"distance_m": 3.14})
    unmarked = seen(10, 20)
    marked = seen(30, 40)
    demonstration = demonstrated(brief, far, unmarked, marked, cues=((35.0, Cue.HERE),))
    assert reasons(demonstration) == [
        "seen for 0.8 s only (at least 2 s)",
        "3.1 m away (at most 2 m)",
        "no cue while it was true",
    ]


def test_all_observations_may_be_kept_whatever_the_words_fall_on() -> None:
    demonstration = demonstrated(seen(10, 20), seen(30, 40), seen(50, 51), cues=((35.0, Cue.HERE),))
    selection = select(demonstration, LearningSettings(heed_cues=False))
    assert [kept.cues for kept in selection.kept] == [(), ((35.0, Cue.HERE),)]
    assert reasons(demonstration, heed_cues=False) == ["seen for 1.0 s only (at least 2 s)"]


def test_exactly_two_seconds_are_enough_whatever_the_clock_says() -> None:
    assert reasons(demonstrated(seen(10.3, 12.3))) == []


def test_a_word_may_come_a_little_early_or_late() -> None:
    early, late, too_late = seen(10, 20), seen(30, 40), seen(50, 60)
    demonstration = demonstrated(early, late, too_late, cues=((8.5, Cue.HERE), (41.5, Cue.HERE), (61.6, Cue.HERE)))
    selection = select(demonstration, LearningSettings())
    assert [kept.cues for kept in selection.kept] == [((8.5, Cue.HERE),), ((41.5, Cue.HERE),)]
    assert selection.unused_cues == ((61.6, Cue.HERE),)


def thing(start: float, end: float, color: str, far: float = 1.0) -> Observed:
    instance = Instance("Track", (("color", color),))
    return Observed(instance=instance, interval=Interval(start, end), values={"distance_m": far})


def kept_at(time: float, *things: Observed, **changes: object) -> list[str]:
    selection = select(demonstrated(*things, cues=((time, Cue.HERE),), **changes), LearningSettings())
    return [dict(one.instance.parameters)["color"] for one in selection.kept]


def test_a_late_word_is_not_about_what_is_gone_if_something_is_there() -> None:
    gone, there, coming = thing(10, 20, "red"), thing(18, 30, "yellow"), thing(22, 32, "green")
    assert kept_at(21, gone) == ["red"]
    assert kept_at(21, gone, there) == ["yellow"]
    assert kept_at(21, gone, there, coming) == ["yellow", "green"]
    assert kept_at(21, gone, coming) == ["green"]
    assert kept_at(21, gone, thing(20.5, 22, "yellow")) == ["red"]  # too short to be anything


def test_what_was_taken_back_is_left_out_and_the_word_is_not_reported_as_unused() -> None:
    red, yellow = thing(10, 20, "red"), thing(12, 20, "yellow")
    word = (15.0, Cue.HERE)
    assert kept_at(15.0, red, yellow, taken_back=((*word, red.instance),)) == ["yellow"]
    alone = demonstrated(red, cues=(word,), taken_back=((*word, red.instance),))
    assert select(alone, LearningSettings()).unused_cues == ()


def test_take_counts_for_the_box_which_the_robot_holds_some_time_after() -> None:
    demonstration = demonstrated(seen(30, 40, "PickUp"), cues=((10.0, Cue.TAKE),))
    assert select(demonstration, LearningSettings()).kept[0].cues == ((10.0, Cue.TAKE),)
    assert reasons(demonstration, cue_delay_s=20.0) == []
    assert reasons(demonstration, cue_delay_s=19.9) == ["no cue while it was true"]


def test_the_box_belongs_to_the_last_take_before_it() -> None:
    demonstration = demonstrated(seen(30, 40, "PickUp"), cues=((10.0, Cue.TAKE), (20.0, Cue.TAKE), (29.0, Cue.DROP)))
    selection = select(demonstration, LearningSettings())
    assert selection.kept[0].cues == ((20.0, Cue.TAKE), (29.0, Cue.DROP))


def test_take_does_not_reach_ahead_to_a_target() -> None:
    assert reasons(demonstrated(seen(15, 40, "Track"), cues=((10.0, Cue.TAKE),))) == ["no cue while it was true"]


def test_the_gripper_that_was_empty_at_start_needs_no_word() -> None:
    at_start, later = seen(0, 8, "Drop"), seen(60, 70, "Drop")
    demonstration = demonstrated(at_start, later, seen(8, 60, "PickUp"), cues=((40.0, Cue.HERE),))
    selection = select(demonstration, LearningSettings())
    assert [(kept.instance.behavior, kept.interval.start) for kept in selection.kept] == [("Drop", 0), ("PickUp", 8)]
    assert reasons(demonstration, standing=frozenset()) == ["no cue while it was true"] * 2


def test_a_condition_that_never_changed_can_be_left_out() -> None:
    throughout = seen(0, 100, "Drop")
    demonstration = demonstrated(throughout, seen(0, 99, "Drop"), seen(0, 100, "Track", values={"angle_deg": 9.0}))
    assert select(demonstration, LearningSettings(keep_unchanging=True)).dropped == ()
    selection = select(demonstration, LearningSettings())
    assert [dropped.observed for dropped in selection.dropped] == [throughout]


def test_what_the_robot_did_at_a_word_counts_however_short() -> None:
    demonstration = demonstrated(seen(50, 50.6, "Drop"), cues=((48.0, Cue.DROP),))
    assert reasons(demonstration) == []
    by_chance = demonstrated(seen(50, 50.6, "Drop"), cues=((50.3, Cue.HERE),))
    assert reasons(by_chance) == ["seen for 0.6 s only (at least 2 s)"]


def test_annotated_steps_are_no_false_indications() -> None:
    steps = (seen(0, 0, "Drop"), seen(1, 9, values={"distance_m": 30.0}))
    assert reasons(demonstrated(*steps, annotated=True)) == []
    assert reasons(demonstrated(*steps, annotated=True, cues=((5.0, Cue.HERE),))) == ["no cue while it was true"]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"merge_gap_s": -1.0}, "merge_gap_s is -1; it must be 0 or more"),
        ({"tolerance_s": float("nan")}, "tolerance_s is nan"),
        ({"value_tolerances": {"angle_deg": -3.0}}, r"value_tolerances\['angle_deg'\] is -3"),
        ({"order": "end"}, "order is 'end'; it must be 'onset' or 'closest'"),
    ],
)
def test_settings_without_sense_are_refused(changes: dict[str, object], message: str) -> None:
    with pytest.raises(LearningError, match=message):
        LearningSettings(**changes)  # type: ignore[arg-type]
