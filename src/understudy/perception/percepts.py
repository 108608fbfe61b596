"""What the robot knows of its surroundings at one moment: the values on which goals and skills rest."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from understudy.geometry import Point, Pose, bearing_to_angle
from understudy.robot import Color, Odometry

__all__ = ["Attention", "Doorway", "GripperState", "Percepts", "Room", "Thing"]

Room = Literal["near", "far"]
"""The rooms on the two sides of a doorway; in the near one the left post is at the left of who looks at it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Thing:
    """A target, a box or the teacher, as perceived or remembered.

    Attributes:
        id: the same as long as the robot believes it to be the same thing.
        color: the color it was seen in most often.
        position: of its middle, in the robot's frame, metres.
        radius: metres.
        sensed: camera or laser met it in this very observation; otherwise it is remembered (§3.5.3.2).
        seen_s: when a sensor last met it.
        followed: the camera found it, and the sensors have met it ever since (§3.5.3.2); false for what the laser
            alone met again where memory had it.
    """

    id: int
    color: Color
    position: Point
    radius: float
    sensed: bool
    seen_s: float
    followed: bool = True

    @property
    def distance_m(self) -> float:
        """From the robot's turning point to the thing's surface."""
        return max(0.0, self.position.distance - self.radius)

    @property
    def bearing(self) -> float:
        """Radians, 0 ahead, left positive."""
        return self.position.bearing

    @property
    def angle_deg(self) -> float:
        """As the skills count it: 0 right, 90 ahead, 180 left; beyond both behind the robot (§3.5.3.2)."""
        return bearing_to_angle(self.bearing)


@dataclass(frozen=True, slots=True, kw_only=True)
class GripperState:
    """What the gripper tells (A.3).

    Attributes:
        holding: closed, with something between the paddles.
        empty: nothing between the paddles.
        color: of what it holds; None while it holds nothing, or something of which it does not know the color.
        open: the paddles stand wide open.
        raised: the lift is up.
        blocked: something stands between the paddles, whether they are closed or not.
        pushing: the color of what has stood between the open, lowered paddles for a while, so that it comes along when
            the robot drives forward; None for nothing, or something of which it does not know the color.
    """

    holding: bool
    empty: bool
    color: Color | None
    open: bool
    raised: bool
    blocked: bool
    pushing: Color | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Attention:
    """Which landmarks are worth watching, for the skills that are to be executed.

    Attributes:
        landmarks: colors of tall things that stay where they are, one of each.
        doorways: the posts of doors, left and right as seen from the near room.
    """

    landmarks: frozenset[Color] = frozenset()
    doorways: frozenset[tuple[Color, Color]] = frozenset()

    def __or__(self, other: "Attention") -> "Attention":
        """Both."""
        return Attention(landmarks=self.landmarks | other.landmarks, doorways=self.doorways | other.doorways)

    @property
    def colors(self) -> frozenset[Color]:
        """Of all landmarks, posts included."""
        return self.landmarks.union(*self.doorways)


@dataclass(frozen=True, slots=True, kw_only=True)
class Doorway:
    """The opening between two posts.

    Attributes:
        posts: their colors, left and right as seen from the near room.
        frame: in the robot's frame: the middle between the posts; its x axis leads from the near room into the far
            one, its y axis to the left post.
        half_width: from the middle to a post's surface, metres.
        gap: the widest part of it, along the y axis of ``frame``, in which nothing stands as far as a door's leaf
            could reach, as it was last seen; None if it never was.
        seen_s: when one of its posts was last seen where memory has it.
    """

    posts: tuple[Color, Color]
    frame: Pose
    half_width: float
    gap: tuple[float, float] | None = None
    seen_s: float = 0.0

    @property
    def here(self) -> Pose:
        """The robot in the doorway's frame."""
        place = self.frame.to_local(Point(0.0, 0.0))
        return Pose(place.x, place.y, -self.frame.heading)

    @property
    def room(self) -> Room:
        """In which room the robot is; it changes on the line between the posts."""
        return "near" if self.here.x < 0 else "far"

    def free(self, width: float) -> bool:
        """Whether there was room for something so wide when it was last seen."""
        return self.gap is not None and self.gap[1] - self.gap[0] >= width


def _no_points() -> NDArray[np.float64]:
    return np.empty((0, 2))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Percepts:
    """Everything perceived and remembered at one moment.

    Attributes:
        time_s: of the observation.
        odometry: as the wheels tell.
        targets: tall colored things, nearest first.
        boxes: small colored things on the floor, nearest first.
        teacher: None while unseen.
        gripper: None on a robot without one.
        landmarks: by color; those that the robot was told to watch (:class:`Attention`).
        doorways: those of which it knows both posts.
        obstacles: points that laser and sonars met, robot's frame, metres, shape ``(n, 2)``.
    """

    time_s: float
    odometry: Odometry = Odometry()
    targets: Sequence[Thing] = ()
    boxes: Sequence[Thing] = ()
    teacher: Thing | None = None
    gripper: GripperState | None = None
    landmarks: Mapping[Color, Thing] = field(default_factory=lambda: MappingProxyType({}))
    doorways: Sequence[Doorway] = ()
    obstacles: NDArray[np.float64] = field(default_factory=_no_points)

    def doorway(self, left: Color, right: Color) -> Doorway | None:
        """The doorway between two posts, if both are known."""
        return next((doorway for doorway in self.doorways if doorway.posts == (left, right)), None)

    def nearest_target(self, color: Color) -> Thing | None:
        """The nearest target of a color, sensed or remembered."""
        return next((thing for thing in self.targets if thing.color == color), None)

    def nearest_box(self, color: Color) -> Thing | None:
        """The nearest box of a color, sensed or remembered."""
        return next((thing for thing in self.boxes if thing.color == color), None)
