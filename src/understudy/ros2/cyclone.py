"""ROS 2 without ROS: Cyclone DDS, with the names and types by which ROS 2 nodes know each other.

A topic ``/scan`` is the DDS topic ``rt/scan``. Everything happens in the thread of the caller: listeners that are alive
when the interpreter ends made it hang.
"""

import gc
import logging
from collections.abc import Iterator
from typing import Any, Final
from uuid import UUID

from cyclonedds.builtin import (
    BuiltinDataReader,
    BuiltinTopic,
    BuiltinTopicDcpsPublication,
    BuiltinTopicDcpsSubscription,
    DcpsEndpoint,
)
from cyclonedds.core import DDSException, InstanceState, Policy, ReadCondition, SampleState, ViewState, WaitSet
from cyclonedds.core import Qos as DdsQos
from cyclonedds.domain import DomainParticipant
from cyclonedds.internal import InvalidSample
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from understudy.clock import WallClock
from understudy.errors import RobotError
from understudy.ros2.idl import ros_type_name, sample_type
from understudy.ros2.transport import Endpoint, Qos

__all__ = ["CycloneTransport"]

_log = logging.getLogger(__name__)

_PREFIX: Final = "rt"
_ANY: Final = ViewState.Any | InstanceState.Any | SampleState.Any
_LINGER_S: Final = 1.0
_MANY: Final = 1000
"""More endpoints than ever change between two looks."""


class CycloneTransport:
    """A DDS participant.

    Args:
        domain: the ROS domain.
        node: the name that the program has there.

    Raises:
        RobotError: the network cannot be joined.
    """

    def __init__(self, domain: int, node: str) -> None:
        self._node = node
        try:
            self._participant = DomainParticipant(domain, qos=DdsQos(Policy.Userdata(b"enclave=/;")))
        except DDSException as error:
            raise RobotError(
                f"ROS domain {domain} cannot be joined ({error.msg}); check that a network interface is up, and what"
                " CYCLONEDDS_URI says"
            ) from error
        self._own = self._participant.guid
        self._waitset = WaitSet(self._participant)
        self._topics: dict[tuple[str, str], Topic[Any]] = {}
        self._readers: list[_Reader] = []
        self._writers: list[_Writer] = []
        self._publishers = _Endpoints(self._participant, BuiltinTopicDcpsPublication)
        self._subscribers = _Endpoints(self._participant, BuiltinTopicDcpsSubscription)

    def subscribe(self, topic: str, type_name: str, qos: Qos) -> "_Reader":
        """Messages of a topic; only those of this type are received."""
        reader = DataReader(self._participant, self._topic(topic, type_name), qos=_dds(qos))
        self._waitset.attach(ReadCondition(reader, _ANY))
        self._readers.append(_Reader(reader, qos.depth))
        return self._readers[-1]

    def publish(self, topic: str, type_name: str, qos: Qos) -> "_Writer":
        """A way to publish on a topic."""
        writer = DataWriter(self._participant, self._topic(topic, type_name), qos=_dds(qos))
        self._writers.append(_Writer(writer, sample_type(type_name)))
        return self._writers[-1]

    def publishers(self, topic: str) -> tuple[Endpoint, ...]:
        """Who publishes on a topic, but for this node."""
        return self._publishers.of(topic, but=self._own)

    def subscribers(self, topic: str) -> tuple[Endpoint, ...]:
        """Who listens to a topic, but for this node."""
        return self._subscribers.of(topic, but=self._own)

    def published_topics(self) -> tuple[str, ...]:
        """The topics that others publish on, sorted."""
        return self._publishers.topics(but=self._own)

    def wait(self, timeout_s: float) -> bool:
        """Until one of the subscriptions has a message, at most so long; False if none has."""
        return self._waitset.wait(duration(seconds=max(timeout_s, 0.0))) > 0

    def close(self) -> None:
        """Leaves the network, after what was published has been received or a second has passed."""
        clock = WallClock()
        for writer in self._writers:
            writer.close(max(0.0, _LINGER_S - clock.now()))
        for reader in self._readers:
            reader.close()
        self._writers.clear()
        self._readers.clear()
        self._topics.clear()
        del self._waitset, self._publishers, self._subscribers, self._participant
        # Cyclone DDS's readers refer to themselves in a circle, which would keep us in the network.
        gc.collect()

    def _topic(self, topic: str, type_name: str) -> Topic[Any]:
        key = topic, type_name
        if key not in self._topics:
            self._topics[key] = Topic(self._participant, f"{_PREFIX}{topic}", sample_type(type_name))
        return self._topics[key]


class _Reader:
    def __init__(self, reader: DataReader[Any], depth: int) -> None:
        self._reader: DataReader[Any] | None = reader
        self._depth = depth

    def take(self) -> list[bytes]:
        """All that came since the last call; nothing after the end."""
        taken = self._reader.take(self._depth) if self._reader is not None else []
        return [sample.cdr for sample in taken if not isinstance(sample, InvalidSample)]

    def close(self) -> None:
        """Lets go of the reader."""
        self._reader = None


class _Writer:
    def __init__(self, writer: DataWriter[Any], kind: Any) -> None:
        self._writer: DataWriter[Any] | None = writer
        self._kind = kind

    def publish(self, data: bytes) -> None:
        """Sends a message; none after the end.

        Raises:
            RobotError: the network does not take it.
        """
        if self._writer is None:
            return
        try:
            self._writer.write(self._kind(data))
        except DDSException as error:
            raise RobotError(
                f"{self._writer.topic.name} cannot be published ({error.msg}); check the network"
            ) from error

    def close(self, patience_s: float) -> None:
        """Waits until what was published has been received, at most so long, and lets go of the writer."""
        if self._writer is None:
            return
        try:
            self._writer.wait_for_acks(duration(seconds=patience_s))
        except (DDSException, AttributeError) as error:
            # Where it takes too long, Cyclone DDS 11.0.1 looks the code of that up in the wrong class.
            _log.debug("not all was received: %s", error)
        self._writer = None


class _Endpoints:
    """All publishers, or all subscribers, of a domain, as far as they are known."""

    def __init__(self, participant: DomainParticipant, kind: BuiltinTopic) -> None:
        self._reader = BuiltinDataReader(participant, kind)
        self._known: dict[UUID, DcpsEndpoint] = {}

    def of(self, topic: str, *, but: UUID) -> tuple[Endpoint, ...]:
        """Those of a topic that do not belong to this participant."""
        return tuple(_endpoint(one) for one in self._others(but) if one.topic_name == f"{_PREFIX}{topic}")

    def topics(self, *, but: UUID) -> tuple[str, ...]:
        """The names of all topics."""
        names = {one.topic_name for one in self._others(but)}
        return tuple(sorted(name.removeprefix(_PREFIX) for name in names if name.startswith(f"{_PREFIX}/")))

    def _others(self, but: UUID) -> Iterator[DcpsEndpoint]:
        self._look()
        return (one for one in self._known.values() if one.participant_key != but)

    def _look(self) -> None:
        for sample in self._reader.take(_MANY):
            if sample.sample_info.instance_state == InstanceState.Alive and sample.sample_info.valid_data:
                self._known[sample.key] = sample
            else:
                self._known.pop(sample.key, None)


def _endpoint(found: DcpsEndpoint) -> Endpoint:
    reliability, durability = found.qos[Policy.Reliability], found.qos[Policy.Durability]
    return Endpoint(
        topic=found.topic_name.removeprefix(_PREFIX),
        type=ros_type_name(found.type_name),
        reliable=isinstance(reliability, Policy.Reliability.Reliable),
        latched=durability is not None and durability is not Policy.Durability.Volatile,
    )


def _dds(qos: Qos) -> DdsQos:
    # The representation that every ROS 2 release reads and writes.
    return DdsQos(
        Policy.Reliability.Reliable(duration(milliseconds=100)) if qos.reliable else Policy.Reliability.BestEffort,
        Policy.Durability.TransientLocal if qos.latched else Policy.Durability.Volatile,
        Policy.History.KeepLast(qos.depth),
        Policy.DataRepresentation(use_cdrv0_representation=True),
    )
