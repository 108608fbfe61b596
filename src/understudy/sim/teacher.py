"""The scripted teacher: leads a robot as Appendix A.5 asks a person to, and speaks the cues.

The teacher stays in the robot's view, does not go farther from it than it can see, waits when it falls behind,
and steps back in front of it when it looks elsewhere. Teachers of other habits do less of that, and play the script
with slips (:mod:`understudy.sim.slips`).
"""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from understudy.clock import CONTROL_PERIOD_S
from understudy.geometry import Point
from understudy.robot import Cue
from understudy.sim.gait import Gait
from understudy.sim.habits import Habits
from understudy.sim.listening import Listener, place_of
from understudy.sim.model import ArenaModel
from understudy.sim.script import Saying, ScriptItem, Waiting, Walk
from understudy.sim.slips import slipped
from understudy.sim.surroundings import Surroundings
from understudy.sim.truth import Truth

__all__ = ["ScriptedTeacher"]

_SLOWS_OVER_M = 1.2 - 0.9
"""The last part of the lead, over which the teacher slows down to a stand."""
_LOST_AT = math.radians(70)
_FOUND_AT = math.radians(35)
_LOST_AFTER_S = 0.5
_NEAR_M, _FACING = 0.9, math.radians(30)
_PASS_M, _ARRIVED_M = 0.12, 0.03
_BLOCKED_AFTER_S = 3.0
"""Standing before something that blocks the way, the teacher takes the walk for finished."""
_IN_SIGHT_M = 2.0
"""What is farther away than this, the robot does not take note of."""
_COMES_WITHIN_M = 1.2
"""So near does a teacher come to a robot that called."""
_SAYS_AGAIN_AFTER_S = 2.0
_LISTENS_FOR_S = 2.0
"""A word that is said once more is waited for an answer to; in the meantime the teacher stands still."""
_LEADING_M = (0.75, 0.95)
_LEADING_BEARINGS = tuple(math.radians(a) for a in (0, 20, -20, 40, -40, 60, -60))


class ScriptedTeacher:
    """Plays a script, one control period at a time.

    Args:
        arena: the world with its teacher.
        truth: what the teacher sees.
        random: of the teacher's slips.
    """

    def __init__(self, arena: ArenaModel, truth: Truth, random: np.random.Generator) -> None:
        document = arena.world.teacher
        assert document is not None, "this world has no teacher"
        self._truth = truth
        self._surroundings = Surroundings(arena, truth)
        self._document, self._meant = document, document.script
        self._habits = document.habits  # at this moment
        targets = [(target.color, Point(*target.at)) for target in arena.world.targets]
        self._listener = Listener(document.script, targets, document.habits.heeds, random)
        names = [robot.name for robot in arena.world.robots]
        self._led = names.index(document.leads) if document.leads is not None else 0
        self.gait = Gait(Point(*document.at), document.radius, document.speed * document.habits.pace)
        played, self.slips = slipped(
            document.script,
            document.habits,
            random,
            start=self.gait.place,
            speed=self.gait.speed,
            free=lambda spot: self._surroundings.free(spot, document.radius),
        )
        self.heading = math.radians(document.heading_deg)
        self._script = list(played)
        self._starts = {0: self.gait.place}  # of the items that were begun: where the teacher stood
        self._back: list[ScriptItem] = []  # walks back, before the item is played again
        self._answers: list[Cue] = []
        self._again: float | None = None  # when the last word will be said once more
        self._listens_until = 0.0  # to the answer to that
        self._called = False
        self._careful: int | None = None  # the item that is played with care, since it went wrong before
        self._driven: Point | None = None
        self._now = 0.0
        self._item = 0
        self._done = not self._script
        self._begun, self._from = 0.0, self.gait.place
        self._ripe: float | None = None  # since when the word may be said
        self._said = False
        self._lost_for = 0.0
        self._returning = False
        self._blocked_for = 0.0
        self._looked, self._seen = -math.inf, Point(0.0, 0.0)
        self.complaints: list[tuple[float, str]] = []
        """Each time that the teacher went on without what it had waited for: when, and a sentence."""

    @property
    def done(self) -> bool:
        """Whether the script came to its end in an earlier period: its last word has been heard."""
        return self._done

    @property
    def _at_end(self) -> bool:
        return self._item >= len(self._script)

    @property
    def item(self) -> int:
        """Index of the script's item that is being played."""
        return self._item

    @property
    def at(self) -> str:
        """The script's item that is being played, ``script[3]: walk to (2.4, 1.4)``; empty at the script's end."""
        return "" if self._at_end else f"script[{self._item}]: {self._current}"

    @property
    def _current(self) -> ScriptItem:
        return self._back[0] if self._back else self._script[self._item]

    def drive(self, velocity: Point | None) -> None:
        """Walks by hand at this velocity (m/s, arena's frame) instead of by the script, or, at None, by the script."""
        self._driven = velocity

    def hear(self, remark: Mapping[str, Any]) -> None:
        """Listens to what the robot says aloud, and does what such a teacher does then.

        Args:
            remark: an event of the robot's, see :class:`understudy.learning.Remarks`.
        """
        item = self._listener.item
        place = place_of(self._meant[item]) if item is not None else None
        seen = self._truth.robot_pose(self._led).to_local(place) if place is not None else Point(0.0, 0.0)
        behind = seen.x < 0.0 or seen.distance > _IN_SIGHT_M
        answers, reaction = self._listener.hears(remark, at=self._item, behind=behind)
        self._answers += answers
        match reaction:
            case "come back":
                self._called = self._returning = True
            case "say again":
                self._again = self._now + _SAYS_AGAIN_AFTER_S
            case "lead again" if item is not None:
                self._lead_again(item)

    def _lead_again(self, item: int) -> None:
        """Goes back, carefully, to where an item began, to play it from there once more as it was meant."""
        if self._meant[item].walk is None:
            self._again = self._now + _SAYS_AGAIN_AFTER_S  # there is nowhere to go back to
            return
        self._back = [ScriptItem(walk=Walk(to=tuple(spot))) for spot in self._way_back(self._starts[item])]
        self._script[item] = self._meant[item]
        self._careful = item
        self._start_item(item)

    def _way_back(self, to: Point) -> list[Point]:
        """Around the robot, which stands on the way that it was led; nowhere if it has not come far since."""
        robot = self._truth.robot_pose(self._led)
        if robot.position.distance_to(to) < _NEAR_M:
            return []
        beside = [robot.to_parent(Point(0.0, side)) for side in (_NEAR_M, -_NEAR_M)]
        free = [spot for spot in beside if self._surroundings.free(spot, self.gait.radius)]
        return [*sorted(free, key=to.distance_to)[:1], to]

    def advance(self, now_s: float) -> tuple[Cue, ...]:
        """One control period: moves the teacher, and returns what was said in it."""
        self._now = now_s
        self._done = self._at_end
        said, self._answers = self._answers, []
        if self._again is not None and now_s >= self._again:
            said.append(self._listener.word)
            self._again, self._listens_until = None, now_s + _LISTENS_FOR_S
        if self._driven is not None:
            self.gait.at_velocity(self._driven, self._surroundings.near(self.gait.place))
        else:
            pausing = self._again is not None or now_s < self._listens_until
            while not (pausing or self._at_end) and self._play(self._current, said):
                self._next()
            if pausing or self._at_end or not self._walking(self._current):
                self._stand()
        if not self.gait.standing:
            self.heading = self.gait.velocity.bearing
        return tuple(said)

    # -- the script -------------------------------------------------------------------------------------------

    @staticmethod
    def _walking(item: ScriptItem) -> bool:
        return item.walk is not None or item.step_aside is not None

    def _next(self) -> None:
        if self._back:
            del self._back[0]
            self._start_item(self._item)
        else:
            self._starts[self._item + 1] = self.gait.place
            self._start_item(self._item + 1)

    def _start_item(self, item: int) -> None:
        if item != self._careful:
            self._careful = None
        own = self._document.habits
        self._habits = own if self._careful is None else Habits(patience=own.patience)
        self.gait.speed = self._document.speed * self._habits.pace
        self._item = item
        self._begun, self._from = self._now, self.gait.place
        self._ripe, self._said, self._blocked_for = None, False, 0.0

    def _play(self, item: ScriptItem, said: list[Cue]) -> bool:
        """Plays an item for this period; True when it is finished and took no time of it."""
        elapsed = self._now - self._begun
        if item.say is not None:
            return self._say(item.say, said, elapsed)
        if item.wait is not None:
            return elapsed >= item.wait
        if item.wait_for is not None:
            return self._wait_for(item.wait_for, elapsed)
        if item.step_aside is not None:
            return self._go(Point(*item.step_aside), haste=1.0, stop_there=True)
        assert item.walk is not None
        return self._lead(item.walk, said)

    def _say(self, saying: Saying, said: list[Cue], elapsed: float) -> bool:
        if self._ripe is None:
            if self._may_say(saying):
                self._ripe = self._now
            elif elapsed >= saying.timeout:
                self._ripe = self._now
                self._complain(f"{saying.word} was said after {round(elapsed, 1):g} s in vain: {saying.unmet}")
        if self._ripe is None or self._now - self._ripe < saying.delay - 1e-9:
            return False
        said.append(saying.word)
        self._listener.spoke(self._item, saying.word)
        self._said, self._again = True, None
        return True

    def _may_say(self, saying: Saying) -> bool:
        robot = self._truth.robot_pose(self._led)
        if saying.of is not None and saying.when_robot_within is not None:
            return robot.position.distance_to(Point(*saying.of)) <= saying.when_robot_within
        if saying.when_robot_past is not None:
            return robot.to_local(Point(*saying.when_robot_past)).x <= 0.0
        return True

    def _wait_for(self, waiting: Waiting, elapsed: float) -> bool:
        if self._holds(waiting):
            return True
        if elapsed < waiting.timeout:
            return False
        self._complain(f"waited {round(elapsed, 1):g} s in vain for: {waiting.condition}")
        return True

    def _complain(self, sentence: str) -> None:
        self.complaints.append((self._now, sentence))

    def _holds(self, waiting: Waiting) -> bool:
        match waiting.condition:
            case "robot_holds_box":
                return self._truth.held_box(self._led) is not None
            case "robot_empty":
                # Not as soon as the paddles let go: dropping goes on until the gripper is closed and lifted.
                return self._truth.gripper_stowed(self._led)
            case "robot_near":
                me = self._from_robot()
                return me.distance <= _NEAR_M and abs(me.bearing) <= _FACING

    # -- leading ----------------------------------------------------------------------------------------------

    def _from_robot(self) -> Point:
        """Where the teacher is, in the robot's frame."""
        return self._truth.robot_pose(self._led).to_local(self.gait.place)

    def _look_back(self) -> Point:
        """Where the teacher was in the robot's frame at the last look at it; whoever comes back, looks all the time."""
        if self._returning or self._now - self._looked >= self._habits.looks_back - 1e-9:
            self._looked, self._seen = self._now, self._from_robot()
        return self._seen

    def _impatient(self, walk: Walk) -> bool:
        """Whether a walk takes so much longer than without the robot that the teacher goes on without it."""
        patience = self._habits.patience
        if patience is None or self._blocked_for >= _BLOCKED_AFTER_S:
            return False
        lost_s = self._now - self._begun - self._from.distance_to(Point(*walk.to)) / self.gait.speed
        if lost_s <= patience:
            return False
        self._complain(f"went on without the robot, which cost {lost_s:.0f} s on the walk {walk}")
        return True

    def _lead(self, walk: Walk, said: list[Cue]) -> bool:
        if walk.say is not None and not self._said:
            # On the way the patience has not begun to run out; at the end of it, it has.
            self._say(walk.say, said, self._now - self._begun if self._arrived(Point(*walk.to), True) else 0.0)
        speaking = walk.say is not None and not self._said
        me = self._look_back()
        self._lost_for = self._lost_for + CONTROL_PERIOD_S if abs(me.bearing) > _LOST_AT else 0.0
        if self._lost_for >= _LOST_AFTER_S:
            self._returning = True
        if self._impatient(walk):
            self._returning = self._called = False
            self._blocked_for = _BLOCKED_AFTER_S
        if self._returning:
            spot = self._spot_in_view()
            if spot is None or (abs(me.bearing) < _FOUND_AT and not (self._called and me.distance > _COMES_WITHIN_M)):
                self._returning = self._called = False
            else:
                self.gait.toward(spot, 1.0, self._surroundings.near(self.gait.place), stop_there=True)
                return False
        haste = min(1.0, max(0.0, (self._habits.lead - me.distance) / _SLOWS_OVER_M))
        if self._lost_for > 0.0:
            haste *= 0.5
        onward = (
            self._back is None and self._item + 1 < len(self._script) and self._script[self._item + 1].walk is not None
        )
        arrived = self._go(Point(*walk.to), haste=haste, stop_there=speaking or not onward)
        return arrived and not speaking

    def _go(self, goal: Point, *, haste: float, stop_there: bool) -> bool:
        if self._arrived(goal, stop_there):
            return True
        self.gait.toward(goal, haste, self._surroundings.near(self.gait.place), stop_there=stop_there)
        blocked = haste > 0.3 and self.gait.standing
        self._blocked_for = self._blocked_for + CONTROL_PERIOD_S if blocked else 0.0
        if self._blocked_for >= _BLOCKED_AFTER_S:
            left, x, y = self.gait.place.distance_to(goal), round(goal.x, 2), round(goal.y, 2)
            self._complain(f"gave up walking {left:.1f} m before ({x}, {y}): something is in the way")
        return False

    def _arrived(self, goal: Point, stop_there: bool) -> bool:
        near = _ARRIVED_M if stop_there else _PASS_M
        return self.gait.place.distance_to(goal) <= near or self._blocked_for >= _BLOCKED_AFTER_S

    def _stand(self) -> None:
        self.gait.at_velocity(Point(0.0, 0.0), ())

    def _spot_in_view(self) -> Point | None:
        """The free spot nearest to the middle of the robot's view."""
        robot = self._truth.robot_pose(self._led)
        for bearing in _LEADING_BEARINGS:
            for distance in _LEADING_M:
                spot = robot.to_parent(Point(distance * math.cos(bearing), distance * math.sin(bearing)))
                if self._surroundings.free(spot, self.gait.radius):
                    return spot
        return None
