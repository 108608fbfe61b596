"""What a scripted teacher does, one item after the other: the ``teacher.script`` of a world document."""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BeforeValidator, model_validator
from pydantic_core import PydanticCustomError

from understudy.documents import Part
from understudy.robot import Cue
from understudy.sim.quantities import Metres, Place, Seconds

__all__ = ["DEFAULT_TIMEOUT_S", "Condition", "Saying", "ScriptItem", "Waiting", "Walk"]

DEFAULT_TIMEOUT_S = 30.0
"""A teacher's patience: after that it goes on, so that a script always ends."""

Condition = Literal["robot_holds_box", "robot_empty", "robot_near"]
"""``robot_holds_box``: gripped and lifted; ``robot_empty``: nothing in the gripper, which is closed and lifted again;
``robot_near``: within 0.9 m of the teacher and facing it."""


def _in_capitals(given: Any) -> Any:
    # What is no word stays as it was given, for the message.
    return given.upper() if isinstance(given, str) and given.upper() in list(Cue) else given


Word = Annotated[Cue, BeforeValidator(_in_capitals)]
"""Spoken words have no capitals: ``take`` is as good as ``TAKE``."""


def _at(place: tuple[float, float]) -> str:
    x, y = place
    return f"({round(x, 2)}, {round(y, 2)})"


class Saying(Part):
    """One spoken cue; without a condition it is said at once.

    Attributes:
        word: the cue; in capitals or not.
        delay: seconds between the condition and the word.
        when_robot_within: metres from ``of``; the word waits until the robot's centre is that near.
        of: the place that ``when_robot_within`` refers to.
        when_robot_past: a place; the word waits until it has left the robot's forward half plane.
        timeout: seconds after which the word is said in any case.
    """

    shorthand: ClassVar[str | None] = "word"

    word: Word
    delay: Seconds = 0.0
    when_robot_within: Metres | None = None
    of: Place | None = None
    when_robot_past: Place | None = None
    timeout: Seconds = DEFAULT_TIMEOUT_S

    @model_validator(mode="after")
    def _one_whole_condition(self) -> Self:
        if (self.when_robot_within is None) != (self.of is None):
            raise PydanticCustomError("half_condition", "'when_robot_within' and 'of' go together; only one was given")
        if self.when_robot_within is not None and self.when_robot_past is not None:
            raise PydanticCustomError(
                "two_conditions", "'when_robot_within' and 'when_robot_past' were both given; keep one"
            )
        return self

    @property
    def unmet(self) -> str:
        """What never happened, if the word was said because of its timeout."""
        if self.when_robot_past is not None:
            return f"the robot never got past {_at(self.when_robot_past)}"
        if self.of is not None:
            return f"the robot never came within {self.when_robot_within:g} m of {_at(self.of)}"
        return "it waited for nothing"

    def __str__(self) -> str:
        if self.when_robot_past is not None:
            return f"{self.word} when the robot is past {_at(self.when_robot_past)}"
        if self.of is not None:
            return f"{self.word} when the robot is within {self.when_robot_within:g} m of {_at(self.of)}"
        return str(self.word)


class Walk(Part):
    """A straight walk, waiting for the robot when it falls behind.

    Attributes:
        to: where to.
        say: a cue said on the way, as soon as its condition holds, or at the end of the walk after its timeout.
    """

    shorthand: ClassVar[str | None] = "to"

    to: Place
    say: Saying | None = None

    def __str__(self) -> str:
        return f"to {_at(self.to)}" + (f", saying {self.say}" if self.say is not None else "")


class Waiting(Part):
    """Standing still until the robot is in a state.

    Attributes:
        condition: the state.
        timeout: seconds after which the teacher goes on in any case.
    """

    shorthand: ClassVar[str | None] = "condition"

    condition: Condition
    timeout: Seconds = DEFAULT_TIMEOUT_S


class ScriptItem(Part):
    """One thing that the teacher does; exactly one key is given.

    Attributes:
        say: speak a cue, standing still until its condition holds.
        walk: lead the robot along a straight line.
        step_aside: walk without waiting for the robot or staying in its view, to clear its way to a box.
        wait: stand still for some seconds.
        wait_for: stand still until the robot is in a state.
    """

    say: Saying | None = None
    walk: Walk | None = None
    step_aside: Place | None = None
    wait: Seconds | None = None
    wait_for: Waiting | None = None

    @model_validator(mode="after")
    def _exactly_one(self) -> Self:
        given = [name for name in type(self).model_fields if getattr(self, name) is not None]
        if len(given) != 1:
            raise PydanticCustomError(
                "one_key",
                "a script item has exactly one of the keys {allowed}; given: {given}",
                {"allowed": ", ".join(type(self).model_fields), "given": ", ".join(given) or "none"},
            )
        return self

    def __str__(self) -> str:
        if self.say is not None:
            return f"say {self.say}"
        if self.walk is not None:
            return f"walk {self.walk}"
        if self.step_aside is not None:
            return f"step aside to {_at(self.step_aside)}"
        if self.wait is not None:
            return f"wait {self.wait:g} s"
        assert self.wait_for is not None
        return f"wait for {self.wait_for.condition}"
