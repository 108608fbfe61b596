"""Gaps between footprints against a slow reference: points sampled from both."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from understudy.geometry import Point, Pose
from understudy.sim.layout import Footprint

places = st.floats(-1.5, 1.5)
shapes = st.one_of(
    st.builds(lambda x, y, r: Footprint.disc((x, y), r), places, places, st.floats(0.05, 0.4)),
    st.builds(
        lambda x, y, a, b, f, w: Footprint.rectangle(Pose(x, y, a), -b, f, w),
        places,
        places,
        st.floats(-math.pi, math.pi),
        *[st.floats(0.05, 0.5)] * 3,
    ),
    st.builds(lambda x, y, u, v: Footprint((Point(x, y), Point(u, v)), 0.02), places, places, places, places),
)


def samples(shape: Footprint) -> NDArray[np.float64]:
    """Points all over the hull of the corners."""
    corners = np.array(shape.corners)
    grid = np.linspace(0.0, 1.0, 25)
    if len(corners) == 1:
        return corners
    if len(corners) == 2:
        return np.asarray(corners[0] + grid[:, None] * (corners[1] - corners[0]))
    u, v = (axis.reshape(-1, 1) for axis in np.meshgrid(grid, grid))
    return np.asarray(corners[0] + u * (corners[1] - corners[0]) + v * (corners[3] - corners[0]))


@settings(max_examples=150, deadline=None)
@given(shapes, shapes)
def test_the_gap_is_that_of_the_nearest_points(a: Footprint, b: Footprint) -> None:
    nearest = np.linalg.norm(samples(a)[:, None] - samples(b)[None], axis=-1).min()
    expected = nearest - a.radius - b.radius
    assert expected - 0.16 <= a.gap_to(b) <= expected + 1e-6
    assert a.gap_to(b) == pytest.approx(b.gap_to(a))


@given(places, places, st.floats(0.05, 0.4))
def test_inside_means_every_edge_point_is(x: float, y: float, radius: float) -> None:
    angles = np.linspace(0.0, math.tau, 60)
    edge = np.array([x, y]) + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    inside = bool((edge >= -1e-9).all() and (edge <= 1.0 + 1e-9).all())
    assert Footprint.disc((x, y), radius).inside((1.0, 1.0)) == inside
