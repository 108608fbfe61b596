"""The camera's picture: what appears where, in which color, and what hides what."""

import math
from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from tests.sim.support import QUIET, make_world, simulate
from understudy.geometry import Point, Pose
from understudy.robot import PIONEER, RGB, Color
from understudy.sim import Simulation
from understudy.sim.lens import Lens

CAMERA = PIONEER.camera


def picture(**changes: Any) -> NDArray[np.uint8]:
    image = simulate(**changes).robot().sense().image
    assert image is not None
    return image


def mask(image: NDArray[np.uint8], color: Color) -> NDArray[np.bool_]:
    """Pixels whose hue is that of a color, in any light."""
    pixels = image.astype(float)
    paint = np.array(RGB[color], float)
    length = np.linalg.norm(pixels, axis=-1)
    cosine = pixels @ paint / np.maximum(length * np.linalg.norm(paint), 1e-9)
    return np.asarray((cosine > 0.995) & (length > 0.5 * np.linalg.norm(paint)))


def column(place: Point, height: float) -> float:
    """Of a point before the camera: a pinhole, turned about its own axis, written down again."""
    ahead, up = place.x - CAMERA.x, height - CAMERA.height
    depth = ahead * math.cos(CAMERA.tilt) - up * math.sin(CAMERA.tilt)
    return CAMERA.width / 2 - 0.5 - place.y / depth * CAMERA.focal_px


def row(ahead: float, height: float) -> float:
    below = math.atan2(CAMERA.height - height, ahead - CAMERA.x) - CAMERA.tilt
    return CAMERA.rows / 2 - 0.5 + math.tan(below) * CAMERA.focal_px


def sight_lines(place: Point, radius: float) -> list[Point]:
    """Where the lines of sight touch a disc, to its left and right."""
    ahead, left = place.x - CAMERA.x, place.y
    away = math.hypot(ahead, left)
    reach, half = math.sqrt(away**2 - radius**2), math.asin(radius / away)
    angles = (math.atan2(left, ahead) + half, math.atan2(left, ahead) - half)
    return [Point(CAMERA.x + reach * math.cos(a), reach * math.sin(a)) for a in angles]


def test_a_picture_is_rgb_of_five_bits_a_channel() -> None:
    image = Simulation(make_world(noise={})).robot().sense().image
    assert image is not None
    assert image.shape == (120, 160, 3)
    assert image.dtype == np.uint8
    assert not (image & 0x07).any()


@pytest.mark.parametrize("bearing_deg", [0.0, 15.0, -18.0])
@pytest.mark.parametrize("color", [Color.RED, Color.LIGHT_ORANGE, Color.GREEN])
def test_a_cylinder_two_metres_ahead_is_at_its_place_in_its_color(bearing_deg: float, color: Color) -> None:
    bearing = math.radians(bearing_deg)
    place = Point(2.0 * math.cos(bearing), 2.0 * math.sin(bearing))
    at = Pose(2.0, 2.0, math.pi / 2).to_parent(place)
    seen = mask(picture(targets=[{"color": color, "at": list(at)}]), color)
    rows, columns = np.nonzero(seen)
    middle = row(2.0 * math.cos(bearing), 0.25)
    in_row = columns[rows == round(middle)]
    assert in_row.mean() == pytest.approx(column(place, 0.25), abs=1.0)
    edges = [column(edge, 0.25) for edge in sight_lines(place, 0.10)]
    assert in_row.min() == pytest.approx(min(edges), abs=1.5)
    assert in_row.max() == pytest.approx(max(edges), abs=1.5)
    nearest = 2.0 * math.cos(bearing) - 0.10
    assert rows.max() == pytest.approx(row(nearest, 0.0), abs=1.5)
    assert rows.min() == pytest.approx(row(nearest, 0.5), abs=1.5)


def test_what_is_behind_or_beside_is_not_seen() -> None:
    targets = [{"color": "red", "at": [2.0, 0.8]}, {"color": "pink", "at": [3.5, 2.2]}]
    image = picture(targets=targets)
    assert not mask(image, Color.RED).any()
    assert not mask(image, Color.PINK).any()


def test_the_nearer_hides_the_farther() -> None:
    near, far = {"color": "red", "at": [2.0, 3.0]}, {"color": "green", "at": [2.0, 4.5]}
    assert mask(picture(targets=[far]), Color.GREEN).any()
    for targets in ([near, far], [far, near]):
        image = picture(targets=targets)
        assert mask(image, Color.RED).any()
        assert not mask(image, Color.GREEN).any()


def test_an_inner_wall_hides_what_is_behind_it_and_not_what_is_before() -> None:
    wall = {"from": [0.5, 3.5], "to": [3.5, 3.5]}
    assert not mask(picture(walls=[wall], targets=[{"color": "red", "at": [2.2, 4.5]}]), Color.RED).any()
    assert mask(picture(walls=[wall], targets=[{"color": "red", "at": [2.2, 3.2]}]), Color.RED).any()


def test_a_box_is_seen_from_afar_and_not_when_it_is_too_near() -> None:
    sizes = {}
    for ahead in (0.45, 0.9, 1.5):
        seen = mask(picture(boxes=[{"color": "orange", "at": [2.0, 2.0 + ahead]}]), Color.ORANGE)
        sizes[ahead] = int(seen.sum())
    assert sizes[0.45] == 0
    assert sizes[0.9] > sizes[1.5] > 20


def test_a_box_shows_its_top_at_the_right_rows() -> None:
    rows, _ = np.nonzero(mask(picture(boxes=[{"color": "yellow", "at": [2.0, 3.0]}]), Color.YELLOW))
    assert rows.max() == pytest.approx(row(1.0 - 0.045, 0.0), abs=1.5)
    assert rows.min() == pytest.approx(row(1.0 + 0.045, 0.10), abs=1.5)


@pytest.mark.parametrize("heading_deg", [0, 20, 45, 130, -75])
@pytest.mark.parametrize("place", [(2.0, 2.9), (2.3, 3.3), (1.8, 2.7)])
def test_a_turned_box_covers_what_its_corners_span(place: tuple[float, float], heading_deg: float) -> None:
    seen = mask(picture(boxes=[{"color": "orange", "at": list(place), "heading_deg": heading_deg}]), Color.ORANGE)
    box, eye = Pose(*place, math.radians(heading_deg)), Pose(2.0, 2.0, math.pi / 2)
    corners = [eye.to_local(box.to_parent(Point(x, y))) for x in (-0.045, 0.045) for y in (-0.045, 0.045)]
    pixels = [(column(corner, height), row_of(corner, height)) for corner in corners for height in (0.0, 0.10)]
    span = np.zeros(seen.shape, np.uint8)
    cv2.fillConvexPoly(span, cv2.convexHull(np.rint(pixels).astype(np.int32)), 1)
    assert (seen & (span > 0)).sum() >= 0.9 * (seen | (span > 0)).sum()


def test_a_box_is_brightest_on_top() -> None:
    image = picture(boxes=[{"color": "orange", "at": [2.0, 2.9]}])
    rows, columns = np.nonzero(mask(image, Color.ORANGE))
    light = image[rows, columns].sum(axis=-1)
    assert rows[light == light.max()].max() < rows[light < light.max()].min() + 2


def row_of(place: Point, height: float) -> float:
    """Of a point before the camera, whichever its direction."""
    ahead, up = place.x - CAMERA.x, height - CAMERA.height
    depth = ahead * math.cos(CAMERA.tilt) - up * math.sin(CAMERA.tilt)
    down = -ahead * math.sin(CAMERA.tilt) - up * math.cos(CAMERA.tilt)
    return CAMERA.rows / 2 - 0.5 + down / depth * CAMERA.focal_px


@given(st.lists(st.tuples(st.floats(0.2, 9.0), st.floats(-5, 5))), st.floats(0.0, 0.6))
def test_many_pixels_go_the_way_of_one(places: list[tuple[float, float]], height: float) -> None:
    lens = Lens(CAMERA)
    assert lens.pixels_at(places, height) == [lens.pixel(*place, height) for place in places]


def test_the_teacher_fills_the_picture_to_its_upper_edge() -> None:
    for away in (0.7, 1.5):
        rows, columns = np.nonzero(mask(picture(teacher={"at": [2.0, 2.0 + away]}), Color.BLUE))
        assert rows.min() == 0
        assert columns.mean() == pytest.approx(79.5, abs=1.0)


def test_another_robot_is_dark_and_shows_its_marker() -> None:
    robots = [
        {"name": "learner", "at": [2.0, 1.0], "heading_deg": 90},
        {"name": "guide", "at": [2.0, 2.5], "heading_deg": 90, "marker": "pink"},
    ]
    image = picture(robots=robots)
    assert mask(image, Color.PINK).sum() > 300
    assert (image.max(axis=-1) < 90).sum() > 200
    own_view = simulate(robots=robots).robot("guide").sense().image
    assert own_view is not None
    assert not mask(own_view, Color.PINK).any()


def test_images_err_as_much_as_they_should() -> None:
    still = simulate().robot().sense().image
    assert still is not None
    noisy = Simulation(make_world(noise={**QUIET, "image": 6.0})).robot().sense().image
    assert noisy is not None
    error = noisy.astype(float) - still
    # Rounding to multiples of eight adds 8/√12 to a deviation of 6.
    assert float(error.std()) == pytest.approx(math.hypot(6.0, 8 / math.sqrt(12)), rel=0.2)


def test_the_light_changes_slowly() -> None:
    simulation = Simulation(make_world(noise={**QUIET, "illumination": 0.1}))
    robot = simulation.robot()
    levels = []
    for _ in range(120):
        image = robot.sense().image
        assert image is not None
        levels.append(float(image[100].mean()))
        robot.wait()
    assert np.std(levels) > 3.0
    assert np.abs(np.diff(levels)).mean() < np.std(levels)


def test_false_blobs_come_as_often_as_they_should() -> None:
    simulation = Simulation(make_world(noise={**QUIET, "false_blobs": 0.3}))
    robot = simulation.robot()
    plain = robot.sense().image
    assert plain is not None
    with_blob = 0
    for _ in range(200):
        robot.wait()
        image = robot.sense().image
        assert image is not None
        with_blob += int(any(mask(image, color).sum() >= 6 for color in Color))
    assert 30 <= with_blob <= 90


def test_no_pose_of_a_crowded_room_breaks_the_drawing() -> None:
    simulation = simulate(
        walls=[{"from": [1, 3], "to": [3, 3.4]}],
        targets=[{"color": "red", "at": [1, 1]}, {"color": "green", "at": [3, 1], "height": 0.2}],
        boxes=[{"color": "orange", "at": [1.5, 4.2]}],
        teacher={"at": [3.0, 4.5]},
    )
    robot = simulation.robot()
    rng = np.random.default_rng(3)
    for _ in range(300):
        x, y = (rng.random(2) * (4.0, 6.0)).tolist()
        simulation.move_robot((x, y), float(rng.uniform(-180, 180)))
        image = robot.sense().image
        assert image is not None
        assert image.shape == (120, 160, 3)
