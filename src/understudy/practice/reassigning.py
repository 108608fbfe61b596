"""A word that was taken for another step than was meant: the corrections of a practice run, made again (§6.1)."""

from collections.abc import Sequence
from dataclasses import replace

from understudy.errors import NetworkError
from understudy.network import END, Component
from understudy.practice.attribution import Attribution
from understudy.practice.corrections import Correction
from understudy.practice.edits import inserted, without
from understudy.robot import Cue

__all__ = ["made", "reassigned"]


def reassigned(corrections: Sequence[Correction], number: int, component: str) -> tuple[Correction, ...]:
    """The corrections with one of them about another step, and those after it made again on what comes of that.

    Args:
        corrections: of one practice run, in their order.
        number: of the word to be understood otherwise; the first is 1.
        component: the path of the step that it was about; END for a COME that showed what comes after everything else.

    Returns:
        As many corrections; the last one's ``after`` is the task now. One that cannot be made any more says so in its
        ``note``, and changes nothing.

    Raises:
        NetworkError: there is no such correction, or the task did not have such a step then.
    """
    if not 1 <= number <= len(corrections):
        raise NetworkError(f"there is no correction {number}; the practice run has {len(corrections)}")
    chosen = corrections[number - 1]
    steps = [path for path, part in chosen.before.walk() if isinstance(part, Component)]
    if chosen.piece is not None:
        steps.append(END)
    if component not in steps:
        raise NetworkError(f"no step was called {component!r} then; there were: {', '.join(steps)}")
    if chosen.word is not Cue.BAD and chosen.piece is None:
        raise NetworkError(f"of {chosen.word} at {chosen.time_s:.1f} s nothing was learned that could go elsewhere")
    others = tuple(one for one in chosen.meant if one.component != component)
    first = next(
        (one for one in chosen.meant if one.component == component),
        Attribution(component=component, how="said", since_s=chosen.time_s),
    )
    result = list(corrections[: number - 1])
    task = chosen.before
    for correction in (replace(chosen, meant=(first, *others)), *corrections[number:]):
        result.append(made(replace(correction, before=task, after=task)))
        task = result[-1].after
    return tuple(result)


def made(correction: Correction) -> Correction:
    """A correction as it comes out on the task before it.

    One that is about no step, or of which nothing was learned, changes nothing, and keeps its note.
    """
    if not correction.meant or (correction.word is not Cue.BAD and correction.piece is None):
        return correction
    correction = replace(correction, note="")
    path = correction.meant[0].component
    try:
        if correction.piece is not None:
            return replace(correction, after=inserted(correction.before, path, correction.piece))
        return replace(correction, after=without(correction.before, path))
    except NetworkError as error:
        return replace(correction, note=str(error))
