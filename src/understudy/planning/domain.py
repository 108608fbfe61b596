"""The planning domain: all that the skills can do with the things at hand, one operator for each (§3.3.1)."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product

from understudy.behaviors import ANY, BOX, TARGET, Fact, Skill
from understudy.planning.declarations import Use, read_use, words_of
from understudy.robot import Color

__all__ = ["EVERYTHING", "Domain", "Facts", "Operator", "Things", "domain_of"]

Facts = frozenset[Fact]
"""What is so; everything else is not."""

Things = Mapping[str, Sequence[str]]
"""What there is: colors by kind."""

EVERYTHING: Things = {BOX: tuple(map(str, Color)), TARGET: tuple(map(str, Color))}
"""A box and a target of each trained color."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Operator:
    """One use of a skill.

    Attributes:
        name: unique in its domain; ``Drop(box=orange, target=pink)``.
        skill: its name.
        parameters: values of its discrete parameters.
        goal: what the skill's own goal senses in a running task.
        needs: must be so when it begins, ``keeps`` among it.
        keeps: must be so until it is done.
        gives: is so afterwards, ``goal`` among it.
        ends: is not so afterwards; nothing that it gives.
    """

    name: str
    skill: str
    parameters: Mapping[str, str] = field(hash=False)
    goal: Fact
    needs: Facts
    keeps: Facts
    gives: Facts
    ends: Facts

    def after(self, facts: Facts) -> Facts:
        """What is so after it, if what it needs was so before."""
        return (facts - self.ends) | self.gives


@dataclass(frozen=True, slots=True, kw_only=True)
class Domain:
    """What can be done, and said.

    Attributes:
        things: colors by kind.
        words: of each word of the skills, what kinds of things it is said of.
        operators: in the order of the skills' names, then of the things.
        silent: names of the skills that do not say how they can be used, and so are left out.
    """

    things: Things
    words: Mapping[str, tuple[str, ...]]
    operators: tuple[Operator, ...]
    silent: tuple[str, ...] = ()

    @property
    def silence(self) -> tuple[str, ...]:
        """That nothing can be planned with these, as a sentence, if there are any."""
        if not self.silent:
            return ()
        say = "it does not say what it needs and gives" if len(self.silent) == 1 else "they do not say what they need"
        return (f"nothing can be planned with {', '.join(self.silent)}: {say}",)


def domain_of(skills: Mapping[str, Skill], things: Things = EVERYTHING) -> Domain:
    """All that the skills can do with some things.

    Args:
        skills: by name.
        things: colors by kind.

    Raises:
        SkillError: what a skill says of itself cannot be read, or has no meaning.
    """
    uses = [read_use(skills[name], way) for name in sorted(skills) for way in skills[name].ways]
    words = words_of(uses)
    return Domain(
        things=things,
        words=words,
        operators=tuple(operator for use in uses for operator in _operators(use, things, words)),
        silent=tuple(name for name in sorted(skills) if not skills[name].ways),
    )


def _operators(use: Use, things: Things, words: Mapping[str, tuple[str, ...]]) -> Iterator[Operator]:
    """One operator for each choice of things."""
    for values in product(*(things[kind] for kind in use.of.values())):
        chosen = dict(zip(use.of, values, strict=True))

        def said(*facts: Fact, chosen: Mapping[str, str] = chosen) -> Facts:
            return frozenset(Fact(fact.word, tuple(chosen[thing] for thing in fact.things)) for fact in facts)

        inside = ", ".join(f"{name}={value}" for name, value in chosen.items())
        keeps, gives = said(*use.keeps), said(use.goal, *use.gives)
        (goal,) = said(use.goal)
        ends = {
            one for fact in use.ends if fact.word in words for one in _every(fact, chosen, things, words[fact.word])
        }
        yield Operator(
            name=f"{use.skill}({inside})" if inside else use.skill,
            skill=use.skill,
            parameters={name: chosen[name] for name in use.parameters},
            goal=goal,
            needs=keeps | said(*use.needs),
            keeps=keeps,
            gives=gives,
            ends=frozenset(ends - gives),
        )


def _every(fact: Fact, chosen: Mapping[str, str], things: Things, kinds: Sequence[str]) -> Iterator[Fact]:
    """The facts for which one with ``*`` stands."""
    choices = [
        things[kind] if thing == ANY else (chosen[thing],) for thing, kind in zip(fact.things, kinds, strict=True)
    ]
    return (Fact(fact.word, values) for values in product(*choices))
