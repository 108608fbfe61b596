"""Our files in other programs' hands: rosbags' own reader, with nothing but the definitions in the file."""

import math
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from rosbags.highlevel import AnyReader
from scipy.spatial.transform import Rotation

from tests.recording.support import drive, record
from understudy.recording import Recorder
from understudy.robot import PIONEER, Command


def test_rosbags_reads_every_topic_by_the_definitions_in_the_file(tmp_path: Path) -> None:
    live = drive(12)
    path = tmp_path / "a.mcap"
    with Recorder(path, kind="run", name="a", spec=PIONEER) as into:
        for obs in live:
            into.observation(obs)
        into.command(1.2, Command(linear=0.25, angular=-0.5, paddles="close", lift="up"))
        into.event({"time_s": 1.2, "kind": "done"})
    by_topic: dict[str, list[Any]] = {}
    with AnyReader([path]) as reader:
        types = {connection.topic: connection.msgtype for connection in reader.connections}
        for connection, time_ns, raw in reader.messages():
            by_topic.setdefault(connection.topic, []).append(reader.deserialize(raw, connection.msgtype))
            assert time_ns <= 1_200_000_000
    assert types == {
        "/scan": "sensor_msgs/msg/LaserScan",
        "/sonar": "sensor_msgs/msg/PointCloud2",
        "/odom": "nav_msgs/msg/Odometry",
        "/camera/image_raw/compressed": "sensor_msgs/msg/CompressedImage",
        "/joint_states": "sensor_msgs/msg/JointState",
        "/gripper/beam": "std_msgs/msg/Bool",
        "/gripper/command": "std_msgs/msg/String",
        "/tf": "tf2_msgs/msg/TFMessage",
        "/tf_static": "tf2_msgs/msg/TFMessage",
        "/cues": "std_msgs/msg/String",
        "/cmd_vel": "geometry_msgs/msg/Twist",
        "/understudy/observation": "understudy_msgs/msg/Observation",
        "/understudy/command": "understudy_msgs/msg/Command",
        "/understudy/events": "std_msgs/msg/String",
    }
    assert {
        topic: len(messages)
        for topic, messages in by_topic.items()
        if topic in ("/scan", "/cmd_vel", "/tf", "/tf_static")
    } == {
        "/scan": 12,
        "/cmd_vel": 1,
        "/tf": 12,
        "/tf_static": 1,
    }
    scan, odom, image = by_topic["/scan"][3], by_topic["/odom"][3], by_topic["/camera/image_raw/compressed"][1]
    assert (scan.header.stamp.sec, scan.header.stamp.nanosec) == (0, 300_000_000)
    assert np.array_equal(scan.ranges, live[3].scan.ranges)
    assert scan.angle_max == pytest.approx(math.pi / 2)
    assert math.sin(2 * math.atan2(odom.pose.pose.orientation.z, odom.pose.pose.orientation.w)) == pytest.approx(
        math.sin(live[3].odometry.pose.heading)
    )
    assert odom.child_frame_id == "base_link"
    assert image.format == "rgb8; png compressed bgr8"
    seen = cv2.imdecode(image.data, cv2.IMREAD_COLOR)
    assert seen is not None
    assert live[2].image is not None
    assert np.array_equal(seen[..., ::-1], live[2].image)
    states = by_topic["/joint_states"][0]
    assert states.name == ["gripper_finger_joint", "gripper_lift_joint"]
    assert states.position.tolist() == pytest.approx([0.4 * 0.20, 0.0])
    assert by_topic["/gripper/command"][0].data == "close up"
    assert by_topic["/cmd_vel"][0].angular.z == -0.5
    assert by_topic["/understudy/observation"][3].heading == live[3].odometry.pose.heading


def test_transforms_place_the_robot_its_laser_and_its_camera(tmp_path: Path) -> None:
    live = drive(4)
    found: dict[str, list[Any]] = {"/tf": [], "/tf_static": []}
    with AnyReader([record(tmp_path / "a.mcap", live)]) as reader:
        for connection, _, raw in reader.messages([c for c in reader.connections if c.topic in found]):
            found[connection.topic] += reader.deserialize(raw, connection.msgtype).transforms
    for obs, moved in zip(live, found["/tf"], strict=True):
        assert (moved.header.frame_id, moved.child_frame_id) == ("odom", "base_link")
        assert moved.header.stamp.sec + moved.header.stamp.nanosec / 1e9 == pytest.approx(obs.time_s)
        place, pose = moved.transform.translation, obs.odometry.pose
        assert (place.x, place.y, place.z) == (pose.x, pose.y, 0.0)
        heading = rotation(moved).as_euler("xyz")
        assert heading.tolist() == pytest.approx([0.0, 0.0, math.remainder(pose.heading, math.tau)])
    laser, camera = found["/tf_static"]
    assert [(one.header.frame_id, one.child_frame_id) for one in (laser, camera)] == [
        ("base_link", "laser"),
        ("base_link", "camera"),
    ]
    place = laser.transform.translation
    assert (place.x, place.y, place.z) == (PIONEER.laser.x, 0.0, PIONEER.laser.height)
    assert rotation(laser).magnitude() == 0.0
    place = camera.transform.translation
    assert (place.x, place.y, place.z) == (PIONEER.camera.x, 0.0, PIONEER.camera.height)
    # An image's frame: z looks into the picture, x to its right, y down in it.
    tilt = PIONEER.camera.tilt
    assert rotation(camera).apply([0, 0, 1]).tolist() == pytest.approx([math.cos(tilt), 0, -math.sin(tilt)])
    assert rotation(camera).apply([1, 0, 0]).tolist() == pytest.approx([0, -1, 0])


def rotation(transform: Any) -> Rotation:
    turned = transform.transform.rotation
    return Rotation.from_quat([turned.x, turned.y, turned.z, turned.w])


def test_sonar_points_lie_where_the_sonars_heard_something(tmp_path: Path) -> None:
    (obs,) = drive(1)
    obs.sonar[5] = np.inf
    with AnyReader([record(tmp_path / "a.mcap", [obs])]) as reader:
        (connection,) = [c for c in reader.connections if c.topic == "/sonar"]
        _, _, raw = next(reader.messages([connection]))
        cloud: Any = reader.deserialize(raw, connection.msgtype)
    points = cloud.data.view("<f4").reshape(-1, 4)
    assert np.isnan(points[5, :2]).all()
    assert points[5, 3] == np.inf
    front_left, reach = PIONEER.sonar_poses[0], obs.sonar[0]  # it looks to the left
    assert points[0].tolist() == pytest.approx(
        [front_left.x, front_left.y + reach, PIONEER.sonar_height, reach], abs=1e-6
    )
