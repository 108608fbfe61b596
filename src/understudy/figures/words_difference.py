"""What another demonstration changed in a task, in plain words."""

from collections.abc import Iterator, Mapping, Sequence

from understudy.behaviors import Skill
from understudy.figures.labels import clean
from understudy.figures.numbering import numbers_of
from understudy.figures.words_goals import goal_in_words, listed
from understudy.generalization import Branch, Difference, Relaxed
from understudy.network import END, START, LinkType, Network

__all__ = ["describe_difference"]

_MEANING = {
    LinkType.PERMANENT: "holds all the while",
    LinkType.ENABLING: "still holds when it begins",
    LinkType.ORDERING: "has been done",
    None: "comes in any order",
}


def describe_difference(difference: Difference, network: Network, skills: Mapping[str, Skill]) -> str:
    """Tell what a demonstration has in common with the task, and where it went another way.

    Args:
        difference: from :func:`understudy.generalization.generalize`.
        network: the task as it is told, by whose numbers the steps are called: the result, or what became of it later.
        skills: by name, for the words.

    Returns:
        Several lines without a newline at the end.
    """
    return "\n".join(_lines(difference, _Steps(network, skills)))


class _Steps:
    """Steps by number and in words."""

    def __init__(self, network: Network, skills: Mapping[str, Skill]) -> None:
        self.numbers = numbers_of(network)
        self.goals = {id_: goal_in_words(part, skills).split(",")[0] for id_, part in network.by_id.items()}

    def named(self, ids: Sequence[str]) -> str:
        """``step 3 (go to the green target) and step 4 (pick up the orange box)``."""
        return listed([f"step {self.numbers[id_]} ({self.goals[id_]})" for id_ in ids])


def _lines(difference: Difference, steps: _Steps) -> Iterator[str]:
    known, count = len(difference.merged), len(difference.merged) + len(difference.added)
    nothing = "" if difference.branches else ", and it went a known way"
    yield f"{clean(listed(difference.demonstrations))}: {known} of {count} steps were known{nothing}"
    yield from (f"  {_branch(branch, steps)}" for branch in difference.branches)
    if difference.bypassed:
        yield f"  never done from now on, since a direct way leads past: {steps.named(difference.bypassed)}"
    yield from (f"  {_relaxed(relaxed, steps)}" for relaxed in difference.relaxed)
    if difference.changed:
        yield f"  other numbers than before: {listed([f'step {steps.numbers[id_]}' for id_ in difference.changed])}"


def _branch(branch: Branch, steps: _Steps) -> str:
    ends = [f"step {steps.numbers[id_]}" for id_ in (branch.after, branch.before) if id_ not in (START, END)]
    if branch.after == START:
        where = f"before {ends[0]}" if ends else "all the way"
    else:
        where = f"between {ends[0]} and {ends[1]}" if branch.before != END else f"after {ends[0]}"
    did = steps.named(branch.steps) or ("it was done" if branch.before == END else "it went on directly")
    others = f"others did {steps.named(branch.instead)}" if branch.instead else "others went on directly"
    return f"{where}: {did}, where {others}"


def _relaxed(relaxed: Relaxed, steps: _Steps) -> str:
    source, target = (f"step {steps.numbers[id_]}" for id_ in (relaxed.source, relaxed.target))
    was, now = _MEANING[relaxed.was], _MEANING[relaxed.now]
    return f"for {target} it is enough that {source} {now}, since not all showed that it {was}"
