"""A teacher's ear: what a remark of the robot's makes a listening teacher do (A.5, A.6)."""

import math
from collections.abc import Mapping, Sequence
from itertools import takewhile
from typing import Any, Literal

import numpy as np

from understudy.geometry import Point
from understudy.robot import Color, Cue
from understudy.sim.script import ScriptItem

__all__ = ["Listener", "Reaction", "meant_by", "place_of"]

Reaction = Literal["come back", "say again", "lead again"]

_STANDS_FOR_M = 1.0
"""A word that waits for a place is about the target that stands there, or beside the box there."""

_TRIES = 2
"""So often does a teacher try to mend one word: first by saying it once more, if that may help."""


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
        self._meant = [meant_by(item, targets) for item in script]
        self._shown: set[int] = set()
        self._tried: dict[int, int] = {}
        self.item: int | None = None
        self.word = Cue.START
        """The word that was said last, and its item in the script."""

    def spoke(self, item: int, word: Cue) -> None:
        """The teacher said a word of an item."""
        self.item, self.word = item, word

    def hears(self, remark: Mapping[str, Any], *, at: int, behind: bool) -> tuple[tuple[Cue, ...], Reaction | None]:
        """What the teacher answers to a remark, and does then.

        Args:
            remark: an event of the robot's, see :class:`understudy.learning.Remarks`.
            at: the item of the script that is being played.
            behind: what the last word was about is behind the robot by now, or out of its sight.
        """
        if self._random.random() >= self._heeds:
            return (), None
        if remark["about"] == "lost":
            return (), "come back"
        named = list(remark.get("noted", ()))
        if remark["about"] == "passed":
            return self._reminded(named[0], at), None
        if remark["cue"] != self.word or self.item is None:
            return (), None  # the teacher has said something else since
        # Each BAD takes back what was named last, so what was named after a wrong thing goes with it.
        right = list(takewhile(set(self._meant[: self.item + 1]).__contains__, named))
        answer = (Cue.BAD,) * (len(named) - len(right))
        if not self._missing(remark["about"], right):
            self._shown.add(self.item)
            return answer, None
        tried = self._tried.get(self.item, 0)
        if tried >= _TRIES:
            return answer, None
        self._tried[self.item] = tried + 1
        return answer, "lead again" if behind or tried or remark["about"] == "missed" else "say again"

    def _reminded(self, name: str, at: int) -> tuple[Cue, ...]:
        """HERE, if that was to be shown by now and has not been."""
        for item, meant in enumerate(self._meant[: at + 1]):
            if meant == name and item not in self._shown:
                self.spoke(item, Cue.HERE)
                return (Cue.HERE,)
        return ()

    def _missing(self, about: str, noted: Sequence[str]) -> bool:
        """Whether the robot did not take what the last word meant."""
        meant = self._meant[self.item or 0]
        if about == "missed":
            return True
        return self.word is Cue.HERE and (meant not in noted if meant is not None else not noted)


def meant_by(item: ScriptItem, targets: Sequence[tuple[Color, Point]]) -> Color | None:
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
