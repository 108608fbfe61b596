"""Bags that were recorded on another ROS 2 robot."""

import logging
import math
from pathlib import Path

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Rosbag2Writer
from rosbags.typesys.stores import ros2_humble as ros

from tests.recording.support import (
    STORE,
    BagWriter,
    header,
    laser,
    odometry,
    picture,
    raw_picture,
    text,
    twist,
)
from understudy.errors import RecordingError
from understudy.recording import GripperJoints, Recording, TopicMap, read_recording
from understudy.robot import Command, Cue

START_S = 1_700_000_000.0
"""Real robots' stamps count from 1970."""


def written(path: Path, messages: list[tuple[str, float, object]], topics: TopicMap | None = None) -> Recording:
    """A bag with these messages (topic, seconds, message)."""
    writer = BagWriter(path)
    for topic, time_s, message in messages:
        writer.write(topic, time_s, message)
    writer.close()
    return read_recording(path, topics=topics or TopicMap())


def moving(until_s: int, laser_hz: int = 40) -> list[tuple[str, float, object]]:
    """A laser and 50 Hz odometry; x is the odometry's time, the first ray the laser's and 1 m more."""
    scans = [START_S + i / laser_hz for i in range(until_s * laser_hz)]
    odoms = [START_S - 0.01 + i / 50 for i in range(until_s * 50)]
    return [
        *(("/scan", t, laser(t, [1 + t - START_S, 2.0])) for t in scans),
        *(("/odom", t, odometry(t, t - START_S, 0.3)) for t in odoms),
    ]


def test_a_rosbag2_file_with_a_fast_laser_and_jpeg_images(tmp_path: Path) -> None:
    """Written by rosbags' own writer, as ``ros2 bag record`` stores it."""
    times = [START_S + i / 40 for i in range(80)]
    with Rosbag2Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:

        def connect(topic: str, type_: str) -> object:
            return writer.add_connection(topic, type_, typestore=STORE)

        scans = connect("/scan", "sensor_msgs/msg/LaserScan")
        odoms = connect("/odom", "nav_msgs/msg/Odometry")
        images = connect("/camera/image_raw/compressed", "sensor_msgs/msg/CompressedImage")
        for i, t in enumerate(times):
            stamp = round(t * 1e9)

            def write(connection: object, message: object, time_ns: int) -> None:
                raw = STORE.serialize_cdr(message, message.__msgtype__)  # type: ignore[attr-defined]
                writer.write(connection, time_ns, raw)  # type: ignore[arg-type]

            write(odoms, odometry(t, i / 40, -1.25), stamp - 1000)
            if i % 8 == 0:
                write(images, picture(t, (250, 10, 40), ".jpg"), stamp - 500)
            write(scans, laser(t), stamp)
    recording = read_recording(next((tmp_path / "bag").glob("*.mcap")))
    observed = list(recording.observations())
    assert recording.info.kind == "bag"
    assert recording.info.complete
    assert not recording.info.exact
    assert [obs.time_s for obs in observed] == pytest.approx([i / 10 for i in range(20)], abs=1e-6)
    first = observed[0]
    assert first.time_s == 0
    assert (first.scan.angle_min, first.scan.angle_increment, first.scan.range_max) == (-3.0, 0.5, 30.0)
    assert first.odometry.pose.heading == pytest.approx(-1.25)
    assert (first.odometry.linear, first.odometry.angular) == (0.25, -0.5)
    assert observed[-1].odometry.pose.x == pytest.approx(observed[-1].time_s, abs=1e-6)
    assert first.gripper is None
    assert np.array_equal(first.sonar, np.full(16, np.inf, np.float32))
    seen = [obs.image for obs in observed if obs.image is not None]
    assert len(seen) == 10  # each of the 5 Hz images once
    assert np.abs(seen[0].astype(int) - (250, 10, 40)).max() < 10
    assert list(recording.events()) == []
    assert list(recording.commands()) == []


@pytest.mark.parametrize("laser_hz", [10, 12, 15, 20, 25, 40, 50])
def test_the_grid_is_ten_a_second_at_any_faster_rate(tmp_path: Path, laser_hz: int) -> None:
    rng = np.random.default_rng(1)
    jittered = [START_S + i / laser_hz + (rng.uniform(-0.004, 0.004) if i else 0) for i in range(laser_hz * 5)]
    messages = [("/odom", START_S, odometry(START_S, 0, 0)), *(("/scan", t, laser(t)) for t in jittered)]
    observed = list(written(tmp_path / "a.mcap", messages).observations())
    assert len(observed) in (50, 51)
    assert np.diff([obs.time_s for obs in observed]).max() < 0.2


def test_a_slow_laser_gives_one_observation_a_scan(tmp_path: Path) -> None:
    observed = list(written(tmp_path / "a.mcap", moving(2, laser_hz=4)).observations())
    assert [obs.time_s for obs in observed] == pytest.approx([i / 4 for i in range(8)])


def test_the_newest_reading_before_the_scan_is_held(tmp_path: Path) -> None:
    # The messages stand in the file topic by topic: it is their times that count.
    for obs in written(tmp_path / "a.mcap", moving(2)).observations():
        assert obs.scan.ranges[0] == pytest.approx(1 + obs.time_s, abs=1e-5)
        assert 0 <= obs.time_s - obs.odometry.pose.x < 0.0201


def test_scans_before_the_first_odometry_are_passed_over(tmp_path: Path) -> None:
    messages = [("/odom", 0.45, odometry(0.45, 1.0, 0)), *(("/scan", t / 10, laser(t / 10)) for t in range(10))]
    observed = list(written(tmp_path / "a.mcap", messages).observations())
    assert [obs.time_s for obs in observed] == pytest.approx([0.5, 0.6, 0.7, 0.8, 0.9])


def test_stamps_rule_where_the_laser_sets_them(tmp_path: Path) -> None:
    """Delivery over a network is late by another amount each time."""
    late = [("/scan", 100 + i / 10 + 0.03 * (i % 2), laser(50 + i / 10)) for i in range(5)]
    observed = written(tmp_path / "a.mcap", [("/odom", 99.0, odometry(99, 0, 0)), *late]).observations()
    assert [obs.time_s for obs in observed] == pytest.approx([0, 0.1, 0.2, 0.3, 0.4])
    unset = [("/scan", 100 + i / 10, laser(0)) for i in range(5)]
    observed = written(tmp_path / "b.mcap", [("/odom", 99.0, odometry(99, 0, 0)), *unset]).observations()
    assert [obs.time_s for obs in observed] == pytest.approx([0, 0.1, 0.2, 0.3, 0.4])


def test_two_runs_in_one_bag_are_refused(tmp_path: Path) -> None:
    scans = [("/scan", 10 + i / 10, laser(5 + i / 10 if i < 20 else 1 + i / 10)) for i in range(40)]
    recording = written(tmp_path / "a.mcap", [("/odom", 9.0, odometry(9, 0, 0)), *scans])
    with pytest.raises(RecordingError, match=r"stamps jump back by 3\.9 s.*cut it in two"):
        list(recording.observations())


def ranges_read(path: Path, ranges: list[float], range_min: float) -> np.ndarray:
    scan = laser(1.0, ranges)
    scan.range_min = range_min
    (obs,) = written(path, [("/odom", 0.9, odometry(0.9, 0, 0)), ("/scan", 1.0, scan)]).observations()
    assert obs.scan.ranges.dtype == np.float32
    return obs.scan.ranges


def test_what_is_nearer_than_the_laser_measures_is_unusable(tmp_path: Path) -> None:
    """REP 117: -inf is too near; many drivers give 0.0 for a ray without a reading."""
    given = [math.nan, math.inf, -math.inf, 0.0, -1.0, 0.09, 0.1, 0.2, 1e30]
    ranges = ranges_read(tmp_path / "a.mcap", given, range_min=0.1)
    expected = [math.nan, math.inf, math.nan, math.nan, math.nan, math.nan, 0.1, 0.2, 1e30]
    assert np.array_equal(ranges, np.array(expected, np.float32), equal_nan=True)


def test_a_driver_that_does_not_tell_its_shortest_range_measures_nothing_at_none(tmp_path: Path) -> None:
    ranges = ranges_read(tmp_path / "a.mcap", [0.0, -math.inf, 0.01], range_min=0.0)
    assert np.array_equal(ranges, np.array([math.nan, math.nan, 0.01], np.float32), equal_nan=True)


def one_image(path: Path, topic: str, message: object) -> np.ndarray:
    messages = [("/odom", 0.9, odometry(0.9, 0, 0)), (topic, 0.95, message), ("/scan", 1.0, laser(1.0))]
    (obs,) = written(path, messages).observations()
    assert obs.image is not None
    return obs.image


@pytest.mark.parametrize(
    ("encoding", "pixel"), [("rgb8", (1, 2, 3)), ("bgr8", (3, 2, 1)), ("rgba8", (1, 2, 3, 9)), ("bgra8", (3, 2, 1, 9))]
)
def test_raw_images_become_rgb(tmp_path: Path, encoding: str, pixel: tuple[int, ...]) -> None:
    pixels = np.full((4, 6, len(pixel)), pixel, np.uint8)
    for padding in (0, 5):
        image = one_image(
            tmp_path / f"{padding}.mcap", "/camera/image_raw", raw_picture(0.95, pixels, encoding, padding)
        )
        assert np.array_equal(image, np.full((4, 6, 3), (1, 2, 3), np.uint8))


def test_mono_images_become_grey(tmp_path: Path) -> None:
    pixels = np.arange(24, dtype=np.uint8).reshape(4, 6)
    image = one_image(tmp_path / "a.mcap", "/camera/image_raw", raw_picture(0.95, pixels, "mono8"))
    assert np.array_equal(image, np.stack([pixels] * 3, axis=2))


def test_png_images_are_exact_and_swapped_ones_are_swapped_back(tmp_path: Path) -> None:
    message = picture(0.95, (200, 100, 50), ".png")
    assert one_image(tmp_path / "a.mcap", "/camera/image_raw/compressed", message)[0, 0].tolist() == [200, 100, 50]
    swapped = ros.sensor_msgs__msg__CompressedImage(message.header, "rgb8; png compressed rgb8", message.data)
    assert one_image(tmp_path / "b.mcap", "/camera/image_raw/compressed", swapped)[0, 0].tolist() == [50, 100, 200]


def test_images_that_cannot_be_decoded(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match=r"encoding 'bayer_rggb8'; rgb8, bgr8.* can be read"):
        one_image(tmp_path / "a.mcap", "/camera/image_raw", raw_picture(0, np.zeros((2, 2), np.uint8), "bayer_rggb8"))
    short = raw_picture(0, np.zeros((2, 2, 3), np.uint8), "rgb8")
    short.height = 3
    with pytest.raises(RecordingError, match="too few"):
        one_image(tmp_path / "b.mcap", "/camera/image_raw", short)
    noise = ros.sensor_msgs__msg__CompressedImage(header(0), "jpeg", np.arange(50, dtype=np.uint8))
    with pytest.raises(RecordingError, match='format "jpeg" that cannot be decoded'):
        one_image(tmp_path / "c.mcap", "/camera/image_raw/compressed", noise)


def joints(time_s: float, **positions: float) -> ros.sensor_msgs__msg__JointState:
    return ros.sensor_msgs__msg__JointState(
        header(time_s), list(positions), np.array(list(positions.values()), float), np.zeros(0), np.zeros(0)
    )


def test_another_gripper_by_its_joints(tmp_path: Path) -> None:
    """Counting from the open posture, in radians, without a lift; its wheels report on the same topic."""
    messages = [
        ("/odom", 0.0, odometry(0, 0, 0)),
        ("/joint_states", 0.1, joints(0.1, knuckle=0.2)),
        ("/joint_states", 0.2, joints(0.2, wheel=99.0)),
        ("/beam", 0.3, ros.std_msgs__msg__Bool(True)),
        ("/scan", 1.0, laser(1.0)),
    ]
    mapped = TopicMap(beam="/beam", joints=GripperJoints(finger="knuckle", finger_closed=0.8, finger_open=0.0))
    (obs,) = written(tmp_path / "a.mcap", messages, mapped).observations()
    assert obs.gripper is not None
    assert obs.gripper.aperture == pytest.approx(0.75)
    assert obs.gripper.lift == 1.0
    assert obs.gripper.beam_broken
    with pytest.raises(RecordingError, match="two different end positions"):
        GripperJoints(finger_open=0.0)


def cloud(names: list[str], values: np.ndarray, *, padding: int = 0) -> ros.sensor_msgs__msg__PointCloud2:
    fields = [ros.sensor_msgs__msg__PointField(name, 4 * i, 7, 1) for i, name in enumerate(names)]
    data = np.hstack([values.astype(">f4").view(np.uint8), np.zeros((len(values), padding), np.uint8)]).ravel()
    step = 4 * len(names) + padding
    return ros.sensor_msgs__msg__PointCloud2(
        header(0), 1, len(values), fields, True, step, step * len(values), np.ascontiguousarray(data), True
    )


def test_sonars_from_either_kind_of_point_cloud(tmp_path: Path) -> None:
    ranges = np.array([[9.0, 0.5], [9.0, math.inf], [9.0, math.nan]])
    base = [("/odom", 0.0, odometry(0, 0, 0)), ("/scan", 1.0, laser(1.0))]
    (obs,) = written(
        tmp_path / "a.mcap", [*base, ("/sonar", 0.5, cloud(["x", "range"], ranges, padding=3))]
    ).observations()
    assert obs.sonar.tolist()[:2] == [0.5, math.inf]
    channel = ros.sensor_msgs__msg__ChannelFloat32("range", np.array([0.25, math.inf], np.float32))
    old = ros.sensor_msgs__msg__PointCloud(header(0), [], [channel])
    (obs,) = written(tmp_path / "b.mcap", [*base, ("/sonar", 0.5, old)]).observations()
    assert obs.sonar.tolist() == [0.25, math.inf]
    recording = written(tmp_path / "c.mcap", [*base, ("/sonar", 0.5, cloud(["x", "y"], ranges))])
    with pytest.raises(RecordingError, match=r"has the fields x, y; .*TopicMap\(sonar=None\)"):
        list(recording.observations())


def test_cues_are_handed_over_once_and_stray_words_passed_over(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    said = [("/cues", 0.32, text("here")), ("/cues", 0.34, text(" TAKE ")), ("/cues", 0.36, text("helo"))]
    messages = [
        ("/odom", 0.0, odometry(0, 0, 0)),
        *(("/scan", 0.05 + i / 10, laser(0.05 + i / 10)) for i in range(8)),
        *said,
    ]
    with caplog.at_level(logging.WARNING):
        recording = written(tmp_path / "a.mcap", messages)
        heard = [(obs.time_s, obs.cues) for obs in recording.observations() if obs.cues]
    assert heard == [(0.3, (Cue.HERE, Cue.TAKE))]
    assert [cue for _, cue in recording.cues()] == [Cue.HERE, Cue.TAKE]
    assert "passed over 'helo'; the cues are START, HERE" in caplog.text


def test_commands_of_both_twist_types_and_the_gripper(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    stamped = ros.geometry_msgs__msg__TwistStamped(header(11.5), twist(0.3, -0.2))
    messages = [("/odom", 10.0, odometry(10, 0, 0)), ("/scan", 11.0, laser(0))]
    told = [("/gripper/command", 12.0, text("close up")), ("/gripper/command", 12.5, text("wiggle"))]
    recording = written(tmp_path / "a.mcap", [*messages, ("/cmd_vel", 11.5, stamped), *told])
    assert list(recording.commands()) == [
        (0.5, Command(linear=0.3, angular=-0.2)),
        (1.0, Command(linear=0.3, angular=-0.2, paddles="close", lift="up")),
    ]
    assert "passed over 'wiggle'" in caplog.text
    recording = written(tmp_path / "b.mcap", [*messages, ("/cmd_vel", 11.25, twist(0.1, 0.0))])
    assert list(recording.commands()) == [(0.25, Command(linear=0.1))]


def test_a_bag_that_breaks_off(tmp_path: Path) -> None:
    written(tmp_path / "a.mcap", sorted(moving(20), key=lambda message: message[1]))
    content = (tmp_path / "a.mcap").read_bytes()
    # Another recorder's chunks are larger than ours, so cut within the index at the end.
    (tmp_path / "b.mcap").write_bytes(content[:-20])
    recording = read_recording(tmp_path / "b.mcap")
    assert not recording.info.complete
    assert len(list(recording.observations())) == 200


def test_a_bag_without_chunks_and_index(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "a.mcap", plain=True)
    for topic, time_s, message in sorted(moving(2), key=lambda message: message[1]):
        writer.write(topic, time_s, message)
    writer.close()
    recording = read_recording(tmp_path / "a.mcap")
    assert recording.info.complete
    whole = [obs.time_s for obs in recording.observations()]
    assert len(whole) == 20
    # Cut in the middle of the last scan, which must not be taken for a shorter one.
    content = (tmp_path / "a.mcap").read_bytes()
    (tmp_path / "b.mcap").write_bytes(content[: content.rindex(b"base_laser") + 20])
    cut = read_recording(tmp_path / "b.mcap")
    assert not cut.info.complete
    assert cut.info.topics["/scan"].count == 79
    assert [obs.time_s for obs in cut.observations()] == whole


def test_the_heading_of_a_robot_on_a_slope(tmp_path: Path) -> None:
    heading, pitch, roll = 0.5, 0.3, -0.2
    (sh, ch), (sp, cp), (sr, cr) = ((math.sin(a / 2), math.cos(a / 2)) for a in (heading, pitch, roll))
    message = odometry(0, 0, 0)
    message.pose.pose.orientation = ros.geometry_msgs__msg__Quaternion(
        sr * cp * ch - cr * sp * sh,
        cr * sp * ch + sr * cp * sh,
        cr * cp * sh - sr * sp * ch,
        cr * cp * ch + sr * sp * sh,
    )
    (obs,) = written(tmp_path / "a.mcap", [("/odom", 0.0, message), ("/scan", 1.0, laser(1.0))]).observations()
    assert obs.odometry.pose.heading == pytest.approx(heading)
