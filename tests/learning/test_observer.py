import math
from collections.abc import Mapping, Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.errors import LearningError
from understudy.learning import Demonstration, Instance, LearningSettings, Observer
from understudy.network import Interval
from understudy.robot.cues import Cue

from .reference import runs_of_true

GREEN = Instance("Track", (("color", "green"),))
PINK = Instance("Track", (("color", "pink"),))
DROP = Instance("Drop")


def at(tick: int) -> float:
    return round(tick * 0.1, 9)


def watch(
    ticks: Sequence[Mapping[Instance, Mapping[str, float]]],
    words: Mapping[int, Sequence[Cue]],
    settings: LearningSettings | None = None,
) -> Demonstration:
    observer = Observer(settings)
    for tick, evaluated in enumerate(ticks):
        observer.step(at(tick), evaluated, words.get(tick, ()))
    return observer.finish(name="d")


def flickers() -> st.SearchStrategy[list[bool]]:
    """Truth tick by tick, in runs, so that gaps around the limit of merging are common."""
    runs = st.lists(st.tuples(st.booleans(), st.integers(1, 6)), max_size=10)
    return runs.map(lambda found: [value for value, length in found for _ in range(length)])


@given(st.tuples(flickers(), flickers(), flickers()), st.integers(0, 5), st.integers(0, 20), st.integers(0, 40))
def test_the_observations_are_the_merged_runs_of_truth_between_start_and_done(
    goals: tuple[list[bool], list[bool], list[bool]], merge_ticks: int, start: int, lasting: int
) -> None:
    length = max(map(len, goals)) + start + lasting + 1
    truth = {
        instance: [*values, *[False] * (length - len(values))]
        for instance, values in zip((GREEN, PINK, DROP), goals, strict=True)
    }
    ticks: list[dict[Instance, dict[str, float]]] = [
        {instance: {} for instance, values in truth.items() if values[tick]} for tick in range(length)
    ]
    done = start + lasting
    found = watch(
        ticks,
        {start: [Cue.START], done: [Cue.DONE]} if lasting else {start: [Cue.START, Cue.DONE]},
        LearningSettings(merge_gap_s=at(merge_ticks)),
    )
    expected = {
        (instance, Interval(at(first + start), at(last + start)))
        for instance, values in truth.items()
        for first, last in runs_of_true(values[start:done], merge_ticks)
    }
    assert {(observed.instance, observed.interval) for observed in found.observations} == expected
    assert len(found.observations) == len(expected)
    onsets = [observed.interval.start for observed in found.observations]
    assert onsets == sorted(onsets)
    assert found.span == Interval(at(start), at(done))


@given(st.lists(st.none() | st.floats(0.2, 3.0), min_size=1, max_size=60))
def test_values_closest_approach_and_history_are_those_of_the_interval(distances: list[float | None]) -> None:
    ticks = [{} if metres is None else {GREEN: {"distance_m": metres, "angle_deg": 90.0}} for metres in distances]
    found = watch([*ticks, {}], {0: [Cue.START], len(ticks): [Cue.DONE]}, LearningSettings(merge_gap_s=0.3))
    for observed in found.observations:
        first, last = (round(moment * 10) for moment in observed.interval)
        inside = [(at(tick), metres) for tick, metres in enumerate(distances) if first <= tick < last and metres]
        assert observed.values == {"distance_m": inside[-1][1], "angle_deg": 90.0}
        assert observed.closest_m == min(metres for _, metres in inside)
        assert observed.closest_s == next(time for time, metres in inside if metres == observed.closest_m)
        assert observed.history is not None
        assert observed.history.names == ("distance_m", "angle_deg")
        assert observed.history.times.tolist() == [time for time, _ in inside]
        assert observed.history.values.tolist() == [[metres, 90.0] for _, metres in inside]


def test_a_goal_that_ends_on_the_tick_on_which_another_begins_meets_it() -> None:
    pick_up = Instance("PickUp", (("color", "orange"),))
    found = watch([{DROP: {}}, {DROP: {}}, {pick_up: {}}, {pick_up: {}}, {}], {0: [Cue.START], 4: [Cue.DONE]})
    assert [observed.interval for observed in found.observations] == [Interval(0.0, 0.2), Interval(0.2, 0.4)]
    assert found.observations[0].history is None
    assert found.observations[0].closest_s is None


def test_words_are_kept_with_their_times() -> None:
    words = {0: [Cue.HERE, Cue.START], 1: [Cue.TAKE, Cue.GO], 3: [Cue.DONE, Cue.HERE]}
    found = watch([{DROP: {}}] * 5, words)
    assert found.cues == ((0.1, Cue.TAKE),)
    assert found.notes == ()


def test_what_was_seen_so_far_can_be_shown_at_any_time() -> None:
    observer = Observer()
    assert not observer.watching
    observer.step(0.0, {DROP: {}}, [Cue.START])
    observer.step(0.7, {DROP: {}})
    assert observer.watching
    assert [observed.interval for observed in observer.observations] == [Interval(0.0, 0.7)]
    observer.step(0.8, {})
    observer.step(0.9, {})
    assert [observed.interval for observed in observer.observations] == [Interval(0.0, 0.8)]


def test_a_demonstration_cut_short_counts_up_to_its_last_second() -> None:
    observer = Observer()
    observer.step(0.0, {}, [Cue.START])
    observer.step(0.1, {DROP: {}})
    found = observer.finish(7.5)
    assert found.observations[0].interval == Interval(0.1, 7.5)
    assert found.span == Interval(0.0, 7.5)
    assert found.notes == ("No DONE: the demonstration was cut short, and counts up to 7.5 s.",)
    assert observer.finish(9.0) == found


def test_words_that_cannot_be_meant_are_ignored_and_noted() -> None:
    words = {0: [Cue.DONE], 2: [Cue.START], 4: [Cue.START], 6: [Cue.DONE], 8: [Cue.START]}
    found = watch([{DROP: {}}] * 10, words)
    assert [observed.interval for observed in found.observations] == [Interval(0.2, 0.6)]
    assert found.notes == (
        "DONE at 0.0 s came before START; it was ignored.",
        "A second START at 0.4 s was ignored; the demonstration was going on.",
        "START at 0.8 s came after DONE; record it as a demonstration of its own.",
    )


def test_practice_begins_and_ends_with_other_words() -> None:
    settings = LearningSettings(begin=Cue.COME, end=Cue.GO)
    found = watch([{DROP: {}}] * 5, {1: [Cue.COME], 3: [Cue.GO]}, settings)
    assert found.span == Interval(0.1, 0.3)


def test_without_start_nothing_was_demonstrated() -> None:
    with pytest.raises(LearningError, match=r"START was never said.*Say START, lead the robot"):
        watch([{DROP: {}}], {})


def test_done_without_start_is_told() -> None:
    with pytest.raises(LearningError, match=r"START was never said.*DONE at 0\.1 s came before START"):
        watch([{DROP: {}}] * 2, {1: [Cue.DONE]})


@pytest.mark.parametrize("time_s", [0.9, math.nan, math.inf])
def test_time_runs_forward(time_s: float) -> None:
    observer = Observer()
    observer.step(1.0, {}, [Cue.START])
    with pytest.raises(LearningError, match="in order of time"):
        observer.step(time_s, {})


@pytest.mark.parametrize("values", [{"distance_m": math.nan}, {"angle_deg": 1.0}, {}])
def test_values_that_no_goal_can_have_are_refused(values: dict[str, float]) -> None:
    observer = Observer()
    observer.step(0.0, {GREEN: {"distance_m": 1.0}}, [Cue.START])
    with pytest.raises(LearningError, match=r"Track\(color=green\) was evaluated to .* finite values for: distance_m"):
        observer.step(0.1, {GREEN: values})
