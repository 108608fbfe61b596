"""How a robot teaches: naively, as the dissertation's did, or with an eye to its follower."""

import math
from dataclasses import dataclass

from understudy.errors import LearningError

__all__ = ["CAREFUL", "NAIVE", "Manner"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Manner:
    """What a teacher does for its follower. Each is one mending of what broke the naive teacher's chains.

    Attributes:
        looks_around: turns once on the spot before it says START, so that it knows where things are and need not
            search for them with the follower behind it.
        waits: stands still while the follower tells that it is not with its teacher.
        pace: share of its own speed at which it drives; the follower is faster than that.
        shows_m: a word is said when the teacher has driven on by so much since the step was achieved: then it is the
            follower that stands where the teacher stood. 0 says it at once.
        trail: agreed upon with the follower, which goes where the teacher went, and not straight towards it.

    Raises:
        LearningError: a figure is out of its range.
    """

    looks_around: bool = True
    waits: bool = True
    pace: float = 0.6
    shows_m: float = 0.75
    trail: bool = True

    def __post_init__(self) -> None:
        if not 0.0 < self.pace <= 1.0:
            raise LearningError(f"the teacher's pace is {self.pace:g}; it must be above 0, and at most 1")
        if not (math.isfinite(self.shows_m) and self.shows_m >= 0.0):
            raise LearningError(f"the teacher shows its steps {self.shows_m:g} m later; it must be 0 or more")


CAREFUL = Manner()

NAIVE = Manner(looks_around=False, waits=False, pace=1.0, shows_m=0.0, trail=False)
"""Executes its task as if nobody followed, and says so when it achieves something (§4.5.5.2)."""
