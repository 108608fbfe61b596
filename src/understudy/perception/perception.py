"""From observations to percepts: camera and laser merged, with working memory (§3.5.3.2, A.3)."""

import math
from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from understudy.errors import RobotError
from understudy.geometry import Point, Pose, wrap_angle
from understudy.perception.blobs import Blob, find_blobs
from understudy.perception.cylinders import Cylinder, find_cylinders
from understudy.perception.doorways import DoorwayMemory
from understudy.perception.gripper import GripperSense
from understudy.perception.landmarks import LandmarkMemory
from understudy.perception.lifted import put_elsewhere
from understudy.perception.memory import Memory, MemorySettings, Track
from understudy.perception.obstacles import Obstacles
from understudy.perception.percepts import Attention, Percepts
from understudy.perception.projection import Projection
from understudy.robot import TEACHER_COLOR, Observation, RobotSpec, Scan

__all__ = ["Perception", "PerceptionSettings"]


@dataclass(frozen=True, slots=True, kw_only=True)
class PerceptionSettings:
    """Limits of what the robot believes to see; metres.

    Attributes:
        target_range: farther tall blobs are too small to be trusted.
        box_range: farther boxes stand in too few pixels for their distance to be told.
        teacher_range: up to here the teacher is recognised (A.3).
        laser_gate: a laser object this near to a remembered place is that thing.
    """

    target_range: float = 6.0
    box_range: float = 3.0
    teacher_range: float = 2.0
    laser_gate: float = 0.25


_TALL_TOP = 0.45
_BOX_TOP = 0.08
_BOX_RADIUS = 0.05
_BEARING_SLACK = math.radians(3.0)
_UNLIKE = math.log(2.2)
"""A blob may look so many times wider or narrower than its object should: the laser measures far ones coarsely."""

_FAR = 4.0
"""Metres; the foot of what stands farther off may be lost in the noise at the horizon."""

_CUT = 0.3
"""A blob narrowed by the picture's border fits less well than a whole one of the right width."""

_UNSURE = 0.2
"""Metres by which a landmark's remembered place may be wrong."""

_SLIM = 3
"""Pixels; a narrower blob is too slim for its direction to be trusted."""


def _across(here: Point) -> list[Point]:
    """A landmark's place, and as far to both sides of it as memory may be wrong."""
    c, s = math.cos(here.bearing), math.sin(here.bearing)
    return [Point(here.x - s * aside, here.y + c * aside) for aside in (-_UNSURE, 0.0, _UNSURE)]


class Perception:
    """Merges the sensors into percepts. Call :meth:`update` once for every observation, in order.

    Args:
        spec: the robot whose sensors these are.
        settings: limits.
        attention: the landmarks to be watched; none if left out.
    """

    def __init__(
        self, spec: RobotSpec, settings: PerceptionSettings | None = None, attention: Attention | None = None
    ) -> None:
        self.spec = spec
        self.settings = settings or PerceptionSettings()
        self.projection = Projection(spec.camera)
        self.targets = Memory(MemorySettings(doubt_m=2.0, doubt_s=20.0))
        # A box is seen in few pixels, and it moves when it is pushed.
        self.boxes = Memory(MemorySettings(gate_m=0.20, gate_per_m=0.10))
        # People walk: half a metre per sighting is generous at 10 Hz, yet keeps two people apart.
        self.people = Memory(MemorySettings(gate_m=0.45, forget=4, smoothing=0.9))
        self.gripper = GripperSense(spec)
        attention = attention or Attention()
        self.landmarks = LandmarkMemory(attention.colors)
        self.doorways = DoorwayMemory(attention.doorways)
        self._obstacles = Obstacles(spec)
        self._before: Observation | None = None

    def update(self, observation: Observation) -> Percepts:
        """The percepts of one observation.

        Raises:
            RobotError: the readings cannot be used (:meth:`Observation.check`).
        """
        observation.check()
        image = observation.image
        if image is not None and image.shape != (self.spec.camera.rows, self.spec.camera.width, 3):
            image = self._resized(image)
        time_s, pose = observation.time_s, observation.odometry.pose
        cylinders = find_cylinders(observation.scan, self.spec.laser.x)
        if self.landmarks.colors:
            self._notice_lifting(observation)
        if image is not None:
            blobs = find_blobs(image, paints=self.spec.paints)
            if self.landmarks.colors:
                self._look_for_landmarks(time_s, pose, observation.scan, blobs)
            seen = self._look(time_s, pose, observation.scan, cylinders, blobs)
            cylinders = [cylinder for cylinder in cylinders if cylinder not in seen]
        self._feel(time_s, pose, cylinders)
        self._forget(time_s, pose, observation.scan, looked=image is not None)
        gripper = self.gripper.update(time_s, pose, observation.gripper, self.boxes)
        people = [
            thing
            for thing in self.people.things(time_s, pose)
            if thing.distance_m <= self.settings.teacher_range and thing.sensed
        ]
        targets = self.targets.things(time_s, pose)
        landmarks = self.landmarks.things(time_s, pose) if self.landmarks.colors else {}
        obstacles = self._obstacles.points(observation, targets)
        return Percepts(
            time_s=time_s,
            odometry=observation.odometry,
            targets=targets,
            boxes=self.boxes.things(time_s, pose),
            teacher=people[0] if people else None,
            gripper=gripper,
            landmarks=landmarks,
            doorways=self.doorways.update(landmarks, obstacles) if landmarks else (),
            obstacles=obstacles,
        )

    def _resized(self, image: NDArray[np.uint8]) -> NDArray[np.uint8]:
        """The picture in the size that the robot's camera has by its spec.

        Raises:
            RobotError: it is no RGB picture, or has another shape, so that its directions cannot be told.
        """
        camera = self.spec.camera
        same_shape = image.ndim == 3 and image.shape[1] * camera.rows == image.shape[0] * camera.width
        if not same_shape or image.shape[2] != 3:
            raise RobotError(
                f"the camera's picture has the shape {image.shape}; the {self.spec.name}'s has "
                f"({camera.rows}, {camera.width}, 3), or a multiple of it: check the camera topic"
            )
        return cv2.resize(image, (camera.width, camera.rows), interpolation=cv2.INTER_AREA).astype(np.uint8)

    def _look(
        self, time_s: float, pose: Pose, scan: Scan, cylinders: list[Cylinder], blobs: list[Blob]
    ) -> list[Cylinder]:
        """Enters the camera's blobs into memory: tall ones by the laser's distance, small ones by the floor's.

        Returns:
            The laser's objects that the camera knows. They are nothing else: a person who goes behind a target is not
            where the target is.
        """
        tall = [blob for blob in blobs if blob.top < self.projection.horizon_row - 1]
        matched = self._matched(tall, cylinders)
        for blob, cylinder in matched:
            teacher = blob.color is TEACHER_COLOR
            limit = self.settings.teacher_range + 0.5 if teacher else self.settings.target_range
            if cylinder.center.distance - cylinder.radius <= limit:
                memory = self.people if teacher else self.targets
                memory.sighted(time_s, pose, cylinder.center, cylinder.radius, blob.color)
        for blob in blobs:
            if blob.top >= self.projection.horizon_row - 1 and blob.color is not TEACHER_COLOR:
                self._look_at_small(time_s, pose, scan, blob)
        return [cylinder for _, cylinder in matched]

    def _look_for_landmarks(self, time_s: float, pose: Pose, scan: Scan, blobs: list[Blob]) -> None:
        """The camera gives the direction of a landmark, the laser the distance there (§3.5.3.2)."""
        camera = self.spec.camera
        for blob in blobs:
            if blob.color not in self.landmarks.colors or blob.top >= self.projection.horizon_row - 1:
                continue
            if blob.left <= 0 or blob.right >= camera.width - 1 or blob.right - blob.left < _SLIM:
                continue
            row = (blob.top + blob.bottom) / 2
            columns = (blob.left + (blob.right - blob.left) * share for share in (0.3, 0.5, 0.7))
            bearings = [self.projection.bearing(column, row) for column in columns]
            away = min(self._range_along(scan, bearing) for bearing in bearings)
            if not 0.0 < away <= self.settings.target_range or not self._stands_there(blob, away):
                continue
            radius = min(0.3, (blob.right - blob.left + 1) / 2 / camera.focal_px * away)
            reach = away + radius
            position = Point(camera.x + reach * math.cos(bearings[1]), reach * math.sin(bearings[1]))
            if self.landmarks.sighted(time_s, pose, position, radius, blob.color):
                self._forget_all()

        def look(here: Point) -> Literal["through", "hidden", ""]:
            if here.distance > self.settings.target_range - 0.5 or not self.projection.sees(
                here, _TALL_TOP / 2, margin=12
            ):
                return ""
            beyond = min(self._range_towards(scan, place) - place.distance for place in _across(here))
            return "through" if beyond > 0.3 else "hidden" if beyond > -0.5 else ""

        self.landmarks.contradict(time_s, pose, look)

    def _notice_lifting(self, observation: Observation) -> None:
        before, self._before = self._before, observation
        if before is not None:
            turned = wrap_angle(observation.odometry.pose.heading - before.odometry.pose.heading)
            if put_elsewhere(before.scan, observation.scan, turned):
                self.landmarks.known.clear()
                self._forget_all()

    def _forget_all(self) -> None:
        """Somebody put the robot elsewhere: what it remembers is not where it believes it to be."""
        for memory in (self.targets, self.boxes, self.people):
            memory.tracks = []
        self.gripper.lifted()

    def _range_along(self, scan: Scan, bearing: float) -> float:
        """What the laser, which sits nearly where the camera does, measures in a direction; zero if nothing."""
        index = round((bearing - scan.angle_min) / scan.angle_increment)
        if not 0 <= index < len(scan.ranges):
            return 0.0
        reading = float(scan.ranges[index])
        return reading + self.spec.laser.x - self.spec.camera.x if math.isfinite(reading) else 0.0

    def _matched(self, blobs: list[Blob], cylinders: list[Cylinder]) -> list[tuple[Blob, Cylinder]]:
        """Which tall blob is which of the laser's objects: in the same direction, and as wide as it should look.

        Of two targets that stand nearly behind each other, the far one must not lend its color to the near one.
        """
        if not blobs or not cylinders:
            return []
        edges = [self._bearings(blob) for blob in blobs]
        pairs = [
            (unlike, i, j)
            for i, blob in enumerate(blobs)
            for j, cylinder in enumerate(cylinders)
            if (unlike := self._unlikeness(blob, *edges[i], cylinder)) is not None
        ]
        matched: dict[int, int] = {}
        for _, i, j in sorted(pairs):
            if i not in matched and j not in matched.values():
                matched[i] = j
        return [(blobs[i], cylinders[j]) for i, j in sorted(matched.items())]

    def _bearings(self, blob: Blob) -> tuple[float, float]:
        """Of a blob's left and right edge."""
        row = (blob.top + blob.bottom) / 2
        return self.projection.bearing(blob.left - 0.5, row), self.projection.bearing(blob.right + 0.5, row)

    def _unlikeness(self, blob: Blob, left: float, right: float, cylinder: Cylinder) -> float | None:
        """How little a blob, between two bearings, looks like an object that the laser met; None if it cannot be that
        one.
        """
        camera = self.spec.camera
        # Seen from the camera, whose place differs a little from the laser's.
        ahead, beside = cylinder.center.x - camera.x, cylinder.center.y
        bearing, away = math.atan2(beside, ahead), math.hypot(ahead, beside)
        half = math.asin(min(1.0, cylinder.radius / away))
        cut_left, cut_right = blob.left <= 0, blob.right >= camera.width - 1
        # Where the picture ends, the middle of the object may lie beyond its border.
        outside = max(0.0, bearing - left - half * cut_left, right - half * cut_right - bearing)
        if outside > _BEARING_SLACK:
            return None
        ratio = math.log((blob.right - blob.left + 1) / (2 * cylinder.radius * camera.focal_px / away))
        unlike = _CUT if (cut_left or cut_right) and ratio < 0 else abs(ratio)
        if unlike > _UNLIKE or not self._stands_there(blob, away):
            return None
        return unlike + 0.5 * outside / _BEARING_SLACK

    def _stands_there(self, blob: Blob, away: float) -> bool:
        """Whether the foot of a blob, if it is in the picture, agrees with a distance from the camera."""
        if blob.bottom >= self.spec.camera.rows - 2:
            return True
        foot = self.projection.floor_point(blob.column, blob.bottom + 0.5)
        worn = blob.color is TEACHER_COLOR  # by a robot on its back: it need not reach down to the floor
        if foot is None:
            return worn or away > _FAR
        farthest = math.inf if worn else 1.5 * away + 0.3
        return 0.6 * away - 0.2 <= math.hypot(foot.x - self.spec.camera.x, foot.y) <= farthest

    def _look_at_small(self, time_s: float, pose: Pose, scan: Scan, blob: Blob) -> None:
        camera = self.spec.camera
        if blob.bottom >= camera.rows - 2 or blob.left <= 0 or blob.right >= camera.width - 1:
            return  # cut off by the image's border: its foot, or its middle, is not to be seen
        foot = self.projection.floor_point(blob.column, blob.bottom + 0.5)
        if foot is None or foot.distance > self.settings.box_range:
            return
        bearing = math.atan2(foot.y, foot.x - camera.x)
        position = Point(foot.x + _BOX_RADIUS * math.cos(bearing), foot.y + _BOX_RADIUS * math.sin(bearing))
        if self._range_towards(scan, position) < position.distance - 0.15:
            return  # a low stripe of something tall that stands before it
        self.boxes.sighted(time_s, pose, position, _BOX_RADIUS, blob.color)

    def _feel(self, time_s: float, pose: Pose, cylinders: list[Cylinder]) -> None:
        """Follows believed things by the laser alone, beyond the camera's field (Figure 3.9)."""
        free = list(cylinders)
        for memory in (self.people, self.targets):
            gate = self.settings.laser_gate if memory is self.targets else memory.settings.gate_m
            for track, (x, y) in zip(
                memory.tracks, pose.to_locals(track.place for track in memory.tracks), strict=True
            ):
                if track.seen_s == time_s:
                    continue  # the camera knows which of the laser's objects it is
                nearest, index = math.inf, 0
                for i, cylinder in enumerate(free):
                    away = math.hypot(x - cylinder.center.x, y - cylinder.center.y)
                    if away < nearest:
                        nearest, index = away, i
                if nearest > gate:
                    continue
                met = free.pop(index)
                if track.believed:
                    memory.felt(track, time_s, pose, met.center, met.radius, whole=not met.cut)

    def _forget(self, time_s: float, pose: Pose, scan: Scan, *, looked: bool) -> None:
        """Forgets what should have been met and was not."""

        def tall_missing(track: Track) -> bool:
            here = pose.to_local(track.place)
            if here.distance > self.settings.target_range - 0.5:
                return False
            if self._range_towards(scan, here) <= here.distance + track.radius + 0.25:
                return False
            # The laser sees through the place. Far off it may just miss a slim target: there the camera must agree.
            return here.distance < 4.0 or (looked and self.projection.sees(here, _TALL_TOP / 2, margin=6))

        def box_missing(track: Track) -> bool:
            here = pose.to_local(track.place)
            if not looked or here.distance > self.settings.box_range - 0.3:
                return False
            hidden = self._range_towards(scan, here) < here.distance - 0.05
            # Its near edge is the first to leave the picture, and a cut-off blob is no sighting.
            nearer = 1 - _BOX_RADIUS / max(here.distance, 2 * _BOX_RADIUS)
            foot = Point(here.x * nearer, here.y * nearer)
            in_view = self.projection.sees(foot, 0.0, margin=8) and self.projection.sees(here, _BOX_TOP, margin=8)
            return in_view and not hidden

        self.targets.contradict(time_s, pose, tall_missing)
        self.boxes.contradict(time_s, pose, box_missing)
        self.people.contradict(time_s, pose, lambda track: True)

    def _range_towards(self, scan: Scan, here: Point) -> float:
        """What the laser measures in the direction of a point of the robot's frame, from the robot's origin.

        Zero outside of its field, where it knows nothing.
        """
        laser_x = self.spec.laser.x
        bearing = math.atan2(here.y, here.x - laser_x)
        index = round((bearing - scan.angle_min) / scan.angle_increment)
        if not 0 <= index < len(scan.ranges):
            return 0.0
        reading = float(scan.ranges[index])
        if math.isnan(reading):
            return 0.0
        reading = min(reading, scan.range_max)
        return math.hypot(laser_x + reading * math.cos(bearing), reading * math.sin(bearing))
