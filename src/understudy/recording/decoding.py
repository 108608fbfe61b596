"""From ROS 2 messages to the parts of an observation: our own recordings' and those of any robot's bag."""

import logging
import math
from typing import Literal, cast

import numpy as np
from numpy.typing import NDArray
from rosbags.typesys.stores import ros2_humble as ros

from understudy.errors import RecordingError
from understudy.geometry import Pose
from understudy.recording.images import decode_compressed, decode_raw
from understudy.recording.source import RawMessage
from understudy.recording.typestore import decode_message
from understudy.robot import Odometry, Scan

__all__ = [
    "decode",
    "image_of",
    "joint_fraction",
    "odometry_of",
    "place",
    "posture_of",
    "scan_of",
    "sonar_of",
    "speeds_of",
    "stamp_ns",
]

_log = logging.getLogger(__name__)


def place(path: object, raw: RawMessage) -> str:
    """Where a message stands, for errors."""
    return f"{path}: {raw.topic} at {raw.time_ns / 1e9:.3f} s"


def decode(path: object, raw: RawMessage) -> object:
    """A stored message, decoded.

    Raises:
        RecordingError: its bytes are not of its type.
    """
    return decode_message(raw.data, raw.type, where=place(path, raw))


def stamp_ns(header: ros.std_msgs__msg__Header) -> int:
    """A header's stamp; 0 where the driver did not set it."""
    return header.stamp.sec * 1_000_000_000 + header.stamp.nanosec


def scan_of(message: ros.sensor_msgs__msg__LaserScan, *, zero_is_free: bool = False) -> Scan:
    """The scan of a driver, whatever its geometry. The array is its own, not a view of the file.

    By REP 117 a reading below ``range_min``, -inf among them, tells that something is too near to be measured, and by
    older drivers' habit 0.0 tells that there is none. As a distance it would be an obstacle within the robot. Of a
    driver that gives 0.0 where nothing was met, ``zero_is_free`` says so.
    """
    ranges = np.array(message.ranges, np.float32)
    if zero_is_free:
        ranges[ranges == 0.0] = np.inf
    # Many drivers leave range_min at 0, and nothing is measured at no distance.
    ranges[(ranges < message.range_min) | (ranges <= 0.0)] = np.nan
    return Scan(
        ranges=ranges,
        angle_min=message.angle_min,
        angle_increment=message.angle_increment,
        range_max=message.range_max,
    )


def odometry_of(message: ros.nav_msgs__msg__Odometry) -> Odometry:
    """Planar odometry; the heading from the quaternion."""
    position, q = message.pose.pose.position, message.pose.pose.orientation
    heading = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
    twist = message.twist.twist
    return Odometry(pose=Pose(position.x, position.y, heading), linear=twist.linear.x, angular=twist.angular.z)


def sonar_of(path: object, raw: RawMessage) -> NDArray[np.float32]:
    """The ranges in a point cloud's float32 field, or channel, of this name.

    Raises:
        RecordingError: it has none.
    """
    message = decode(path, raw)
    if raw.type == "sensor_msgs/msg/PointCloud":
        channels = cast(ros.sensor_msgs__msg__PointCloud, message).channels
        for channel in channels:
            if channel.name == "range":
                return np.array(channel.values, np.float32)
        found = [channel.name for channel in channels]
    else:
        cloud = cast(ros.sensor_msgs__msg__PointCloud2, message)
        for entry in cloud.fields:
            if entry.name == "range" and entry.datatype == ros.sensor_msgs__msg__PointField.FLOAT32:
                return _cloud_column(cloud, entry.offset, where=place(path, raw))
        found = [entry.name for entry in cloud.fields]
    raise RecordingError(
        f"{place(path, raw)} has the fields {', '.join(found) or 'none'}; the sonars' need a float32 field named range:"
        " map another topic as sonar, or leave it out with TopicMap(sonar=None)"
    )


def image_of(path: object, raw: RawMessage) -> NDArray[np.uint8]:
    """An RGB image.

    Raises:
        RecordingError: it cannot be decoded.
    """
    message, where = decode(path, raw), place(path, raw)
    if raw.type == "sensor_msgs/msg/CompressedImage":
        compressed = cast(ros.sensor_msgs__msg__CompressedImage, message)
        return decode_compressed(compressed.data, compressed.format, where=where)
    image = cast(ros.sensor_msgs__msg__Image, message)
    return decode_raw(
        image.data, encoding=image.encoding, height=image.height, width=image.width, step=image.step, where=where
    )


def speeds_of(message: object, type_name: str) -> tuple[float, float]:
    """The speeds in a ``Twist`` or a ``TwistStamped``: forward, m/s, and turning, rad/s."""
    if type_name == "geometry_msgs/msg/TwistStamped":
        message = cast(ros.geometry_msgs__msg__TwistStamped, message).twist
    twist = cast(ros.geometry_msgs__msg__Twist, message)
    return twist.linear.x, twist.angular.z


def posture_of(
    message: ros.std_msgs__msg__String, *, where: str
) -> tuple[Literal["open", "close"] | None, Literal["up", "down"] | None]:
    """What a gripper is told in words: its paddles, its lift; None where they are left as they are."""
    paddles: Literal["open", "close"] | None = None
    lift: Literal["up", "down"] | None = None
    for word in message.data.lower().split():
        match word:
            case "open" | "close":
                paddles = word
            case "up" | "down":
                lift = word
            case _:
                _log.warning("%s: passed over %r; the words are open, close, up, down", where, word)
    return paddles, lift


def joint_fraction(positions: dict[str, float], name: str, start: float, end: float) -> float | None:
    """Where a joint stands between two positions, 0 to 1; None where it was never reported."""
    if name not in positions:
        return None
    return min(max((positions[name] - start) / (end - start), 0.0), 1.0)


def _cloud_column(cloud: ros.sensor_msgs__msg__PointCloud2, offset: int, *, where: str) -> NDArray[np.float32]:
    rows, used = cloud.height, cloud.width * cloud.point_step
    if cloud.row_step < used or cloud.data.size < rows * cloud.row_step or offset + 4 > cloud.point_step:
        raise RecordingError(f"{where} is a point cloud with too few bytes; record it again, or leave the topic out")
    points = cloud.data[: rows * cloud.row_step].reshape(rows, cloud.row_step)[:, :used].reshape(-1, cloud.point_step)
    column = np.ascontiguousarray(points[:, offset : offset + 4])
    return np.array(column.view(">f4" if cloud.is_bigendian else "<f4").ravel(), np.float32)
