"""Tasks that are shown: once, for all runs of a row, or anew in every trial (§4.5.4)."""

from collections import Counter
from dataclasses import dataclass, replace
from functools import lru_cache

from understudy.behaviors import installed_skills
from understudy.errors import LearningError
from understudy.experiments.document import Learning
from understudy.experiments.judging import collisions_of, problems_of
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit
from understudy.learning import Lesson, learn
from understudy.network import Component, Network, Task, task_text
from understudy.sessions import Taught, perform, teach
from understudy.sim import World

__all__ = [
    "Shown",
    "executed",
    "reference",
    "run_trial",
    "show",
    "side",
    "structure",
    "teach_and_run_trial",
    "teach_trial",
]

Structure = tuple[tuple[str, ...], ...]

_RIGHT_DEG = 45.0

_REMEMBERED = 32
"""A process remembers the tasks of so many rows, so that not every run is preceded by the same demonstration."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """A demonstration in a trial, and what was learned from it.

    Attributes:
        taught: the demonstration.
        lesson: None if nothing could be learned.
        problems: what was wrong with it.
    """

    taught: Taught
    lesson: Lesson | None
    problems: tuple[str, ...]


@lru_cache(maxsize=_REMEMBERED)
def _reference(world: World, learning: Learning) -> Network:
    taught = teach(world, installed_skills(), settings=learning.settings)
    return learn(taught.demonstration, learning.settings).network


def reference(unit: Unit) -> Network:
    """What one demonstration teaches in the row's world as it stands, with the world's own seed.

    The tests compare it with the text (§4.5.4).

    Raises:
        WorldError: the world has no teacher.
        LearningError: nothing can be learned.
    """
    return _reference(unit.experiment.world(unit.row), unit.experiment.document.learning)


def show(unit: Unit) -> Shown:
    """Shows the task with the trial's seed, by the teacher that the experiment gives to the world.

    Raises:
        WorldError: the world has no teacher.
    """
    settings = unit.experiment.document.learning.settings
    taught = teach(
        unit.place, installed_skills(), seed=unit.seed, settings=settings, recording=unit.recording("demonstration")
    )
    problems, lesson = collisions_of(taught.verdict), None
    try:
        lesson = learn(taught.demonstration, settings)
        told = _difference(structure(lesson.network), structure(reference(unit)))
        problems += [*taught.complaints, f"another task was learned: {told}"] if told else []
        problems += taught.complaints[-1:] if not taught.finished and not told else []
    except LearningError as error:  # a failed trial, too
        problems.append(str(error))
    if unit.witness is not None:
        unit.witness(taught, lesson.network if lesson is not None else None)
    return Shown(taught=taught, lesson=lesson, problems=tuple(problems))


def structure(network: Network) -> Structure:
    """What two lessons of one task must have in common: the steps, on which side targets are passed, and the links."""
    steps = tuple((path, side(part)) for path, part in network.walk() if isinstance(part, Component))
    return steps + tuple((link.source, link.target, link.type.value) for link in network.links)


def _difference(learned: Structure, wanted: Structure) -> str:
    """What one lesson has and another one has not, in words; empty if they are the same."""
    if learned == wanted:
        return ""
    lists = (
        ("without", [one for one in wanted if one not in learned]),
        ("with", [one for one in learned if one not in wanted]),
    )
    told = [f"{word} {', '.join(map(_in_words, each))}" for word, each in lists if each]
    return "; ".join(told) or "the same steps in another order"


def _in_words(part: tuple[str, ...]) -> str:
    match part:
        case (step, side):
            return f"{step} ({side})" if side else step
        case _:
            source, target, kind = part
            return f"{source} → {target} ({kind})"


def side(component: Component) -> str:
    """On which side a target is passed: ``left``, ``right`` or ``ahead``; empty for other steps."""
    angle = component.parameters.get("angle_deg")
    if not isinstance(angle, float):
        return ""
    return "right" if angle < _RIGHT_DEG else "left" if angle > 180 - _RIGHT_DEG else "ahead"


def teach_trial(unit: Unit) -> Trial:
    """Shows the task. A success is a clean demonstration from which the same is learned as from the reference."""
    return _shown_trial(unit, show(unit))


def _shown_trial(unit: Unit, shown: Shown) -> Trial:
    return unit.trial(
        ending="taught" if shown.taught.finished else "unfinished",
        stage=shown.taught.stage,
        time_s=round(shown.taught.demonstration.span.duration, 3),
        problems=shown.problems,
        learned=_text(unit, shown),
    )


def run_trial(unit: Unit) -> Trial:
    """Executes the task of the row, or what the reference teaches."""
    return executed(unit, unit.experiment.task(unit.row) or reference(unit))


def executed(unit: Unit, network: Network) -> Trial:
    """Executes a task in the room of the trial.

    Args:
        unit: the trial.
        network: the task.
    """
    performed = perform(
        unit.experiment.name,
        network,
        unit.room,
        installed_skills(),
        seed=unit.seed,
        limit_s=unit.limit_s,
        recording=unit.recording("run"),
    )
    return unit.trial_of(performed, network, problems_of(performed, network))


def teach_and_run_trial(unit: Unit) -> Trial:
    """Shows the task, and executes what was learned from that; both have to succeed (§4.5.5.1)."""
    shown = show(unit)
    if shown.lesson is None:
        return _shown_trial(unit, shown)
    run = executed(unit, shown.lesson.network)
    demonstration = [f"taught: {problem}" for problem in shown.problems]
    return replace(
        run,
        problems=(*demonstration, *run.problems),
        collisions=dict(Counter(shown.taught.verdict.collisions) + Counter(run.collisions)),
        grazes=dict(Counter(shown.taught.verdict.grazes) + Counter(run.grazes)),
        learned=_text(unit, shown),
    )


def _text(unit: Unit, shown: Shown) -> str:
    return task_text(Task.of(unit.experiment.name, shown.lesson.network)) if shown.lesson is not None else ""
