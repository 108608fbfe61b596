import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.figures.chart import lanes
from understudy.figures.labels import label, number
from understudy.figures.placement import Placer, Rect
from understudy.figures.style import PAPER, blend, contrast, edge, elide, text_width, wrap
from understudy.figures.timeline import _flying
from understudy.figures.trajectories import Trajectory
from understudy.robot import Color

spans = st.lists(
    st.tuples(st.floats(0, 100), st.floats(0, 30)).map(lambda pair: (pair[0], pair[0] + pair[1])), max_size=12
)


@given(spans)
def test_spans_of_one_lane_do_not_overlap(given_spans):
    chosen = lanes(given_spans)
    for i, (a, b) in enumerate(given_spans):
        for j, (c, d) in enumerate(given_spans[:i]):
            assert chosen[i] != chosen[j] or b <= c or a >= d


@given(spans)
def test_no_line_of_a_flag_runs_through_another_flag(given_spans):
    flags = sorted(given_spans)
    heights = _flying(flags)
    for i, (a, b) in enumerate(flags):
        for j, (c, _) in enumerate(flags):
            if i != j and a < c < b:
                assert heights[j] < heights[i]


def test_a_label_avoids_what_is_taken_and_stays_inside():
    placer = Placer(Rect(0, 0, 200, 200))
    thing = Rect.around(180, 100, 20, 20)
    placer.take(thing, 4.0)
    first = placer.place(180, 100, 10, (60, 10))
    second = placer.place(180, 100, 10, (60, 10))
    for rect in (first, second):
        assert rect.overlap(thing) == 0
        assert rect.overlap(placer.bounds) == pytest.approx(rect.area)
    assert first.overlap(second) == 0


def test_a_free_label_stands_to_the_right():
    rect = Placer(Rect(0, 0, 400, 400)).place(200, 200, 10, (60, 10))
    assert rect.left > 210
    assert rect.top < 200 < rect.bottom


@pytest.mark.parametrize("color", Color)
def test_edges_are_seen_on_white(color):
    assert contrast(edge(color), PAPER) >= 3.0


def test_black_and_white_have_the_greatest_contrast():
    assert contrast("#000000", "white") == pytest.approx(21.0)
    assert blend("#000000", "#ffffff", 0.5) == "#808080"


@given(st.text(max_size=60), st.floats(20, 200))
def test_lines_keep_their_width(text, width):
    lines = wrap(text, width, 9.0, lines=3)
    assert len(lines) <= 3
    assert all(text_width(line, 9.0) <= width for line in lines)


def test_what_fits_is_left_whole():
    assert elide("Track light orange", 200, 9.0) == "Track light orange"
    assert wrap("one two", 500, 9.0) == ("one two",)
    assert elide("Track light orange", 60, 9.0).endswith("…")


def test_labels_tell_words_from_numbers():
    named = label("Track", {"color": "light orange", "distance_m": 0.519, "angle_deg": 178.4})
    assert (named.title, named.color, named.details) == ("Track light orange", "light orange", "0.52 m, 178°")
    poured = label("pour", {"into": "cup", "count": 3, "color": "mauve"})
    assert (poured.title, poured.color, poured.details) == ("pour cup mauve", "", "count 3")
    assert number("wait_s", 2.04) == "2.0 s"
    # As in a component, which has 0.545, and not as it was seen.
    assert number("distance_m", 0.54496) == number("distance_m", 0.545) != "0.54 m"


def test_a_trajectory_is_resampled_by_way_and_not_by_time():
    still = [[time, 0.0, 0.0] for time in range(5)]
    moved = Trajectory(name="robot", points=np.array([*still, [6.0, 1.0, 0.0]])).resampled(0.25)
    np.testing.assert_allclose(moved[:, 1], [0, 0.25, 0.5, 0.75, 1.0])
    assert moved[-1, 0] == 6.0


def test_a_trajectory_knows_where_it_ended():
    points = np.array([[0, 0, 0], [1, 0, 1.0], [2, 0, 1.001]])
    assert Trajectory(name="robot", points=points).last_pose.heading == pytest.approx(np.pi / 2)
    with_heading = np.column_stack([points, [0.0, 0.0, 0.3]])
    assert Trajectory(name="robot", points=with_heading).last_pose.heading == 0.3
    assert Trajectory(name="robot", points=points[:1]).resampled(0.1).shape == (1, 3)
    assert Trajectory(name="robot", points=points).at(0.5) == (0.0, 0.5)
    with pytest.raises(ValueError, match="shape"):
        Trajectory(name="robot", points=points[:, :2])
