"""What the gripper holds, and of which color (A.3)."""

from understudy.geometry import Point, Pose
from understudy.perception.memory import Memory
from understudy.perception.percepts import GripperState
from understudy.robot import Color, GripperReading, RobotSpec

__all__ = ["GripperSense"]

_SETTLE = 2
"""Readings in a row before a change is believed: the beam flickers while a box slides in."""

_CLOSED_BELOW = 0.80
"""Paddles closed on a box stand at about half of their opening; wide open they read 1."""

_OPEN_ABOVE = 0.92
_RAISED_ABOVE = 0.8
_REACH = 0.35
"""A remembered box at most this far from the beam, in metres, is the one that broke it."""

_PUSHED = 0.80
"""So far, in metres, it may have been pushed since it was seen, where there is no nearer one."""

_LATELY_S = 5.0

_CAPTURED_S = 0.5
"""What has stood between the open paddles for so long is pushed along, and is no longer where it was seen."""

_PUT_M = 0.06
"""So far beyond the beam is the middle of a box that has just left it."""


class GripperSense:
    """Debounces the gripper's sensors and remembers the color of what it took.

    Its state is plain data: the settled beam, the colour, and a count.
    """

    def __init__(self, spec: RobotSpec) -> None:
        self.spec = spec
        self.blocked = False
        self.color: Color | None = None
        self.holding = False
        self._differs = 0
        self._begun = False
        self.pushing: Color | None = None
        self._let_in_s: float | None = None
        self._last: tuple[Color, float, Point] | None = None

    def update(self, time_s: float, pose: Pose, reading: GripperReading | None, boxes: Memory) -> GripperState | None:
        """The gripper's state now; the box that it takes hold of leaves the memory of things on the floor."""
        if reading is None or self.spec.gripper is None:
            return None
        self._differs = self._differs + 1 if reading.beam_broken != self.blocked else 0
        if self._differs >= _SETTLE or not self._begun:
            # The first reading is taken as it is: the robot may begin with something in its gripper.
            self.blocked, self._differs, self._begun = reading.beam_broken, 0, True
        holding = self.blocked and reading.aperture < _CLOSED_BELOW
        mouth = pose.to_parent(Point(self.spec.gripper.x_beam, 0.0))
        if self.blocked:
            self._recognise(time_s, mouth, boxes, holding=holding)
        else:
            self.color = None
        self.holding = holding
        self._push(time_s, pose, reading, boxes)
        return GripperState(
            holding=holding,
            empty=not self.blocked,
            color=self.color if holding else None,
            open=reading.aperture > _OPEN_ABOVE,
            raised=reading.lift > _RAISED_ABOVE,
            blocked=self.blocked,
            pushing=self.pushing,
        )

    def lifted(self) -> None:
        """Somebody carried the robot away: what it pushed stayed behind."""
        self._let_in_s = self.pushing = None

    def _push(self, time_s: float, pose: Pose, reading: GripperReading, boxes: Memory) -> None:
        """What stands between the open, lowered paddles leaves the memory of things on the floor, and returns to it."""
        if self.holding or (self.blocked and reading.lift > _RAISED_ABOVE):
            self._let_in_s = self.pushing = None
        elif self.blocked:
            self._let_in_s = time_s if self._let_in_s is None else self._let_in_s
            if time_s - self._let_in_s >= _CAPTURED_S and self.color is not None:
                self.pushing = self.color
                track = boxes.nearest(pose.to_parent(Point(self._mouth_x, 0.0)), _REACH)
                if track is not None and track.seen_s < time_s and track.color is self.color:
                    boxes.forget(track)
        else:
            if self.pushing is not None:
                boxes.put(time_s, pose, Point(self._mouth_x + _PUT_M, 0.0), self.pushing)
            self._let_in_s = self.pushing = None

    @property
    def _mouth_x(self) -> float:
        return self.spec.gripper.x_beam if self.spec.gripper else 0.0

    def _recognise(self, time_s: float, mouth: Point, boxes: Memory, *, holding: bool) -> None:
        """Which box stands between the paddles: what stands there is not on the floor for the taking."""
        track = boxes.nearest(mouth, _REACH)
        if track is not None and track.believed and track.seen_s < time_s:
            self.color = self.color or track.color
            if holding:
                boxes.forget(track)
        elif self.color is None:
            self.color = self._lost_lately(time_s, mouth) or self._pushed_here(time_s, mouth, boxes)
        if self.color is not None:
            self._last = (self.color, time_s, mouth)

    def _lost_lately(self, time_s: float, mouth: Point) -> Color | None:
        """A box that slipped out of the paddles a moment ago, and is back between them."""
        if self._last is None:
            return None
        color, lost_s, place = self._last
        return color if time_s - lost_s < _LATELY_S and place.distance_to(mouth) < _REACH else None

    @staticmethod
    def _pushed_here(time_s: float, mouth: Point, boxes: Memory) -> Color | None:
        """A box that was last seen not far off, and may have been pushed since."""
        unseen = [track for track in boxes.tracks if track.believed and track.seen_s < time_s]
        near = min(unseen, key=lambda track: track.place.distance_to(mouth), default=None)
        return near.color if near is not None and near.place.distance_to(mouth) < _PUSHED else None
