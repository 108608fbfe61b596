"""What goes wrong in one lesson: a teacher's script as somebody with such habits plays it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from understudy.geometry import Point
from understudy.robot import Cue
from understudy.sim.habits import Habits
from understudy.sim.script import Saying, ScriptItem, Walk

__all__ = ["Slip", "slipped"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Slip:
    """Where a teacher departs from the script.

    Attributes:
        item: its index in the script.
        kind: a word is forgotten, or comes early or late, or the walk ends aside.
        word: the item's.
        amount: seconds early or late, metres aside; 0 for what is forgotten.
    """

    item: int
    kind: Literal["forgotten", "early", "late", "aside"]
    word: Cue
    amount: float = 0.0

    def __str__(self) -> str:
        match self.kind:
            case "forgotten":
                what = f"{self.word} was forgotten"
            case "aside":
                what = f"the walk with {self.word} ended {self.amount:.1f} m aside"
            case _:
                what = f"{self.word} came {self.amount:.1f} s {self.kind}"
        return f"script[{self.item}]: {what}"


def slipped(
    script: tuple[ScriptItem, ...],
    habits: Habits,
    random: np.random.Generator,
    *,
    start: Point,
    speed: float,
    free: Callable[[Point], bool],
) -> tuple[tuple[ScriptItem, ...], tuple[Slip, ...]]:
    """The script as it will be played, item for item, and where it departs from the one that was meant.

    Every item takes the same number of random numbers whatever the habits, so that the same seed makes a teacher of
    one level err where one of another level does, only more.

    Args:
        script: as it is meant.
        habits: the teacher's.
        random: for this lesson.
        start: where the teacher stands at first.
        speed: of walking, m/s; an early word comes while the robot has still that far to go.
        free: whether the teacher could stand there.
    """
    played: list[ScriptItem] = []
    slips: list[Slip] = []
    for index, meant in enumerate(script):
        forgetting, straying, side = random.random(3)
        late = round(habits.late + habits.timing * float(random.standard_normal()), 1)
        item, begin = meant, start
        if meant.step_aside is not None:
            start = Point(*meant.step_aside)
        if meant.walk is not None:
            start = Point(*meant.walk.to)
        saying = meant.say or (meant.walk.say if meant.walk is not None else None)
        if saying is not None:
            if meant.walk is not None and straying < habits.strays:
                sides = (1.0, -1.0) if side < 0.5 else (-1.0, 1.0)
                aside = [_aside(begin, start, sign * habits.strays_by) for sign in sides]
                if spot := next((spot for spot in aside if free(spot)), None):
                    start = spot
                    item = item.model_copy(update={"walk": meant.walk.model_copy(update={"to": tuple(spot)})})
                    slips.append(Slip(item=index, kind="aside", word=saying.word, amount=habits.strays_by))
            if saying.word is Cue.HERE and forgetting < habits.forgets:
                item = _saying(item, None)
                slips.append(Slip(item=index, kind="forgotten", word=saying.word))
            elif moved := _at_another_time(saying, late, speed, begin, start):
                item = _saying(item, moved)
                slips.append(Slip(item=index, kind="late" if late > 0 else "early", word=saying.word, amount=abs(late)))
        played.append(item)
    return tuple(played), tuple(slips)


def _aside(begin: Point, to: Point, by: float) -> Point:
    """A point so far to the left of the end of a walk."""
    length = begin.distance_to(to)
    if length == 0.0:
        return to
    return Point(to.x - by * (to.y - begin.y) / length, to.y + by * (to.x - begin.x) / length)


def _saying(item: ScriptItem, saying: Saying | None) -> ScriptItem:
    """The item with another word, or with none."""
    if item.walk is not None:
        return ScriptItem(walk=Walk.model_copy(item.walk, update={"say": saying}))
    return ScriptItem(wait=0.0) if saying is None else ScriptItem(say=saying)


def _at_another_time(saying: Saying, late: float, speed: float, begin: Point, to: Point) -> Saying | None:
    """A word so late, or, while the robot has still some way to go, so early; None where nothing changes."""
    if late > 0:
        return saying.model_copy(update={"delay": saying.delay + late})
    too_far, length = -late * speed, begin.distance_to(to)
    if too_far > 0 and saying.when_robot_within is not None:
        return saying.model_copy(update={"when_robot_within": saying.when_robot_within + too_far})
    if too_far > 0 and saying.when_robot_past is not None and length > 0.0:
        x, y = saying.when_robot_past
        back = (x - too_far * (to.x - begin.x) / length, y - too_far * (to.y - begin.y) / length)
        return saying.model_copy(update={"when_robot_past": back})
    return None  # what waits for nothing cannot come too early
