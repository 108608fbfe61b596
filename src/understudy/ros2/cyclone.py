"""ROS 2 without ROS: Cyclone DDS, with the names and types by which ROS 2 nodes know each other.

A topic ``/scan`` is the DDS topic ``rt/scan``. Everything happens in the thread of the caller: listeners that are alive
when the interpreter ends made it hang.
"""

import logging
from collections.abc import Iterator
from typing import Final
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
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from understudy.errors import RobotError
from understudy.ros2.idl import CdrSample, ros_type_name, sample_type
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
        self._topics: dict[tuple[str, str], Topic[CdrSample]] = {}
        self._writers: list[DataWriter[CdrSample]] = []
        self._publishers = _Endpoints(self._participant, BuiltinTopicDcpsPublication)
        self._subscribers = _Endpoints(self._participant, BuiltinTopicDcpsSubscription)

    def subscribe(self, topic: str, type_name: str, qos: Qos) -> "_Reader":
        """Messages of a topic; only those of this type are received."""
        reader = DataReader(self._participant, self._topic(topic, type_name), qos=_dds(qos))
        self._waitset.attach(ReadCondition(reader, _ANY))
        return _Reader(reader, qos.depth)

    def publish(self, topic: str, type_name: str, qos: Qos) -> "_Writer":
        """A way to publish on a topic."""
        writer = DataWriter(self._participant, self._topic(topic, type_name), qos=_dds(qos))
        self._writers.append(writer)
        return _Writer(writer, sample_type(type_name))

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
        for writer in self._writers:
            try:
                writer.wait_for_acks(duration(seconds=_LINGER_S))
            except DDSException as error:
                _log.debug("not all was received: %s", error)
        self._writers.clear()
        self._topics.clear()
        del self._waitset, self._publishers, self._subscribers, self._participant

    def _topic(self, topic: str, type_name: str) -> Topic[CdrSample]:
        key = topic, type_name
        if key not in self._topics:
            self._topics[key] = Topic(self._participant, f"{_PREFIX}{topic}", sample_type(type_name))
        return self._topics[key]


class _Reader:
    def __init__(self, reader: DataReader[CdrSample], depth: int) -> None:
        self._reader, self._depth = reader, depth

    def take(self) -> list[bytes]:
        """All that came since the last call."""
        return [sample.cdr for sample in self._reader.take(self._depth) if isinstance(sample, CdrSample)]


class _Writer:
    def __init__(self, writer: DataWriter[CdrSample], kind: type[CdrSample]) -> None:
        self._writer, self._kind = writer, kind

    def publish(self, data: bytes) -> None:
        """Sends a message.

        Raises:
            RobotError: the network does not take it.
        """
        try:
            self._writer.write(self._kind(data))
        except DDSException as error:
            raise RobotError(
                f"{self._writer.topic.name} cannot be published ({error.msg}); check the network"
            ) from error


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
