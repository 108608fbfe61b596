"""Colors taken for others: as often and for as long as the document says, and nothing else errs differently."""

from itertools import groupby
from typing import Any

import numpy as np
import pytest

from tests.sim.support import QUIET, simulate
from understudy.perception import Perception
from understudy.perception.blobs import find_blobs
from understudy.robot import PIONEER, Color, Observation

AHEAD: dict[str, Any] = {
    "targets": [{"color": "green", "at": [2.3, 3.5]}],
    "boxes": [{"color": "orange", "at": [1.6, 3.2]}],
    "arena": {"size": [4.0, 4.0]},
}


def seen(pictures: int, **noise: float) -> tuple[list[set[Color]], list[Observation]]:
    """The colors in each of so many pictures, and the observations."""
    robot = simulate(**AHEAD, noise={**QUIET, **noise}).robot()
    observations = []
    for _ in range(pictures):
        observations.append(robot.sense())
        robot.wait()
    images = [observation.image for observation in observations]
    return [{blob.color for blob in find_blobs(image)} for image in images if image is not None], observations


@pytest.mark.parametrize("lasting", [0.0, 1.0])
def test_a_color_is_misread_as_often_as_it_should_be(lasting: float) -> None:
    colors, _ = seen(1500, misread_colors=0.2, misread_s=lasting)
    for color in (Color.GREEN, Color.ORANGE):
        assert np.mean([color not in there for there in colors]) == pytest.approx(0.2, abs=0.08)
    assert set.union(*colors) == set(Color)


def test_an_error_lasts_for_a_picture_or_for_a_while() -> None:
    for lasting, least, most in ((0.0, 1.0, 1.6), (1.0, 7.0, 18.0)):
        colors, _ = seen(1500, misread_colors=0.2, misread_s=lasting)
        runs = [len(list(run)) for wrong, run in groupby(Color.GREEN not in there for there in colors) if wrong]
        assert least <= np.mean(runs) <= most


def test_the_other_errors_stay_as_they_were() -> None:
    noise = {"laser": 0.02, "image": 5.0, "illumination": 0.04, "false_blobs": 0.1}
    _, plain = seen(30, **noise)
    _, misread = seen(30, **noise, misread_colors=0.5)
    changed = 0
    for a, b in zip(plain, misread, strict=True):
        assert np.array_equal(a.scan.ranges, b.scan.ranges)
        assert a.image is not None
        assert b.image is not None
        # What is of no thing's color is the same to the last bit.
        differs = np.any(a.image != b.image, axis=2)
        assert differs.mean() < 0.2
        changed += bool(differs.any())
    assert 10 < changed < 30


def test_the_robot_is_not_misled_by_single_pictures() -> None:
    """A thing has the color in which it was seen most often."""
    perception = Perception(PIONEER)
    _, observations = seen(300, misread_colors=0.2)
    for observation in observations:
        percepts = perception.update(observation)
    assert [thing.color for thing in percepts.targets] == [Color.GREEN]
    assert [thing.color for thing in percepts.boxes] == [Color.ORANGE]
