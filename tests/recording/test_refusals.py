"""What cannot be recorded or read is refused in one line that says how to mend it."""

import io
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader
from mcap.writer import CompressionType, Writer

from tests.recording.support import BagWriter, bits, drive, laser, odometry, record, text
from understudy.errors import RecordingError
from understudy.recording import FORMAT_VERSION, Recorder, TopicMap, read_recording
from understudy.robot import PIONEER, Command, Observation, Scan


def recorder(path: Path) -> Recorder:
    return Recorder(path, kind="run", name="a", spec=PIONEER)


def refused(path: Path, topics: TopicMap | None = None) -> str:
    """The refusal's message: one line that names the file."""
    with pytest.raises(RecordingError) as caught:
        list(read_recording(path, topics=topics or TopicMap()).observations())
    message = str(caught.value)
    assert str(path) in message
    assert "\n" not in message
    return message


def test_an_existing_file_is_never_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    path.write_bytes(b"precious")
    with pytest.raises(RecordingError, match=r"exists already.*name another file"):
        recorder(path)
    assert path.read_bytes() == b"precious"


def test_a_folder_that_is_missing(tmp_path: Path) -> None:
    with pytest.raises(RecordingError, match=r"No such file or directory.*name a file in a folder that exists"):
        recorder(tmp_path / "missing" / "a.mcap")


def test_a_wrong_kind_or_a_reserved_key_leaves_no_file(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with pytest.raises(RecordingError, match=r"'film' is no kind.*demonstration, run"):
        Recorder(path, kind="film", name="a", spec=PIONEER)  # type: ignore[arg-type]
    with pytest.raises(RecordingError, match="robot are written by the recorder itself"):
        Recorder(path, kind="run", name="a", spec=PIONEER, metadata={"robot": "r2"})
    assert not path.exists()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda: Observation(time_s=-1.0, scan=drive(1)[0].scan), "t=-1.0 s cannot be recorded"),
        (lambda: Observation(time_s=float("nan"), scan=drive(1)[0].scan), "t=nan s cannot be recorded"),
        (lambda: Observation(time_s=0.0, scan=Scan(ranges=np.ones(4))), "scan.ranges is float64"),  # type: ignore[arg-type]
        (
            lambda: Observation(time_s=0.0, scan=drive(1)[0].scan, image=np.zeros((4, 4), np.uint8)),
            r"image of shape \(4, 4\).*must be \(height, width, 3\)",
        ),
    ],
)
def test_what_could_not_come_back_equal_is_refused_whole(
    tmp_path: Path, change: Callable[[], Observation], message: str
) -> None:
    live = drive(2)
    with recorder(tmp_path / "a.mcap") as into:
        into.observation(live[0])
        with pytest.raises(RecordingError, match=message):
            into.observation(change())
        into.observation(live[1])
    recording = read_recording(tmp_path / "a.mcap")
    assert [bits(obs) for obs in recording.observations()] == [bits(obs) for obs in live]
    assert recording.info.topics["/scan"].count == 2


@pytest.mark.parametrize(
    ("event", "message"),
    [
        ({"kind": "a"}, 'needs a number "time_s"'),
        ({"time_s": 1.0}, 'and a "kind"'),
        ({"time_s": 1.0, "kind": "a", "value": object()}, "cannot be written as JSON"),
    ],
)
def test_an_event_without_time_or_kind_or_sense(tmp_path: Path, event: dict[str, object], message: str) -> None:
    with recorder(tmp_path / "a.mcap") as into, pytest.raises(RecordingError, match=message):
        into.event(event)


def test_nothing_is_recorded_after_closing(tmp_path: Path) -> None:
    into = recorder(tmp_path / "a.mcap")
    into.observation(drive(1)[0])
    into.close()
    size = (tmp_path / "a.mcap").stat().st_size
    into.close()
    with pytest.raises(RecordingError, match="is closed; record into a new file"):
        into.command(0.1, Command())
    assert (tmp_path / "a.mcap").stat().st_size == size


def record_all(into: Recorder, live: list[Observation]) -> None:
    for obs in live:
        into.observation(obs)


def test_a_full_disk_says_what_is_kept(tmp_path: Path) -> None:
    resource = pytest.importorskip("resource", reason="limits a file's size; Windows has no such thing")
    path, live = tmp_path / "a.mcap", drive(200)
    old = resource.getrlimit(resource.RLIMIT_FSIZE)
    into = recorder(path)
    # The process may not write beyond this size: the system fails as on a full disk.
    resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, old[1]))
    try:
        with pytest.raises(RecordingError, match=r"a\.mcap cannot be written any further.* s is kept") as caught:
            record_all(into, live)
        with pytest.raises(RecordingError, match="broken off"):
            into.observation(live[0])
        into.close()
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, old)
    recording = read_recording(path)
    kept = [bits(obs) for obs in recording.observations()]
    assert not recording.info.complete
    assert kept == [bits(obs) for obs in live[: len(kept)]]
    promised_s = float(str(caught.value).split("until t=")[1].split(" s")[0])
    assert promised_s >= 1.0
    assert live[len(kept) - 1].time_s >= promised_s


@pytest.mark.parametrize("limit", [0, 100])
def test_a_disk_that_is_full_from_the_beginning_leaves_no_file(tmp_path: Path, limit: int) -> None:
    resource = pytest.importorskip("resource", reason="limits a file's size; Windows has no such thing")
    path = tmp_path / "a.mcap"
    old = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, old[1]))
    try:
        with pytest.raises(RecordingError, match=r"a\.mcap cannot be written: .*there is no such file now"):
            recorder(path)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, old)
    assert not path.exists()
    with recorder(path) as into:  # the name is free
        into.observation(drive(1)[0])


def test_files_that_are_no_recordings(tmp_path: Path) -> None:
    def of(name: str, content: bytes) -> Path:
        (tmp_path / name).write_bytes(content)
        return tmp_path / name

    assert "is empty" in refused(of("empty.mcap", b""))
    assert "is no MCAP file" in refused(of("noise.mcap", b"\x00\x01garbage" * 100))
    assert "is no MCAP file" in refused(of("short.mcap", b"\x89MC"))
    assert "cannot be read as a rosbag2" in refused(of("a.db3", b"SQLite format 3\0" + bytes(100)))
    assert "ROS 1 bag" in refused(of("a.bag", b"#ROSBAG V2.0\n" + bytes(100)))
    assert "No such file" in refused(tmp_path / "missing.mcap")
    assert "breaks off before its first message" in refused(of("header.mcap", b"\x89MCAP0\r\n"))
    assert "breaks off before its first message" in refused(of("cut.mcap", b"\x89MCAP0\r\n" + b"\x01\xff" * 50))


def test_a_folder_names_the_file_in_it(tmp_path: Path) -> None:
    record(tmp_path / "bag_0.mcap", drive(1))
    assert f"read the file in it: {tmp_path / 'bag_0.mcap'}" in refused(tmp_path)


def bag(path: Path, *messages: tuple[str, object]) -> Path:
    writer = BagWriter(path)
    for topic, message in messages:
        writer.write(topic, 0.0, message)
    writer.close()
    return path


def test_no_scan_names_the_topic_that_would_do(tmp_path: Path) -> None:
    path = bag(tmp_path / "a.mcap", ("/base_scan", laser(0)), ("/odom", odometry(0, 0, 0)))
    message = refused(path)
    assert "has no topic /scan (sensor_msgs/msg/LaserScan)" in message
    assert 'topics=TopicMap(scan="/base_scan")' in message
    assert len(list(read_recording(path, topics=TopicMap(scan="/base_scan")).observations())) == 1


def test_no_laser_at_all_lists_what_there_is(tmp_path: Path) -> None:
    message = refused(bag(tmp_path / "a.mcap", ("/chatter", text("hello")), ("/odom", odometry(0, 0, 0))))
    assert "has no topic /scan" in message
    assert "it has /chatter, /odom; record the bag with the scan topic" in message


def test_no_odometry_is_refused_unless_done_without(tmp_path: Path) -> None:
    path = bag(tmp_path / "a.mcap", ("/scan", laser(0)))
    assert "has no topic /odom" in refused(path)
    (obs,) = read_recording(path, topics=TopicMap(odom=None)).observations()
    assert obs.odometry.pose.x == 0


def test_a_wrong_type_on_scan(tmp_path: Path) -> None:
    message = refused(bag(tmp_path / "a.mcap", ("/scan", text("not a scan")), ("/odom", odometry(0, 0, 0))))
    assert "/scan holds std_msgs/msg/String" in message
    assert "must be sensor_msgs/msg/LaserScan" in message


def test_a_wrong_type_on_a_topic_that_can_be_left_out(tmp_path: Path) -> None:
    path = bag(tmp_path / "a.mcap", ("/scan", laser(0)), ("/odom", odometry(0, 0, 0)), ("/sonar", text("ping")))
    assert "leave it out with TopicMap(sonar=None)" in refused(path)
    assert len(list(read_recording(path, topics=TopicMap(sonar=None)).observations())) == 1


def test_another_encoding(tmp_path: Path) -> None:
    writer = BagWriter(tmp_path / "a.mcap")
    writer.write("/scan", 0, laser(0), encoding="ros1")
    writer.write("/odom", 0, odometry(0, 0, 0))
    writer.close()
    assert "sensor_msgs/msg/LaserScan as ros1" in refused(tmp_path / "a.mcap")


def test_bytes_that_are_not_of_their_type(tmp_path: Path) -> None:
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start(profile="ros2")
    for topic, type_ in (("/scan", "sensor_msgs/msg/LaserScan"), ("/odom", "nav_msgs/msg/Odometry")):
        schema = writer.register_schema(type_, "ros2msg", b"")
        channel = writer.register_channel(topic, "cdr", schema)
        writer.add_message(channel, 0, b"\x00\x01\x00\x00\xff\xff", 0)
    writer.finish()  # type: ignore[no-untyped-call]
    (tmp_path / "a.mcap").write_bytes(stream.getvalue())
    assert "/odom at 0.000 s holds 6 bytes that are no nav_msgs/msg/Odometry" in refused(tmp_path / "a.mcap")


def test_a_recording_of_a_newer_format(tmp_path: Path) -> None:
    stream = io.BytesIO()
    writer = Writer(stream, compression=CompressionType.NONE)
    writer.start(profile="ros2")
    writer.add_metadata("understudy", {"format": str(FORMAT_VERSION + 1), "kind": "run", "name": "a"})
    writer.finish()  # type: ignore[no-untyped-call]
    (tmp_path / "a.mcap").write_bytes(stream.getvalue())
    assert "upgrade understudy" in refused(tmp_path / "a.mcap")


def test_damage_within_a_file_that_is_otherwise_whole(tmp_path: Path) -> None:
    live = drive(60)
    path = record(tmp_path / "a.mcap", live)
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 0xFF
    path.write_bytes(content)
    back: list[tuple[object, ...]] = []
    with pytest.raises(RecordingError, match=r"a\.mcap is damaged"):
        back.extend(bits(obs) for obs in read_recording(path).observations())
    assert back
    assert back == [bits(obs) for obs in live[: len(back)]]


def test_a_step_whose_scan_was_taken_out_does_not_get_another_steps(tmp_path: Path) -> None:
    whole, path = record(tmp_path / "whole.mcap", drive(3)), tmp_path / "a.mcap"
    with whole.open("rb") as source, path.open("wb") as target:
        writer, channels = Writer(target), {}
        writer.start(profile="ros2")
        for schema, channel, message in make_reader(source).iter_messages(log_time_order=False):
            assert schema is not None
            if channel.topic not in channels:
                schema_id = writer.register_schema(schema.name, schema.encoding, schema.data)
                channels[channel.topic] = writer.register_channel(channel.topic, channel.message_encoding, schema_id)
            if (channel.topic, message.log_time) != ("/scan", 100_000_000):
                writer.add_message(channels[channel.topic], message.log_time, message.data, message.publish_time)
        writer.finish()  # type: ignore[no-untyped-call]
    assert "the step at 0.1 s lacks its scan message" in refused(path)
