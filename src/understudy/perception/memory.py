"""Working memory: things keep their places while the robot moves, until the senses contradict (§3.5.3.2)."""

import math
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

from understudy.geometry import Point, Pose
from understudy.perception.percepts import Thing
from understudy.robot import Color

__all__ = ["Memory", "MemorySettings", "Track"]


@dataclass(frozen=True, slots=True, kw_only=True)
class MemorySettings:
    """How quickly the memory believes and forgets.

    Attributes:
        confirm: sightings by the camera before a thing is believed; a false blob rarely comes twice in one place.
        confirm_within_s: they must come within this time.
        forget: contradictions in a row after which a thing is forgotten.
        gate_m: a sighting this near to a remembered place is the same thing.
        gate_per_m: added for every metre of distance, since far sightings are less exact.
        smoothing: weight of a new position against the remembered one.
        lose_s: a thing not met for this long is no longer followed, only remembered.
        doubt_m, doubt_s: a thing not met although the robot has been so near for so long in all is forgotten: it is not
            there, or it cannot be reached from here, as behind a wall; and the search for it begins anew.
    """

    confirm: int = 3
    confirm_within_s: float = 1.0
    forget: int = 8
    gate_m: float = 0.30
    gate_per_m: float = 0.05
    smoothing: float = 0.6
    lose_s: float = 1.0
    doubt_m: float = 0.0
    doubt_s: float = math.inf


@dataclass(slots=True)
class Track:
    """One remembered thing; ``place`` is in the odometry's frame."""

    id: int
    place: Point
    radius: float
    first_s: float
    seen_s: float
    votes: Counter[Color] = field(default_factory=Counter)
    sightings: int = 0
    misses: int = 0
    near_s: float = 0.0
    believed: bool = False
    followed: bool = False

    @property
    def color(self) -> Color:
        """The one it was seen in most often."""
        if len(self.votes) == 1:  # as nearly always
            return next(iter(self.votes))
        return max(self.votes, key=self.votes.__getitem__)


class Memory:
    """The things of one kind (targets, boxes, or people) that the robot believes in.

    All its state is in :attr:`tracks`, :attr:`next_id` and :attr:`time_s`, plain data.
    """

    def __init__(self, settings: MemorySettings | None = None) -> None:
        self.settings = settings or MemorySettings()
        self.tracks: list[Track] = []
        self.next_id = 1
        self.time_s = 0.0

    def nearest(self, place: Point, reach: float) -> Track | None:
        """The track nearest to a place of the odometry's frame, at most ``reach`` metres away."""
        best, best_distance = None, reach
        for track in self.tracks:
            distance = track.place.distance_to(place)
            if distance <= best_distance:
                best, best_distance = track, distance
        return best

    def sighted(self, time_s: float, pose: Pose, position: Point, radius: float, color: Color) -> Track:
        """The camera saw a thing of a color at ``position`` (robot's frame).

        In another color than it is believed to have it is there, but does not move: a false blob beside a thing is no
        sighting of it (§4.5.6).
        """
        place = pose.to_parent(position)
        track = self.nearest(place, self.settings.gate_m + self.settings.gate_per_m * position.distance)
        if track is None:
            track = Track(self.next_id, place, radius, time_s, time_s)
            self.next_id += 1
            self.tracks.append(track)
        if track.believed and color is not track.color:
            self._meet(track, time_s)
        else:
            self._move(track, time_s, place, radius)
        track.followed = True
        track.votes[color] += 1
        track.sightings += 1
        if track.sightings >= self.settings.confirm:
            track.believed = True
        return track

    def put(self, time_s: float, pose: Pose, position: Point, color: Color, *, radius: float = 0.05) -> None:
        """A thing of which the robot knows without seeing it now is at ``position`` (robot's frame)."""
        track = Track(self.next_id, pose.to_parent(position), radius, time_s, time_s, believed=True)
        track.votes[color] = self.settings.confirm
        self.next_id += 1
        self.tracks.append(track)

    def felt(self, track: Track, time_s: float, pose: Pose, position: Point, radius: float, *, whole: bool) -> None:
        """The laser met a believed thing at ``position`` (robot's frame); it tells no color.

        Where the sweep ends at it and it is not met ``whole``, it is there, but memory knows better where.
        """
        if whole:
            self._move(track, time_s, pose.to_parent(position), radius)
        else:
            self._meet(track, time_s)

    def _move(self, track: Track, time_s: float, place: Point, radius: float) -> None:
        keep, take = 1 - self.settings.smoothing, self.settings.smoothing
        track.place = Point(keep * track.place.x + take * place.x, keep * track.place.y + take * place.y)
        track.radius = 0.8 * track.radius + 0.2 * radius
        self._meet(track, time_s)

    @staticmethod
    def _meet(track: Track, time_s: float) -> None:
        track.seen_s, track.misses, track.near_s = time_s, 0, 0.0

    def contradict(self, time_s: float, pose: Pose, missing: Callable[[Track], bool]) -> None:
        """Counts a miss for every track not met now that ``missing`` says should have been, and forgets."""
        kept: list[Track] = []
        passed = time_s - self.time_s
        self.time_s = time_s
        for track in self.tracks:
            if track.seen_s < time_s:
                track.misses += missing(track)
                if track.place.distance_to(pose.position) < self.settings.doubt_m:
                    track.near_s += passed
            if time_s - track.seen_s > self.settings.lose_s:
                track.followed = False
            stale = not track.believed and time_s - track.first_s > self.settings.confirm_within_s
            doubtful = track.near_s >= self.settings.doubt_s
            if track.misses < self.settings.forget and not stale and not doubtful:
                kept.append(track)
        self.tracks = kept

    def forget(self, track: Track) -> None:
        """Takes a thing out of memory, for example because the gripper holds it now."""
        self.tracks = [other for other in self.tracks if other is not track]

    def things(self, time_s: float, pose: Pose) -> list[Thing]:
        """The believed things in the robot's frame, nearest first."""
        believed = [track for track in self.tracks if track.believed]
        if not believed:
            return []
        found = [
            Thing(
                id=track.id,
                color=track.color,
                position=position,
                radius=track.radius,
                sensed=track.seen_s == time_s,
                seen_s=track.seen_s,
                followed=track.followed,
            )
            for track, position in zip(believed, pose.to_locals(track.place for track in believed), strict=True)
        ]
        return sorted(found, key=lambda thing: (thing.distance_m, thing.id))
