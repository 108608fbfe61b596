"""A goal as a person writes it: ``carried(orange, pink) and visited(green)``."""

from difflib import get_close_matches

from understudy.behaviors import Fact, read_facts
from understudy.errors import PlanningError
from understudy.planning.domain import Domain

__all__ = ["goal_name", "in_words", "read_goal"]

_TOLD = 3
"""So many facts of a goal make a name that can still be read."""


def read_goal(text: str, domain: Domain) -> tuple[Fact, ...]:
    """The facts of a goal, with ``and`` or commas between them; each once.

    Raises:
        PlanningError: it cannot be read, or has a word that no skill has, or says it of the wrong number of things, or
            of one that there is not.
    """
    try:
        facts = read_facts(text)
    except ValueError as error:
        raise PlanningError(f"{text!r} cannot be read as a goal: {error}; {_example(domain)}") from None
    if not facts:
        raise PlanningError(f"no goal is given; {_example(domain)}")
    return tuple(dict.fromkeys(_known(fact, domain) for fact in facts))


def in_words(facts: tuple[Fact, ...]) -> str:
    """``carried(orange, pink) and visited(green)``."""
    return " and ".join(map(str, facts))


def goal_name(facts: tuple[Fact, ...]) -> str:
    """A name for a task with this goal: ``carried orange pink and visited green``, or ``… and 7 more``."""
    told = [" ".join((fact.word, *fact.things)) for fact in facts]
    shown = told[:_TOLD] if len(told) > _TOLD + 1 else told
    more = [f"{len(told) - _TOLD} more"] if len(shown) < len(told) else []
    return " and ".join((*shown, *more))


def _known(fact: Fact, domain: Domain) -> Fact:
    if fact.word not in domain.words:
        close = get_close_matches(fact.word, domain.words, n=1)
        hint = f", did you mean {close[0]!r}?" if close else ""
        raise PlanningError(f"no skill speaks of {fact.word!r}{hint}; {_sayable(domain)}")
    kinds = domain.words[fact.word]
    if len(kinds) != len(fact.things):
        raise PlanningError(
            f"{fact} is said of {len(fact.things)}, and not of {len(kinds)}; write {Fact(fact.word, kinds)}"
        )
    things = []
    for given, kind in zip(fact.things, kinds, strict=True):
        color = " ".join(given.replace("-", " ").replace("_", " ").split()).lower()
        if color not in domain.things[kind]:
            there = ", ".join(domain.things[kind]) or "none"
            raise PlanningError(f"{fact}: there is no {given!r} {kind}; there are: {there}")
        things.append(color)
    return Fact(fact.word, tuple(things))


def _sayable(domain: Domain) -> str:
    said = ", ".join(str(Fact(word, kinds)) for word, kinds in domain.words.items())
    return "; ".join((f"what can be said is: {said or 'nothing'}", *domain.silence))


def _example(domain: Domain) -> str:
    return f"write facts with 'and' between them; {_sayable(domain)}"
