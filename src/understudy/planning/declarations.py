"""What skills say of themselves, read and checked, each for itself and all against each other."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from understudy.behaviors import ANY, BOX, TARGET, Fact, Skill, Way, read_facts
from understudy.errors import SkillError

__all__ = ["Use", "read_use", "words_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Use:
    """A way of a skill, read.

    Attributes:
        skill: its name.
        parameters: names of those that a plan chooses, which are among those in ``of``.
        of, goal, needs, keeps, gives, ends: as in :class:`~understudy.behaviors.Way`.
    """

    skill: str
    parameters: tuple[str, ...]
    of: Mapping[str, str]
    goal: Fact
    needs: tuple[Fact, ...]
    keeps: tuple[Fact, ...]
    gives: tuple[Fact, ...]
    ends: tuple[Fact, ...]


def read_use(skill: Skill, way: Way) -> Use:
    """A way of a skill, checked for itself.

    Raises:
        SkillError: it cannot be read, or names what it does not explain.
    """
    chosen = [one for one in skill.abstract.parameters if one.default is None]
    for one in chosen:
        if one.kind != "color":
            raise SkillError(f"{skill.name}: a plan cannot choose {one.name!r}, which is no color; give it a default")
    parameters = tuple(one.name for one in chosen)
    for name in parameters:
        if name not in way.of:
            raise SkillError(
                f"{skill.name} does not say in 'of' whether its parameter {name!r} is a {BOX} or a {TARGET}"
            )
    for name, kind in way.of.items():
        if kind not in (BOX, TARGET):
            raise SkillError(f"{skill.name} says in 'of' that {name!r} is a {kind!r}; it is a {BOX} or a {TARGET}")
    read: dict[str, tuple[Fact, ...]] = {}
    for part in ("goal", "needs", "keeps", "gives", "ends"):
        text = getattr(way, part)
        try:
            read[part] = read_facts(text)
        except ValueError as error:
            raise SkillError(f"{skill.name}: {part!r} is {text!r}, and cannot be read: {error}") from None
        for fact in read[part]:
            for thing in fact.things:
                if thing not in way.of and not (thing == ANY and part == "ends"):
                    names = ", ".join(way.of) or "none"
                    raise SkillError(
                        f"{skill.name} speaks of {fact}, and {thing!r} is no name in 'of'; these are: {names}"
                    )
    if len(read["goal"]) != 1:
        raise SkillError(f"{skill.name}: 'goal' is {way.goal!r}; it is one fact, the one that the skill's goal senses")
    (goal,) = read.pop("goal")
    return Use(skill=skill.name, parameters=parameters, of=way.of, goal=goal, **read)


def words_of(uses: Iterable[Use]) -> dict[str, tuple[str, ...]]:
    """What kinds of things each word is said of.

    Raises:
        SkillError: it is not the same everywhere.
    """
    words: dict[str, tuple[str, ...]] = {}
    ended = []
    for use in uses:
        for fact in (use.goal, *use.needs, *use.keeps, *use.gives, *use.ends):
            if ANY in fact.things:
                ended.append((use, fact))
            else:
                kinds = tuple(use.of[thing] for thing in fact.things)
                _compare(use, Fact(fact.word, kinds), words.setdefault(fact.word, kinds))
    for use, fact in ended:
        if fact.word in words:  # else there is no skill that gives it, and so it cannot end
            known = words[fact.word]
            kinds = tuple(
                known[place] if thing == ANY and place < len(known) else use.of.get(thing, ANY)
                for place, thing in enumerate(fact.things)
            )
            _compare(use, Fact(fact.word, kinds), known)
    return dict(sorted(words.items()))


def _compare(use: Use, said: Fact, known: tuple[str, ...]) -> None:
    if said.things != known:
        raise SkillError(f"{use.skill} says {said}, and elsewhere it is {Fact(said.word, known)}; rename one of them")
