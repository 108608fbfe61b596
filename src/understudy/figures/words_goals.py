"""What one component is to achieve, in plain words."""

from collections.abc import Mapping, Sequence

from understudy.behaviors import Parameters, Skill
from understudy.errors import SkillError
from understudy.figures.labels import clean, label_of
from understudy.learning.construction import DECIMALS
from understudy.network import Component, Nab, ParameterValue

__all__ = ["completed", "goal_in_words", "listed"]


def goal_in_words(component: Component | Nab, skills: Mapping[str, Skill]) -> str:
    """What a component is to achieve: ``pick up the orange box``; of unknown skills, and of networks, the label."""
    if isinstance(component, Component):
        values = completed(component.behavior, component.parameters, skills)
        if values is not None:
            return clean(skills[component.behavior].abstract.describe(values))
    named = label_of(component)
    return f"{named.title} ({named.details})" if named.details else named.title


def completed(
    behavior: str, parameters: Mapping[str, ParameterValue], skills: Mapping[str, Skill]
) -> Parameters | None:
    """The parameters as the skill takes them; None for somebody else's skill, of which the label is what is known."""
    if behavior not in skills:
        return None
    # Rounded as what was learned is: what was seen then reads the same, and so does a picture of either.
    values = {name: value if isinstance(value, str) else round(value, DECIMALS) for name, value in parameters.items()}
    try:
        return skills[behavior].complete(values)
    except SkillError:
        return None


def listed(parts: Sequence[str], last: str = "and") -> str:
    """``a``, ``a and b``, ``a, b and c``."""
    return f" {last} ".join(part for part in (", ".join(parts[:-1]), *parts[-1:]) if part)
