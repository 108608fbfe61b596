"""The robot document: which topics a ROS 2 robot has, where its sensors sit, and how fast it may go (``robot/1``)."""

import math
from pathlib import Path
from typing import Annotated, Any, Final, Literal, Self

import yaml
from pydantic import Field, ValidationError, model_validator
from pydantic_core import PydanticCustomError

from understudy.documents import Name, Part, expect_kind, first_fault, read_data
from understudy.errors import RobotDocumentError
from understudy.geometry import Pose
from understudy.recording import GripperJoints, TopicMap
from understudy.robot import (
    DEADMAN_S,
    PIONEER,
    RGB,
    TURTLEBOT,
    CameraMount,
    Color,
    GripperGeometry,
    LaserMount,
    RobotSpec,
)

__all__ = ["RobotDocument", "find_robot", "load_robot", "parse_robot", "robot_names", "robot_schema"]

_KIND: Final = "robot/1"
_BUNDLED = Path(__file__).parent / "robots"

Topic = Annotated[str, Field(pattern=r"^/[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*$")]
"""A topic's whole name, ``/scan``."""

Length = Annotated[float, Field(gt=0, le=100, allow_inf_nan=False)]
Place = Annotated[float, Field(ge=-10, le=10, allow_inf_nan=False)]
Angle = Annotated[float, Field(ge=-360, le=360, allow_inf_nan=False)]
Position = Annotated[float, Field(allow_inf_nan=False)]
Channel = Annotated[int, Field(ge=0, le=255)]
Paint = tuple[Channel, Channel, Channel]
Reliability = Literal["best_effort", "reliable"]
"""What a reader asks for: best effort takes all that is sent, reliable refuses who does not repeat what was lost."""

_SIMULATION_DEADMAN_S: Final = 10.0

_CAMERA = TURTLEBOT.camera
assert PIONEER.gripper is not None
_HAND: GripperGeometry = PIONEER.gripper


class Body(Part):
    """How large the robot is, metres; a round one is as long as it is wide."""

    length: Length = TURTLEBOT.length
    width: Length = TURTLEBOT.width
    height: Length = TURTLEBOT.height


class Limits(Part):
    """How fast the robot may go, m/s and rad/s, and how fast that may change, per second."""

    linear: Length = TURTLEBOT.max_linear
    angular: Length = TURTLEBOT.max_angular
    linear_acceleration: Length = TURTLEBOT.max_linear_acceleration
    angular_acceleration: Length = TURTLEBOT.max_angular_acceleration


class Laser(Part):
    """The laser: its topic, and where it sits in ``base_link``.

    Attributes:
        zero: what a reading of 0.0 means: ``unusable``, or that ``nothing`` was met, as some cheap lasers have it.
        x: metres before the point about which the robot turns.
        height: metres.
        yaw_deg: direction of its angle 0, left positive.
        upside_down: it is mounted so.
    """

    topic: Topic = "/scan"
    reliability: Reliability = "best_effort"
    zero: Literal["unusable", "nothing"] = "unusable"
    x: Place = TURTLEBOT.laser.x
    height: Length = TURTLEBOT.laser.height
    yaw_deg: Angle = 0.0
    upside_down: bool = False


class OdometryTopic(Part):
    """Dead reckoning."""

    topic: Topic = "/odom"
    reliability: Reliability = "best_effort"


class Camera(Part):
    """The camera: its topic, where it sits and how it looks.

    Attributes:
        topic: of raw images; compressed ones are at the same with ``/compressed``.
        message: ``raw``, ``compressed``, or whichever of them is there.
        info: a ``sensor_msgs/CameraInfo``, against which the doctor holds these numbers.
        x: metres before the point about which the robot turns.
        height: metres.
        tilt_deg: downward.
        field_deg: horizontal field of view.
        width: pixels to which pictures are reduced.
        rows: pixels to which pictures are reduced; of the same shape as the camera's.
    """

    topic: Topic = "/camera/image_raw"
    message: Literal["detect", "raw", "compressed"] = "detect"
    info: Topic | None = "/camera/camera_info"
    reliability: Reliability = "best_effort"
    x: Place = _CAMERA.x
    height: Length = _CAMERA.height
    tilt_deg: Annotated[float, Field(ge=-45, le=80)] = round(math.degrees(_CAMERA.tilt), 3)
    field_deg: Annotated[float, Field(ge=10, le=150)] = round(math.degrees(_CAMERA.field), 3)
    width: Annotated[int, Field(ge=40, le=640)] = _CAMERA.width
    rows: Annotated[int, Field(ge=30, le=480)] = _CAMERA.rows


class Drive(Part):
    """Where the robot takes its speeds.

    Attributes:
        message: ``detect`` takes the type that the robot listens for.
    """

    topic: Topic = "/cmd_vel"
    message: Literal["detect", "Twist", "TwistStamped"] = "detect"


class Joint(Part):
    """A joint of the gripper, with two of its positions in its own unit."""

    joint: Name
    low: Position
    high: Position

    @model_validator(mode="after")
    def _two_ends(self) -> Self:
        if self.low == self.high:
            raise PydanticCustomError("one_end", "low and high must be two different positions of the joint")
        return self


class Gripper(Part):
    """A gripper in front of the robot, told by words on a topic.

    Attributes:
        command: a ``std_msgs/String`` with ``open``, ``close``, ``up``, ``down``.
        joint_states: where its joints' positions are told.
        finger: ``low`` when the paddles touch, ``high`` when they are fully open.
        lift: ``low`` on the floor, ``high`` when raised; a gripper without one counts as raised.
        beam: a ``std_msgs/Bool``, true while something stands between the paddles.
        x_back: where the paddles begin, metres before the point about which the robot turns.
        x_front: where they end.
        x_beam: where the beam crosses between them.
        opening: metres between them.
        lift_height: metres by which they are raised.
    """

    command: Topic = "/gripper/command"
    joint_states: Topic = "/joint_states"
    finger: Joint = Joint(joint="gripper_finger_joint", low=0.0, high=_HAND.opening)
    lift: Joint | None = Joint(joint="gripper_lift_joint", low=0.0, high=_HAND.lift_height)
    beam: Topic = "/gripper/beam"
    x_back: Place = _HAND.x_back
    x_front: Place = _HAND.x_front
    x_beam: Place = _HAND.x_beam
    opening: Length = _HAND.opening
    lift_height: Length = _HAND.lift_height


class Sonar(Part):
    """Sonars in one point cloud with a field ``range``.

    Attributes:
        poses: of each sonar in the order of the cloud: metres, metres, degrees.
        height: metres.
        range: metres.
        cone_deg: the angle of its cone.
    """

    topic: Topic = "/sonar"
    reliability: Reliability = "best_effort"
    poses: Annotated[list[tuple[Place, Place, Angle]], Field(min_length=1)]
    height: Length = PIONEER.sonar_height
    range: Length = PIONEER.sonar_range
    cone_deg: Annotated[float, Field(gt=0, le=90)] = round(math.degrees(PIONEER.sonar_cone), 3)


class RobotDocument(Part):
    """A robot that speaks ROS 2. What is left out is as TurtleBot-like robots have it.

    Attributes:
        name: what it is called.
        note: anything a person should know of it.
        domain: the ROS domain; None takes ``ROS_DOMAIN_ID``, or 0.
        transport: ``cyclonedds`` needs no ROS; ``rclpy`` is ROS's own; ``detect`` takes rclpy where it is there.
        clock: ``wall`` for a real robot; ``sim`` for one whose time may stand still or run fast.
        colors: how its camera sees the trained colors, red, green and blue from 0 to 255; ``understudy calibrate``
            finds it out. Those that are left out are as in plain light.
        cues: a ``std_msgs/String`` with the teacher's words.
        emergency_stop: a ``std_msgs/Bool``; true stops the robot and ends the run.
    """

    understudy: Literal["robot/1"] = _KIND
    name: Name = TURTLEBOT.name
    note: str | None = None
    domain: Annotated[int, Field(ge=0, le=232)] | None = None
    transport: Literal["detect", "cyclonedds", "rclpy"] = "detect"
    clock: Literal["wall", "sim"] = "wall"
    body: Body = Body()
    limits: Limits = Limits()
    laser: Laser = Laser()
    odometry: OdometryTopic = OdometryTopic()
    camera: Camera = Camera()
    drive: Drive = Drive()
    gripper: Gripper | None = None
    sonar: Sonar | None = None
    colors: dict[Color, Paint] = {}
    cues: Topic | None = "/cues"
    emergency_stop: Topic | None = "/emergency_stop"

    @property
    def deadman_s(self) -> float:
        """Without fresh readings, or without a decision, for so long the robot is stopped; seconds on our clock.

        Between two steps of a simulation any time may pass.
        """
        return DEADMAN_S if self.clock == "wall" else _SIMULATION_DEADMAN_S

    @property
    def spec(self) -> RobotSpec:
        """What the robot is made of."""
        hand, sonar = self.gripper, self.sonar
        return RobotSpec(
            name=self.name,
            length=self.body.length,
            width=self.body.width,
            height=self.body.height,
            mass=TURTLEBOT.mass,
            max_linear=self.limits.linear,
            max_angular=self.limits.angular,
            max_linear_acceleration=self.limits.linear_acceleration,
            max_angular_acceleration=self.limits.angular_acceleration,
            laser=LaserMount(
                x=self.laser.x,
                height=self.laser.height,
                rays=TURTLEBOT.laser.rays,
                range_max=TURTLEBOT.laser.range_max,
                noise_std=TURTLEBOT.laser.noise_std,
            ),
            camera=CameraMount(
                x=self.camera.x,
                height=self.camera.height,
                tilt=math.radians(self.camera.tilt_deg),
                field=math.radians(self.camera.field_deg),
                width=self.camera.width,
                rows=self.camera.rows,
            ),
            gripper=GripperGeometry(
                x_back=hand.x_back,
                x_front=hand.x_front,
                x_beam=hand.x_beam,
                opening=hand.opening,
                lift_height=hand.lift_height,
            )
            if hand is not None
            else None,
            sonar_poses=tuple(Pose(x, y, math.radians(deg)) for x, y, deg in sonar.poses) if sonar is not None else (),
            sonar_height=sonar.height if sonar is not None else 0.0,
            sonar_range=sonar.range if sonar is not None else 0.0,
            sonar_cone=math.radians(sonar.cone_deg) if sonar is not None else 0.0,
            paints=tuple(self.colors.get(color, RGB[color]) for color in Color),
        )

    @property
    def topics(self) -> TopicMap:
        """The names under which the robot's own bags hold its messages, too."""
        hand = self.gripper
        return TopicMap(
            scan=self.laser.topic,
            odom=self.odometry.topic,
            sonar=self.sonar.topic if self.sonar is not None else None,
            image=self.camera.topic,
            joint_states=hand.joint_states if hand is not None else None,
            beam=hand.beam if hand is not None else None,
            cues=self.cues,
            cmd_vel=self.drive.topic,
            gripper_command=hand.command if hand is not None else None,
            joints=_joints(hand) if hand is not None else GripperJoints(),
            zero_is_free=self.laser.zero == "nothing",
        )

    def to_yaml(self) -> str:
        """The document's text, with all that was left out."""
        return yaml.safe_dump(self.model_dump(mode="json"), sort_keys=False)


def _joints(hand: Gripper) -> GripperJoints:
    lift = hand.lift or Joint(joint="", low=0.0, high=1.0)  # no joint is called so: it counts as raised
    return GripperJoints(
        finger=hand.finger.joint,
        finger_closed=hand.finger.low,
        finger_open=hand.finger.high,
        lift=lift.joint,
        lift_down=lift.low,
        lift_up=lift.high,
    )


def parse_robot(data: Any, *, source: str) -> RobotDocument:
    """The robot in a document's plain data.

    Args:
        data: a mapping.
        source: the document's name, for messages.

    Raises:
        RobotDocumentError: it is malformed.
    """
    expect_kind(data, _KIND, source=source, kind=RobotDocumentError)
    try:
        return RobotDocument.model_validate(data)
    except ValidationError as error:
        raise first_fault(error, source, RobotDocumentError) from None


def load_robot(path: str | Path) -> RobotDocument:
    """The robot of a document's file.

    Raises:
        RobotDocumentError: the file cannot be read, or the document is malformed.
    """
    return parse_robot(read_data(path, RobotDocumentError), source=str(path))


def robot_names() -> tuple[str, ...]:
    """The robots that come with the program."""
    return tuple(sorted(path.stem for path in _BUNDLED.glob("*.yaml")))


def find_robot(name: str | Path) -> RobotDocument:
    """The robot of a document, or a bundled one by its name.

    Raises:
        RobotDocumentError: there is neither, or the document is malformed.
    """
    path = Path(name)
    if not path.exists() and str(name) in robot_names():
        path = _BUNDLED / f"{name}.yaml"
    elif not path.exists() and not path.suffix:
        raise RobotDocumentError(
            f"there is no such file, and no such robot among: {', '.join(robot_names())}", source=str(name)
        )
    return load_robot(path)


def robot_schema() -> dict[str, Any]:
    """The JSON Schema of a robot document."""
    return RobotDocument.model_json_schema()
