"""Topic names, and the message type that each of them must carry."""

from dataclasses import dataclass, field

from understudy.errors import RecordingError
from understudy.robot import PIONEER

__all__ = [
    "COMMAND_TOPIC",
    "DEFAULT_TOPICS",
    "EVENTS_TOPIC",
    "OBSERVATION_TOPIC",
    "ROLE_TYPES",
    "GripperJoints",
    "TopicMap",
]

OBSERVATION_TOPIC = "/understudy/observation"
"""What the conventional topics round or leave out; written last, it completes a control step."""

COMMAND_TOPIC = "/understudy/command"
"""The commands with their exact time."""

EVENTS_TOPIC = "/understudy/events"
"""The trace: one JSON object a message."""

ROLE_TYPES: dict[str, tuple[str, ...]] = {
    "scan": ("sensor_msgs/msg/LaserScan",),
    "odom": ("nav_msgs/msg/Odometry",),
    "sonar": ("sensor_msgs/msg/PointCloud2", "sensor_msgs/msg/PointCloud"),
    "image": ("sensor_msgs/msg/Image", "sensor_msgs/msg/CompressedImage"),
    "joint_states": ("sensor_msgs/msg/JointState",),
    "beam": ("std_msgs/msg/Bool",),
    "cues": ("std_msgs/msg/String",),
    "cmd_vel": ("geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"),
    "gripper_command": ("std_msgs/msg/String",),
}
"""The message types that can be read in each role; the roles are the fields of :class:`TopicMap`."""

# Recordings of a robot without a gripper never use these two.
_OPENING_M = PIONEER.gripper.opening if PIONEER.gripper else 1.0
_LIFT_M = PIONEER.gripper.lift_height if PIONEER.gripper else 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class GripperJoints:
    """How the joints of a robot's gripper become an aperture and a lift between 0 and 1.

    Positions are in the joint's own unit (metres or radians). ``finger_open`` may be less than ``finger_closed``:
    many grippers count from the open posture. The default is the Pioneer's gripper.

    Attributes:
        finger: name of the joint that opens the paddles.
        finger_closed: its position when the paddles touch.
        finger_open: its position when they are fully open.
        lift: name of the joint that raises the gripper; a robot without one counts as raised.
        lift_down: its position on the floor.
        lift_up: its position when raised.

    Raises:
        RecordingError: the two ends of a joint are the same position.
    """

    finger: str = "gripper_finger_joint"
    finger_closed: float = 0.0
    finger_open: float = _OPENING_M
    lift: str = "gripper_lift_joint"
    lift_down: float = 0.0
    lift_up: float = _LIFT_M

    def __post_init__(self) -> None:
        if self.finger_closed == self.finger_open or self.lift_down == self.lift_up:
            raise RecordingError(f"a gripper joint needs two different end positions; given: {self}")


@dataclass(frozen=True, slots=True, kw_only=True)
class TopicMap:
    """The names under which a recording holds what Understudy needs.

    The defaults are the names in Understudy's own recordings. ``None`` leaves a topic out, even where the recording
    holds it.

    Attributes:
        scan: laser; its stamps give the observations their times.
        odom: odometry. Required, unless left out on purpose.
        sonar: a point cloud with a float32 field (or channel) named ``range``.
        image: raw images; where this topic is missing, the same name with ``/compressed`` is tried.
        joint_states: holds the joints named in ``joints``.
        beam: true while something stands between the paddles.
        cues: the teacher's words.
        cmd_vel: speeds that the robot was told.
        gripper_command: the words ``open``, ``close``, ``up``, ``down``.
        joints: how the gripper's joints are named and scaled.
        zero_is_free: the laser's driver gives 0.0 where nothing was met, and not where it could not measure.
    """

    scan: str = "/scan"
    odom: str | None = "/odom"
    sonar: str | None = "/sonar"
    image: str | None = "/camera/image_raw"
    joint_states: str | None = "/joint_states"
    beam: str | None = "/gripper/beam"
    cues: str | None = "/cues"
    cmd_vel: str | None = "/cmd_vel"
    gripper_command: str | None = "/gripper/command"
    joints: GripperJoints = field(default_factory=GripperJoints)
    zero_is_free: bool = False

    def candidates(self, role: str) -> tuple[str, ...]:
        """The topic names to try for a role, in this order; empty when the role is left out."""
        name: str | None = getattr(self, role)
        if name is None:
            return ()
        return (name, f"{name}/compressed") if role == "image" else (name,)


DEFAULT_TOPICS = TopicMap()
"""The names in Understudy's own recordings."""
