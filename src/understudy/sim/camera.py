"""The camera's picture, drawn from the simulation's state.

The painter's order does the hiding: floor, arena walls, then everything else from far to near. Ray casting the
same picture costs twenty times as much (``docs/design.md``).
"""

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from understudy.geometry import Point, Pose
from understudy.robot import RGB, CameraMount
from understudy.sim.body import RobotBody
from understudy.sim.lens import NEAR_M, Floats, Lens, clipped
from understudy.sim.misreading import Misreading
from understudy.sim.noise import NoiseLevels
from understudy.sim.scenery import Cylinders, Paint, Prisms, Scenery

__all__ = ["Camera"]

Image = NDArray[np.uint8]

_FLOOR, _SKY = (150.0, 146.0, 138.0), (176.0, 178.0, 182.0)

_LIGHT_FROM = math.radians(-35)
"""Where in the arena the light comes from."""

_FRAME_GRABBER = np.uint8(0xF8)
"""The frame grabber delivers five bits a channel."""

_LIGHT_MEMORY = 0.9
"""How much of the light's deviation is left in the next picture: it flickers slowly."""

_GAIN_LEVELS = 16
"""Steps of the light from its mean to three standard deviations: the background is drawn ahead for each."""

_STRIPS = 6
"""Around the visible half of a cylinder: enough for a round shading."""
_RIM = [1.0 - 2.0 * j / _STRIPS for j in range(_STRIPS + 1)]
_MIDDLES = [1.0 - (2 * j + 1) / _STRIPS for j in range(_STRIPS)]
"""The visible rim from left to right, and the strips' middles, as shares of the half arc."""
_AROUND = np.linspace(0.0, math.tau, 16, endpoint=False)
_LID = np.stack([np.cos(_AROUND), np.sin(_AROUND)], axis=1)


class Camera:
    """One robot's camera.

    Args:
        body: the robot that carries it.
        scenery: what there is to see.
        noise: how much the picture errs.
        rng: where its noise comes from.
        colors: where the errors in the colors of things come from.
    """

    def __init__(
        self,
        body: RobotBody,
        scenery: Scenery,
        noise: NoiseLevels,
        rng: np.random.Generator,
        colors: np.random.Generator,
    ) -> None:
        self._body, self._scenery, self._noise, self._rng = body, scenery, noise, rng
        self._mount: CameraMount = body.spec.camera
        self._lens = Lens(self._mount)
        self._widest = self._mount.field / 2 + math.radians(6)  # the tilt widens the field in the lower corners
        self._slope = math.tan(self._widest)
        self._corners = [wall.start for wall in scenery.arena_walls]
        # Everything but the camera's own robot.
        self._prisms, self._cylinders = (
            [i for i, owner in enumerate(things.owners) if owner != body.index.body]
            for things in (scenery.prisms, scenery.cylinders)
        )
        self._boxes = Misreading(scenery.prisms.paints, scenery.prisms.boxes, noise, colors)
        self._targets = Misreading(scenery.cylinders.paints, scenery.cylinders.targets, noise, colors)
        levels = range(-_GAIN_LEVELS, _GAIN_LEVELS + 1)
        self._gains = [1.0 + 3.0 * noise.illumination * level / _GAIN_LEVELS for level in levels]
        self._backgrounds = [_background(self._mount, gain) for gain in self._gains]
        self._grain = _Grain(noise.image, self._backgrounds[0].size, rng)
        self._light = 0.0

    def picture(self, pose: Pose) -> Image:
        """One frame of a robot at this true pose: RGB, ``(rows, width, 3)``."""
        self._light = _LIGHT_MEMORY * self._light + math.sqrt(1 - _LIGHT_MEMORY**2) * self._rng.standard_normal()
        level = round(_GAIN_LEVELS * (1.0 + min(1.0, max(-1.0, self._light / 3.0))))
        gain, image = self._gains[level], self._backgrounds[level].copy()
        eye = Pose(*pose.to_parent(Point(self._mount.x, 0.0)), pose.heading)
        self._boxes.look()
        self._targets.look()
        self._draw_walls(image, eye, gain)
        self._draw_things(image, eye, gain)
        if self._rng.random() < self._noise.false_blobs:
            self._draw_false_blob(image, gain)
        return self._grain.on(image)

    def _draw_walls(self, image: Image, eye: Pose, gain: float) -> None:
        ends = eye.to_locals(self._corners)
        for wall, start, end in zip(self._scenery.arena_walls, ends, ends[1:] + ends[:1], strict=True):
            seen = _between_sight_lines(start, end, self._slope)
            if seen is not None:
                low, high = self._lens.pixels_at(seen, 0.0), self._lens.pixels_at(seen, wall.height)
                face = np.array((*low, *reversed(high)), np.int32)
                cv2.fillConvexPoly(image, face, _lit(wall.paint, gain * wall.shade))

    def _fill(self, image: Image, face: Floats, paint: Paint) -> None:
        """Fills one flat face, given in the camera, cut off at the near plane."""
        if face[:, 2].min() < NEAR_M:
            face = clipped(face)
            if len(face) < 3:
                return
        cv2.fillConvexPoly(image, self._lens.pixels(face), paint)

    def _draw_things(self, image: Image, eye: Pose, gain: float) -> None:
        prisms, cylinders = self._scenery.prisms, self._scenery.cylinders
        jobs = [(*seen, True) for seen in self._in_field(prisms, self._prisms, eye)]
        jobs += [(*seen, False) for seen in self._in_field(cylinders, self._cylinders, eye)]
        for away, i, place, is_prism in sorted(jobs, reverse=True):
            if is_prism:
                self._draw_prism(image, prisms, i, place, eye, gain)
            elif away > cylinders.radii[i]:
                self._draw_cylinder(image, cylinders, i, place, heading=eye.heading, gain=gain)

    def _in_field(self, things: Prisms | Cylinders, which: list[int], eye: Pose) -> list[tuple[float, int, Point]]:
        """Distance, index and place in the view of those things that may be in the picture."""
        if not which:
            return []
        found = []
        c, s = math.cos(eye.heading), math.sin(eye.heading)
        centres = things.centres()
        for i in which:
            dx, dy = centres[i][0] - eye.x, centres[i][1] - eye.y
            forward, left = c * dx + s * dy, c * dy - s * dx
            away, radius = math.hypot(forward, left), things.radii[i]
            half_angle = math.asin(radius / away) if away > radius else math.pi
            if abs(math.atan2(left, forward)) - half_angle <= self._widest:
                found.append((away, i, Point(forward, left)))
        return found

    def _draw_cylinder(
        self, image: Image, cylinders: Cylinders, i: int, place: Point, *, heading: float, gain: float
    ) -> None:
        """Draws the visible half of an upright cylinder in upright strips.

        It ends where the sight lines touch the cylinder; lens and cylinder share the vertical, so that both edges
        are straight and upright in space.
        """
        radius, bottom, top = cylinders.radii[i], cylinders.bottoms[i], cylinders.tops[i]
        paint = self._targets.paints[i]
        away = place.distance
        # What lies above the picture's upper edge need not be drawn, and would be behind the tilted lens when near.
        upper = min(top, self._mount.height + (away + radius) * math.tan(math.radians(10)))
        toward, half_arc = math.atan2(-place.y, -place.x), math.acos(radius / away)
        rim = []
        for share in _RIM:
            angle = toward + half_arc * share
            rim.append((max(NEAR_M, place.x + radius * math.cos(angle)), place.y + radius * math.sin(angle)))
        corners: list[tuple[int, int]] = []
        for low, high in zip(self._lens.pixels_at(rim, bottom), self._lens.pixels_at(rim, upper), strict=True):
            # Alternating, so that any four in a row from an even place on go around one strip.
            corners += (low, high) if len(corners) % 4 == 0 else (high, low)
        outline = np.array(corners, np.int32)
        for j, share in enumerate(_MIDDLES):
            sunward = heading + toward + half_arc * share - _LIGHT_FROM
            lit = _lit(paint, gain * (0.92 + 0.19 * math.cos(sunward)))
            cv2.fillConvexPoly(image, outline[2 * j : 2 * j + 4], lit)
        if top < self._mount.height:
            face = self._lens.in_camera(np.array(place) + radius * _LID, np.full(len(_LID), top))
            self._fill(image, face, _lit(paint, gain * 1.05))

    def _draw_prism(self, image: Image, prisms: Prisms, i: int, middle: Point, eye: Pose, gain: float) -> None:
        """Draws the faces that the eye sees. In plain floats: eight corners are too few for arrays to pay."""
        (x, y, z), (rx, ry, rz) = prisms.pose(i)
        half = prisms.halves[i]
        c, s = math.cos(eye.heading), math.sin(eye.heading)
        corners = [(middle.x, middle.y, z)]
        for ax, ay, az, h in zip(rx, ry, rz, half, strict=True):
            # The prism's half axis in the view: forward, left, up. From each point half an axis down and up.
            forward, left, up = (c * ax + s * ay) * h, (c * ay - s * ax) * h, az * h
            corners = [(px + k * forward, py + k * left, pz + k * up) for px, py, pz in corners for k in (-1, 1)]
        depths = self._lens.depths(corners)
        if self._lens.off_screen(corners, depths):
            return
        before_the_lens = min(depths) >= NEAR_M
        if before_the_lens:
            pixels = [self._lens.pixel(*corner) for corner in corners]
        # The eye in the prism's own axes tells which of its faces it sees.
        to_eye = (eye.x - x, eye.y - y, self._mount.height - z)
        for axis, (ax, ay, az, reach) in enumerate(zip(rx, ry, rz, half, strict=True)):
            place = ax * to_eye[0] + ay * to_eye[1] + az * to_eye[2]
            if abs(place) <= reach:
                continue
            sign = 1 if place > 0 else -1
            sunward = sign * (ax * math.cos(_LIGHT_FROM) + ay * math.sin(_LIGHT_FROM))
            lit = _lit(self._boxes.paints[i], gain * (0.9 + 0.17 * sunward + 0.12 * max(0.0, sign * az)))
            face = prisms.FACES[axis, sign]
            if before_the_lens:
                cv2.fillConvexPoly(image, np.array([pixels[corner] for corner in face], np.int32), lit)
            else:
                shape = np.array([corners[corner] for corner in face])
                self._fill(image, self._lens.in_camera(shape[:, :2], shape[:, 2]), lit)

    def _draw_false_blob(self, image: Image, gain: float) -> None:
        """A patch of a trained color where nothing of that color is (§4.5.5: noise of the vision system)."""
        paints = list(RGB.values())
        rng = self._rng
        paint = _lit(paints[int(rng.integers(len(paints)))], gain)
        place = (int(rng.integers(self._mount.width)), int(rng.integers(self._mount.rows)))
        axes = (int(rng.integers(2, 6)), int(rng.integers(2, 6)))
        cv2.ellipse(image, place, axes, 0.0, 0.0, 360.0, paint, cv2.FILLED)


class _Grain:
    """A picture's noise: windows at random into a long strip of it, since fresh normals cost 0.6 ms a picture."""

    def __init__(self, std: float, size: int, rng: np.random.Generator) -> None:
        self._size, self._rng = size, rng
        strip = np.rint(std * rng.standard_normal(4 * size, np.float32))
        # Two saturating eight-bit operations instead of one with wider numbers: brighter, then darker.
        self._brighter = np.clip(strip, 0, 255).astype(np.uint8)
        self._darker = np.clip(-strip, 0, 255).astype(np.uint8)

    def on(self, image: Image) -> Image:
        start = int(self._rng.integers(3 * self._size))
        window = slice(start, start + self._size)
        flat = image.reshape(-1)
        cv2.add(flat, self._brighter[window], dst=flat)
        cv2.subtract(flat, self._darker[window], dst=flat)
        np.bitwise_and(flat, _FRAME_GRABBER, out=flat)
        return image


def _between_sight_lines(start: Point, end: Point, slope: float) -> tuple[Point, Point] | None:
    """The part of a wall, in the view, that lies within the field: ``slope`` is its half width at a distance of one.

    What lies behind the lens would be drawn upside down.
    """
    if max(start.x, end.x) <= 0.0:
        return None
    for side in (1.0, -1.0):
        a, b = slope * start.x + side * start.y, slope * end.x + side * end.y
        if a <= 0.0 and b <= 0.0:
            return None
        if a * b < 0.0:
            t = a / (a - b)
            cut = Point(start.x + t * (end.x - start.x), start.y + t * (end.y - start.y))
            start, end = (cut, end) if a < 0.0 else (start, cut)
    return start, end


def _background(mount: CameraMount, gain: float) -> Image:
    """Floor below the horizon, a little darker with distance, and a plain backdrop above the walls."""
    rows = np.arange(mount.rows)
    below = np.arctan((rows - mount.rows / 2 + 0.5) / mount.focal_px) + mount.tilt
    shade = np.clip(0.8 + 0.45 * below, 0.8, 1.05)[:, None]
    lines = np.where(below[:, None] > 0.0, shade * np.array(_FLOOR), np.array(_SKY))
    image = np.empty((mount.rows, mount.width, 3), np.uint8)
    image[:] = np.clip(np.rint(gain * lines), 0, 255)[:, None, :]
    return image


def _lit(paint: Paint, shade: float) -> Paint:
    red, green, blue = paint
    return red * shade, green * shade, blue * shade
