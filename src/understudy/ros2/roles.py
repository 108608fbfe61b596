"""What each topic of a robot is for: its types, its quality of service, and what is wrong where nothing comes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from understudy.recording import ROLE_TYPES
from understudy.ros2.document import RobotDocument
from understudy.ros2.transport import COMMANDS, SENSORS, Endpoint, Qos, Transport

__all__ = ["OUTPUT_TYPES", "Role", "output_fault", "roles_of"]

OUTPUT_TYPES: Final = {"Twist": "geometry_msgs/msg/Twist", "TwistStamped": "geometry_msgs/msg/TwistStamped"}
"""Speeds, as the robot document calls them."""

_IMAGE, _COMPRESSED = ROLE_TYPES["image"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Role:
    """A topic that a robot publishes.

    Attributes:
        name: ``scan``, ``odom`` …, as in a :class:`~understudy.recording.TopicMap`.
        what: in words, for messages.
        key: where the robot document names the topic.
        candidates: topics with their types; the first that is published is taken.
        qos: what we ask for.
        needed: the robot cannot do without.
        exclusive: readings of two publishers must not be mixed.
        fresh_s: an older reading must not be acted upon; None for one that holds until it is told otherwise.
    """

    name: str
    what: str
    key: str
    candidates: tuple[tuple[str, str], ...]
    qos: Qos
    needed: bool = True
    exclusive: bool = True
    fresh_s: float | None = None

    @property
    def topic(self) -> str:
        """The topic, or all that may be it."""
        return " or ".join(dict.fromkeys(topic for topic, _ in self.candidates))

    def choose(self, transport: Transport) -> tuple[str, str] | None:
        """The topic and type to listen to; None while that cannot be told."""
        if len(self.candidates) == 1:
            return self.candidates[0]
        for topic, type_name in self.candidates:
            if any(one.type == type_name for one in transport.publishers(topic)):
                return topic, type_name
        return None

    def fault(self, transport: Transport) -> str:
        """What keeps its messages from coming, with the mend; empty if nothing can be told."""
        found = [one for topic, _ in self.candidates for one in transport.publishers(topic)]
        wanted = dict.fromkeys(type_name for _, type_name in self.candidates)
        if not found:
            return (
                f"nobody publishes {self.topic} ({' or '.join(wanted)}); start the {self.what}, check the ROS domain,"
                f" or name another topic as {self.key} in the robot document"
            )
        fitting = [one for one in found if (one.topic, one.type) in self.candidates]
        if not fitting:
            return (
                f"{found[0].topic} carries {found[0].type}, and the {self.what} must be {' or '.join(wanted)};"
                f" name another topic as {self.key} in the robot document"
            )
        if self.qos.reliable and not any(one.reliable for one in fitting):
            return (
                f"{fitting[0].topic} is published with best effort, and asked for reliably, so that nothing is"
                f" received; publish it reliably, or put `reliability: best_effort` beside {self.key}"
            )
        return ""


def roles_of(document: RobotDocument) -> tuple[Role, ...]:
    """Everything that a robot should publish, by its document. The scan comes last: whoever sees us listen to it knows
    that we listen to all of them.
    """
    # Looked at with every sweep, which may be a control period later.
    fresh_s = 0.8 * document.deadman_s
    camera, hand, sonar = document.camera, document.gripper, document.sonar
    roles = []
    if document.cues is not None:
        roles.append(_words("cues", "teacher's words", "cues", document.cues, ROLE_TYPES["cues"]))
    if document.emergency_stop is not None:
        topic = document.emergency_stop
        roles.append(_words("emergency_stop", "emergency stop", "emergency_stop", topic, ["std_msgs/msg/Bool"]))
    raw, compressed = (camera.topic, _IMAGE), (f"{camera.topic}/compressed", _COMPRESSED)
    pictures = {"detect": (raw, compressed), "raw": (raw,), "compressed": (compressed,)}[camera.message]
    roles.append(
        Role(name="image", what="camera", key="camera.topic", candidates=pictures, qos=_asked(camera.reliability))
    )
    if hand is not None:
        joints = ((hand.joint_states, ROLE_TYPES["joint_states"][0]),)
        beam = ((hand.beam, ROLE_TYPES["beam"][0]),)
        # Several nodes may report on one topic, each its own joints.
        key = "gripper.joint_states"
        roles.append(
            Role(
                name="joint_states",
                what="gripper's joints",
                key=key,
                candidates=joints,
                qos=SENSORS,
                exclusive=False,
                fresh_s=2 * fresh_s,
            )
        )
        roles.append(Role(name="beam", what="gripper's beam", key="gripper.beam", candidates=beam, qos=SENSORS))
    if sonar is not None:
        echoes = ((sonar.topic, ROLE_TYPES["sonar"][0]),)
        qos = _asked(sonar.reliability)
        roles.append(
            Role(name="sonar", what="sonars", key="sonar.topic", candidates=echoes, qos=qos, fresh_s=2 * fresh_s)
        )
    odometry, laser = document.odometry, document.laser
    wheels = ((odometry.topic, ROLE_TYPES["odom"][0]),)
    qos = _asked(odometry.reliability)
    roles.append(Role(name="odom", what="odometry", key="odometry.topic", candidates=wheels, qos=qos, fresh_s=fresh_s))
    sweeps = ((laser.topic, ROLE_TYPES["scan"][0]),)
    roles.append(Role(name="scan", what="laser", key="laser.topic", candidates=sweeps, qos=_asked(laser.reliability)))
    return tuple(roles)


def output_fault(topic: str, key: str, types: Sequence[str], listeners: Sequence[Endpoint]) -> str:
    """What keeps the robot from hearing us on a topic, with the mend; empty if nothing does.

    Args:
        topic: that we publish.
        key: where the robot document names it.
        types: that we can publish.
        listeners: who listens to it.
    """
    if not listeners:
        return (
            f"nobody listens to {topic} ({' or '.join(types)}); start the robot's base, check the ROS domain, or name"
            f" another topic as {key} in the robot document"
        )
    if not any(one.type in types for one in listeners):
        return (
            f"{topic} is listened to as {listeners[0].type}, and we publish {' or '.join(types)}; name another topic"
            f" as {key} in the robot document"
        )
    return ""


def _words(name: str, what: str, key: str, topic: str, types: Sequence[str]) -> Role:
    # Several programs may speak: a keyboard, a recogniser, a button.
    return Role(
        name=name, what=what, key=key, candidates=((topic, types[0]),), qos=COMMANDS, needed=False, exclusive=False
    )


def _asked(reliability: str) -> Qos:
    return SENSORS if reliability == "best_effort" else Qos(reliable=True, depth=SENSORS.depth)
