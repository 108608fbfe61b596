"""Before a robot is used: what it publishes and listens for is found out, and what is wrong said with the mend."""

from dataclasses import replace

import numpy as np
import pytest

from tests.ros2.network import TWIST, Base, Network, Node
from understudy.errors import MissingExtraError, RobotError
from understudy.recording import decode_message
from understudy.robot import PIONEER, Command, Cue
from understudy.ros2 import RobotDocument, Ros2Robot, find_robot, open_transport
from understudy.ros2.transport import COMMANDS, Qos

STAMPED = "geometry_msgs/msg/TwistStamped"


def connect(base: Base, **keys: object) -> Ros2Robot:
    robot = Ros2Robot(RobotDocument.model_validate(keys), Node(base.network, "understudy"), base.network.clock)
    try:
        robot.connect(timeout_s=3.0)
    finally:
        robot.close()
    return robot


def refused(base: Base, **keys: object) -> str:
    with pytest.raises(RobotError) as raised:
        connect(base, **keys)
    message = str(raised.value)
    assert "\n" not in message
    return message


def test_a_robot_that_is_not_there() -> None:
    network = Network()
    with pytest.raises(RobotError, match=r"nobody publishes /camera.*and 3 more: understudy doctor --robot"):
        Ros2Robot(RobotDocument(), Node(network, "understudy"), network.clock).connect(timeout_s=1.0)


def test_a_missing_topic() -> None:
    base = Base(Network())
    assert "nobody publishes /lidar (sensor_msgs/msg/LaserScan)" in refused(base, laser={"topic": "/lidar"})


def test_a_topic_of_another_type() -> None:
    base = Base(Network(), types={"/odom": "geometry_msgs/msg/PoseStamped"})
    message = refused(base)
    assert message.startswith("/odom carries geometry_msgs/msg/PoseStamped, and the odometry must be nav_msgs/msg/Odom")
    assert message.endswith("name another topic as odometry.topic in the robot document")


def test_a_quality_of_service_that_does_not_match() -> None:
    base = Base(Network())
    message = refused(base, laser={"reliability": "reliable"})
    assert "/scan is published with best effort, and asked for reliably" in message
    assert "put `reliability: best_effort` beside laser.topic" in message
    connect(base)


@pytest.mark.parametrize("offered", [COMMANDS, Qos(reliable=False, depth=1)])
def test_best_effort_takes_what_anybody_sends(offered: Qos) -> None:
    connect(Base(Network(), qos={"/scan": offered, "/odom": offered}))


def test_nobody_listens() -> None:
    base = Base(Network())
    assert "nobody listens to /base/cmd_vel (geometry_msgs/msg/Twist or" in refused(
        base, drive={"topic": "/base/cmd_vel"}
    )


@pytest.mark.parametrize("type_name", [TWIST, STAMPED])
def test_the_type_of_the_speeds_is_found_out(type_name: str) -> None:
    network = Network()
    base = Base(network, speeds=type_name)
    with Ros2Robot(RobotDocument(), Node(network, "understudy"), network.clock) as robot:
        robot.connect()
        robot.sense()
        robot.act(Command(linear=0.05))
    first, last = base.reader.take()[0], base.reader.take()
    message = decode_message(first, type_name, where="/cmd_vel")
    twist = getattr(message, "twist", message)
    assert twist.linear.x == pytest.approx(0.05)
    if type_name == STAMPED:
        assert message.header.stamp.sec >= 1000  # type: ignore[attr-defined]  # the robot's clock, not ours
    assert last == []


def test_compressed_pictures_are_taken_where_there_are_no_raw_ones() -> None:
    network = Network()
    base = Base(network, compressed=True)
    base.change = lambda one: replace(one, image=np.full((120, 160, 3), (10, 200, 30), np.uint8))
    with Ros2Robot(RobotDocument(), Node(network, "understudy"), network.clock) as robot:
        robot.connect()
        robot.sense()
        robot.wait()
        image = robot.sense().image
    assert image is not None
    assert image[60, 80].tolist() == [10, 200, 30]
    raw = {"camera": {"message": "raw"}}
    assert "nobody publishes /camera/image_raw (sensor_msgs/msg/Image)" in refused(
        Base(Network(), compressed=True), **raw
    )


def test_a_stated_type_is_insisted_on() -> None:
    base = Base(Network(), speeds=STAMPED)
    message = refused(base, drive={"message": "Twist"})
    assert f"/cmd_vel is listened to as {STAMPED}, and we publish {TWIST}" in message


def test_both_types_at_once_are_for_a_person_to_decide() -> None:
    base = Base(Network())
    Node(base.network, "second").subscribe("/cmd_vel", STAMPED, COMMANDS)
    assert "say in the robot document which the robot's base takes" in refused(base)
    connect(base, drive={"message": "Twist"})


def test_a_robot_that_comes_late_is_waited_for() -> None:
    network = Network()
    network.at(102.0, lambda: Base(network) and None)
    with Ros2Robot(RobotDocument(), Node(network, "understudy"), network.clock) as robot:
        robot.connect(timeout_s=5.0)
        assert robot.sense().scan.ranges.size == 360


def test_a_gripper_is_heard_and_told_what_is_new_to_it() -> None:
    network = Network()
    base = Base(network, PIONEER)
    document = RobotDocument.model_validate({"gripper": {}})
    with Ros2Robot(document, Node(network, "understudy"), network.clock) as robot:
        robot.connect()
        gripper = robot.sense().gripper
        for _ in range(3):
            robot.act(Command(paddles="open", lift="down"))
        robot.act(Command(paddles="close"))
    assert gripper is not None
    assert gripper.aperture == pytest.approx(0.5)
    told = [decode_message(data, "std_msgs/msg/String", where="gripper") for data in base.gripper.take()]
    assert [message.data for message in told] == ["open down", "close"]  # type: ignore[attr-defined]


def test_a_gripper_that_is_not_there() -> None:
    assert "nobody publishes /joint_states" in refused(Base(Network()), gripper={})


def test_words_come_once_from_the_topic_and_the_keyboard() -> None:
    network = Network()
    base = Base(network)
    with Ros2Robot(RobotDocument(), Node(network, "understudy"), network.clock) as robot:
        robot.connect()
        base.say("/cues", "here")
        base.say("/cues", "louder")
        robot.wait()
        robot.hear(Cue.DONE)
        robot.wait()
        heard = [robot.sense().cues, robot.sense().cues]
    assert heard == [(Cue.HERE, Cue.DONE), ()]


def test_two_transports_and_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"pip install 'understudy\[ros2\]'"):
        open_transport()
    with pytest.raises(MissingExtraError, match="source ROS 2"):
        open_transport("rclpy")


def test_bundled_robots_are_what_they_say() -> None:
    pioneer = find_robot("pioneer").spec
    assert pioneer.gripper == PIONEER.gripper
    assert pioneer.camera.field == pytest.approx(PIONEER.camera.field)
    assert find_robot("turtlebot").spec.gripper is None
