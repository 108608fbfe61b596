"""Two rooms and the door between them: what the skills of the delivery task share (§3.5.2).

The rooms are told apart by the door's posts: who looks at the door from the home room has the one of ``left_post`` on
the left. Metres, radians.
"""

import math
from dataclasses import dataclass
from typing import Self

from understudy.behaviors.skill import Drive, Head, Parameter, Parameters, Strip
from understudy.geometry import Point, Pose, wrap_angle
from understudy.perception import Attention, Doorway, Percepts, Room
from understudy.robot import PIONEER

__all__ = [
    "BEACON",
    "HOME",
    "LEFT_POST",
    "OTHER",
    "PASSABLE_M",
    "RIGHT_POST",
    "ROOM",
    "Passage",
    "doorway_of",
    "in_this_room",
    "leaf_of",
    "look_again",
    "near_leaf",
    "observed_posts",
    "posts_of",
    "room_of",
]

HOME, OTHER = "home", "other"

LEFT_POST = Parameter(name="left_post", kind="color", default="green")
RIGHT_POST = Parameter(name="right_post", kind="color", default="yellow")
BEACON = Parameter(name="beacon", kind="color", default="pink")
ROOM = Parameter(name="room", kind="word", words=(HOME, OTHER))

PASSABLE_M = PIONEER.width + 0.28
"""An opening so wide is wide enough."""

_SHY_M = 0.35
"""The middle of the robot keeps so far from the posts."""

_EDGE_M = 0.15
"""A leaf is as wide as the doorway, whose width the robot knows that well."""

_RELY_S = 12.0
"""For so long the robot relies on where it saw a door's posts."""

_THRESHOLD_M = 0.8
"""Nearer to the line than this, and between the posts, the robot is in both rooms."""


def posts_of(parameters: Parameters) -> Attention:
    """The door that these parameters are about."""
    return Attention(doorways=frozenset({(parameters[LEFT_POST.name], parameters[RIGHT_POST.name])}))


def doorway_of(percepts: Percepts, parameters: Parameters) -> Doorway | None:
    """The door that these parameters are about, if the robot knows where it is."""
    return percepts.doorway(parameters[LEFT_POST.name], parameters[RIGHT_POST.name])


def observed_posts(doorway: Doorway) -> tuple[tuple[str, str], ...]:
    """The parameters of an observed instance that say which door it is about."""
    return ((LEFT_POST.name, str(doorway.posts[0])), (RIGHT_POST.name, str(doorway.posts[1])))


def room_of(doorway: Doorway) -> str:
    """The room in which the robot is."""
    return HOME if doorway.room == "near" else OTHER


def leaf_of(doorway: Doorway, *, shy: bool) -> Strip:
    """Where a door's leaf may stand, which gives way."""
    reach = 2 * doorway.half_width + _EDGE_M
    return Strip(frame=doorway.frame, half_width=doorway.half_width - 0.05, reach=reach, shy=shy)


def near_leaf(percepts: Percepts) -> Strip | None:
    """Where the leaf of the nearest door may stand, for a robot that has something else in mind."""
    nearest = min(percepts.doorways, key=lambda doorway: doorway.here.position.distance, default=None)
    return leaf_of(nearest, shy=True) if nearest is not None else None


def look_again(percepts: Percepts, doorway: Doorway) -> Drive | None:
    """Turning towards a post, if none was seen for a while; None if the robot may rely on knowing where the door is.

    Whoever is about to drive into a doorway, and to push what is in the way, should look where it is.
    """
    if percepts.time_s - doorway.seen_s <= _RELY_S:
        return None
    # A leaf that is open to this side may hide the post on which it hangs.
    left = doorway.gap is not None and sum(doorway.gap) > 0
    bearing = percepts.landmarks[doorway.posts[0 if left else 1]].bearing
    return Drive(angular=max(-0.6, min(0.6, 1.5 * bearing)))


def in_this_room(percepts: Percepts, place: Point) -> bool:
    """Whether a place of the robot's frame lies on the robot's side of every door that it knows."""
    for doorway in percepts.doorways:
        there, here = doorway.frame.to_local(place).x, doorway.here
        on_the_threshold = abs(here.x) < _THRESHOLD_M and abs(here.y) < doorway.half_width
        if there * here.x < 0 and abs(there) > 0.2 and not on_the_threshold:
            return False
    return True


@dataclass(frozen=True, slots=True, kw_only=True)
class Passage:
    """A doorway, looked at in the direction in which the robot goes through it.

    Attributes:
        frame: in the robot's frame: the middle between the posts; its x axis leads through.
        here: the robot in that frame.
        half_width: to a post's surface.
        gap: the free part along the y axis; None if it was never seen.
    """

    frame: Pose
    here: Pose
    half_width: float
    gap: tuple[float, float] | None

    @classmethod
    def into(cls, doorway: Doorway, room: Room) -> Self:
        """The way into a room."""
        frame, here, gap = doorway.frame, doorway.here, doorway.gap
        if room == "near":
            frame = Pose(frame.x, frame.y, wrap_angle(frame.heading + math.pi))
            here = Pose(-here.x, -here.y, wrap_angle(here.heading + math.pi))
            gap = (-gap[1], -gap[0]) if gap is not None else None
        return cls(frame=frame, here=here, half_width=doorway.half_width, gap=gap)

    @property
    def line(self) -> float:
        """Where along the y axis the robot goes through: in the middle of what is free, or of all if it is closed."""
        if self.gap is None or self.gap[1] - self.gap[0] < PASSABLE_M:
            return 0.0
        room = max(0.0, self.half_width - _SHY_M)
        return max(-room, min(room, sum(self.gap) / 2))

    @property
    def stand(self) -> Point:
        """From where to go through, in the robot's frame: where no leaf can reach that is open to this side."""
        return self.frame.to_parent(Point(-2 * self.half_width - 0.3, self.line))

    @property
    def lined_up(self) -> bool:
        """Whether the robot is before the door, or in it, and need not go around a post."""
        before, aside = max(0.0, -self.here.x - 0.6), abs(self.here.y - self.line)
        return aside < min(0.15 + 0.3 * before, self.half_width) or (
            self.here.x > -0.45 and abs(self.here.y) < self.half_width - 0.3
        )

    def through(self, offset: float, speed: float, turn: float) -> Head:
        """Straight through, ``offset`` to the left of the middle; or first to where that can be done from."""
        goal = self.frame.to_parent(Point(self.here.x + 0.8, offset)) if self.lined_up else self.stand
        return Head(bearing=goal.bearing, speed=speed, turn=turn)

    def backwards(self, offset: float, speed: float) -> Drive:
        """Straight back along the same line."""
        heading = max(-0.4, min(0.4, 0.8 * (self.here.y - offset)))
        return Drive(linear=-speed, angular=max(-0.5, min(0.5, 1.5 * wrap_angle(heading - self.here.heading))))
