import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.learning import HALF_A_TICK_S, TABLE_4_1, Relation, relation
from understudy.learning.instants import micros, micros_array
from understudy.learning.pairs import RELATIONS, relation_codes
from understudy.network import Interval

from .build import interval, seconds, spans
from .reference import rows_of_table_4_1, same

tolerances = st.sampled_from([0, 25, 50, 110])


@given(spans(), spans(), tolerances)
def test_it_is_the_one_row_of_the_table_that_applies(a: tuple[int, int], b: tuple[int, int], tolerance: int) -> None:
    if a[0] > b[0] and not same(a[0], b[0], tolerance):
        a, b = b, a
    [(name, link)] = rows_of_table_4_1(a, b, tolerance)
    found = relation(interval(a), interval(b), seconds(tolerance))
    assert found == name
    assert TABLE_4_1[found] == link


@given(st.lists(st.tuples(spans(), spans()), max_size=20), tolerances)
def test_many_at_once_give_the_same_as_one_by_one(
    pairs: list[tuple[tuple[int, int], tuple[int, int]]], tolerance: int
) -> None:
    pairs = [(min(a, b), max(a, b)) for a, b in pairs]
    a_start, a_end, b_start, b_end = (
        micros_array(seconds(pair[which][end]) for pair in pairs) for which in (0, 1) for end in (0, 1)
    )
    codes = relation_codes(a_start, a_end, b_start, b_end, micros(seconds(tolerance)))
    one_by_one = [relation(interval(a), interval(b), seconds(tolerance)) for a, b in pairs]
    assert [RELATIONS[code] for code in codes] == one_by_one


def test_table_4_1_has_a_row_for_every_relation() -> None:
    assert set(TABLE_4_1) == set(Relation)


@pytest.mark.parametrize(
    ("end", "expected"),
    [(12.0, Relation.MEETS), (11.95, Relation.MEETS), (12.05, Relation.MEETS), (11.949, Relation.BEFORE)],
)
def test_the_tolerance_is_half_a_tick_as_decimals_are_written(end: float, expected: Relation) -> None:
    assert HALF_A_TICK_S == 0.05
    assert relation(Interval(0, end), Interval(12.0, 20)) is expected


def test_stamps_since_1970_compare_as_well() -> None:
    now = 1_790_000_000.0
    assert relation(Interval(now, now + 12.05), Interval(now + 12.1, now + 20)) is Relation.MEETS


def test_the_later_one_first_is_refused() -> None:
    with pytest.raises(ValueError, match="the earlier one first"):
        relation(Interval(1, 2), Interval(0, 5))
