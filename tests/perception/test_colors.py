"""The eight colors are told apart in any reasonable light, and from grey."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.perception import find_blobs
from understudy.perception.colors import COLOR_CLASSES, classify
from understudy.robot import RGB, Color


def patch(rgb: tuple[float, float, float]) -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    return np.full((4, 4, 3), np.clip(np.round(rgb), 0, 255).astype(np.uint8), np.uint8)


@given(st.sampled_from(list(Color)), st.floats(0.80, 1.0), st.tuples(*[st.floats(-4, 4)] * 3))
def test_a_paint_is_recognised_in_dimmer_light_and_with_noise(
    color: Color, light: float, noise: tuple[float, float, float]
) -> None:
    red, green, blue = (channel * light + error for channel, error in zip(RGB[color], noise, strict=True))
    assert (classify(patch((red, green, blue))) == COLOR_CLASSES.index(color) + 1).all()


@given(st.floats(0, 255), st.tuples(*[st.floats(-6, 6)] * 3))
def test_grey_is_no_color(level: float, noise: tuple[float, float, float]) -> None:
    assert (classify(patch((level + noise[0], level + noise[1], level + noise[2]))) == 0).all()


def test_the_dark_has_no_color() -> None:
    assert (classify(patch((30, 4, 4))) == 0).all()


def test_blobs_have_their_places() -> None:
    image = np.full((120, 160, 3), 120, np.uint8)
    image[10:50, 20:30] = RGB[Color.GREEN]
    image[60:70, 100:120] = RGB[Color.GREEN]
    image[100, 5:10] = RGB[Color.RED]  # five pixels: noise
    blobs = find_blobs(image)
    assert [(b.color, b.left, b.right, b.top, b.bottom, b.area) for b in blobs] == [
        (Color.GREEN, 20, 29, 10, 49, 400),
        (Color.GREEN, 100, 119, 60, 69, 200),
    ]
    assert blobs[0].column == 24.5


@pytest.mark.parametrize("gap", [0, 1])
def test_patches_that_touch_are_one(gap: int) -> None:
    image = np.full((120, 160, 3), 120, np.uint8)
    image[10:20, 10:20] = RGB[Color.PINK]
    image[10:20, 20 + gap : 30] = RGB[Color.PINK]
    assert len(find_blobs(image)) == 1 + gap
