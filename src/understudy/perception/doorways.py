"""Doorways: what lies between two posts, on which side of it the robot is, and whether there is a way through."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from understudy.geometry import Point, Pose
from understudy.perception.percepts import Doorway, Thing
from understudy.robot import Color

__all__ = ["DoorwayMemory", "DoorwaySettings"]


@dataclass(frozen=True, slots=True, kw_only=True)
class DoorwaySettings:
    """What counts as a doorway, and from where its passage can be judged; metres.

    Attributes:
        narrowest, widest: distances of two posts that can be those of a door.
        nearest, farthest: the robot must stand so far from the line between the posts to see what is in the way.
        slant: at most so many times farther aside than before it.
        believe: judgements in a row before they replace the last one.
    """

    narrowest: float = 0.7
    widest: float = 2.5
    nearest: float = 0.5
    farthest: float = 3.5
    slant: float = 1.5
    believe: int = 3


_SLACK = 0.05
"""Metres beyond a post's radius that still count as the post."""


class DoorwayMemory:
    """The doorways between given posts, and how far each was last seen to be free. All its state is plain data.

    Args:
        posts: pairs of colors, left and right as seen from the one room; from the other it is the other way round.
        settings: limits.
    """

    def __init__(self, posts: Iterable[tuple[Color, Color]], settings: DoorwaySettings | None = None) -> None:
        self.posts = tuple(sorted(posts))
        self.settings = settings or DoorwaySettings()
        self.gaps: dict[tuple[Color, Color], tuple[float, float]] = {}
        self._news: dict[tuple[Color, Color], list[tuple[float, float]]] = {}

    def update(self, landmarks: Mapping[Color, Thing], obstacles: NDArray[np.float64]) -> tuple[Doorway, ...]:
        """The doorways whose posts are known.

        Args:
            landmarks: by color.
            obstacles: what laser and sonars meet, robot's frame.
        """
        found = []
        for posts in self.posts:
            left, right = (landmarks.get(color) for color in posts)
            if left is None or right is None:
                continue
            width = left.position.distance_to(right.position)
            if not self.settings.narrowest <= width <= self.settings.widest:
                continue
            middle = Point((left.position.x + right.position.x) / 2, (left.position.y + right.position.y) / 2)
            across = math.atan2(right.position.y - left.position.y, right.position.x - left.position.x)
            frame = Pose(middle.x, middle.y, across + math.pi / 2)
            free = width / 2 - max(left.radius, right.radius)
            self._judge(posts, frame, free, obstacles)
            found.append(
                Doorway(
                    posts=posts,
                    frame=frame,
                    half_width=free,
                    gap=self.gaps.get(posts),
                    seen_s=max(left.seen_s, right.seen_s),
                )
            )
        return tuple(found)

    def _judge(self, posts: tuple[Color, Color], frame: Pose, free: float, obstacles: NDArray[np.float64]) -> None:
        gap = self._gap(frame, free, obstacles)
        if gap is None:
            self._news.pop(posts, None)
            return
        news = [*self._news.get(posts, []), gap][-self.settings.believe :]
        self._news[posts] = news
        if len(news) == self.settings.believe:
            self.gaps[posts] = sorted(news, key=lambda one: one[1] - one[0])[len(news) // 2]

    def _gap(self, frame: Pose, free: float, obstacles: NDArray[np.float64]) -> tuple[float, float] | None:
        """The widest part between the posts in which nothing stands as far as a door's leaf could reach.

        None where that cannot be told: from too near, too far, aside, or when something stands before it.
        """
        here, settings = frame.to_local(Point(0.0, 0.0)), self.settings
        away = abs(here.x)
        if not settings.nearest <= away <= settings.farthest or abs(here.y) > settings.slant * away:
            return None
        if abs(frame.position.bearing) > math.pi / 2 - math.atan2(free, frame.position.distance):
            return None  # the laser sees only what is before the robot
        c, s = math.cos(frame.heading), math.sin(frame.heading)
        dx, dy = obstacles[:, 0] - frame.x, obstacles[:, 1] - frame.y
        depth, lateral = c * dx + s * dy, c * dy - s * dx
        reach, inside = 2 * free, free - _SLACK
        side = math.copysign(1.0, here.x)
        # Where a ray that ends on this side of the strip would have crossed the line: what is behind is hidden.
        short = (side * depth > min(reach, away - 0.1)) & (side * depth < away - 0.05)
        crossing = here.y + (lateral - here.y) * away / np.maximum(away - side * depth, 1e-6)
        if bool((short & (np.abs(crossing) < inside)).any()):
            return None
        taken = lateral[(np.abs(depth) <= reach) & (np.abs(lateral) < inside) & (side * depth < away - 0.1)]
        edges = np.concatenate(([-inside], np.sort(taken), [inside]))
        widest = int(np.diff(edges).argmax())
        return float(edges[widest]), float(edges[widest + 1])
