"""A camera that sees colors otherwise than in plain light learns them from a card, and recognises them from then on."""

import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from tests.ros2.network import Base, Network, Node
from understudy.errors import RobotDocumentError, RobotError
from understudy.perception.colors import COLOR_CLASSES, classify
from understudy.robot import RGB, Color
from understudy.ros2 import RobotDocument, alike, keep_colors, load_robot, paint_of, picture_from

TINT = (0.75, 1.0, 0.55)
"""The gains of a camera under a greenish lamp."""

DOCUMENT = """\
understudy: robot/1
# My robot has a cheap camera.
name: cheap
colors: {red: [200, 0, 0]}
drive:
  topic: /cmd_vel  # as the base has it
"""


def seen(color: Color) -> tuple[int, int, int]:
    red, green, blue = (round(channel * gain) for channel, gain in zip(RGB[color], TINT, strict=True))
    return red, green, blue


def card() -> NDArray[np.uint8]:
    """Eight patches of 20 pixels in a row, as the tinted camera sees them, with noise."""
    image = np.full((40, 160, 3), 100, np.int64)
    for index, color in enumerate(Color):
        image[10:30, 20 * index : 20 * index + 20] = seen(color)
    image += np.random.default_rng(0).integers(-5, 6, image.shape)
    return np.clip(image, 0, 255).astype(np.uint8)


PLACES = {color: (20 * index + 10, 20) for index, color in enumerate(Color)}


def recognised(document: RobotDocument) -> list[Color | None]:
    classes = classify(card(), document.spec.paints)
    found = [int(np.bincount(classes[12:28, 20 * i + 2 : 20 * i + 18].ravel()).argmax()) for i in range(len(Color))]
    return [COLOR_CLASSES[index - 1] if index else None for index in found]


def test_what_was_learned_is_recognised() -> None:
    assert recognised(RobotDocument()) != list(Color)
    paints = {color: paint_of(card(), at) for color, at in PLACES.items()}
    for color, paint in paints.items():
        assert paint == pytest.approx(seen(color), abs=2)
    assert recognised(RobotDocument(colors=paints)) == list(Color)
    assert alike(paints) == []


def test_the_document_keeps_its_other_lines(tmp_path: Path) -> None:
    path = tmp_path / "robot.yaml"
    path.write_text(DOCUMENT, encoding="utf-8")
    keep_colors(path, {Color.GREEN: (1, 2, 3)})
    document = keep_colors(path, {Color.LIGHT_GREEN: (4, 5, 6)})
    assert document == load_robot(path)
    assert document.colors == {Color.RED: (200, 0, 0), Color.LIGHT_GREEN: (4, 5, 6), Color.GREEN: (1, 2, 3)}
    text = path.read_text(encoding="utf-8")
    assert "# My robot has a cheap camera." in text
    assert "# as the base has it" in text
    assert text.count("colors:") == 1
    assert list(tmp_path.iterdir()) == [path]
    with pytest.raises(RobotDocumentError):
        keep_colors(tmp_path / "none.yaml", {})


@pytest.mark.parametrize(
    ("at", "says"),
    [
        ((2, 20), "not in the picture of 160 by 40"),
        ((200, 20), "not in the picture"),
        ((20, 20), "is of several colors"),
    ],
)
def test_patches_that_tell_nothing(at: tuple[int, int], says: str) -> None:
    with pytest.raises(RobotError, match=says):
        paint_of(card(), at)


def test_a_dark_patch() -> None:
    with pytest.raises(RobotError, match="too dark"):
        paint_of(np.zeros((40, 40, 3), np.uint8), (20, 20))


def test_colors_that_look_alike_are_named() -> None:
    assert alike({Color.GREEN: (145, 228, 105)}) == [(Color.LIGHT_GREEN, Color.GREEN)]


def test_a_live_picture() -> None:
    network = Network()
    Base(network)
    image = picture_from(RobotDocument(), Node(network, "understudy"), clock=network.clock)
    assert image.shape == (120, 160, 3)
    camera = RobotDocument.model_validate({"camera": {"topic": "/eye"}})
    with pytest.raises(RobotError, match="nobody publishes /eye"):
        picture_from(camera, Node(network, "another"), clock=network.clock)


def test_the_command(tmp_path: Path) -> None:
    (tmp_path / "robot.yaml").write_text(DOCUMENT, encoding="utf-8")
    cv2.imwrite(str(tmp_path / "card.png"), cv2.cvtColor(card(), cv2.COLOR_RGB2BGR))
    places = [f"--patch={color}={column},{row}" for color, (column, row) in PLACES.items()]

    def calibrate(*arguments: str) -> subprocess.CompletedProcess[str]:
        program = [sys.executable, "-c", "from understudy.cli import main; main()", "calibrate", "robot.yaml"]
        return subprocess.run([*program, *arguments], cwd=tmp_path, capture_output=True, text=True, check=False)

    done = calibrate(*places, "--picture", "card.png")
    assert done.returncode == 0, done.stderr
    assert recognised(load_robot(tmp_path / "robot.yaml")) == list(Color)
    wrong = calibrate("--patch=purple", "--picture", "card.png")
    assert wrong.returncode == 2
    assert "is no COLOR=COLUMN,ROW; the colors are: red, orange" in wrong.stderr
