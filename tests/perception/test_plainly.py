"""What perception computes quickly, against the same written down plainly."""

import math
from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage

from understudy.geometry import Point, Pose
from understudy.perception import Cylinder, Perception, find_blobs, find_cylinders
from understudy.perception.colors import COLOR_CLASSES, classify
from understudy.perception.memory import Track
from understudy.robot import PIONEER, RGB, Color, Observation, Scan

EVERYWHERE = np.ones((3, 3), int)  # pixels that meet at corners are connected, too
BLIND = math.radians(85)

coordinates = st.floats(-5, 5)
poses = st.builds(Pose, coordinates, coordinates, st.floats(-math.pi, math.pi))
# A step of 0.25 m now and then, so that groups of rays of any length come about.
readings = st.sampled_from([0.5, 1.0, 1.05, 1.1, 1.25, 2.0, 2.1, 7.9, 8.0, 8.5, math.inf, math.nan])
sweeps = st.builds(
    lambda pieces: [reading + slant * ray for reading, rays, slant in pieces for ray in range(rays)],
    st.lists(st.tuples(readings, st.integers(1, 30), st.sampled_from([0.0, 0.15])), min_size=1, max_size=20),
)


@given(poses, st.lists(st.tuples(coordinates, coordinates)))
def test_many_points_go_the_way_of_one(pose: Pose, points: list[tuple[float, float]]) -> None:
    assert pose.to_locals(points) == [pose.to_local(Point(*point)) for point in points]


patches = st.tuples(
    st.sampled_from([*Color, None]), st.integers(0, 159), st.integers(0, 119), st.integers(1, 30), st.integers(1, 30)
)


@given(st.lists(patches, max_size=12), st.integers(1, 40))
def test_blobs_are_the_connected_patches_of_each_color(
    painted: list[tuple[Color | None, int, int, int, int]], min_area: int
) -> None:
    image = np.full((120, 160, 3), 120, np.uint8)
    for color, left, top, width, height in painted:
        image[top : top + height, left : left + width] = 120 if color is None else RGB[color]
    classes = classify(image)
    expected = []
    for index, color in enumerate(COLOR_CLASSES, start=1):
        labels, count = ndimage.label(classes == index, EVERYWHERE)
        for label in range(1, count + 1):
            rows, columns = np.nonzero(labels == label)
            if len(rows) >= min_area:
                expected.append((color, columns.min(), columns.max(), rows.min(), rows.max(), len(rows)))
    blobs = find_blobs(image, min_area=min_area)
    assert sorted((b.color, b.left, b.right, b.top, b.bottom, b.area) for b in blobs) == sorted(expected)
    for before, after in pairwise(blobs):
        assert before.color != after.color or before.area >= after.area
    assert [b.color for b in blobs] == sorted((b.color for b in blobs), key=COLOR_CLASSES.index)


def plainly_cylinders(scan: Scan, laser_x: float) -> list[Cylinder]:
    """The definition: for every group of rays between two jumps, all conditions one after the other."""
    reaches = [scan.range_max if math.isnan(reading) else min(reading, scan.range_max) for reading in scan.ranges]
    reaches = [float(np.float32(reach)) for reach in reaches]
    last = len(reaches) - 1
    starts = [0, *(i + 1 for i in range(last) if abs(reaches[i + 1] - reaches[i]) > 0.18)]
    found = []
    for start, after in zip(starts, [*starts[1:], last + 1], strict=True):
        end, group = after - 1, reaches[start:after]
        width = min(group) * len(group) * scan.angle_increment
        tips = [
            Point(math.cos(a) * reaches[i], math.sin(a) * reaches[i]) for i in (start, end) for a in [angle(scan, i)]
        ]
        free = (start == 0 or reaches[start] < reaches[start - 1]) and (end == last or reaches[end] < reaches[end + 1])
        if not free or (start == 0 and end == last) or min(group) >= scan.range_max:
            continue
        if width > 0.60 or tips[0].distance_to(tips[1]) > 0.60:
            continue
        radius, third = max(0.04, width / 2), max(1, len(group) // 3)
        first = (len(group) - third) // 2
        reach = sum(group[first : first + third]) / third + radius
        bearing = angle(scan, (start + end) / 2)
        center = Point(laser_x + reach * math.cos(bearing), reach * math.sin(bearing))
        found.append(Cylinder(center=center, radius=radius, rays=len(group), cut=start == 0 or end == last))
    return found


def angle(scan: Scan, index: float) -> float:
    return scan.angle_min + index * scan.angle_increment


@given(sweeps, st.sampled_from([math.pi / 180, 0.02]))
def test_cylinders_are_the_groups_that_stand_free(ranges: list[float], increment: float) -> None:
    scan = Scan(ranges=np.array(ranges, np.float32), angle_increment=increment)
    assert find_cylinders(scan, 0.1) == plainly_cylinders(scan, 0.1)


@given(arrays(np.float32, st.integers(0, 40), elements=st.sampled_from([0.0, 1.5, 8.0, math.inf, math.nan])))
def test_unusable_rays_are_counted(ranges: np.ndarray[tuple[int], np.dtype[np.float32]]) -> None:
    assert Scan(ranges=ranges).unusable == sum(math.isnan(reading) for reading in ranges.tolist())


@given(
    arrays(np.float32, 181, elements=st.sampled_from([0.5, 3.0, 7.99, 8.0, math.inf])),
    st.lists(st.sampled_from([0.2, 0.99, 1.0, 4.0, math.inf]), max_size=16),
)
def test_obstacles_are_what_laser_and_sonars_met(
    ranges: np.ndarray[tuple[int], np.dtype[np.float32]], sonar: list[float]
) -> None:
    observation = Observation(time_s=0.0, scan=Scan(ranges=ranges), sonar=np.array(sonar, np.float32))
    expected = [
        (
            PIONEER.laser.x + reading * math.cos(angle(observation.scan, i)),
            reading * math.sin(angle(observation.scan, i)),
        )
        for i, reading in enumerate(ranges.tolist())
        if reading < 8.0
    ]
    for mount, distance in zip(PIONEER.sonar_poses, observation.sonar.tolist(), strict=False):
        if distance < 1.0 and abs(mount.heading) > BLIND:
            expected.append(mount.to_parent(Point(distance, 0.0)))
    obstacles = Perception(PIONEER).update(observation).obstacles
    assert obstacles.shape == (len(expected), 2)
    np.testing.assert_allclose(obstacles, np.array(expected).reshape(-1, 2), atol=1e-9)


@given(poses, st.lists(st.tuples(coordinates, coordinates), min_size=1, max_size=5), st.data())
def test_a_remembered_target_is_met_by_the_nearest_free_object(
    pose: Pose, places: list[tuple[float, float]], data: st.DataObject
) -> None:
    perception = Perception(PIONEER)
    perception.targets.tracks = [
        Track(number, Point(*place), 0.1, 0.0, 0.0, believed=True) for number, place in enumerate(places)
    ]
    near = data.draw(st.lists(st.tuples(st.sampled_from(places), st.floats(-0.3, 0.3)), max_size=5))
    met = [pose.to_local(Point(x + beside, y)) for (x, y), beside in near]
    cylinders = [Cylinder(center=center, radius=0.1, rays=5, cut=True) for center in met]  # cut: met, and not moved
    perception._feel(1.0, pose, cylinders)
    free, expected = list(met), []
    for number, place in enumerate(places):
        here = pose.to_local(Point(*place))
        nearest = min(free, key=here.distance_to, default=Point(math.inf, 0.0))
        if here.distance_to(nearest) <= 0.25:
            free.remove(nearest)
            expected.append(number)
    assert [track.id for track in perception.targets.tracks if track.seen_s == 1.0] == expected


@given(st.dictionaries(st.sampled_from(list(Color)), st.integers(1, 3), min_size=1))
def test_a_thing_has_the_color_that_most_saw(votes: dict[Color, int]) -> None:
    track = Track(1, Point(0, 0), 0.1, 0.0, 0.0)
    track.votes.update(votes)
    assert track.color == next(color for color, count in votes.items() if count == max(votes.values()))
