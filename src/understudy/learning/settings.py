"""What the learner takes for noise, for one observation, for salient. Every figure is settable."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType
from typing import Literal

from understudy.errors import LearningError
from understudy.learning.allen import HALF_A_TICK_S
from understudy.robot.cues import Cue

__all__ = ["DISTANCE", "LearningSettings"]

DISTANCE = "distance_m"
"""The value, among those that make a goal true, which is the distance to what the goal is about."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LearningSettings:
    """Settings of the learner; the defaults are those of semantics §4.

    Attributes:
        merge_gap_s: two observations of one kind, no farther apart than this, are one (ε of §4.4.1).
        min_duration_s: shorter observations are false indications (§4.4.1: "less than 2sec.").
        max_distance_m: what was last seen farther away was not visited (§4.4.1: "greater than 2 meters").
        cue_grace_s: how early or late a word may come, by human timing. It is late for a thing that is out of view only
            if no other one is in view (:func:`~understudy.learning.pointing.pointed_at`).
        take_back_s: how long after a word BAD takes back what it pointed at (A.6: "within 10 seconds"); 0 is never.
        cue_delay_s: how long after TAKE or DROP the robot may need until it holds the box or has let go of it.
        cue_effects: the behaviors whose goal a word brings about; they may come true ``cue_delay_s`` after it.
        heed_cues: keep only what the teacher's words fall on, if there were any; off, all that was observed belongs to
            the task (§5.4.3).
        standing: behaviors whose goal may be the situation that a task starts from. Seen at START, such an
            observation needs no cue: nobody points at the empty gripper (semantics §4).
        keep_unchanging: keep a goal without values that was true from START to DONE. A condition that the teacher
            neither brought about nor ended is left out, so that visiting six targets is learned as six visits in an
            order (Figure 4.7), not as six visits with an empty gripper.
        tolerance_s: endpoints that differ by no more are one moment.
        order: by the onset of the observations (§4.4.1), or by the moments of closest approach.
        value_tolerances: how far a value may stray and still be the learned one (semantics §1). A value that is not
            listed must not change at all: the doubt goes to the less demanding link.
        begin: the word that begins a demonstration. Practice uses COME here.
        end: the word that ends it. Practice uses GO here.

    Raises:
        LearningError: a figure is negative or not a number.
    """

    merge_gap_s: float = 2.0
    min_duration_s: float = 2.0
    max_distance_m: float = 2.0
    cue_grace_s: float = 1.5
    take_back_s: float = 10.0
    cue_delay_s: float = 30.0
    cue_effects: Mapping[Cue, frozenset[str]] = field(
        default_factory=lambda: MappingProxyType(
            {Cue.TAKE: frozenset({"PickUp", "GetBox"}), Cue.DROP: frozenset({"Drop"})}
        )
    )
    heed_cues: bool = True
    standing: frozenset[str] = frozenset({"Drop"})
    keep_unchanging: bool = False
    tolerance_s: float = HALF_A_TICK_S
    order: Literal["onset", "closest"] = "onset"
    value_tolerances: Mapping[str, float] = field(
        default_factory=lambda: MappingProxyType({DISTANCE: 0.10, "angle_deg": 10.0})
    )
    begin: Cue = Cue.START
    end: Cue = Cue.DONE

    def __post_init__(self) -> None:
        figures = {item.name: getattr(self, item.name) for item in fields(self) if item.type is float}
        figures |= {f"value_tolerances[{name!r}]": value for name, value in self.value_tolerances.items()}
        for name, value in figures.items():
            if not (math.isfinite(value) and value >= 0):
                raise LearningError(f"the setting {name} is {value:g}; it must be 0 or more")
        if self.order not in ("onset", "closest"):
            raise LearningError(f"the setting order is {self.order!r}; it must be 'onset' or 'closest'")
