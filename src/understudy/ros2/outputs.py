"""What a ROS 2 robot is told: speeds within its limits, and words for its gripper."""

import threading

from rosbags.typesys.stores import ros2_humble as ros

from understudy.errors import RobotError
from understudy.recording import ROLE_TYPES, encode_message, stamp_of, twist_of
from understudy.robot import Command, RobotSpec
from understudy.ros2.document import RobotDocument
from understudy.ros2.roles import OUTPUT_TYPES, output_fault
from understudy.ros2.transport import COMMANDS, Publication, Transport

__all__ = ["Outputs", "eased"]

_WORDS = ROLE_TYPES["gripper_command"][0]


class Outputs:
    """Everything that a robot is told. Speeds may be published from several threads.

    Args:
        document: which topics it listens to.
        transport: the network.
    """

    def __init__(self, document: RobotDocument, transport: Transport) -> None:
        self._transport, self._drive, self._frame = transport, document.drive, "base_link"
        self._gripper_topic = document.gripper.command if document.gripper is not None else None
        self._wheels: Publication | None = None
        self._stamped = False
        self._gripper = (
            transport.publish(self._gripper_topic, _WORDS, COMMANDS) if self._gripper_topic is not None else None
        )
        self._told: tuple[str | None, str | None] = (None, None)
        self._lock = threading.Lock()
        self._speeds = (0.0, 0.0)
        self._halted = False

    def examined(self) -> tuple[tuple[str, str, str], ...]:
        """What each topic is for, its name, and what keeps the robot from hearing us on it; empty if nothing does."""
        topic, types = self._drive.topic, self._types()
        found = [("speeds", topic, output_fault(topic, "drive.topic", types, self._transport.subscribers(topic)))]
        if (hand := self._gripper_topic) is not None:
            fault = output_fault(hand, "gripper.command", [_WORDS], self._transport.subscribers(hand))
            found.append(("gripper", hand, fault))
        return tuple(found)

    @property
    def faults(self) -> tuple[str, ...]:
        """What keeps the robot from hearing us, with the mends; empty if nothing does."""
        return tuple(fault for _, _, fault in self.examined() if fault)

    @property
    def others(self) -> int:
        """How many other programs could send speeds to the robot, too."""
        return len(self._transport.publishers(self._drive.topic))

    def connect(self) -> None:
        """Begins to publish speeds, of the type that the robot listens for.

        Raises:
            RobotError: it listens for both, and the document does not say which to take.
        """
        asked = {one.type for one in self._transport.subscribers(self._drive.topic)} & set(self._types())
        if len(asked) > 1:
            raise RobotError(
                f"{self._drive.topic} is listened to as Twist and as TwistStamped; say in the robot document which the"
                " robot's base takes, as `message` beside drive.topic"
            )
        if self._wheels is None and asked:
            type_name = asked.pop()
            self._stamped = type_name == OUTPUT_TYPES["TwistStamped"]
            self._wheels = self._transport.publish(self._drive.topic, type_name, COMMANDS)

    def drive(self, linear: float, angular: float, stamp_ns: int) -> None:
        """Publishes speeds, m/s and rad/s.

        Args:
            linear: forward.
            angular: left positive.
            stamp_ns: the moment, by the robot's own clock.
        """
        with self._lock:
            if self._halted:
                linear = angular = 0.0
            self._speeds = (linear, angular)
            if self._wheels is None:
                return
            twist = twist_of(linear, angular)
            if self._stamped:
                header = ros.std_msgs__msg__Header(stamp=stamp_of(stamp_ns), frame_id=self._frame)
                message: object = ros.geometry_msgs__msg__TwistStamped(header=header, twist=twist)
                self._wheels.publish(encode_message(message, OUTPUT_TYPES["TwistStamped"]))
            else:
                self._wheels.publish(encode_message(twist, OUTPUT_TYPES["Twist"]))

    def halt(self, stamp_ns: int) -> None:
        """Stands still, from now on for good."""
        self._halted = True
        self.drive(0.0, 0.0, stamp_ns)

    def move_gripper(self, command: Command) -> None:
        """Tells the gripper what is new to it."""
        paddles, lift = self._told
        told = (command.paddles or paddles, command.lift or lift)
        if told == self._told or self._gripper is None or self._halted:
            return
        words = " ".join(word for word in (command.paddles, command.lift) if word)
        self._gripper.publish(encode_message(ros.std_msgs__msg__String(data=words), _WORDS))
        self._told = told

    @property
    def speeds(self) -> tuple[float, float]:
        """The speeds that were published last."""
        return self._speeds

    def _types(self) -> tuple[str, ...]:
        if self._drive.message == "detect":
            return tuple(OUTPUT_TYPES.values())
        return (OUTPUT_TYPES[self._drive.message],)


def eased(speeds: tuple[float, float], command: Command, spec: RobotSpec, period_s: float) -> tuple[float, float]:
    """The speeds that come next on the way from these to a command's, within the robot's limits.

    Args:
        speeds: of now, m/s and rad/s.
        command: what is wanted.
        spec: the limits.
        period_s: since they were told.
    """
    linear = min(max(command.linear, -spec.max_linear), spec.max_linear)
    angular = min(max(command.angular, -spec.max_angular), spec.max_angular)
    step, turn = spec.max_linear_acceleration * period_s, spec.max_angular_acceleration * period_s
    return (
        speeds[0] + min(max(linear - speeds[0], -step), step),
        speeds[1] + min(max(angular - speeds[1], -turn), turn),
    )
