"""Landmarks: tall things of a color of their own that stay where they are, a beacon or the posts of a door (§3.5.2).

Two things make them different from targets. They may stand in a wall, where the laser cannot tell them from it; so the
camera gives the direction, and the laser the distance there (§3.5.3.2). And they belong together: what one of them
tells about the error of the odometry holds for all, so that one that is seen keeps the places of the others right.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Literal

from understudy.geometry import Point, Pose, wrap_angle
from understudy.perception.percepts import Thing
from understudy.robot import Color

__all__ = ["LandmarkMemory", "LandmarkSettings"]


@dataclass(frozen=True, slots=True, kw_only=True)
class LandmarkSettings:
    """How quickly landmarks are believed and given up.

    Attributes:
        gate_m: a sighting this near to the remembered place agrees with it.
        gate_per_m: added for every metre of distance.
        smoothing: weight of a new place against the remembered one.
        alone_s: when no other landmark was seen for so long, an error is taken for the odometry's, and not for its own.
        confirm: sightings in a row that agree with each other, before a landmark is believed or a place is given up.
        confirm_within_s: they must come within this time.
        forget: looks at its place, through which the laser could see, that did not show it.
        forget_hidden: looks at its place, where something else stood, that did not show it, while no landmark was seen
            where it should be. A door's leaf may hide a post, but then the other one tells that memory is right.
        drift_m, drift_rad: what the odometry may have gone wrong by since the last sighting. Where the senses
            contradict memory by more, the robot was put elsewhere.
    """

    gate_m: float = 0.20
    gate_per_m: float = 0.06
    smoothing: float = 0.4
    alone_s: float = 3.0
    confirm: int = 3
    confirm_within_s: float = 1.0
    forget: int = 8
    forget_hidden: int = 100
    drift_m: float = 0.8
    drift_rad: float = math.radians(35)


@dataclass(slots=True)
class _Landmark:
    """``place`` is in the odometry's frame."""

    place: Point
    radius: float
    seen_s: float
    misses: int = 0
    hidden: int = 0


@dataclass(slots=True)
class _Doubt:
    """Sightings that no memory explains."""

    place: Point
    since_s: float
    count: int = 1


class LandmarkMemory:
    """The landmarks of some colors, one of each. All its state is plain data.

    Args:
        colors: of the landmarks.
        settings: limits.
    """

    def __init__(self, colors: Iterable[Color], settings: LandmarkSettings | None = None) -> None:
        self.colors = frozenset(colors)
        self.settings = settings or LandmarkSettings()
        self.known: dict[Color, _Landmark] = {}
        self._doubts: dict[Color, _Doubt] = {}

    def sighted(self, time_s: float, pose: Pose, position: Point, radius: float, color: Color) -> bool:
        """The camera saw the landmark of a color at ``position`` (robot's frame).

        Returns:
            Whether memory has to be given up: the robot is not where it believed to be.
        """
        landmark, settings = self.known.get(color), self.settings
        gate = settings.gate_m + settings.gate_per_m * position.distance
        if landmark is not None:
            expected = pose.to_local(landmark.place)
            if expected.distance_to(position) <= gate:
                self._doubts.pop(color, None)
                self._learn(time_s, pose, color, position)
                landmark.radius = 0.8 * landmark.radius + 0.2 * radius
                landmark.seen_s, landmark.misses = time_s, 0
                for each in self.known.values():
                    each.hidden = 0
                return False
        place = pose.to_parent(position)
        doubt = self._doubts.get(color)
        if doubt is None or doubt.place.distance_to(place) > gate or time_s - doubt.since_s > settings.confirm_within_s:
            self._doubts[color] = _Doubt(place, time_s)
            return False
        doubt.count += 1
        if doubt.count < settings.confirm:
            return False
        del self._doubts[color]
        lost = False
        if landmark is not None:
            expected = pose.to_local(landmark.place)
            turned = abs(wrap_angle(expected.bearing - position.bearing))
            moved = abs(expected.distance - position.distance)
            lost = turned > settings.drift_rad or moved > settings.drift_m
            if lost:
                self.known.clear()
            else:
                self._correct(pose, expected, position, self._alone(time_s, color))
        self.known[color] = _Landmark(place, radius, time_s)
        return lost

    def _learn(self, time_s: float, pose: Pose, color: Color, position: Point) -> None:
        """Brings memory nearer to a sighting that agrees with it.

        Where another landmark was seen a moment ago the odometry cannot have gone wrong much: the error is in the
        place of this one. The longer none was, the more it is the odometry's, and holds for all.
        """
        landmark, smoothing = self.known[color], self.settings.smoothing
        alone = self._alone(time_s, color)
        self._correct(pose, pose.to_local(landmark.place), position, smoothing * alone)
        here, own = pose.to_local(landmark.place), smoothing * (1.0 - alone)
        landmark.place = pose.to_parent(
            Point(here.x + own * (position.x - here.x), here.y + own * (position.y - here.y))
        )

    def _alone(self, time_s: float, color: Color) -> float:
        """How much of an error is the odometry's: 0 where another landmark is in sight, 1 where none was for long."""
        others = max((each.seen_s for other, each in self.known.items() if other != color), default=-math.inf)
        return min(1.0, (time_s - others) / self.settings.alone_s)

    def _correct(self, pose: Pose, expected: Point, position: Point, share: float) -> None:
        """Turns all landmarks about the robot, and shifts them along the line of sight, by what one of them showed."""
        turn = share * wrap_angle(position.bearing - expected.bearing)
        shift = share * (position.distance - expected.distance)
        turned = Pose(0.0, 0.0, turn)
        dx, dy = shift * math.cos(position.bearing), shift * math.sin(position.bearing)
        for landmark in self.known.values():
            here = turned.to_parent(pose.to_local(landmark.place))
            landmark.place = pose.to_parent(Point(here.x + dx, here.y + dy))

    def contradict(self, time_s: float, pose: Pose, look: Callable[[Point], Literal["through", "hidden", ""]]) -> None:
        """Forgets what should be seen at its place and is not, again and again.

        Args:
            time_s: of this look.
            pose: of the robot.
            look: for a place in the robot's frame: whether the camera looks there, and the laser sees ``through`` it,
                or something else stands there that may have ``hidden`` it.
        """
        for color, landmark in list(self.known.items()):
            if landmark.seen_s == time_s:
                continue
            seen = look(pose.to_local(landmark.place))
            landmark.misses += seen == "through"
            landmark.hidden += seen == "hidden"
            if landmark.misses >= self.settings.forget or landmark.hidden >= self.settings.forget_hidden:
                del self.known[color]

    def things(self, time_s: float, pose: Pose) -> dict[Color, Thing]:
        """The landmarks in the robot's frame."""
        return {
            color: Thing(
                id=0,
                color=color,
                position=pose.to_local(landmark.place),
                radius=landmark.radius,
                sensed=landmark.seen_s == time_s,
                seen_s=landmark.seen_s,
            )
            for color, landmark in self.known.items()
        }
