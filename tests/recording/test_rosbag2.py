"""Rosbag2 folders of either storage: written from a recording, and read as any other bag."""

import math
from pathlib import Path
from typing import Literal

import numpy as np
import pytest
from rosbags.rosbag2 import Reader, StoragePlugin, Writer

from tests.recording.support import STORE, drive, laser, odometry, record
from understudy.errors import RecordingError
from understudy.recording import Recorder, TopicMap, export_bag, read_recording
from understudy.robot import PIONEER, Command

Storage = Literal["sqlite3", "mcap"]
STORAGES: tuple[Storage, ...] = ("sqlite3", "mcap")
PLUGINS = {"sqlite3": StoragePlugin.SQLITE3, "mcap": StoragePlugin.MCAP}


@pytest.mark.parametrize("storage", STORAGES)
def test_an_exported_recording_says_the_same(storage: Storage, tmp_path: Path) -> None:
    observations = drive(20)
    commands = [(0.3, Command(linear=0.25, paddles="open")), (0.5, Command(angular=-1.0))]
    with Recorder(tmp_path / "drive.mcap", kind="run", name="drive", spec=PIONEER) as into:
        for one in observations:
            into.observation(one)
            for time_s, command in commands:
                if time_s == one.time_s:
                    into.command(time_s, command)
    count = export_bag(tmp_path / "drive.mcap", tmp_path / "bag", storage=storage)
    with Reader(tmp_path / "bag") as reader:
        assert reader.message_count == count
        assert all(not one.msgtype.startswith("understudy") for one in reader.connections)
    bag = read_recording(tmp_path / "bag")
    assert (bag.info.kind, bag.info.exact, bag.info.complete) == ("bag", False, True)
    read = list(bag.observations())
    assert [one.time_s for one in read] == pytest.approx([one.time_s for one in observations])
    for before, after in zip(observations, read, strict=True):
        assert np.array_equal(before.scan.ranges, after.scan.ranges)
        assert (before.image is None) == (after.image is None)
        assert after.odometry.pose.x == pytest.approx(before.odometry.pose.x)
        assert before.cues == after.cues
    assert [command.linear for _, command in bag.commands()][-2:] == [0.25, 0.0]


@pytest.mark.parametrize("storage", STORAGES)
def test_a_robots_bag_with_other_names(storage: Storage, tmp_path: Path) -> None:
    with Writer(tmp_path / "bag", version=9, storage_plugin=PLUGINS[storage]) as writer:
        scans = writer.add_connection("/lidar", "sensor_msgs/msg/LaserScan", typestore=STORE)
        odoms = writer.add_connection("/wheels", "nav_msgs/msg/Odometry", typestore=STORE)
        for step in range(20):
            time_s = 1000.0 + step / 10
            data = STORE.serialize_cdr(odometry(time_s, step / 100, 0.1), "nav_msgs/msg/Odometry")
            writer.write(odoms, int(time_s * 1e9), data)
            data = STORE.serialize_cdr(laser(time_s, [0.0, 2.0, 3.0, 4.0, 5.0, 6.0]), "sensor_msgs/msg/LaserScan")
            writer.write(scans, int(time_s * 1e9), data)
    with pytest.raises(RecordingError, match=r'has no topic /scan .*TopicMap\(scan="/lidar"\)'):
        read_recording(tmp_path / "bag")
    seen = list(read_recording(tmp_path / "bag", topics=TopicMap(scan="/lidar", odom="/wheels")).observations())
    assert len(seen) == 20
    assert math.isnan(seen[0].scan.ranges[0])
    free = TopicMap(scan="/lidar", odom="/wheels", zero_is_free=True)
    assert math.isinf(next(read_recording(tmp_path / "bag", topics=free).observations()).scan.ranges[0])


def test_the_sqlite_file_of_a_folder_that_was_broken_off(tmp_path: Path) -> None:
    record(tmp_path / "drive.mcap", drive(5))
    export_bag(tmp_path / "drive.mcap", tmp_path / "bag")
    (tmp_path / "bag" / "metadata.yaml").unlink()
    (file,) = (tmp_path / "bag").glob("*.db3")
    assert len(list(read_recording(file).observations())) == 5
    with pytest.raises(RecordingError, match=r"is a folder without the metadata\.yaml of a rosbag2"):
        read_recording(tmp_path / "bag")


def test_broken_bags_are_refused_in_one_line(tmp_path: Path) -> None:
    record(tmp_path / "drive.mcap", drive(5))
    export_bag(tmp_path / "drive.mcap", tmp_path / "bag")
    with pytest.raises(RecordingError, match="name a folder that does not exist yet"):
        export_bag(tmp_path / "drive.mcap", tmp_path / "bag")
    (tmp_path / "bag" / "metadata.yaml").write_text("rosbag2_bagfile_information: {version: 99}", encoding="utf-8")
    with pytest.raises(RecordingError, match="ros2 bag reindex") as raised:
        read_recording(tmp_path / "bag")
    assert "\n" not in str(raised.value)


def test_a_rosbag2_has_no_attachments(tmp_path: Path) -> None:
    record(tmp_path / "drive.mcap", drive(5))
    export_bag(tmp_path / "drive.mcap", tmp_path / "bag", storage="mcap")
    recording = read_recording(tmp_path / "bag")
    assert list(recording.events()) == []
    with pytest.raises(RecordingError, match=r"has no attachment 'task.yaml'; a rosbag2 has none"):
        recording.attachment("task.yaml")
