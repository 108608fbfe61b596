"""The other side: a robot of this program, such as a simulated one, offered to a ROS 2 network.

It has the topics of the bundled document ``pioneer``. Whoever commands it is treated as a base treats its commander:
without a command for half a second, the robot stands still.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Final, Literal, cast

from rosbags.typesys.stores import ros2_humble as ros

from understudy.clock import CONTROL_PERIOD_S, Clock, WallClock
from understudy.recording import (
    DEFAULT_TOPICS,
    ROLE_TYPES,
    ObservationEncoder,
    TopicMessage,
    decode_message,
    encode_message,
    posture_of,
    speeds_of,
    stamp_of,
    string_message,
)
from understudy.robot import DEADMAN_S, STOP, Observation, Robot
from understudy.ros2.transport import COMMANDS, LATCHED, SENSORS, Publication, Transport

__all__ = ["Served", "TimeKeeping"]

TimeKeeping = Literal["wall", "sim", "lockstep"]
"""By which time a served robot lives: as fast as the wall clock, with its stamps or with its own from ``/clock``; or a
step for each command, however long that takes."""

_BEGIN_S: Final = 1.0
"""Stamps begin here: one of 0 means that there is none."""

_AGAIN_S: Final = 0.5
"""In lockstep, readings that nobody answered are published again."""

_CLOCK: Final = TopicMessage("/clock", "rosgraph_msgs/msg/Clock", None)
_EACH_ONCE: Final = (DEFAULT_TOPICS.cues, "/tf_static")


class Served:
    """A robot in a ROS 2 network.

    Args:
        robot: is sensed and commanded here, and nowhere else.
        transport: the network.
        time: by which it lives.
        stamped: it takes its speeds as ``TwistStamped``.
        clock: of the wall.
        epoch_s: what the wall clock's stamps begin with, seconds since 1970.
    """

    def __init__(
        self,
        robot: Robot,
        transport: Transport,
        *,
        time: TimeKeeping = "wall",
        stamped: bool = False,
        clock: Clock | None = None,
        epoch_s: float = _BEGIN_S,
    ) -> None:
        self._robot, self._transport, self._time = robot, transport, time
        self._clock = clock or WallClock()
        self._begin_s = epoch_s if time == "wall" else _BEGIN_S
        self._encoder = ObservationEncoder(robot.spec, live=True)
        self._publications: dict[str, Publication] = {}
        spoken = [("cmd_vel", "TwistStamped" if stamped else "Twist")]
        if robot.spec.gripper is not None:
            spoken.append(("gripper_command", "String"))
        self._listening = [
            (topic, type_name, transport.subscribe(topic, type_name, COMMANDS))
            for role, short in spoken
            for topic in DEFAULT_TOPICS.candidates(role)
            for type_name in ROLE_TYPES[role]
            if type_name.endswith(f"/{short}")
        ]
        self._command, self._told_s = STOP, self._clock.now()
        self._commanded = False
        # All of them from the beginning: who listens to a topic that comes later misses its first message.
        self._publication(string_message(DEFAULT_TOPICS.cues or "", ""))
        self._publish(self._messages(robot.sense()))

    def run(self, until: Callable[[], bool] = lambda: False) -> None:
        """Serves until it is told to end; the robot is stopped then.

        Args:
            until: is asked before each control period.
        """
        step = self._answered_step if self._time == "lockstep" else self._timed_step
        due_s = self._clock.now()
        try:
            while not until():
                due_s = step(due_s, until)
        finally:
            self._robot.stop()

    @property
    def deserted(self) -> bool:
        """Whether somebody commanded the robot, and nobody listens to it any more."""
        return self._commanded and not self._awaited()

    def _timed_step(self, due_s: float, until: Callable[[], bool]) -> float:
        self._publish(self._messages(self._robot.sense()))
        due_s = max(due_s + CONTROL_PERIOD_S, self._clock.now())
        while (left_s := due_s - self._clock.now()) > 0.0:
            self._transport.wait(left_s)
            self._listen()
        if self._clock.now() - self._told_s > DEADMAN_S:
            self._command = replace(self._command, linear=0.0, angular=0.0)
        self._robot.act(self._command)
        self._robot.wait()
        return due_s

    def _answered_step(self, due_s: float, until: Callable[[], bool]) -> float:
        """One step of the robot's time: readings out, a command in."""
        messages = list(self._messages(self._robot.sense()))
        if not self._awaited():
            self._transport.wait(CONTROL_PERIOD_S)
            self._listen()  # whatever comes before it is listened to is no answer
            return due_s
        self._publish(messages)
        published_s = self._clock.now()
        while not self._listen():
            if until() or not self._awaited():
                return due_s
            if self._clock.now() - published_s > _AGAIN_S:
                published_s = self._clock.now()
                self._publish(message for message in messages if message.topic not in _EACH_ONCE)
            self._transport.wait(_AGAIN_S)
        self._robot.act(self._command)
        self._robot.wait()
        return due_s

    def _awaited(self) -> bool:
        """Whether somebody listens to the robot."""
        return bool(self._transport.subscribers(DEFAULT_TOPICS.scan))

    def _listen(self) -> bool:
        """Takes in what the robot is told; whether speeds were among it."""
        told = False
        for topic, type_name, subscription in self._listening:
            for data in subscription.take():
                message = decode_message(data, type_name, where=topic)
                if topic == DEFAULT_TOPICS.gripper_command:
                    words = cast(ros.std_msgs__msg__String, message)
                    paddles, lift = posture_of(words, where=topic)
                    command = self._command
                    self._command = replace(command, paddles=paddles or command.paddles, lift=lift or command.lift)
                else:
                    linear, angular = speeds_of(message, type_name)
                    self._command = replace(self._command, linear=linear, angular=angular)
                    self._told_s, self._commanded, told = self._clock.now(), True, True
        return told

    def _messages(self, observation: Observation) -> Iterator[TopicMessage]:
        """Those of one control step; the scan last, since it is what observations are made at."""
        observation = replace(observation, time_s=self._begin_s + observation.time_s)
        scan: TopicMessage | None = None
        if self._time != "wall":
            stamp = stamp_of(round(observation.time_s * 1e9))
            yield _CLOCK._replace(message=ros.rosgraph_msgs__msg__Clock(clock=stamp))
        for message in self._encoder.messages(observation):
            if message.topic == DEFAULT_TOPICS.scan:
                scan = message
            else:
                yield message
        if scan is not None:
            yield scan

    def _publish(self, messages: Iterable[TopicMessage]) -> None:
        for message in messages:
            self._publication(message).publish(encode_message(message.message, message.type))

    def _publication(self, message: TopicMessage) -> Publication:
        if message.topic not in self._publications:
            qos = {"/tf_static": LATCHED, DEFAULT_TOPICS.cues: COMMANDS, "/odom": COMMANDS, "/tf": COMMANDS}
            self._publications[message.topic] = self._transport.publish(
                message.topic, message.type, qos.get(message.topic, SENSORS)
            )
        return self._publications[message.topic]
