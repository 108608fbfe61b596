"""What was learned from several demonstrations in a free order, in plain words."""

from collections.abc import Callable, Iterator, Mapping

from understudy.behaviors import Skill
from understudy.figures.labels import clean
from understudy.figures.numbering import numbers_of
from understudy.figures.words_goals import goal_in_words, listed
from understudy.generalization import Deviation, FreeOrder
from understudy.network import Component, Nab

__all__ = ["describe_deviations"]


def describe_deviations(found: FreeOrder, skills: Mapping[str, Skill]) -> str:
    """Tell which demonstrations the task does not allow, and why each was taken for a slip.

    Args:
        found: from :func:`understudy.generalization.free_order`.
        skills: by name, for the words.

    Returns:
        Several lines without a newline at the end.
    """
    return "\n".join(_lines(found, skills))


def _lines(found: FreeOrder, skills: Mapping[str, Skill]) -> Iterator[str]:
    count, odd = len(found.demonstrations), len(found.deviations)
    yield f"{count - odd} of {count} demonstrations are ways to do this task{', and so not these:' if odd else ''}"
    numbers = numbers_of(found.network)
    goals = {id_: _goal(part, skills) for id_, part in found.network.by_id.items()}

    def named(id_: str) -> str:
        return f"step {numbers[id_]} ({goals[id_]})"

    for one in found.deviations:
        yield f"  {clean(one.demonstration)}: {'; '.join(_reasons(one, named, skills))}"


def _reasons(one: Deviation, named: Callable[[str], str], skills: Mapping[str, Skill]) -> Iterator[str]:
    if one.left_out:
        yield f"it left out {listed([named(id_) for id_ in one.left_out])}"
    if one.extra:
        extra = listed([_goal(part, skills) for part in one.extra])
        yield f"it did what most did not do, or not so often: {extra}"
    for first, last in one.inverted:
        yield f"it did {named(last)} before {named(first)}"


def _goal(part: Component | Nab, skills: Mapping[str, Skill]) -> str:
    return goal_in_words(part, skills).split(",")[0]
