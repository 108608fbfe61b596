"""A stand-in for rclpy, as far as the transport calls it: it records the calls, and hands messages over when spun.

What it shows is that the calls are those of the documented API; not that ROS answers as it should.
"""

import sys
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from enum import Enum
from types import ModuleType, SimpleNamespace
from typing import Any


class Reliability(Enum):
    RELIABLE = 1
    BEST_EFFORT = 2


class Durability(Enum):
    TRANSIENT_LOCAL = 1
    VOLATILE = 2


class History(Enum):
    KEEP_LAST = 1


class Publisher:
    def __init__(self, kind: str, topic: str, qos: SimpleNamespace) -> None:
        self.kind, self.topic, self.qos = kind, topic, qos
        self.published: list[bytes] = []
        self.acknowledged = False

    def publish(self, message: bytes) -> None:
        assert isinstance(message, bytes)
        self.published.append(message)

    def wait_for_all_acked(self, timeout: object) -> bool:
        self.acknowledged = True
        return True


class Node:
    """Attributes of the stand-in's own: ``pending`` callbacks, ``others`` at the ends of topics."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.publishers: list[Publisher] = []
        self.subscriptions: dict[str, tuple[str, Callable[[bytes], None], SimpleNamespace]] = {}
        self.pending: deque[Callable[[], None]] = deque()
        self.others: list[SimpleNamespace] = []
        self.destroyed = False

    def get_name(self) -> str:
        return self.name

    def create_subscription(
        self, kind: str, topic: str, callback: Callable[[bytes], None], qos: SimpleNamespace, *, raw: bool
    ) -> None:
        assert raw
        self.subscriptions[topic] = (kind, callback, qos)

    def create_publisher(self, kind: str, topic: str, qos: SimpleNamespace) -> Publisher:
        self.publishers.append(Publisher(kind, topic, qos))
        return self.publishers[-1]

    def get_publishers_info_by_topic(self, topic: str) -> list[SimpleNamespace]:
        return [one for one in self.others if one.topic == topic and one.publishes]

    def get_subscriptions_info_by_topic(self, topic: str) -> list[SimpleNamespace]:
        return [one for one in self.others if one.topic == topic and not one.publishes]

    def get_topic_names_and_types(self) -> list[tuple[str, list[str]]]:
        return [(topic, [kind]) for topic, kind in dict.fromkeys((one.topic, one.topic_type) for one in self.others)]

    def destroy_node(self) -> None:
        self.destroyed = True


class Executor:
    def __init__(self, *, context: object) -> None:
        self.nodes: list[Node] = []

    def add_node(self, node: Node) -> None:
        self.nodes.append(node)

    def spin_once(self, timeout_sec: float) -> None:
        assert timeout_sec >= 0.0
        for node in self.nodes:
            if node.pending:
                node.pending.popleft()()

    def shutdown(self) -> None:
        self.nodes.clear()


@contextmanager
def installed() -> Iterator[SimpleNamespace]:
    """Puts the stand-in where rclpy would be; gives what was done with it."""
    done = SimpleNamespace(nodes=[], inits=[], shutdowns=0)

    def create_node(name: str, *, context: object) -> Node:
        done.nodes.append(Node(name))
        return done.nodes[-1]

    def shutdown(*, context: object) -> None:
        done.shutdowns += 1

    names: dict[str, dict[str, Any]] = {
        "rclpy": {"init": lambda **how: done.inits.append(how), "create_node": create_node, "shutdown": shutdown},
        "rclpy.context": {"Context": object},
        "rclpy.duration": {"Duration": lambda *, seconds: seconds},
        "rclpy.executors": {"SingleThreadedExecutor": Executor},
        "rclpy.node": {"Node": Node},
        "rclpy.publisher": {"Publisher": Publisher},
        "rclpy.qos": {
            "DurabilityPolicy": Durability,
            "HistoryPolicy": History,
            "QoSProfile": SimpleNamespace,
            "ReliabilityPolicy": Reliability,
        },
        "rclpy.signals": {"SignalHandlerOptions": SimpleNamespace(NO="no")},
        "rclpy.topic_endpoint_info": {"TopicEndpointInfo": SimpleNamespace},
        "rosidl_runtime_py": {},
        "rosidl_runtime_py.utilities": {"get_message": lambda name: name},
    }
    modules = {name: ModuleType(name) for name in names}
    for name, contents in names.items():
        vars(modules[name]).update(contents)
    before = {name: sys.modules.get(name) for name in [*modules, "understudy.ros2.ros_client"]}
    sys.modules.update(modules)
    sys.modules.pop("understudy.ros2.ros_client", None)
    try:
        yield done
    finally:
        for name, module in before.items():
            sys.modules.pop(name, None)
            if module is not None:
                sys.modules[name] = module
