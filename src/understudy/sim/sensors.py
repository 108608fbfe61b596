"""Laser, sonars, odometry and gripper of one simulated robot, each with its errors."""

import math
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from understudy.clock import CONTROL_PERIOD_S
from understudy.geometry import Point, Pose, wrap_angle
from understudy.robot import GripperReading, Odometry, Scan
from understudy.sim.body import RobotBody
from understudy.sim.mjcf import GRIPPER_HEIGHT_M, GROUP_BOXES, GROUP_SOLID
from understudy.sim.noise import NoiseLevels

__all__ = ["GripperSensor", "Laser", "SonarRing", "WheelOdometry"]

_SONAR_RAYS = (-0.5, 0.0, 0.5)
"""Directions within a sonar's cone, as shares of its angle: the nearest echo counts."""


def _only(group: int) -> NDArray[np.uint8]:
    mask = np.zeros(6, np.uint8)
    mask[group] = 1
    return mask


class _Fan:
    """Level rays from one point of a robot, met by everything solid but the robot itself."""

    def __init__(self, model: Any, data: Any, body: RobotBody, *, at: Point, height: float, angles: ArrayLike) -> None:
        self._model, self._data, self._robot = model, data, body.index.body
        self._at = at
        directions = np.asarray(angles, np.float64)
        rays = directions.size
        self._local = np.stack([np.cos(directions), np.sin(directions)], axis=1)
        self._origin = np.array([0.0, 0.0, height])
        self._turned = np.zeros((2, 3))
        self._directions = np.zeros((rays, 3))
        self._flat = self._directions.reshape(-1)
        self._geoms = np.zeros(rays, np.int32)
        self._distances = np.zeros(rays)
        self._groups = _only(GROUP_SOLID)

    def cast(self, pose: Pose, reach: float) -> NDArray[np.float64]:
        """Metres to what each ray meets, negative where it meets nothing; the array is reused."""
        # Number by number: handing tuples over to NumPy costs more.
        origin, turned = self._origin, self._turned
        origin[0], origin[1] = pose.to_parent(self._at)
        c, s = math.cos(pose.heading), math.sin(pose.heading)
        turned[0, 0], turned[0, 1] = c, s
        turned[1, 0], turned[1, 1] = -s, c
        np.dot(self._local, turned, out=self._directions)
        mujoco.mj_multiRay(
            self._model,
            self._data,
            origin,
            self._flat,
            self._groups,
            1,
            self._robot,
            self._geoms,
            self._distances,
            None,
            self._geoms.size,
            reach,
        )
        return self._distances


class Laser:
    """The laser of the spec: the SICK LMS 200 has one ray a degree across the forward half plane."""

    def __init__(self, model: Any, data: Any, body: RobotBody, noise: NoiseLevels, rng: np.random.Generator) -> None:
        mount = body.spec.laser
        self._range, self._std, self._rng = mount.range_max, noise.laser, rng
        # A sweep all around ends before it would give its first ray once more.
        gaps = mount.rays if mount.sweep >= math.tau else mount.rays - 1
        self._angle_min, self._increment = -mount.sweep / 2, mount.sweep / gaps
        angles = self._angle_min + self._increment * np.arange(mount.rays)
        self._fan = _Fan(model, data, body, at=Point(mount.x, 0.0), height=mount.height, angles=angles)

    def scan(self, pose: Pose) -> Scan:
        """One sweep of a robot at this true pose."""
        met = self._fan.cast(pose, self._range)
        ranges = self._rng.standard_normal(met.size, np.float32)
        ranges *= self._std
        ranges += met
        np.maximum(ranges, 0.0, out=ranges)
        missed = ranges > self._range
        missed |= met < 0.0
        ranges[missed] = np.inf
        return Scan(ranges=ranges, angle_min=self._angle_min, angle_increment=self._increment, range_max=self._range)


class SonarRing:
    """The sonars of the spec; each gives the nearest echo within its cone.

    All rays start at the robot's centre, and the way to the ring is taken off: the sonars look straight outward, so
    that this shifts a ray by 4 cm at most, and one fan of rays costs a tenth of sixteen.
    """

    def __init__(self, model: Any, data: Any, body: RobotBody, noise: NoiseLevels, rng: np.random.Generator) -> None:
        spec = body.spec
        self._range, self._std, self._rng = spec.sonar_range, noise.sonar, rng
        self._offsets = np.array([pose.position.distance for pose in spec.sonar_poses])
        self._reach = spec.sonar_range + float(self._offsets.max(initial=0.0))
        angles = [pose.heading + share * spec.sonar_cone for pose in spec.sonar_poses for share in _SONAR_RAYS]
        self._fan = _Fan(model, data, body, at=Point(0.0, 0.0), height=spec.sonar_height, angles=angles)

    def ranges(self, pose: Pose) -> NDArray[np.float32]:
        """Metres from each sonar of a robot at this true pose, ``inf`` for no echo."""
        if not self._offsets.size:
            return np.zeros(0, np.float32)
        met = self._fan.cast(pose, self._reach)
        met[met < 0.0] = np.inf
        nearest = np.minimum.reduce(met.reshape(-1, len(_SONAR_RAYS)), axis=1) - self._offsets
        echo = self._std * self._rng.standard_normal(nearest.size)
        echo += nearest
        np.maximum(echo, 0.0, out=echo)
        echo[nearest > self._range] = np.inf
        ranges: NDArray[np.float32] = echo.astype(np.float32)
        return ranges


class WheelOdometry:
    """Dead reckoning from the wheels.

    The wheels' scale is a little wrong, the same way all through a run; the heading drifts at random on top.
    """

    def __init__(self, start: Pose, noise: NoiseLevels, rng: np.random.Generator) -> None:
        self._rng = rng
        self._drift = noise.odometry_heading
        distance_error, turn_error = (noise.odometry_scale * rng.standard_normal(2)).tolist()
        self._distance_scale, self._turn_scale = 1.0 + distance_error, 1.0 + turn_error
        self._true = start
        self.reading = Odometry()

    def advance(self, true: Pose) -> None:
        """Takes in the motion of one control period."""
        forward = self._true.to_local(true.position).x * self._distance_scale
        turn = wrap_angle(true.heading - self._true.heading) * self._turn_scale
        self._true = true
        # A random walk: its variance, not its deviation, grows with the way.
        turn += self._drift * math.sqrt(abs(forward) + abs(turn)) * self._rng.standard_normal()
        self.reading = Odometry(
            pose=self.reading.pose.moved(forward, turn),
            linear=forward / CONTROL_PERIOD_S,
            angular=turn / CONTROL_PERIOD_S,
        )

    def carried_to(self, true: Pose) -> None:
        """The robot was lifted and put down elsewhere: its wheels noticed nothing."""
        self._true = true


_PRESSED_M = 0.005
"""How far both paddles together may be pressed into a box by the soft contacts of the physics."""


class GripperSensor:
    """Paddles' and lift's positions, and the infrared beam between the paddles (A.1)."""

    def __init__(self, model: Any, data: Any, body: RobotBody, noise: NoiseLevels, rng: np.random.Generator) -> None:
        self._model, self._data, self._body = model, data, body
        self._misreads, self._rng = noise.beam_misreads, rng
        self._groups = _only(GROUP_BOXES)
        self._geom = np.zeros(1, np.int32)
        self._origin, self._across = np.zeros(3), np.zeros(3)

    def read(self, pose: Pose) -> GripperReading | None:
        """The gripper of a robot at this true pose, as its own sensors give it; None without one."""
        gripper = self._body.spec.gripper
        if gripper is None:
            return None
        left, right = self._body.paddles
        lift = self._body.lift
        misread = self._rng.random() < self._misreads
        return GripperReading(
            aperture=min(1.0, max(0.0, (left + right) / gripper.opening)),
            lift=min(1.0, max(0.0, lift / gripper.lift_height)),
            beam_broken=self._beam_broken(pose, Point(gripper.x_beam, left), left + right, lift) != misread,
        )

    def _beam_broken(self, pose: Pose, start: Point, opening: float, lift: float) -> bool:
        """The truth about the beam, which begins at ``start`` in the robot's frame, on the left paddle."""
        origin, across = self._origin, self._across
        origin[0], origin[1] = pose.to_parent(start)
        origin[2] = GRIPPER_HEIGHT_M + lift
        across[0], across[1] = math.sin(pose.heading), -math.cos(pose.heading)
        met = mujoco.mj_ray(
            self._model, self._data, origin, across, self._groups, 1, self._body.index.body, self._geom, None
        )
        # Paddles that grip hard are pressed into the box: the ray then begins inside it and meets its far side.
        return bool(0.0 <= met <= opening + _PRESSED_M)
