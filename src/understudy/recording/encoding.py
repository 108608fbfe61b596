"""From observations and commands to the ROS 2 messages that a recording holds (REP 103, 105, 117)."""

import math
from collections.abc import Iterator
from ctypes import c_float
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys.stores import ros2_humble as ros

from understudy.clock import CONTROL_PERIOD_S
from understudy.errors import RecordingError
from understudy.recording.exact import COMMAND_TYPE, OBSERVATION_TYPE, ExactCommand, ExactObservation
from understudy.recording.images import PNG_FORMAT, encode_png
from understudy.recording.topics import COMMAND_TOPIC, DEFAULT_TOPICS, OBSERVATION_TOPIC
from understudy.robot import Command, GripperGeometry, GripperReading, Observation, RobotSpec

__all__ = [
    "CommandEncoder",
    "ObservationEncoder",
    "TopicMessage",
    "nanoseconds",
    "stamp_of",
    "string_message",
    "twist_of",
]

_LATEST_S: Final = 2**31
"""A ROS 2 stamp counts its seconds in an int32."""

_TF_TYPE: Final = "tf2_msgs/msg/TFMessage"
_COVARIANCE: Final = np.zeros(36)
_NO_FLOATS: Final = np.zeros(0)
_NO_FLOATS32: Final = np.zeros(0, np.float32)
_CLOUD_FIELDS: Final = [
    ros.sensor_msgs__msg__PointField(
        name=name, offset=4 * index, datatype=ros.sensor_msgs__msg__PointField.FLOAT32, count=1
    )
    for index, name in enumerate(("x", "y", "z", "range"))
]


class TopicMessage(NamedTuple):
    """A message on its way to a topic; ``type`` is the full name, ``sensor_msgs/msg/LaserScan``."""

    topic: str
    type: str
    message: object


def nanoseconds(time_s: float) -> int:
    """A time as recordings count it.

    Raises:
        RecordingError: the time is not a number from 0 to 2³¹ s, or not a number at all.
    """
    if not 0 <= time_s < _LATEST_S:
        raise RecordingError(
            f"t={time_s} s cannot be recorded; times are seconds since the robot's clock began, from 0 to {_LATEST_S}"
        )
    return round(time_s * 1e9)


class ObservationEncoder:
    """Makes a robot's observations into messages.

    Args:
        spec: places the sonars' echoes and scales the gripper's joints.
        live: for a network, as drivers publish: images raw and with the camera's numbers, and no exact message.
    """

    def __init__(self, spec: RobotSpec, *, live: bool = False) -> None:
        self._spec = spec
        self._live = live
        self._sonar_places = np.array([(p.x, p.y) for p in spec.sonar_poses], np.float64).reshape(-1, 2)
        self._sonar_directions = np.array(
            [(math.cos(p.heading), math.sin(p.heading)) for p in spec.sonar_poses], np.float64
        ).reshape(-1, 2)
        self._mounts_told = False

    def messages(self, obs: Observation) -> Iterator[TopicMessage]:
        """One control step. In a recording the exact message comes last: a step without it is not whole.

        Raises:
            RecordingError: an array has another type or shape than the contract says, so it could not come back equal.
        """
        _check_array("scan.ranges", obs.scan.ranges)
        _check_array("sonar", obs.sonar)
        stamp = stamp_of(nanoseconds(obs.time_s))
        yield TopicMessage("/scan", "sensor_msgs/msg/LaserScan", _scan(obs, stamp))
        yield TopicMessage("/sonar", "sensor_msgs/msg/PointCloud2", self._sonar(obs.sonar, stamp))
        odometry = _odometry(obs, stamp)
        yield TopicMessage("/odom", "nav_msgs/msg/Odometry", odometry)
        yield TopicMessage("/tf", _TF_TYPE, _tf(_moved(odometry)))
        if not self._mounts_told:
            yield TopicMessage("/tf_static", _TF_TYPE, _tf(*_mounts(self._spec, stamp)))
        if obs.image is not None and self._live:
            yield TopicMessage("/camera/image_raw", "sensor_msgs/msg/Image", _raw_image(obs.image, stamp))
            yield TopicMessage("/camera/camera_info", "sensor_msgs/msg/CameraInfo", _camera_info(self._spec, stamp))
        elif obs.image is not None:
            image = ros.sensor_msgs__msg__CompressedImage(
                header=_header(stamp, "camera"), format=PNG_FORMAT, data=encode_png(obs.image)
            )
            yield TopicMessage("/camera/image_raw/compressed", "sensor_msgs/msg/CompressedImage", image)
        if obs.gripper is not None:
            beam = ros.std_msgs__msg__Bool(data=obs.gripper.beam_broken)
            yield TopicMessage("/gripper/beam", "std_msgs/msg/Bool", beam)
            if self._spec.gripper is not None:
                joints = _joints(obs.gripper, self._spec.gripper, stamp)
                yield TopicMessage("/joint_states", "sensor_msgs/msg/JointState", joints)
        for cue in obs.cues:
            yield string_message("/cues", cue.value)
        if not self._live:
            yield TopicMessage(OBSERVATION_TOPIC, OBSERVATION_TYPE, ExactObservation.of(obs))
        self._mounts_told = (
            True  # not before all messages of the step could be made: it is recorded whole or not at all
        )

    def _sonar(self, ranges: NDArray[np.float32], stamp: ros.builtin_interfaces__msg__Time) -> object:
        """The echoes as points for viewers, and the ranges themselves.

        A point without an echo, or of a sonar whose place the spec does not tell, is NaN, as point clouds have it; its
        range is kept all the same.
        """
        points = np.full((ranges.size, 4), np.nan, np.float32)
        points[:, 3] = ranges
        placed = min(ranges.size, len(self._sonar_places))
        reach = ranges[:placed].astype(np.float64)
        reach[~np.isfinite(reach)] = np.nan
        with np.errstate(over="ignore"):
            points[:placed, :2] = self._sonar_places[:placed] + reach[:, np.newaxis] * self._sonar_directions[:placed]
        points[:placed, 2] = self._spec.sonar_height
        return ros.sensor_msgs__msg__PointCloud2(
            header=_header(stamp, "base_link"),
            height=1,
            width=ranges.size,
            fields=_CLOUD_FIELDS,
            is_bigendian=False,
            point_step=16,
            row_step=16 * ranges.size,
            data=points.astype("<f4", copy=False).view(np.uint8).ravel(),
            is_dense=False,
        )


class CommandEncoder:
    """Makes a robot's commands into messages; remembers what the gripper was told last."""

    def __init__(self) -> None:
        self._told: tuple[str | None, str | None] = (None, None)

    def messages(self, time_s: float, command: Command) -> Iterator[TopicMessage]:
        """One command, as a ROS 2 robot would be told, and exactly. The gripper is told only what is new to it."""
        paddles, lift = self._told
        told = (command.paddles or paddles, command.lift or lift)
        if told != self._told:
            words = " ".join(word for word in (command.paddles, command.lift) if word)
            yield string_message("/gripper/command", words)
        twist = twist_of(command.linear, command.angular)
        yield TopicMessage("/cmd_vel", "geometry_msgs/msg/Twist", twist)
        yield TopicMessage(COMMAND_TOPIC, COMMAND_TYPE, ExactCommand.of(time_s, command))
        self._told = told  # not before all messages could be made: a command is recorded whole or not at all


def string_message(topic: str, text: str) -> TopicMessage:
    """A ``std_msgs/String``."""
    return TopicMessage(topic, "std_msgs/msg/String", ros.std_msgs__msg__String(data=text))


def _check_array(name: str, array: NDArray[np.float32]) -> None:
    if array.dtype != np.float32 or array.ndim != 1:
        raise RecordingError(
            f"{name} is {array.dtype} of shape {array.shape}; an observation's must be float32 of one dimension,"
            " or the recording would not be equal to it"
        )


def stamp_of(time_ns: int) -> ros.builtin_interfaces__msg__Time:
    """A time in nanoseconds as a message's stamp."""
    seconds, rest = divmod(time_ns, 1_000_000_000)
    return ros.builtin_interfaces__msg__Time(sec=seconds, nanosec=rest)


def _header(stamp: ros.builtin_interfaces__msg__Time, frame: str) -> ros.std_msgs__msg__Header:
    return ros.std_msgs__msg__Header(stamp=stamp, frame_id=frame)


def _scan(obs: Observation, stamp: ros.builtin_interfaces__msg__Time) -> object:
    scan = obs.scan
    return ros.sensor_msgs__msg__LaserScan(
        header=_header(stamp, "laser"),
        angle_min=_float32(scan.angle_min),
        angle_max=_float32(scan.angle_min + scan.angle_increment * max(scan.ranges.size - 1, 0)),
        angle_increment=_float32(scan.angle_increment),
        time_increment=0.0,
        scan_time=CONTROL_PERIOD_S,
        range_min=0.0,
        range_max=_float32(scan.range_max),
        ranges=scan.ranges,
        intensities=_NO_FLOATS32,
    )


def _raw_image(image: NDArray[np.uint8], stamp: ros.builtin_interfaces__msg__Time) -> object:
    rows, width, _ = image.shape
    return ros.sensor_msgs__msg__Image(
        header=_header(stamp, "camera"),
        height=rows,
        width=width,
        encoding="rgb8",
        is_bigendian=0,
        step=3 * width,
        data=np.ascontiguousarray(image).reshape(-1),
    )


def _camera_info(spec: RobotSpec, stamp: ros.builtin_interfaces__msg__Time) -> object:
    """A pinhole without distortion."""
    camera = spec.camera
    focal, column, row = camera.focal_px, (camera.width - 1) / 2, (camera.rows - 1) / 2
    return ros.sensor_msgs__msg__CameraInfo(
        header=_header(stamp, "camera"),
        height=camera.rows,
        width=camera.width,
        distortion_model="plumb_bob",
        d=np.zeros(5),
        k=np.array([focal, 0.0, column, 0.0, focal, row, 0.0, 0.0, 1.0]),
        r=np.eye(3).reshape(-1),
        p=np.array([focal, 0.0, column, 0.0, 0.0, focal, row, 0.0, 0.0, 0.0, 1.0, 0.0]),
        binning_x=0,
        binning_y=0,
        roi=ros.sensor_msgs__msg__RegionOfInterest(x_offset=0, y_offset=0, height=0, width=0, do_rectify=False),
    )


def _joints(reading: GripperReading, gripper: GripperGeometry, stamp: ros.builtin_interfaces__msg__Time) -> object:
    return ros.sensor_msgs__msg__JointState(
        header=_header(stamp, ""),
        name=[DEFAULT_TOPICS.joints.finger, DEFAULT_TOPICS.joints.lift],
        position=np.array([reading.aperture * gripper.opening, reading.lift * gripper.lift_height], np.float64),
        velocity=_NO_FLOATS,
        effort=_NO_FLOATS,
    )


def _odometry(obs: Observation, stamp: ros.builtin_interfaces__msg__Time) -> ros.nav_msgs__msg__Odometry:
    pose = obs.odometry.pose
    # A broken wheel encoder's reading is recorded as it is; sin and cos alone refuse infinity.
    half = pose.heading / 2 if math.isfinite(pose.heading) else math.nan
    return ros.nav_msgs__msg__Odometry(
        header=_header(stamp, "odom"),
        child_frame_id="base_link",
        pose=ros.geometry_msgs__msg__PoseWithCovariance(
            pose=ros.geometry_msgs__msg__Pose(
                position=ros.geometry_msgs__msg__Point(x=pose.x, y=pose.y, z=0.0),
                orientation=ros.geometry_msgs__msg__Quaternion(x=0.0, y=0.0, z=math.sin(half), w=math.cos(half)),
            ),
            covariance=_COVARIANCE,
        ),
        twist=ros.geometry_msgs__msg__TwistWithCovariance(
            twist=twist_of(obs.odometry.linear, obs.odometry.angular), covariance=_COVARIANCE
        ),
    )


def _moved(odometry: ros.nav_msgs__msg__Odometry) -> ros.geometry_msgs__msg__TransformStamped:
    pose = odometry.pose.pose
    return ros.geometry_msgs__msg__TransformStamped(
        header=odometry.header,
        child_frame_id=odometry.child_frame_id,
        transform=ros.geometry_msgs__msg__Transform(
            translation=ros.geometry_msgs__msg__Vector3(x=pose.position.x, y=pose.position.y, z=0.0),
            rotation=pose.orientation,
        ),
    )


def _mounts(
    spec: RobotSpec, stamp: ros.builtin_interfaces__msg__Time
) -> Iterator[ros.geometry_msgs__msg__TransformStamped]:
    """Where the laser and the camera sit; the camera as images have it: z into the picture, x right, y down."""
    # Forward to z, left to -x, up to -y; and about the camera's x-axis by as much as it looks down.
    down = math.pi / 4 + spec.camera.tilt / 2
    along, across = math.cos(math.pi / 4), math.sin(math.pi / 4)
    placed = (
        ("laser", spec.laser.x, spec.laser.height, (0.0, 0.0, 0.0, 1.0)),
        (
            "camera",
            spec.camera.x,
            spec.camera.height,
            (-along * math.sin(down), across * math.sin(down), -across * math.cos(down), along * math.cos(down)),
        ),
    )
    for frame, x, height, (qx, qy, qz, qw) in placed:
        yield ros.geometry_msgs__msg__TransformStamped(
            header=_header(stamp, "base_link"),
            child_frame_id=frame,
            transform=ros.geometry_msgs__msg__Transform(
                translation=ros.geometry_msgs__msg__Vector3(x=x, y=0.0, z=height),
                rotation=ros.geometry_msgs__msg__Quaternion(x=qx, y=qy, z=qz, w=qw),
            ),
        )


def _tf(*transforms: ros.geometry_msgs__msg__TransformStamped) -> ros.tf2_msgs__msg__TFMessage:
    return ros.tf2_msgs__msg__TFMessage(transforms=list(transforms))


def twist_of(linear: float, angular: float) -> ros.geometry_msgs__msg__Twist:
    """Speeds as ROS 2 has them, m/s and rad/s."""
    return ros.geometry_msgs__msg__Twist(
        linear=ros.geometry_msgs__msg__Vector3(x=linear, y=0.0, z=0.0),
        angular=ros.geometry_msgs__msg__Vector3(x=0.0, y=0.0, z=angular),
    )


def _float32(value: float) -> float:
    # What float32 cannot hold, the serialiser refuses; this makes it infinite. The exact message has the value itself.
    return c_float(value).value
