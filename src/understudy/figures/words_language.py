"""The language of a task, and what was asked of it, in plain words."""

import math
from collections.abc import Iterable, Mapping, Sequence

from understudy.behaviors import Skill
from understudy.errors import LanguageError
from understudy.figures.labels import clean
from understudy.figures.words_goals import goal_in_words
from understudy.language import Comparison, Language, Membership, symbol_of
from understudy.network import Component, Network

__all__ = ["compared_in_words", "describe_language", "membership_in_words"]


def _word(word: Sequence[str]) -> str:
    """``Drop, Track(green), PickUp(orange)``."""
    return clean(", ".join(word)) or "nothing at all"


def _size(language: Language, *, longest: float = math.inf) -> str:
    """How many words there are: ``24 words, of 11 steps each``."""
    try:
        count = language.count(longest=longest)
        most = language.longest
    except LanguageError:
        return "more words than can be counted"
    if count is None:
        return "words without end"
    at_most = "" if math.isinf(longest) else f" of at most {longest:g} steps"
    if not count:
        return f"no word{at_most}" + ("" if at_most else ": it is never done")
    words = f"{count} word{'' if count == 1 else 's'}"
    if at_most:
        return words + at_most
    least = len(next(language.words()))
    steps = f"{least} to {most:g}" if least != most else f"{most:g}"
    return f"{words}, of {steps} step{'' if steps == '1' else 's'}{'' if least != most or count == 1 else ' each'}"


def describe_language(
    name: str,
    network: Network,
    language: Language,
    skills: Mapping[str, Skill],
    words: Iterable[Sequence[str]],
    *,
    longest: float = math.inf,
) -> str:
    """Tell how many words a task has, what its symbols mean, and some of the words.

    Args:
        name: of the task.
        network: the task.
        language: its language.
        skills: by name; they know the words.
        words: to be shown.
        longest: the words counted have at most so many steps.

    Returns:
        Several lines without a newline at the end.
    """
    goals: dict[str, dict[str, None]] = {}
    for _, part in network.walk():
        if isinstance(part, Component):
            # A symbol does not say at which distance or angle; nor does what stands before the comma.
            goals.setdefault(symbol_of(part), {})[goal_in_words(part, skills).split(",")[0]] = None
    width = max(map(len, goals))
    lines = [f"{clean(name)}: {_size(language, longest=longest)}", ""]
    lines += [f"  {clean(symbol):{width}}  {' or '.join(told)}" for symbol, told in goals.items()]
    shown = [f"  {number:>3}. {_word(word)}" for number, word in enumerate(words, start=1)]
    return "\n".join([*lines, *(["", *shown] if shown else [])])


def membership_in_words(membership: Membership) -> str:
    """Whether the task can be done in an order, and if not, where it goes wrong."""
    if membership.member:
        return "Yes: the task can be done in this order."
    begun = _word(membership.word[: membership.begins])
    instead = " or ".join(map(clean, membership.allowed)) or "nothing"
    if membership.begins == len(membership.word):
        return f"No: after {begun} the task is not done yet; what can come next: {instead}."
    left = clean(membership.word[membership.begins])
    before = f" after {begun}" if membership.begins else ""
    done = "; the task is done there" if membership.complete else ""
    return f"No: {left} cannot be step {membership.begins + 1}{before}{done}; what can come there: {instead}."


def compared_in_words(first: str, second: str, comparison: Comparison) -> str:
    """How two tasks lie to each other, with an example for every difference."""
    first, second = clean(first), clean(second)
    told = {
        "equal": f"{first} and {second} can be done in just the same orders.",
        "included": f"Whatever {first} does, {second} can do, too, but not the other way round.",
        "includes": f"Whatever {second} does, {first} can do, too, but not the other way round.",
        "overlapping": f"{first} and {second} have some orders in common, and each has others.",
        "disjoint": f"{first} and {second} have no order in common.",
    }
    lines = [told[comparison.relation]]
    for who, word in (
        ("both", comparison.both),
        (f"only {first}", comparison.only_first),
        (f"only {second}", comparison.only_second),
    ):
        if word is not None:
            lines.append(f"  {who}: {_word(word)}")
    return "\n".join(lines)
