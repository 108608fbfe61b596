"""The same topics through rclpy, where ROS 2 is sourced: messages pass as their CDR bytes here, too."""

import os
from collections import deque
from collections.abc import Iterable

import rclpy
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
from rclpy.signals import SignalHandlerOptions
from rclpy.topic_endpoint_info import TopicEndpointInfo
from rosidl_runtime_py.utilities import get_message

from understudy.ros2.transport import Endpoint, Qos

__all__ = ["RosClientTransport"]

_LINGER_S = 1.0


class RosClientTransport:
    """A node of rclpy, in a context of its own.

    Args:
        domain: the ROS domain.
        node: the name that the program has there; its process number is added, so that two programs differ.
    """

    def __init__(self, domain: int, node: str) -> None:
        self._context = Context()
        # Ctrl-C must stop the robot before it stops ROS.
        rclpy.init(context=self._context, domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
        self._node: Node = rclpy.create_node(f"{node}_{os.getpid()}", context=self._context)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._queues: list[_Queue] = []
        self._publishers: list[Publisher] = []

    def subscribe(self, topic: str, type_name: str, qos: Qos) -> "_Queue":
        """Messages of a topic; only those of this type are received."""
        queue = _Queue(qos.depth)
        self._node.create_subscription(get_message(type_name), topic, queue.put, _profile(qos), raw=True)
        self._queues.append(queue)
        return queue

    def publish(self, topic: str, type_name: str, qos: Qos) -> Publisher:
        """A way to publish on a topic; rclpy's own publisher takes bytes, too."""
        publisher = self._node.create_publisher(get_message(type_name), topic, _profile(qos))
        self._publishers.append(publisher)
        return publisher

    def publishers(self, topic: str) -> tuple[Endpoint, ...]:
        """Who publishes on a topic, but for this node."""
        return self._endpoints(topic, self._node.get_publishers_info_by_topic(topic))

    def subscribers(self, topic: str) -> tuple[Endpoint, ...]:
        """Who listens to a topic, but for this node."""
        return self._endpoints(topic, self._node.get_subscriptions_info_by_topic(topic))

    def published_topics(self) -> tuple[str, ...]:
        """The topics that others publish on, sorted."""
        names = (name for name, _ in self._node.get_topic_names_and_types())
        return tuple(sorted(name for name in names if self.publishers(name)))

    def wait(self, timeout_s: float) -> bool:
        """Until one of the subscriptions has a message, at most so long; False if none has."""
        before = -1
        # A spin hands over one message: the others that are there come with it, until there is none left.
        while before != (waiting := sum(queue.received for queue in self._queues)):
            self._executor.spin_once(timeout_sec=max(timeout_s, 0.0) if before < 0 else 0.0)
            before = waiting
        return any(queue.messages for queue in self._queues)

    def close(self) -> None:
        """Leaves the network, after what was published has been received or a second has passed."""
        for publisher in self._publishers:
            publisher.wait_for_all_acked(Duration(seconds=_LINGER_S))
        self._executor.shutdown()
        self._node.destroy_node()
        rclpy.shutdown(context=self._context)

    def _endpoints(self, topic: str, found: Iterable[TopicEndpointInfo]) -> tuple[Endpoint, ...]:
        return tuple(
            Endpoint(
                topic=topic,
                type=one.topic_type,
                reliable=one.qos_profile.reliability == ReliabilityPolicy.RELIABLE,
                latched=one.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL,
            )
            for one in found
            if one.node_name != self._node.get_name()
        )


class _Queue:
    """Messages between rclpy's callbacks and whoever takes them."""

    def __init__(self, depth: int) -> None:
        self.messages: deque[bytes] = deque(maxlen=depth)
        self.received = 0

    def put(self, data: bytes) -> None:
        """One more."""
        self.messages.append(data)
        self.received += 1

    def take(self) -> list[bytes]:
        """All that came since the last call."""
        taken = list(self.messages)
        self.messages.clear()
        return taken


def _profile(qos: Qos) -> QoSProfile:
    return QoSProfile(
        depth=qos.depth,
        history=HistoryPolicy.KEEP_LAST,
        reliability=ReliabilityPolicy.RELIABLE if qos.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if qos.latched else DurabilityPolicy.VOLATILE,
    )
