"""The skills that are installed. Others add theirs through the entry-point group ``understudy.skills``."""

from collections.abc import Iterable, Iterator, Mapping
from difflib import get_close_matches
from functools import cache
from importlib.metadata import entry_points

from understudy.behaviors.skill import Skill
from understudy.errors import SkillError

__all__ = ["ENTRY_POINT_GROUP", "SkillSet", "installed_skills", "unknown_skill"]

ENTRY_POINT_GROUP = "understudy.skills"


class SkillSet(Mapping[str, Skill]):
    """Skills by name; no name twice."""

    def __init__(self, *skills: Skill) -> None:
        self._skills: dict[str, Skill] = {}
        for skill in skills:
            if skill.name in self._skills:
                raise SkillError(f"two skills are called {skill.name!r}; rename one of them")
            self._skills[skill.name] = skill

    def __getitem__(self, name: str) -> Skill:
        return self._skills[name]

    def __contains__(self, name: object) -> bool:
        return name in self._skills

    def __iter__(self) -> Iterator[str]:
        return iter(self._skills)

    def __len__(self) -> int:
        return len(self._skills)


def unknown_skill(name: str, skills: Iterable[str]) -> str:
    """What to say of a skill that is not there: which there are, and which may be meant."""
    known = list(skills)
    close = get_close_matches(name, known, n=1)
    hint = f", did you mean {close[0]!r}?" if close else ""
    return f"there is no skill called {name!r}{hint}; installed are: {', '.join(known) or 'none'}"


@cache
def installed_skills() -> SkillSet:
    """Every skill that an installed package offers.

    Raises:
        SkillError: an entry point cannot be loaded, or is no :class:`Skill`.
    """
    skills = []
    for point in sorted(entry_points(group=ENTRY_POINT_GROUP), key=lambda point: point.name):
        try:
            skill = point.load()
        except Exception as error:  # whatever a foreign package does when it is imported
            raise SkillError(f"the skill {point.name!r} ({point.value}) cannot be loaded: {error}") from error
        if not isinstance(skill, Skill):
            raise SkillError(f"the entry point {point.name!r} ({point.value}) is no understudy Skill")
        skills.append(skill)
    return SkillSet(*skills)
