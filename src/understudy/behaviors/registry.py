"""The skills that are installed. Others add theirs through the entry-point group ``understudy.skills``."""

from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from functools import cache
from importlib.metadata import entry_points

from understudy.behaviors.skill import Skill
from understudy.errors import SkillError

__all__ = ["ENTRY_POINT_GROUP", "SkillSet", "installed_skills"]

ENTRY_POINT_GROUP = "understudy.skills"


class SkillSet(Mapping[str, Skill]):
    """Skills by name; an unknown name is answered with those that exist."""

    def __init__(self, *skills: Skill) -> None:
        self._skills: dict[str, Skill] = {}
        for skill in skills:
            if skill.name in self._skills:
                raise SkillError(f"two skills are called {skill.name!r}; rename one of them")
            self._skills[skill.name] = skill

    def __getitem__(self, name: str) -> Skill:
        try:
            return self._skills[name]
        except KeyError:
            close = get_close_matches(name, self._skills, n=1)
            hint = f", did you mean {close[0]!r}?" if close else ""
            known = ", ".join(self._skills) or "none"
            raise SkillError(f"there is no skill called {name!r}{hint}; installed are: {known}") from None

    def __contains__(self, name: object) -> bool:
        return name in self._skills

    def __iter__(self) -> Iterator[str]:
        return iter(self._skills)

    def __len__(self) -> int:
        return len(self._skills)


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
        except (ImportError, AttributeError) as error:
            raise SkillError(f"the skill {point.name!r} ({point.value}) cannot be loaded: {error}") from error
        if not isinstance(skill, Skill):
            raise SkillError(f"the entry point {point.name!r} ({point.value}) is no understudy Skill")
        skills.append(skill)
    return SkillSet(*skills)
