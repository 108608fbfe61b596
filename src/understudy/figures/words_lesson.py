"""What was learned from a demonstration, in plain words."""

from collections.abc import Iterable, Mapping

from understudy.behaviors import Skill
from understudy.figures.labels import clean
from understudy.figures.words_goals import goal_in_words
from understudy.learning.learner import Lesson
from understudy.learning.observations import Observed
from understudy.network import Component, ParameterValue

__all__ = ["describe_lesson"]


def describe_lesson(lesson: Lesson, skills: Mapping[str, Skill]) -> str:
    """Tell what was made of a demonstration: the observations that became steps, and those left out, with the reasons.

    Args:
        lesson: from :func:`understudy.learning.learn`.
        skills: by name, for the words.

    Returns:
        Several lines without a newline at the end.
    """
    seen = len(lesson.kept) + len(lesson.dropped)
    learned = f"{len(lesson.kept)} of {seen} observation{'' if seen == 1 else 's'} became steps"
    lines = [f"{clean(lesson.demonstration)}: {learned}", ""]
    rows = [(*_moment(observed), _goal_of(observed, skills), _cues(observed)) for observed in lesson.kept]
    lines += [f"  {time}  {words}{cues}" for time, words, cues in _aligned(rows)]
    if lesson.dropped:
        lines += ["", "Left out:"]
        rows = [
            (*_moment(item.observed), _goal_of(item.observed, skills), f" – {clean(item.reason)}")
            for item in lesson.dropped
        ]
        lines += [f"  {time}  {words}{reason}" for time, words, reason in _aligned(rows)]
    if lesson.notes:
        lines += ["", *(clean(note) for note in lesson.notes)]
    return "\n".join(lines)


def _goal_of(observed: Observed, skills: Mapping[str, Skill]) -> str:
    parameters: dict[str, ParameterValue] = {**dict(observed.instance.parameters), **observed.values}
    return goal_in_words(Component(id="seen", behavior=observed.instance.behavior, parameters=parameters), skills)


def _moment(observed: Observed) -> tuple[str, str]:
    return f"{observed.interval.start:.1f}", f"{observed.interval.end:.1f} s"


def _cues(observed: Observed) -> str:
    said = ", ".join(f"{cue} {time:.1f} s" for time, cue in observed.cues)
    return f" – {said}" if said else ""


def _aligned(rows: Iterable[tuple[str, str, str, str]]) -> list[tuple[str, str, str]]:
    """Moments under each other, as ``  5.1 to  20.3 s``."""
    rows = list(rows)
    first = max((len(row[0]) for row in rows), default=0)
    second = max((len(row[1]) for row in rows), default=0)
    return [(f"{start:>{first}} to {end:>{second}}", words, rest) for start, end, words, rest in rows]
