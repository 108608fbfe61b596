"""A robot offered to ROS 2: what it is told it does, and without a command it stands still."""

from dataclasses import replace

import numpy as np
import pytest
from rosbags.typesys.stores import ros2_humble as ros

from tests.ros2.network import TWIST, FakeClock, Network, Node
from understudy.recording import decode_message, encode_message, twist_of
from understudy.robot import PIONEER, STOP, Command, Cue, GripperReading, Observation, RobotSpec, Scan
from understudy.ros2 import Served, TimeKeeping
from understudy.ros2.transport import COMMANDS, SENSORS, Publication

STRING = "std_msgs/msg/String"


class Obedient:
    """A robot that notes what it is told, and when; it hears HERE with its third observation."""

    def __init__(self, clock: FakeClock) -> None:
        self.clock = clock
        self.told: list[tuple[float, Command]] = []
        self.stopped = False

    @property
    def spec(self) -> RobotSpec:
        return PIONEER

    def sense(self) -> Observation:
        return Observation(
            time_s=0.1 * len(self.told),
            scan=Scan(ranges=np.ones(181, np.float32)),
            gripper=GripperReading(),
            image=np.zeros((12, 16, 3), np.uint8),
            cues=(Cue.HERE,) if len(self.told) == 2 else (),
        )

    def act(self, command: Command) -> None:
        self.told.append((self.clock.now(), command))

    def wait(self) -> None:
        pass

    def stop(self) -> None:
        self.stopped = True


def offered(network: Network, time: TimeKeeping) -> tuple[Obedient, Served]:
    robot = Obedient(network.clock)
    return robot, Served(robot, Node(network, "server"), time=time, clock=network.clock)


def speeds(writer: Publication, linear: float) -> None:
    writer.publish(encode_message(twist_of(linear, 0.0), TWIST))


def listen(node: Node) -> None:
    node.subscribe("/scan", "sensor_msgs/msg/LaserScan", SENSORS)


def test_it_does_what_it_is_told_until_nobody_tells_it() -> None:
    network = Network()
    robot, served = offered(network, "wall")
    pilot = Node(network, "pilot")
    wheels, hand = pilot.publish("/cmd_vel", TWIST, COMMANDS), pilot.publish("/gripper/command", STRING, COMMANDS)
    begun_s = network.clock.now()
    words = encode_message(ros.std_msgs__msg__String(data="open down"), STRING)
    network.at(begun_s + 0.55, lambda: hand.publish(words))
    network.at(begun_s + 0.55, lambda: speeds(wheels, 0.3))
    served.run(until=lambda: network.clock.now() >= begun_s + 2.0)
    moving = [time_s for time_s, command in robot.told if command.linear]
    assert moving[0] == pytest.approx(begun_s + 0.6)
    assert begun_s + 0.9 < moving[-1] <= begun_s + 0.55 + 0.5 + 0.1
    assert all(command.paddles == "open" and command.lift == "down" for time_s, command in robot.told[8:])
    assert robot.told[0][1] == STOP
    assert robot.stopped
    steps = np.diff([time_s for time_s, _ in robot.told])
    assert steps == pytest.approx(0.1)


def test_in_lockstep_every_command_is_one_step_and_every_word_is_said_once() -> None:
    network = Network()
    robot, served = offered(network, "lockstep")
    pilot = Node(network, "pilot")
    heard = pilot.subscribe("/cues", STRING, replace(COMMANDS, depth=100))
    wheels = pilot.publish("/cmd_vel", TWIST, COMMANDS)
    begun_s = network.clock.now()

    def told_so_far() -> bool:
        return len(robot.told) >= 4

    network.at(begun_s + 1.0, lambda: listen(pilot))
    for number in range(4):  # so late that the readings are published again in between
        network.at(begun_s + 3.0 + 2.0 * number, lambda number=number: speeds(wheels, 0.1 * number))
    served.run(until=told_so_far)
    assert [round(command.linear, 3) for _, command in robot.told] == [0.0, 0.1, 0.2, 0.3]
    assert len(network.sent["/scan"]) > 8
    words = [decode_message(data, STRING, where="/cues") for data in heard.take()]
    assert [word.data for word in words] == ["HERE"]  # type: ignore[attr-defined]
    pilot.close()
    assert served.deserted


def test_stamps_begin_where_they_are_told_to() -> None:
    network = Network()
    Served(Obedient(network.clock), Node(network, "server"), clock=network.clock, epoch_s=1_700_000_000.0)
    scan = decode_message(network.sent["/scan"][0][1], "sensor_msgs/msg/LaserScan", where="/scan")
    assert scan.header.stamp.sec == 1_700_000_000  # type: ignore[attr-defined]
    assert "/clock" not in network.sent
    offered(network, "sim")
    assert "/clock" in network.sent
