import pytest

from understudy.learning.maintenance import departure
from understudy.network import Interval

from .build import seen, tracked

TOLERANCES = {"distance_m": 0.10}


@pytest.mark.parametrize(("before", "expected"), [(0.40, ""), (0.30, ""), (0.41, "distance_m went from 0.41 to 0.41")])
def test_a_value_holds_up_to_its_whole_tolerance(before: float, expected: str) -> None:
    steady = tracked(0.0, [before] * 10 + [0.30])
    assert departure(steady, Interval(0.2, 0.8), TOLERANCES).startswith(expected)
    assert bool(departure(steady, Interval(0.2, 0.8), TOLERANCES)) == bool(expected)


def test_only_the_meantime_counts_half_open() -> None:
    stopping = tracked(0.0, [0.9, 0.9, 0.4, 0.4, 0.4, 0.9, 0.4])
    assert departure(stopping, Interval(0.2, 0.5), TOLERANCES) == ""
    assert departure(stopping, Interval(0.1, 0.5), TOLERANCES) != ""
    assert departure(stopping, Interval(0.2, 0.6), TOLERANCES) != ""


def test_a_value_without_a_tolerance_must_not_change_at_all() -> None:
    assert departure(tracked(0.0, [0.4] * 5), Interval(0.0, 0.5), {}) == ""
    assert departure(tracked(0.0, [0.401] + [0.4] * 4), Interval(0.0, 0.5), {}) != ""


def test_what_was_not_seen_is_not_held() -> None:
    assert departure(tracked(0.0, [0.4] * 5), Interval(0.21, 0.29), TOLERANCES) == "its values were not seen then"


def test_a_goal_without_values_holds_as_long_as_it_was_seen() -> None:
    assert departure(seen(0, 9), Interval(2, 5), {}) == ""
