"""A look at a robot from outside: every topic, whether it is seen, how often it comes, and what is wrong with it."""

import math
from dataclasses import dataclass
from typing import Any, Literal, cast

from rosbags.typesys.stores import ros2_humble as ros

from understudy.clock import Clock, WallClock
from understudy.errors import RobotError
from understudy.recording import decode_message
from understudy.ros2.document import RobotDocument
from understudy.ros2.inputs import Inputs
from understudy.ros2.outputs import Outputs
from understudy.ros2.roles import Role
from understudy.ros2.transport import SENSORS, Endpoint, Transport

__all__ = ["TopicFinding", "examine"]

_SLOW_HZ = 4.0
"""A laser that is slower makes the robot stop and go."""

_LOOK_S = 0.05

_INFO = "sensor_msgs/msg/CameraInfo"
_SAME_DEG = 2.0
"""At two metres, a target at the picture's border is seen 7 cm aside by a field that is wrong by so much."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TopicFinding:
    """One input or output of a robot.

    Attributes:
        what: it is for, in words.
        topic: its name.
        direction: ``in`` to us, or ``out`` to the robot.
        type: of its messages; empty if there is nobody at its other end.
        ends: how many programs are at its other end.
        reliable: whether they send, or ask for, what was lost again; None if there is nobody.
        rate_hz: how often it comes; None for an output, or if too little came.
        age_s: how long ago it came; None if it did not.
        fault: what is wrong, with the mend; empty if nothing is.
        needed: the robot cannot do without.
    """

    what: str
    topic: str
    direction: Literal["in", "out"]
    type: str
    ends: int
    reliable: bool | None
    rate_hz: float | None
    age_s: float | None
    fault: str
    needed: bool

    @property
    def ok(self) -> bool:
        """Nothing is wrong; what is not needed may be missing."""
        return not self.fault or not (self.needed or self.ends)

    def as_record(self) -> dict[str, Any]:
        """In plain data."""
        return {name: getattr(self, name) for name in self.__slots__}

    def told(self) -> str:
        """What was found, in words."""
        if not self.ends:
            return f"{self.topic}: nobody {'publishes it' if self.direction == 'in' else 'listens'}"
        parts = [self.type, "reliable" if self.reliable else "best effort"]
        if self.rate_hz is not None:
            parts.append(f"{self.rate_hz:.1f} Hz")
        if self.age_s is not None:
            parts.append(f"{self.age_s:.1f} s ago")
        elif self.direction == "in":
            parts.append("nothing came")
        return f"{self.topic}: {', '.join(parts)}"


def examine(
    document: RobotDocument, transport: Transport, *, seconds: float = 5.0, clock: Clock | None = None
) -> list[TopicFinding]:
    """Listens to a robot for a while. Nothing is published, and nothing moves.

    Args:
        document: what it should have.
        transport: the network.
        seconds: how long.
        clock: ours.
    """
    clock = clock or WallClock()
    inputs, outputs = Inputs(document, transport, clock), Outputs(document, transport)
    lens = transport.subscribe(document.camera.info, _INFO, SENSORS) if document.camera.info is not None else None
    until_s = clock.now() + seconds
    spoiled: list[str] = []
    told: list[bytes] = []
    while clock.now() < until_s:
        inputs.listen()
        try:
            inputs.update()
        except RobotError as error:
            spoiled.append(str(error))
        told += lens.take() if lens is not None else []
        transport.wait(min(_LOOK_S, max(0.0, until_s - clock.now())))
    findings = [_input(role, inputs, transport, clock.now()) for role in inputs.roles]
    findings += [_output(what, topic, transport.subscribers(topic), fault) for what, topic, fault in outputs.examined()]
    if told:
        spoiled += _lens_faults(document, told[-1])
    return [*findings, *(_spoiled(message) for message in dict.fromkeys(spoiled))]


def _lens_faults(document: RobotDocument, data: bytes) -> list[str]:
    """Where the camera's own numbers are others than those of the document."""
    camera = document.camera
    info = cast(ros.sensor_msgs__msg__CameraInfo, decode_message(data, _INFO, where=camera.info or ""))
    focal = float(info.k[0])
    if focal <= 0.0:
        return []  # it has not been calibrated
    field_deg = math.degrees(2 * math.atan(info.width / 2 / focal))
    if abs(field_deg - camera.field_deg) <= _SAME_DEG:
        return []
    return [
        f"{camera.info} tells of a field of {field_deg:.1f}°, and the document of {camera.field_deg:g}°; put"
        f" `field_deg: {field_deg:.1f}` there, if the camera was calibrated"
    ]


def _input(role: Role, inputs: Inputs, transport: Transport, now_s: float) -> TopicFinding:
    listening = inputs.listening.get(role.name)
    topic = listening.topic if listening is not None else role.topic
    ends = transport.publishers(topic) if listening is not None else ()
    rate_hz = age_s = None
    fault = role.fault(transport)
    if listening is not None and listening.first_s is not None and listening.last_s is not None:
        age_s = now_s - listening.last_s
        if listening.last_s > listening.first_s:
            rate_hz = (listening.count - 1) / (listening.last_s - listening.first_s)
    if not fault and role.needed and age_s is None:
        fault = inputs.why_silent(role)
    elif role.name == "scan" and rate_hz is not None and rate_hz < _SLOW_HZ:
        fault = f"{topic} comes {rate_hz:.1f} times a second, and the robot needs {_SLOW_HZ:g}; set the laser faster"
    elif role.exclusive and len(ends) > 1:
        fault = f"{len(ends)} programs publish {topic}; stop all but one, or name another topic as {role.key}"
    return _finding(role.what, topic, "in", ends, fault, needed=role.needed, rate_hz=rate_hz, age_s=age_s)


def _output(what: str, topic: str, ends: tuple[Endpoint, ...], fault: str) -> TopicFinding:
    return _finding(what, topic, "out", ends, fault, needed=True, rate_hz=None, age_s=None)


def _spoiled(message: str) -> TopicFinding:
    return _finding("readings", "", "in", (), message, needed=True, rate_hz=None, age_s=None)


def _finding(
    what: str,
    topic: str,
    direction: Literal["in", "out"],
    ends: tuple[Endpoint, ...],
    fault: str,
    *,
    needed: bool,
    rate_hz: float | None,
    age_s: float | None,
) -> TopicFinding:
    return TopicFinding(
        what=what,
        topic=topic,
        direction=direction,
        type=ends[0].type if ends else "",
        ends=len(ends),
        reliable=ends[0].reliable if ends else None,
        rate_hz=rate_hz,
        age_s=age_s,
        fault=fault,
        needed=needed,
    )
