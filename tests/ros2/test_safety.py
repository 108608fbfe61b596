"""Whatever goes wrong, the robot stands still within half a second, or carries on where that is safe; and says why.

On a network and a clock of the tests' own, so that half a second is exactly that.
"""

import logging
import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tests.ros2.network import Base, Network, Node
from understudy.errors import RobotError
from understudy.robot import DEADMAN_S, TURTLEBOT, Command, NoJournal, Observation, Scan, control
from understudy.ros2 import RobotDocument, Ros2Robot
from understudy.ros2.deadman import Deadman
from understudy.ros2.transport import Qos

FAST = Command(linear=0.3, angular=0.2)
RELIABLE = Qos(reliable=True, depth=5)


def robot_on(network: Network, document: RobotDocument | None = None) -> Ros2Robot:
    return Ros2Robot(document or RobotDocument(), Node(network, "understudy"), network.clock)


def drive(robot: Ros2Robot, network: Network, until_s: float) -> None:
    """Full speed ahead, until then."""
    control(
        robot,
        lambda observation: FAST if network.clock.time_s < until_s else None,
        NoJournal(),
        period_s=0.1,
    )


def driven_into(fault: Callable[[Base], None], document: RobotDocument | None = None) -> tuple[str, Base, float]:
    """The message with which a drive ended after the fault, the base, and how long after it the robot was stopped."""
    network = Network()
    base = Base(network)
    with robot_on(network, document) as robot:
        robot.connect()
        begun_s = network.clock.time_s
        # A moment after its readings: so it is seen as late as can be.
        network.at(begun_s + 2.01, lambda: fault(base))
        with pytest.raises(RobotError) as raised:
            drive(robot, network, begun_s + 20.0)
        stopped_s = next(time_s for time_s, *speeds in base.told[::-1] if speeds != [0.0, 0.0])
        ended_s = next(time_s for time_s, *_ in base.told if time_s > stopped_s)
    assert base.told[-1][1:] == (0.0, 0.0)
    assert max(linear for _, linear, _ in base.told) == pytest.approx(0.3)
    return str(raised.value), base, ended_s - (begun_s + 2.01)


def carries_on_after(fault: Callable[[Base], None]) -> Base:
    """The base of a drive that went on for ten seconds after it."""
    network = Network()
    base = Base(network)
    with robot_on(network) as robot:
        robot.connect()
        begun_s = network.clock.time_s
        network.at(begun_s + 2.01, lambda: fault(base))
        drive(robot, network, begun_s + 12.0)
    fast = [time_s for time_s, linear, _ in base.told if linear == pytest.approx(0.3)]
    assert fast[-1] - begun_s > 11.5
    return base


def again(base: Base, change: Callable[[Observation], Observation | None]) -> None:
    base.change = change


def frozen_sweep(base: Base) -> None:
    old = Scan(ranges=np.full(360, 2.0, np.float32), angle_min=-np.pi, angle_increment=np.pi / 180)
    again(base, lambda observation: replace(observation, scan=old))


def frozen_message(base: Base) -> None:
    time_s = 1000.0 + 0.1 * base.steps
    again(base, lambda observation: replace(observation, time_s=time_s))


def no_numbers(base: Base) -> None:
    again(base, lambda one: replace(one, scan=replace(one.scan, ranges=np.full(360, np.nan, np.float32))))


def other_shape(base: Base) -> None:
    again(base, lambda observation: replace(observation, image=np.zeros((200, 320, 3), np.uint8)))


def larger(base: Base) -> None:
    again(base, lambda observation: replace(observation, image=np.zeros((480, 640, 3), np.uint8)))


def second_laser(base: Base) -> None:
    Node(base.network, "second").publish("/scan", "sensor_msgs/msg/LaserScan", RELIABLE)


def leap(by_s: float) -> Callable[[Base], None]:
    return lambda base: setattr(base, "stamp_offset_s", by_s)


def without(topic: str) -> Callable[[Base], None]:
    return lambda base: base.left_out.add(topic)


@pytest.mark.parametrize(
    ("fault", "says"),
    [
        (Base.die, "nobody publishes /scan .* start the laser"),
        (without("/scan"), "nothing came on /scan for 0.5 s; check the laser and the connection"),
        (without("/odom"), "nothing came on /odom for 0.[45] s; check the odometry and the connection"),
        (frozen_sweep, "/scan brings the same sweep again and again, while the wheels turn"),
        (frozen_message, "the stamps on /scan stand still, or were set back"),
        (no_numbers, "360 of 360 laser rays are unusable"),
        (other_shape, "the camera's pictures have 320 by 200 pixels, .* camera.width and camera.rows"),
        (second_laser, "2 programs publish /scan, .* stop all but one"),
        (leap(60.0), r"the clock of turtlebot leapt by \+60"),
        (leap(-60.0), r"the clock of turtlebot leapt by -(60|59)"),
        (leap(-0.9), "the stamps on /scan stand still, or were set back"),
        (lambda base: base.press(True), "emergency stop: /emergency_stop is true; make it false"),
    ],
)
def test_it_stops_in_time_and_says_why(fault: Callable[[Base], None], says: str) -> None:
    message, _, after_s = driven_into(fault)
    assert 0.0 <= after_s <= DEADMAN_S
    assert "\n" not in message
    assert re.search(says, message), message


def test_it_stands_still_long_before_it_gives_up() -> None:
    _, base, after_s = driven_into(without("/scan"))
    assert after_s < DEADMAN_S - 0.1
    assert sum(speeds == [0.0, 0.0] for _, *speeds in base.told) > 1


def test_pictures_of_a_multiple_of_the_size_are_reduced() -> None:
    carries_on_after(larger)


def test_without_pictures_it_goes_on_and_says_so_once(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        carries_on_after(without("/camera/image_raw"))
    assert len(caplog.messages) == 1
    assert "goes on without seeing colors" in caplog.messages[0]


def test_a_sweep_that_is_lost_now_and_then_is_no_reason_to_stop() -> None:
    def loses(base: Base) -> None:
        again(base, lambda observation: observation if base.steps % 2 else None)

    base = carries_on_after(loses)
    assert sum(linear == 0.0 for _, linear, _ in base.told) < 3


def test_another_commander_is_named_and_borne(caplog: pytest.LogCaptureFixture) -> None:
    network = Network()
    base = Base(network)
    Node(network, "joystick").publish("/cmd_vel", "geometry_msgs/msg/Twist", RELIABLE)
    with caplog.at_level(logging.WARNING), robot_on(network) as robot:
        robot.connect()
    assert "1 other programs publish /cmd_vel" in caplog.text
    assert base.told[-1][1:] == (0.0, 0.0)


def test_the_emergency_stop_holds_for_good() -> None:
    network = Network()
    base = Base(network)
    with robot_on(network) as robot:
        robot.connect()
        robot.sense()
        robot.emergency_stop("a key was pressed")
        robot.act(FAST)
        robot.wait()
        robot.act(FAST)
        robot.outputs.drive(0.3, 0.0, 0)  # as a decision would that was made at the same moment
        with pytest.raises(RobotError, match="emergency stop: a key was pressed"):
            robot.sense()
    assert base.told
    assert {(linear, angular) for _, linear, angular in base.told} == {(0.0, 0.0)}


def test_nothing_moves_until_something_is_decided() -> None:
    network = Network()
    base = Base(network)
    with robot_on(network) as robot:
        robot.connect()
        for _ in range(20):
            robot.sense()
            robot.wait()
        assert base.told == []
    assert [speeds for _, *speeds in base.told] == [[0.0, 0.0]]


def test_an_exception_stops_the_robot_before_it_is_seen() -> None:
    network = Network()
    base = Base(network)

    def decide(observation: Observation) -> Command:
        if len(base.told) < 20:
            return FAST
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError), robot_on(network) as robot:
        control(robot, decide, NoJournal(), period_s=0.1)
    assert base.told[-1][1:] == (0.0, 0.0)
    assert robot.outputs.speeds == (0.0, 0.0)


def test_a_program_that_hangs_is_noticed_once_per_hang() -> None:
    network = Network()
    stops: list[float] = []
    watch = Deadman(0.4, network.clock, lambda: stops.append(network.clock.time_s))
    watch.close()  # its thread; the test looks itself
    watch.look()
    watch.alive()
    for _ in range(10):
        network.clock.time_s += 0.1
        watch.look()
    assert stops == [pytest.approx(100.5)]
    watch.alive()
    network.clock.time_s += 0.3
    watch.look()
    watch.rest()
    network.clock.time_s += 9.0
    watch.look()
    assert len(stops) == 1


def test_speeds_change_no_faster_than_the_robot_may() -> None:
    network = Network()
    base = Base(network)
    wild = [Command(linear=9.0, angular=-9.0), Command(linear=-9.0, angular=9.0)]
    with robot_on(network) as robot:
        control(
            robot,
            lambda observation: wild[len(base.told) // 15 % 2] if len(base.told) < 60 else None,
            NoJournal(),
            period_s=0.1,
        )
    moving = [(linear, angular) for _, linear, angular in base.told[:60]]
    assert max(linear for linear, _ in moving) == pytest.approx(TURTLEBOT.max_linear)
    assert min(linear for linear, _ in moving) == pytest.approx(-TURTLEBOT.max_linear)
    assert max(abs(angular) for _, angular in moving) == pytest.approx(TURTLEBOT.max_angular)
    for (before, turning), (after, turned) in zip([(0.0, 0.0), *moving], moving, strict=False):
        assert abs(after - before) <= TURTLEBOT.max_linear_acceleration * 0.1 + 1e-6
        assert abs(turned - turning) <= TURTLEBOT.max_angular_acceleration * 0.1 + 1e-6
