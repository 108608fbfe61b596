"""Our own two messages: the numbers of a control step to the last bit.

ROS conventions round: a stamp holds whole nanoseconds, a quaternion changes the last bits of a heading, a laser scan
has its angles in float32. A replay that shall decide exactly as the live run did needs the very same floats, so they
are written once more beside the conventional messages, as named float64 fields that a viewer can plot.
"""

from dataclasses import dataclass
from typing import Final, Literal, cast

from understudy.robot import Command, Observation

__all__ = [
    "COMMAND_TYPE",
    "DEFINITIONS",
    "OBSERVATION_TYPE",
    "ExactCommand",
    "ExactObservation",
]

OBSERVATION_TYPE: Final = "understudy_msgs/msg/Observation"
COMMAND_TYPE: Final = "understudy_msgs/msg/Command"

DEFINITIONS: Final[dict[str, str]] = {
    OBSERVATION_TYPE: """\
# Completes one control step: what the conventional messages before it round or leave out.
float64 time_s                # seconds since the robot's clock began
float64 x                     # odometry, metres
float64 y
float64 heading               # radians
float64 linear                # m/s
float64 angular               # rad/s
float64 scan_angle_min        # radians
float64 scan_angle_increment  # radians
float64 scan_range_max        # metres
bool has_image                # an image came with this step
bool has_gripper              # the next three mean something
float64 gripper_aperture      # 0 paddles together ... 1 fully open
float64 gripper_lift          # 0 on the floor ... 1 raised
bool gripper_beam_broken
string[] cues                 # the words heard since the last step
""",
    COMMAND_TYPE: """\
# What the robot was told for the control period that begins.
float64 time_s   # seconds since the robot's clock began
float64 linear   # m/s
float64 angular  # rad/s
string paddles   # open, close, or empty: leave them
string lift      # up, down, or empty: leave it
""",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class ExactObservation:
    """The fields of ``understudy_msgs/msg/Observation``."""

    time_s: float
    x: float
    y: float
    heading: float
    linear: float
    angular: float
    scan_angle_min: float
    scan_angle_increment: float
    scan_range_max: float
    has_image: bool
    has_gripper: bool
    gripper_aperture: float
    gripper_lift: float
    gripper_beam_broken: bool
    cues: list[str]

    @classmethod
    def of(cls, obs: Observation) -> "ExactObservation":
        """The message for an observation; its arrays go elsewhere."""
        pose, scan, gripper = obs.odometry.pose, obs.scan, obs.gripper
        return cls(
            time_s=obs.time_s,
            x=pose.x,
            y=pose.y,
            heading=pose.heading,
            linear=obs.odometry.linear,
            angular=obs.odometry.angular,
            scan_angle_min=scan.angle_min,
            scan_angle_increment=scan.angle_increment,
            scan_range_max=scan.range_max,
            has_image=obs.image is not None,
            has_gripper=gripper is not None,
            gripper_aperture=gripper.aperture if gripper else 0.0,
            gripper_lift=gripper.lift if gripper else 0.0,
            gripper_beam_broken=gripper.beam_broken if gripper else False,
            cues=[cue.value for cue in obs.cues],
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class ExactCommand:
    """The fields of ``understudy_msgs/msg/Command``."""

    time_s: float
    linear: float
    angular: float
    paddles: str
    lift: str

    @classmethod
    def of(cls, time_s: float, command: Command) -> "ExactCommand":
        """The message for a command."""
        return cls(
            time_s=time_s,
            linear=command.linear,
            angular=command.angular,
            paddles=command.paddles or "",
            lift=command.lift or "",
        )

    @staticmethod
    def to_command(message: "ExactCommand") -> Command:
        """The command again. Static, because a decoded message has these fields but not this class."""
        return Command(
            linear=message.linear,
            angular=message.angular,
            paddles=cast(Literal["open", "close"] | None, message.paddles or None),
            lift=cast(Literal["up", "down"] | None, message.lift or None),
        )
