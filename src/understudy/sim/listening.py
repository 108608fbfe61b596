"""A teacher's ear: what a remark of the robot's makes a listening teacher do (A.5, A.6)."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from understudy.geometry import Point
from understudy.robot import Color, Cue
from understudy.sim.script import ScriptItem

__all__ = ["Listener", "Reaction", "place_of"]

Reaction = Literal["come back", "say again", "lead again"]

_STANDS_FOR_M = 1.0
"""A word that waits for a place is about the target that stands there, or beside the box there."""

_TRIES = 2
"""So often does a teacher try to mend one word."""


class Listener:
    """Remembers which word the robot may be speaking of, and decides.

    Args:
        script: as it was meant.
        targets: colors and places of the targets, as the teacher knows them.
        heeds: share of the remarks that are heeded.
        random: of that.
    """

    def __init__(
        self,
        script: Sequence[ScriptItem],
        targets: Sequence[tuple[Color, Point]],
        heeds: float,
        random: np.random.Generator,
    ) -> None:
        self._heeds, self._random = heeds, random
        self._meant = [_meant(item, targets) for item in script]
        self._tried: dict[int, int] = {}
        self.item, self.word = 0, Cue.START
        """The word that was said last, and its item in the script."""

    def spoke(self, item: int, word: Cue) -> None:
        """The teacher said a word of an item."""
        self.item, self.word = item, word

    def hears(self, remark: Mapping[str, Any], *, behind: bool) -> tuple[tuple[Cue, ...], Reaction | None]:
        """What the teacher answers to a remark, and does then.

        Args:
            remark: an event of the robot's, see :class:`understudy.learning.Remarks`.
            behind: what the last word was about is behind the robot by now, or out of its sight.
        """
        if self._random.random() >= self._heeds:
            return (), None
        if remark["about"] == "lost":
            return (), "come back"
        if remark["cue"] != self.word:
            return (), None  # the teacher has said something else since
        noted, meant = set(remark.get("noted", ())), self._meant[self.item]
        wrong = noted.difference(color for color in self._meant if color is not None)
        match remark["about"], meant:
            case "missed", _:
                missing = True
            case "nothing", None:
                missing = True
            case _, None:
                missing = self.word is Cue.HERE and bool(wrong)
            case _:
                missing = self.word is Cue.HERE and (bool(wrong) or meant not in noted)
        answer = (Cue.BAD,) if wrong else ()
        if not missing or self._tried.get(self.item, 0) >= _TRIES:
            return answer, None
        self._tried[self.item] = self._tried.get(self.item, 0) + 1
        return answer, "lead again" if behind or remark["about"] == "missed" else "say again"


def _meant(item: ScriptItem, targets: Sequence[tuple[Color, Point]]) -> Color | None:
    """The color of the target that an item's word is about; None if it is about none."""
    if (place := place_of(item)) is None:
        return None
    away, color = min(((at.distance_to(place), color) for color, at in targets), default=(math.inf, None))
    return color if away <= _STANDS_FOR_M else None


def place_of(item: ScriptItem) -> Point | None:
    """The place that an item's word waits for, if it has one."""
    saying = item.say or (item.walk.say if item.walk is not None else None)
    place = saying and (saying.of or saying.when_robot_past)
    return Point(*place) if place is not None else None
