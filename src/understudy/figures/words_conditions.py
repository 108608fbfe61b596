"""Conditions in plain words, as something that is so: "the orange box is in the gripper and step 2 is not done"."""

from collections.abc import Callable, Mapping

from understudy.behaviors import Skill, Worded
from understudy.figures.labels import clean, label
from understudy.figures.words_goals import completed
from understudy.network import (
    Achieved,
    After,
    AllOf,
    AnyOf,
    Complete,
    Condition,
    Happened,
    Holds,
    Not,
    Possible,
    TimedOut,
)

__all__ = ["condition_in_words"]


def condition_in_words(condition: Condition, skills: Mapping[str, Skill], step: Callable[[str], str]) -> str:
    """A condition as a clause that can follow "if", "until" and "whenever".

    Args:
        condition: to be told.
        skills: by name; they know the words for what they see and achieve.
        step: how a component of the same network is called: ``step 3``.
    """
    return clean(_told(condition, skills, step, so=True, alone=True))


def _told(
    condition: Condition, skills: Mapping[str, Skill], step: Callable[[str], str], *, so: bool, alone: bool
) -> str:
    match condition:
        case Not():
            return _told(condition.of, skills, step, so=not so, alone=alone)
        case AllOf() | AnyOf():
            # Not all of them: one of them is not so. (De Morgan)
            word = "and" if isinstance(condition, AllOf) is so else "or"
            single = len(condition.of) == 1
            text = f" {word} ".join(_told(part, skills, step, so=so, alone=alone and single) for part in condition.of)
            return text if alone or single else f"({text})"
        case Holds():
            return _of_skill(condition, skills, so)
        case Possible():
            return _of_skill(condition, skills, so)
        case Happened():
            return f"“{condition.event}” {'is' if so else 'is not'} signalled"
        case Achieved():
            return f"{step(condition.component)} {'is' if so else 'is not'} done"
        case TimedOut():
            return f"{step(condition.component)} {'has' if so else 'has not'} run out of time"
        case Complete():
            return f"it {'is' if so else 'is not'} done"
        case After():
            return f"{condition.seconds:g} s have {'' if so else 'not '}passed"


def _of_skill(condition: Holds | Possible, skills: Mapping[str, Skill], so: bool) -> str:
    """In the skill's words, if it has some that can be denied; else by its goal, or by its label."""
    values = completed(condition.behavior, condition.parameters, skills)
    holding = isinstance(condition, Holds)
    if values is None:
        named = label(condition.behavior, condition.parameters)
        goal = f"{named.title} ({named.details})" if named.details else named.title
    else:
        abstract = skills[condition.behavior].abstract
        if isinstance(abstract, Worded):
            words = abstract.holding(values) if holding else abstract.possible(values)
            if so:
                return words
            if " is " in words:
                return words.replace(" is ", " is not ", 1)
        goal = abstract.describe(values)
    return f"“{goal}” {'is' if so else 'is not'} {'achieved now' if holding else 'possible'}"
