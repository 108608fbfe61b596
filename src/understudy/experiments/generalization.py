"""Several demonstrations of one task, each with its mistakes, in several rooms (§5.4.3).

What is learned after each of them is executed where it was shown last, the generalised task in all rooms and in new
ones.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Annotated

from pydantic import Field

from understudy.behaviors import installed_skills
from understudy.documents import Name
from understudy.errors import LearningError
from understudy.experiments.document import Learning, Options
from understudy.experiments.experiment import Experiment
from understudy.experiments.judging import collisions_of
from understudy.experiments.summary import Table
from understudy.experiments.teaching import executed
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit, Witness
from understudy.generalization import generalize
from understudy.learning import learn
from understudy.network import Network, Task, task_text
from understudy.sessions import Stage, teach
from understudy.sim import World

__all__ = [
    "Course",
    "GeneralizationOptions",
    "course",
    "course_trial",
    "generalised_trial",
    "ways",
    "ways_table",
]


class GeneralizationOptions(Options):
    """What rows of generalised tasks take.

    Attributes:
        worlds: of the demonstrations, one after the other.
        after: how many of the demonstrations the executed task is made of; all if left out.
    """

    worlds: Annotated[tuple[Name, ...], Field(min_length=1)]
    after: Annotated[int, Field(ge=1)] | None = None

    @property
    def named_worlds(self) -> tuple[str, ...]:
        return self.worlds


@dataclass(frozen=True, slots=True, kw_only=True)
class Course:
    """Several demonstrations.

    Attributes:
        tasks: what was known after each of them.
        stages: where they took place.
        duration_s: from START to DONE, all together.
        problems: what went wrong in them.
        complaints: what the teacher waited for in vain.
    """

    tasks: tuple[Network, ...]
    stages: tuple[Stage, ...]
    duration_s: float
    problems: tuple[str, ...]
    complaints: tuple[str, ...]


def course(
    worlds: Sequence[World],
    learning: Learning,
    seed: int | None = None,
    *,
    stem: Path | None = None,
    witness: Witness | None = None,
) -> Course:
    """Shows a task several times.

    Args:
        worlds: the rooms.
        learning: settings of the learner.
        seed: of all chance in each room; the rooms' own if None.
        stem: of the recordings; None records nothing.
        witness: is shown each demonstration, and what was known after it.
    """
    tasks: list[Network] = []
    stages: list[Stage] = []
    problems: list[str] = []
    complaints: list[str] = []
    duration_s = 0.0
    for number, world in enumerate(worlds, start=1):
        recording = stem.with_name(f"{stem.name}-{number}.mcap") if stem is not None else None
        taught = teach(world, installed_skills(), seed=seed, settings=learning.settings, recording=recording)
        duration_s += taught.demonstration.span.duration
        stages.append(taught.stage)
        complaints += [f"{world.name}: {complaint}" for complaint in taught.complaints]
        problems += [f"{world.name}: {problem}" for problem in collisions_of(taught.verdict)]
        try:
            network = learn(taught.demonstration, learning.settings).network
            tasks.append(generalize(tasks[-1], network).network if tasks else network)
        except LearningError as error:  # a failed demonstration, too
            problems.append(str(error))
        if witness is not None:
            witness(taught, tasks[-1] if tasks else None)
    return Course(
        tasks=tuple(tasks),
        stages=tuple(stages),
        duration_s=duration_s,
        problems=tuple(problems),
        complaints=tuple(complaints),
    )


@lru_cache(maxsize=4)
def _reference(worlds: tuple[World, ...], learning: Learning) -> tuple[Network, ...]:
    return course(worlds, learning).tasks


def _reference_of(experiment: Experiment, options: GeneralizationOptions) -> tuple[Network, ...]:
    """What the rooms' own seeds teach, after each of them."""
    worlds = tuple(experiment.worlds[name] for name in options.worlds)
    return _reference(worlds, experiment.document.learning)


def ways(network: Network) -> tuple[tuple[str, str], ...]:
    """The ways through a task, step by step: what two courses must have in common."""
    return tuple((edge.source, edge.target) for edge in network.topology.edges)


def course_trial(unit: Unit) -> Trial:
    """Shows the task in all rooms. A success if the ways through it are those of the reference after each of them."""
    options = GeneralizationOptions.model_validate(unit.options)
    experiment = unit.experiment
    worlds = [experiment.furnished(experiment.worlds[name], unit.row) for name in options.worlds]
    stem = unit.folder / f"{unit.stem}-demonstration" if unit.folder is not None else None
    shown = course(worlds, experiment.document.learning, unit.seed, stem=stem, witness=unit.witness)
    same = [ways(task) for task in shown.tasks] == [ways(task) for task in _reference_of(experiment, options)]
    verdicts = [stage.verdict() for stage in shown.stages]
    return unit.trial(
        ending="taught",
        time_s=round(shown.duration_s, 3),
        problems=(*shown.problems, *(() if same else (*shown.complaints, "another task was learned"))),
        collisions=dict(sum((Counter(verdict.collisions) for verdict in verdicts), Counter())),
        grazes=dict(sum((Counter(verdict.grazes) for verdict in verdicts), Counter())),
        learned=task_text(Task.of(experiment.name, shown.tasks[-1])) if shown.tasks else "",
    )


def generalised_trial(unit: Unit) -> Trial:
    """Executes what the rooms' own seeds teach."""
    options = GeneralizationOptions.model_validate(unit.options)
    return executed(unit, _reference_of(unit.experiment, options)[(options.after or len(options.worlds)) - 1])


def ways_table(experiment: Experiment, trials: Sequence[Trial]) -> Table:
    """The ways after each demonstration (Figures 5.9 and 5.10)."""
    options = GeneralizationOptions.model_validate(experiment.document.options)
    rows = [
        (str(number), edge.source, edge.target, ", ".join(edge.shown))
        for number, task in enumerate(_reference_of(experiment, options), start=1)
        for edge in task.topology.edges
    ]
    return Table(
        title="Ways after each demonstration",
        head=("after demonstration", "from", "to", "shown by"),
        rows=tuple(rows),
    )
