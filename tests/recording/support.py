"""What several of the tests need: observations of every kind, the live run's bits, and bags of another robot."""

import math
import struct
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from mcap.writer import Writer
from numpy.typing import NDArray
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.stores import ros2_humble as ros

from understudy.geometry import Pose
from understudy.recording import Recorder
from understudy.robot import PIONEER, Cue, GripperReading, Observation, Odometry, Scan

STORE = get_typestore(Stores.ROS2_HUMBLE)

_anything = st.floats(width=64)
_ranges = st.floats(width=32) | st.sampled_from([math.inf, math.nan, 0.0, -0.0])
_times = st.floats(0, 2**31, exclude_max=True)
_images = hnp.arrays(np.uint8, st.tuples(st.integers(1, 9), st.integers(1, 9), st.just(3)))


def _arrays(max_size: int) -> st.SearchStrategy[NDArray[np.float32]]:
    return hnp.arrays(np.float32, st.integers(0, max_size), elements=_ranges)


observations = st.builds(
    Observation,
    time_s=_times,
    scan=st.builds(Scan, ranges=_arrays(12), angle_min=_anything, angle_increment=_anything, range_max=_anything),
    sonar=_arrays(20),
    image=st.none() | _images,
    odometry=st.builds(
        Odometry, pose=st.builds(Pose, _anything, _anything, _anything), linear=_anything, angular=_anything
    ),
    gripper=st.none() | st.builds(GripperReading, aperture=_anything, lift=_anything, beam_broken=st.booleans()),
    cues=st.lists(st.sampled_from(Cue), max_size=3).map(tuple),
)


def bits(obs: Observation) -> tuple[object, ...]:
    """Everything in an observation such that two are equal only if every bit is: NaN and -0.0, too."""

    def exactly(*numbers: float) -> bytes:
        return struct.pack(f"<{len(numbers)}d", *numbers)

    def array(values: NDArray[np.generic] | None) -> tuple[object, ...] | None:
        return None if values is None else (values.dtype, values.shape, values.tobytes())

    pose, scan, gripper = obs.odometry.pose, obs.scan, obs.gripper
    return (
        exactly(obs.time_s, pose.x, pose.y, pose.heading, obs.odometry.linear, obs.odometry.angular),
        exactly(scan.angle_min, scan.angle_increment, scan.range_max),
        array(scan.ranges),
        array(obs.sonar),
        array(obs.image),
        None if gripper is None else (exactly(gripper.aperture, gripper.lift), gripper.beam_broken),
        obs.cues,
    )


def drive(steps: int, seed: int = 0) -> list[Observation]:
    """A drive as a robot would sense it, 10 steps a second; small images, so that tests are quick."""
    rng = np.random.default_rng(seed)
    return [
        Observation(
            time_s=round(step * 0.1, 9),
            scan=Scan(ranges=(4 + rng.normal(0, 0.015, 181)).astype(np.float32)),
            sonar=rng.uniform(0.2, 5, 16).astype(np.float32),
            image=rng.integers(0, 32, (12, 16, 3), np.uint8) * 8 if step % 2 == 0 else None,
            odometry=Odometry(pose=Pose(0.03 * step, 0.1, 0.7 * step), linear=0.3, angular=0.1),
            gripper=GripperReading(aperture=0.4, lift=0.0, beam_broken=step % 3 == 0),
            cues=(Cue.HERE,) if step % 7 == 3 else (),
        )
        for step in range(steps)
    ]


def record(path: Path, obs: Iterable[Observation]) -> Path:
    with Recorder(
        path, kind="demonstration", name="test", spec=PIONEER, attachments={"world.yaml": b"seed: 4"}
    ) as into:
        for one in obs:
            into.observation(one)
    return path


class BagWriter:
    """Writes an MCAP as another robot's recorder would: any topic, any rate, no records of ours."""

    def __init__(self, path: Path, *, plain: bool = False) -> None:
        """``plain``: without chunks and without an index, as MCAP allows."""
        self._file = path.open("wb")
        self._writer = Writer(
            self._file,
            use_chunking=not plain,
            use_statistics=not plain,
            use_summary_offsets=not plain,
            repeat_channels=not plain,
            repeat_schemas=not plain,
        )
        self._writer.start(profile="ros2", library="another robot")
        self._channels: dict[str, int] = {}

    def write(self, topic: str, time_s: float, message: Any, encoding: str = "cdr") -> None:
        type_ = str(message.__msgtype__)
        if topic not in self._channels:
            text, _ = STORE.generate_msgdef(type_, ros_version=2)
            schema = self._writer.register_schema(type_, "ros2msg", text.encode())
            self._channels[topic] = self._writer.register_channel(topic, encoding, schema)
        time_ns = round(time_s * 1e9)
        self._writer.add_message(self._channels[topic], time_ns, bytes(STORE.serialize_cdr(message, type_)), time_ns)

    def close(self) -> None:
        self._writer.finish()  # type: ignore[no-untyped-call]
        self._file.close()


def header(time_s: float, frame: str = "") -> ros.std_msgs__msg__Header:
    seconds, rest = divmod(round(time_s * 1e9), 10**9)
    return ros.std_msgs__msg__Header(ros.builtin_interfaces__msg__Time(seconds, rest), frame)


def laser(time_s: float, ranges: Iterable[float] = (1.0, 2.0, 3.0)) -> ros.sensor_msgs__msg__LaserScan:
    """A laser unlike the Pioneer's: all around, 30 m."""
    return ros.sensor_msgs__msg__LaserScan(
        header=header(time_s, "base_laser"),
        angle_min=-3.0,
        angle_max=3.0,
        angle_increment=0.5,
        time_increment=0.0,
        scan_time=0.025,
        range_min=0.1,
        range_max=30.0,
        ranges=np.array(list(ranges), np.float32),
        intensities=np.zeros(0, np.float32),
    )


def odometry(time_s: float, x: float, heading: float) -> ros.nav_msgs__msg__Odometry:
    orientation = ros.geometry_msgs__msg__Quaternion(0.0, 0.0, math.sin(heading / 2), math.cos(heading / 2))
    pose = ros.geometry_msgs__msg__Pose(ros.geometry_msgs__msg__Point(x, 0.0, 0.0), orientation)
    return ros.nav_msgs__msg__Odometry(
        header=header(time_s, "odom"),
        child_frame_id="base_link",
        pose=ros.geometry_msgs__msg__PoseWithCovariance(pose, np.zeros(36)),
        twist=ros.geometry_msgs__msg__TwistWithCovariance(twist(0.25, -0.5), np.zeros(36)),
    )


def twist(linear: float, angular: float) -> ros.geometry_msgs__msg__Twist:
    return ros.geometry_msgs__msg__Twist(
        ros.geometry_msgs__msg__Vector3(linear, 0.0, 0.0), ros.geometry_msgs__msg__Vector3(0.0, 0.0, angular)
    )


def text(words: str) -> ros.std_msgs__msg__String:
    return ros.std_msgs__msg__String(words)


def picture(time_s: float, rgb: tuple[int, int, int], extension: str) -> ros.sensor_msgs__msg__CompressedImage:
    """A plain image of one color, compressed as compressed_image_transport does it."""
    _, data = cv2.imencode(extension, np.full((24, 32, 3), rgb[::-1], np.uint8))
    codec = {".jpg": "jpeg", ".png": "png"}[extension]
    return ros.sensor_msgs__msg__CompressedImage(
        header(time_s, "camera"), f"rgb8; {codec} compressed bgr8", np.asarray(data, np.uint8)
    )


def raw_picture(
    time_s: float, pixels: NDArray[np.uint8], encoding: str, padding: int = 0
) -> ros.sensor_msgs__msg__Image:
    """A raw image; every row is followed by ``padding`` bytes of rubbish."""
    height, width = pixels.shape[:2]
    rows = np.hstack([pixels.reshape(height, -1), np.full((height, padding), 255, np.uint8)])
    return ros.sensor_msgs__msg__Image(
        header(time_s), height, width, encoding, 0, rows.shape[1], np.ascontiguousarray(rows).ravel()
    )
