"""Made-up sensor readings for tests of perception: no simulator, so that what is seen is known exactly."""

import math

import numpy as np
from numpy.typing import NDArray

from understudy.geometry import Point, Pose
from understudy.perception.projection import Projection
from understudy.robot import PIONEER, RGB, Color, GripperReading, Observation, Odometry, Scan

__all__ = ["Pillar", "observed", "painted", "swept"]

Pillar = tuple[Color, Point]
"""A tall target of 0.10 m radius and 0.50 m height at a place of the world, which is the odometry's frame here."""

RADIUS, HEIGHT = 0.10, 0.50


def swept(pillars: list[Pillar], pose: Pose, wall: float = 6.0) -> Scan:
    """The laser's sweep: circles before a round wall."""
    bearings = np.radians(np.arange(-90, 91))
    ranges = np.full(181, wall)
    laser = pose.to_parent(Point(PIONEER.laser.x, 0.0))
    for _, place in pillars:
        center = Pose(laser.x, laser.y, pose.heading).to_local(place)
        along = center.x * np.cos(bearings) + center.y * np.sin(bearings)
        across = center.y * np.cos(bearings) - center.x * np.sin(bearings)
        hit = (along > 0) & (np.abs(across) < RADIUS)
        reach = along - np.sqrt(np.maximum(0.0, RADIUS**2 - across**2))
        ranges[hit] = np.minimum(ranges[hit], reach[hit])
    return Scan(ranges=ranges.astype(np.float32))


def painted(pillars: list[Pillar], pose: Pose, boxes: list[Pillar] | None = None) -> NDArray[np.uint8]:
    """The camera's picture: upright rectangles on grey, far ones first."""
    camera, projection = PIONEER.camera, Projection(PIONEER.camera)
    image = np.full((camera.rows, camera.width, 3), 120, np.uint8)
    things = [(color, place, HEIGHT, RADIUS) for color, place in pillars]
    things += [(color, place, 0.10, 0.064) for color, place in boxes or []]  # seen over a corner
    for color, place, height, radius in sorted(things, key=lambda thing: -pose.to_local(thing[1]).distance):
        here = pose.to_local(place)
        away = math.hypot(here.x - camera.x, here.y)
        if here.x - camera.x < 0.1:
            continue
        near = Point(here.x - radius * (here.x - camera.x) / away, here.y - radius * here.y / away)
        foot, top = projection.pixel(near, 0.0), projection.pixel(here, height)
        if foot is None or top is None:
            continue
        half = radius / away * camera.focal_px
        columns = slice(max(0, round(foot[0] - half)), max(0, round(foot[0] + half) + 1))
        rows = slice(max(0, round(top[1])), max(0, round(foot[1]) + 1))
        image[rows, columns] = RGB[color]
    return image


def observed(
    time_s: float,
    pillars: list[Pillar],
    pose: Pose = Pose(),
    *,
    boxes: list[Pillar] | None = None,
    gripper: GripperReading | None = None,
    blind: bool = False,
) -> Observation:
    """What a robot at ``pose`` senses; ``blind`` leaves the picture out."""
    return Observation(
        time_s=time_s,
        scan=swept(pillars, pose),
        image=None if blind else painted(pillars, pose, boxes),
        odometry=Odometry(pose=pose),
        gripper=gripper or GripperReading(),
    )
