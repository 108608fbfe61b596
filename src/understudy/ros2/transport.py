"""The seam between Understudy and a ROS 2 network: topics that carry messages as CDR bytes.

Two transports behind it do the same: :mod:`~understudy.ros2.cyclone`, which needs no ROS, and
:mod:`~understudy.ros2.ros_client` over rclpy where ROS 2 is sourced.
"""

import importlib.util
import os
from dataclasses import dataclass
from typing import Literal, Protocol

from understudy.errors import MissingExtraError

__all__ = [
    "COMMANDS",
    "LATCHED",
    "SENSORS",
    "Endpoint",
    "Publication",
    "Qos",
    "Subscription",
    "Transport",
    "open_transport",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Qos:
    """Quality of service, as far as it matters here.

    Attributes:
        reliable: what was lost is sent again. A reliable reader is not matched with a writer that is not.
        depth: how many messages wait to be taken.
        latched: the last messages are kept for readers that come later (transient local).
    """

    reliable: bool
    depth: int
    latched: bool = False


SENSORS = Qos(reliable=False, depth=5)
"""Of readings that are soon followed by newer ones; such a reader takes what any writer sends."""

COMMANDS = Qos(reliable=True, depth=10)
"""Of words and speeds, none of which may be lost."""

LATCHED = Qos(reliable=True, depth=1, latched=True)
"""Of what is said once and holds for good."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Endpoint:
    """A publisher or a subscriber of another program.

    Attributes:
        topic: its name, ``/scan``.
        type: of its messages, ``sensor_msgs/msg/LaserScan``.
        reliable: what it offers or asks for.
        latched: it offers, or asks for, what was published before.
    """

    topic: str
    type: str
    reliable: bool
    latched: bool


class Subscription(Protocol):
    """Messages of one topic, in the order in which they came."""

    def take(self) -> list[bytes]:
        """All that came since the last call, up to the depth of its quality of service."""
        ...


class Publication(Protocol):
    """A topic to publish on. May be used from several threads."""

    def publish(self, data: bytes) -> None:
        """Sends a message of CDR bytes."""
        ...


class Transport(Protocol):
    """A node in a ROS 2 network."""

    def subscribe(self, topic: str, type_name: str, qos: Qos) -> Subscription:
        """Messages of a topic; only those of this type are received."""
        ...

    def publish(self, topic: str, type_name: str, qos: Qos) -> Publication:
        """A way to publish on a topic."""
        ...

    def publishers(self, topic: str) -> tuple[Endpoint, ...]:
        """Who publishes on a topic, but for this node."""
        ...

    def subscribers(self, topic: str) -> tuple[Endpoint, ...]:
        """Who listens to a topic, but for this node."""
        ...

    def published_topics(self) -> tuple[str, ...]:
        """The topics that others publish on, sorted."""
        ...

    def wait(self, timeout_s: float) -> bool:
        """Until one of the subscriptions has a message, at most so long; False if none has.

        As long as one has a message that nobody takes, it does not wait.
        """
        ...

    def close(self) -> None:
        """Leaves the network, after what was published has been received or a second has passed."""
        ...


def open_transport(
    which: Literal["detect", "cyclonedds", "rclpy"] = "detect", *, domain: int | None = None, node: str = "understudy"
) -> Transport:
    """Joins a ROS 2 network.

    Args:
        which: ``detect`` takes rclpy where ROS 2 is sourced, and Cyclone DDS everywhere else.
        domain: the ROS domain; None takes ``ROS_DOMAIN_ID``, or 0.
        node: the name that the program has there.

    Raises:
        MissingExtraError: what is asked for is not installed.
        RobotError: the network cannot be joined.
    """
    if domain is None:
        domain = _domain_of_environment()
    if which != "cyclonedds" and importlib.util.find_spec("rclpy") is not None:
        from understudy.ros2.ros_client import RosClientTransport  # noqa: PLC0415 - only where it is there

        return RosClientTransport(domain, node)
    if which == "rclpy":
        raise MissingExtraError(
            "there is no rclpy in this Python; source ROS 2 (source /opt/ros/DISTRO/setup.bash), or let the robot"
            " document say `transport: cyclonedds`"
        )
    if importlib.util.find_spec("cyclonedds") is None:
        raise MissingExtraError(
            "a ROS 2 robot needs the extra ros2: pip install 'understudy[ros2]', or source ROS 2 for its rclpy"
        )
    from understudy.ros2.cyclone import CycloneTransport  # noqa: PLC0415 - only where it is there

    return CycloneTransport(domain, node)


def _domain_of_environment() -> int:
    given = os.environ.get("ROS_DOMAIN_ID", "").strip()
    return int(given) if given.isdecimal() else 0
