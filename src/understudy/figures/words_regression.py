"""What an edit makes of the demonstrations and runs of a task, in plain words."""

from collections.abc import Iterator, Mapping, Sequence

from understudy.behaviors import Skill
from understudy.figures.labels import clean
from understudy.figures.words_goals import goal_in_words, listed
from understudy.library import Misfit, Regression, Sitting, SittingKind
from understudy.network import Component, LinkType

__all__ = ["describe_misfit", "describe_regression", "sittings_in_words"]

_HELD = {LinkType.PERMANENT: "all the while", LinkType.ENABLING: "when it began"}


def describe_regression(regression: Regression, skills: Mapping[str, Skill]) -> str:
    """Tell which demonstrations and runs do not fit an edited task any more, and what still does.

    Args:
        regression: from :func:`understudy.library.regression`.
        skills: by name, for the words.

    Returns:
        Several lines without a newline at the end; none if there was nothing to be replayed.
    """
    return "\n".join(_lines(regression, skills))


def describe_misfit(misfit: Misfit, skills: Mapping[str, Skill]) -> str:
    """What keeps a demonstration or a run from fitting a task: ``not in the task: pick up the orange box``."""

    def goals(components: Sequence[Component]) -> str:
        return listed([goal_in_words(component, skills).split(",")[0] for component in components])

    told = [
        f"{what}: {goals(components)}"
        for what, components in (
            ("not in the task", misfit.extra),
            ("missing here", misfit.missing),
            ("at another place", misfit.moved),
        )
        if components
    ]
    told += [
        f"for {goals([one.target])} the task wants that {goals([one.source])} holds {_HELD[one.asked]}, and it did not"
        for one in misfit.unheld
    ]
    return "; ".join(told)


def sittings_in_words(sittings: Sequence[Sitting]) -> str:
    """``2 demonstrations and 1 run``."""
    kinds: dict[SittingKind, int] = {}
    for one in sittings:
        kinds[one.kind] = kinds.get(one.kind, 0) + 1
    called = {"practice": "practice run"}
    return listed([f"{n} {called.get(kind, kind)}{'' if n == 1 else 's'}" for kind, n in kinds.items()])


def _lines(regression: Regression, skills: Mapping[str, Skill]) -> Iterator[str]:
    if regression.unread:
        yield f"Nothing was replayed: {regression.unread}"
    for misfit in regression.broken:
        yield f"{_named(misfit.sitting)} no longer fits: {describe_misfit(misfit, skills)}"
    for misfit in regression.before:
        yield f"{_named(misfit.sitting)} does not fit, and did not before: {describe_misfit(misfit, skills)}"
    if regression.fits:
        still = "still " if regression.broken else ""
        yield f"{sittings_in_words(regression.fits)} {still}fit{'s' if len(regression.fits) == 1 else ''}"


def _named(sitting: Sitting) -> str:
    return f"{sitting} ({clean(sitting.name)})" if sitting.kind == "demonstration" else str(sitting)
