"""How well a teacher teaches: habits in which people who never taught a robot differ from those who did (§4.5.6)."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, model_validator

from understudy.documents import Part
from understudy.sim.quantities import Level, Metres, Rate, Seconds, plainly

__all__ = ["LEVELS", "Habits", "Skilled"]

Skilled = Literal["experienced", "instructed", "inexperienced"]
"""Three levels of skill: who has often taught the robot, who has read the manual, and who has not."""

LEVELS: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "experienced": {},
        "instructed": {
            "pace": 1.2,
            "lead": 1.5,
            "looks_back": 1.0,
            "patience": 60.0,
            "late": 0.3,
            "timing": 0.7,
            "forgets": 0.03,
            "strays": 0.05,
        },
        "inexperienced": {
            "pace": 1.6,
            "lead": 2.0,
            "looks_back": 4.0,
            "patience": 60.0,
            "late": 0.6,
            "timing": 2.0,
            "forgets": 0.10,
            "strays": 0.15,
        },
    }
)
"""What distinguishes each level from the experienced teacher, who has all the defaults."""

Factor = Annotated[float, Field(gt=0.0, le=5.0), plainly("a number above 0, at most 5")]
Delay = Annotated[float, Field(allow_inf_nan=False), plainly("a finite number of seconds")]


class Habits(Part):
    """The ``habits`` of a teacher. The defaults are a careful teacher's, who keeps to Appendix A.5.

    The level alone may be written in the place of all, ``habits: inexperienced``; what is given beside it wins.

    Attributes:
        like: the level of skill that fills in what is left out.
        pace: of walking, as a multiple of the teacher's ``speed``. The robot follows at up to 0.50 m/s, and so falls
            behind people who stroll faster.
        lead: metres from the robot at which the teacher stops and waits; A.5 allows 1.5 m, and beyond 2 m the robot
            recognises nobody.
        looks_back: seconds between two looks at the robot while walking; 0 is always. In between, the teacher walks on
            as if the robot still did what it did then.
        patience: seconds that a walk may take longer than without the robot, until the teacher goes on without it; None
            waits without end.
        late: seconds by which words come late on the average, as reactions do; negative is early.
        timing: standard deviation of that, seconds: the misjudgement of when the robot sees what is meant.
        forgets: share of the HERE that are forgotten. The other words are not: the teacher would notice that nothing
            happens.
        strays: share of the walks with a word that end aside, so that the teacher stands in the robot's view of what is
            meant, or leads it past too far away.
        strays_by: how far aside, metres, to either side; as far as the robot keeps from what it passes.
        heeds: share of the robot's remarks that the teacher heeds: comes back when it is lost, says HERE again, and
            leads it there again, when it did not take note of what was meant.
    """

    shorthand: ClassVar[str | None] = "like"

    like: Skilled = "experienced"
    pace: Factor = 1.0
    lead: Metres = 1.2
    looks_back: Seconds = 0.0
    patience: Seconds | None = None
    late: Delay = 0.0
    timing: Level = 0.0
    forgets: Rate = 0.0
    strays: Rate = 0.0
    strays_by: Metres = 0.7
    heeds: Rate = 0.0

    @model_validator(mode="before")
    @classmethod
    def _filled_in(cls, given: Any) -> Any:
        keys = {"like": given} if isinstance(given, str) else given
        level = keys.get("like") if isinstance(keys, Mapping) else None
        if isinstance(level, str) and level in LEVELS:
            return {**LEVELS[level], **keys}
        return given
