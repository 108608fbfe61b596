"""What is recorded comes back equal, bit for bit."""

import math
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.highlevel import AnyReader

from tests.recording.support import bits, drive, observations, record
from understudy.errors import RecordingError
from understudy.geometry import Pose
from understudy.recording import Recorder, read_recording
from understudy.robot import PIONEER, Command, Cue, Observation, Odometry, Scan

commands = st.builds(
    Command,
    linear=st.floats(allow_nan=False),
    angular=st.floats(allow_nan=False),
    paddles=st.sampled_from([None, "open", "close"]),
    lift=st.sampled_from([None, "up", "down"]),
)


@settings(deadline=None, max_examples=60)
@given(st.lists(observations, min_size=1, max_size=5))
def test_observations_come_back_bit_for_bit(live: list[Observation]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        recording = read_recording(record(Path(folder) / "a.mcap", live))
        assert [bits(obs) for obs in recording.observations()] == [bits(obs) for obs in live]
        assert recording.info.complete
        assert recording.info.exact


@settings(deadline=None, max_examples=30)
@given(st.lists(st.tuples(st.floats(0, 2**31, exclude_max=True), commands), min_size=1, max_size=5))
def test_commands_come_back_with_their_exact_times(given_commands: list[tuple[float, Command]]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.mcap"
        with Recorder(path, kind="run", name="a", spec=PIONEER) as into:
            into.observation(drive(1)[0])
            for time_s, command in given_commands:
                into.command(time_s, command)
        assert list(read_recording(path).commands()) == given_commands


def test_the_gripper_is_told_only_what_is_new_to_it(tmp_path: Path) -> None:
    close = Command(paddles="close", lift="up")
    given_commands = [
        Command(linear=0.1),
        close,
        close,
        Command(linear=0.2),
        Command(paddles="close"),
        Command(lift="down"),
        close,
        Command(paddles="open"),
        Command(paddles="open", lift="up"),
    ]
    with Recorder(tmp_path / "a.mcap", kind="run", name="a", spec=PIONEER) as into:
        into.observation(drive(1)[0])
        for step, command in enumerate(given_commands):
            into.command(step / 10, command)
    with AnyReader([tmp_path / "a.mcap"]) as reader:
        connections = [connection for connection in reader.connections if connection.topic == "/gripper/command"]
        told = [
            (time_ns / 1e9, reader.deserialize(raw, connection.msgtype).data)
            for connection, time_ns, raw in reader.messages(connections)
        ]
    assert told == [(0.1, "close up"), (0.5, "down"), (0.6, "close up"), (0.7, "open")]
    assert [command for _, command in read_recording(tmp_path / "a.mcap").commands()] == given_commands


def test_a_command_that_could_not_be_recorded_does_not_count_as_told(tmp_path: Path) -> None:
    with Recorder(tmp_path / "a.mcap", kind="run", name="a", spec=PIONEER) as into:
        into.observation(drive(1)[0])
        with pytest.raises(RecordingError, match="t=-1 s cannot be recorded"):
            into.command(-1, Command(paddles="open"))
        with pytest.raises(Exception, match="float"):
            into.command(0.0, Command(linear="fast", paddles="open"))  # type: ignore[arg-type]
        into.command(0.1, Command(paddles="open"))
    assert read_recording(tmp_path / "a.mcap").info.topics["/gripper/command"].count == 1


def test_a_real_drive_with_a_camera_comes_back(tmp_path: Path) -> None:
    live = drive(60)
    recording = read_recording(record(tmp_path / "a.mcap", live))
    assert [bits(obs) for obs in recording.observations()] == [bits(obs) for obs in live]
    # A second walk begins anew.
    assert sum(1 for _ in recording.observations()) == 60


def test_a_heading_that_a_quaternion_would_change_comes_back(tmp_path: Path) -> None:
    def through_a_quaternion(heading: float) -> float:
        z, w = math.sin(heading / 2), math.cos(heading / 2)
        return math.atan2(2 * w * z, 1 - 2 * z * z)

    heading = next(heading for heading in np.linspace(0.1, 3, 100).tolist() if through_a_quaternion(heading) != heading)
    obs = Observation(
        time_s=1 / 3, scan=Scan(ranges=np.ones(3, np.float32)), odometry=Odometry(pose=Pose(0.1, 0.2, heading))
    )
    (back,) = read_recording(record(tmp_path / "a.mcap", [obs])).observations()
    assert back.odometry.pose.heading == heading
    assert back.time_s == 1 / 3


def test_arrays_can_be_written_to_and_keep_nothing_of_the_file(tmp_path: Path) -> None:
    (back,) = read_recording(record(tmp_path / "a.mcap", drive(1))).observations()
    for array in (back.scan.ranges, back.sonar, back.image):
        assert array is not None
        assert array.flags.writeable
        array[...] = 0


def test_without_images_everything_else_is_the_same(tmp_path: Path) -> None:
    live = drive(5)
    back = list(read_recording(record(tmp_path / "a.mcap", live)).observations(images=False))
    assert [obs.image for obs in back] == [None] * 5
    assert [obs.scan.ranges.tobytes() for obs in back] == [obs.scan.ranges.tobytes() for obs in live]


def test_cues_come_at_their_observation_and_in_their_order(tmp_path: Path) -> None:
    words = (Cue.HERE, Cue.TAKE, Cue.HERE)
    live = [
        Observation(time_s=t, scan=drive(1)[0].scan, cues=c) for t, c in ((0.0, ()), (0.1, words), (0.2, (Cue.DONE,)))
    ]
    recording = read_recording(record(tmp_path / "a.mcap", live))
    assert [obs.cues for obs in recording.observations()] == [(), words, (Cue.DONE,)]
    assert list(recording.cues()) == [(0.1, Cue.HERE), (0.1, Cue.TAKE), (0.1, Cue.HERE), (0.2, Cue.DONE)]


def test_events_come_back_in_their_order(tmp_path: Path) -> None:
    events = [
        {"time_s": 0.1, "kind": "activated", "component": "track-green-1", "levels": [0.1, math.inf]},
        {"time_s": 0.1, "kind": "finished", "nested": {"a": None, "b": True, "c": "später"}},
    ]
    with Recorder(tmp_path / "a.mcap", kind="run", name="a", spec=PIONEER) as into:
        into.observation(drive(1)[0])
        for event in events:
            into.event(event)
        into.event({"time_s": 0.2, "kind": "numpy", "level": np.float32(0.5), "many": np.arange(3)})
    back = list(read_recording(tmp_path / "a.mcap").events())
    assert back[:2] == events
    assert back[2] == {"time_s": 0.2, "kind": "numpy", "level": 0.5, "many": [0, 1, 2]}


def test_the_recording_describes_itself(tmp_path: Path) -> None:
    metadata, documents = (
        {"seed": "7", "world": "targets: []\n"},
        {"world.yaml": b"a: 1\n", "noise.bin": bytes(range(256))},
    )
    with Recorder(
        tmp_path / "a.mcap", kind="run", name="deliver", spec=PIONEER, metadata=metadata, attachments=documents
    ) as into:
        for obs in drive(21):
            into.observation(obs)
    recording = read_recording(tmp_path / "a.mcap")
    info = recording.info
    assert (info.kind, info.name, info.robot, info.complete) == ("run", "deliver", "pioneer", True)
    assert info.duration_s == pytest.approx(2.0)
    assert info.metadata["seed"] == "7"
    assert info.metadata["world"] == "targets: []\n"
    assert info.metadata["format"] == "1"
    assert info.topics["/scan"].count == 21
    assert info.attachments == ("world.yaml", "noise.bin")
    assert {name: recording.attachment(name) for name in info.attachments} == documents
    with pytest.raises(RecordingError, match=r"no attachment 'task.yaml'; it has: world.yaml, noise.bin"):
        recording.attachment("task.yaml")


def test_the_same_run_makes_the_same_file(tmp_path: Path) -> None:
    files = [record(tmp_path / name, drive(25)) for name in ("a.mcap", "b.mcap")]
    assert files[0].read_bytes() == files[1].read_bytes()
