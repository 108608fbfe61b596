"""A ROS 2 network without a network, on a clock that only it moves: whatever is due happens while somebody waits."""

import heapq
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count

import numpy as np
from rosbags.typesys.stores import ros2_humble as ros

from understudy.geometry import Pose
from understudy.recording import ObservationEncoder, decode_message, encode_message
from understudy.robot import TURTLEBOT, GripperReading, Observation, Odometry, RobotSpec, Scan
from understudy.ros2.transport import COMMANDS, SENSORS, Endpoint, Qos

TWIST = "geometry_msgs/msg/Twist"


class FakeClock:
    """Stands still unless it is moved."""

    def __init__(self) -> None:
        self.time_s = 100.0

    def now(self) -> float:
        return self.time_s


@dataclass(eq=False)
class Reader:
    node: str
    topic: str
    type: str
    qos: Qos
    queue: deque[bytes]

    def take(self) -> list[bytes]:
        taken = list(self.queue)
        self.queue.clear()
        return taken


@dataclass(eq=False)
class Writer:
    network: "Network"
    node: str
    topic: str
    type: str
    qos: Qos

    def publish(self, data: bytes) -> None:
        self.network.deliver(self, data)


@dataclass
class Network:
    """All nodes of it.

    Attributes:
        sent: what was published, by topic, each with its time.
    """

    clock: FakeClock = field(default_factory=FakeClock)
    readers: list[Reader] = field(default_factory=list)
    writers: list[Writer] = field(default_factory=list)
    sent: dict[str, list[tuple[float, bytes]]] = field(default_factory=dict)
    _due: list[tuple[float, int, Callable[[], None]]] = field(default_factory=list)
    _order: "count[int]" = field(default_factory=count)

    def at(self, time_s: float, do: Callable[[], None]) -> None:
        """Something that happens later."""
        heapq.heappush(self._due, (time_s, next(self._order), do))

    def deliver(self, writer: Writer, data: bytes) -> None:
        if writer not in self.writers:
            return
        self.sent.setdefault(writer.topic, []).append((self.clock.time_s, data))
        for reader in self.readers:
            same = (reader.topic, reader.type) == (writer.topic, writer.type)
            if same and (writer.qos.reliable or not reader.qos.reliable):
                reader.queue.append(data)

    def pass_until(self, time_s: float, enough: Callable[[], bool]) -> None:
        """Time passes until then, or until it is enough."""
        while not enough() and self._due and self._due[0][0] <= time_s:
            due_s, _, do = heapq.heappop(self._due)
            self.clock.time_s = max(self.clock.time_s, due_s)
            do()
        if not enough():
            self.clock.time_s = max(self.clock.time_s, time_s)


class Node:
    """A transport."""

    def __init__(self, network: Network, name: str) -> None:
        self.network, self.name = network, name
        self.closed = False

    def subscribe(self, topic: str, type_name: str, qos: Qos) -> Reader:
        reader = Reader(self.name, topic, type_name, qos, deque(maxlen=qos.depth))
        self.network.readers.append(reader)
        return reader

    def publish(self, topic: str, type_name: str, qos: Qos) -> Writer:
        writer = Writer(self.network, self.name, topic, type_name, qos)
        self.network.writers.append(writer)
        return writer

    def publishers(self, topic: str) -> tuple[Endpoint, ...]:
        return self._others(topic, self.network.writers)

    def subscribers(self, topic: str) -> tuple[Endpoint, ...]:
        return self._others(topic, self.network.readers)

    def published_topics(self) -> tuple[str, ...]:
        return tuple(sorted({one.topic for one in self.network.writers if one.node != self.name}))

    def wait(self, timeout_s: float) -> bool:
        mine = [one for one in self.network.readers if one.node == self.name]
        self.network.pass_until(self.network.clock.time_s + timeout_s, lambda: any(one.queue for one in mine))
        return any(one.queue for one in mine)

    def close(self) -> None:
        self.network.readers = [one for one in self.network.readers if one.node != self.name]
        self.network.writers = [one for one in self.network.writers if one.node != self.name]
        self.closed = True

    def _others(self, topic: str, ends: "list[Reader] | list[Writer]") -> tuple[Endpoint, ...]:
        return tuple(
            Endpoint(topic=one.topic, type=one.type, reliable=one.qos.reliable, latched=one.qos.latched)
            for one in ends
            if one.topic == topic and one.node != self.name
        )


class Base:
    """A robot's drivers: ten times a second everything, and what is told is done.

    Attributes:
        change: what becomes of an observation before it is published; None publishes nothing.
        left_out: topics that are not published.
        stamp_offset_s: of the driver's clock.
    """

    def __init__(
        self,
        network: Network,
        spec: RobotSpec = TURTLEBOT,
        *,
        types: "dict[str, str] | None" = None,
        qos: "dict[str, Qos] | None" = None,
        speeds: str = TWIST,
        compressed: bool = False,
    ) -> None:
        self.network, self.spec = network, spec
        self.node = Node(network, "base")
        self.change: Callable[[Observation], Observation | None] = lambda observation: observation
        self.left_out: set[str] = set()
        self.stamp_offset_s = 0.0
        self.steps = 0
        self._types, self._qos = types or {}, qos or {}
        self._rng = np.random.default_rng(1)
        self._encoder = ObservationEncoder(spec, live=not compressed)
        self._writers: dict[str, Writer] = {}
        self.reader = self.node.subscribe("/cmd_vel", speeds, COMMANDS)
        if spec.gripper is not None:
            self.gripper = self.node.subscribe("/gripper/command", "std_msgs/msg/String", COMMANDS)
        self.tick()

    def tick(self) -> None:
        """Publishes everything, and comes again."""
        time_s = 1000.0 + 0.1 * self.steps
        self.network.at(self.network.clock.time_s + 0.1, self.tick)
        self.steps += 1
        rays = self.spec.laser.rays
        ranges = (3.0 + self._rng.normal(0.0, 0.01, rays)).astype(np.float32)
        step = self.spec.laser.sweep / rays
        observation = self.change(
            Observation(
                time_s=time_s + self.stamp_offset_s,
                scan=Scan(ranges=ranges, angle_min=-self.spec.laser.sweep / 2, angle_increment=step),
                sonar=np.zeros(0, np.float32),
                image=np.zeros((120, 160, 3), np.uint8),
                odometry=Odometry(pose=Pose(0.02 * self.steps, 0.0, 0.0), linear=0.2),
                gripper=GripperReading(aperture=0.5) if self.spec.gripper is not None else None,
            )
        )
        if observation is not None:
            for message in sorted(self._encoder.messages(observation), key=lambda one: one.topic == "/scan"):
                if message.topic not in self.left_out:
                    self._writer(message.topic, message.type).publish(encode_message(message.message, message.type))

    def die(self) -> None:
        """The drivers have gone."""
        self.change = lambda observation: None
        self.node.close()

    def say(self, topic: str, text: str) -> None:
        """A ``std_msgs/String``."""
        kind = "std_msgs/msg/String"
        writer = Node(self.network, "teacher").publish(topic, kind, COMMANDS)
        writer.publish(encode_message(ros.std_msgs__msg__String(data=text), kind))

    def press(self, pressed: bool) -> None:
        """The emergency stop."""
        kind = "std_msgs/msg/Bool"
        writer = Node(self.network, "button").publish("/emergency_stop", kind, COMMANDS)
        writer.publish(encode_message(ros.std_msgs__msg__Bool(data=pressed), kind))

    @property
    def told(self) -> list[tuple[float, float, float]]:
        """When the robot was told which speeds."""
        messages = [
            (time_s, decode_message(data, TWIST, where="/cmd_vel"))
            for time_s, data in self.network.sent.get("/cmd_vel", [])
        ]
        return [(time_s, one.linear.x, one.angular.z) for time_s, one in messages]  # type: ignore[attr-defined]

    def _writer(self, topic: str, kind: str) -> Writer:
        if topic not in self._writers:
            qos = self._qos.get(topic, SENSORS)
            self._writers[topic] = self.node.publish(topic, self._types.get(topic, kind), qos)
        return self._writers[topic]
