"""Three demonstrations of one task, each with its mistakes, in three rooms (§5.4.3).

What is learned after each of them is executed where it was shown last, the generalised task in all three rooms and in
new ones. As in the text all observations are learned, whatever the teacher's words fall on.
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from understudy.behaviors import installed_skills
from understudy.errors import LearningError
from understudy.experiments.trials import Trial, run_trials
from understudy.generalization import generalize
from understudy.learning import LearningSettings, learn
from understudy.network import Edge, Network
from understudy.sessions import teach
from understudy.sim import World, load_world, world_path

__all__ = ["Course", "generalization_tables", "generalization_trials", "ways", "worked_course"]

_NAME = "generalization"
_ROOMS = ("generalize_1", "generalize_2", "generalize_3")


@dataclass(frozen=True, slots=True, kw_only=True)
class Course:
    """Three demonstrations.

    Attributes:
        tasks: what was known after each of them.
        duration_s: from START to DONE, all three together.
        problems: what went wrong in them.
        complaints: what the teacher waited for in vain.
        collisions, grazes: of the robot that followed.
    """

    tasks: tuple[Network, ...]
    duration_s: float
    problems: tuple[str, ...]
    complaints: tuple[str, ...]
    collisions: int
    grazes: int


def worked_course(seed: int | None = None) -> Course:
    """Shows the task three times.

    Args:
        seed: of all chance in each room; the rooms' own if None.
    """
    tasks: list[Network] = []
    problems: list[str] = []
    complaints: list[str] = []
    duration_s, collisions, grazes = 0.0, 0, 0
    for world in _rooms():
        taught = teach(world, installed_skills(), seed=seed)
        duration_s += taught.demonstration.span.duration
        collisions += sum(taught.verdict.collisions.values())
        grazes += sum(taught.verdict.grazes.values())
        complaints += [f"{world.name}: {complaint}" for complaint in taught.complaints]
        hits = taught.verdict.collisions.items()
        problems += [f"{world.name}: ran into a {what} ({count} ×)" for what, count in hits]
        try:
            network = learn(taught.demonstration, LearningSettings(heed_cues=False)).network
            tasks.append(generalize(tasks[-1], network).network if tasks else network)
        except LearningError as error:  # a failed demonstration, too
            problems.append(str(error))
    return Course(
        tasks=tuple(tasks),
        duration_s=duration_s,
        problems=tuple(problems),
        complaints=tuple(complaints),
        collisions=collisions,
        grazes=grazes,
    )


def ways(network: Network) -> tuple[tuple[str, str], ...]:
    """The ways through a task, step by step: what two courses must have in common."""
    return tuple((edge.source, edge.target) for edge in network.topology.edges)


def generalization_trials(seeds: Sequence[int]) -> Iterator[Trial]:
    """Teaches anew with every seed; then executes what the rooms' own seeds taught, one trial a seed in each room.

    A demonstration counts as a success if the ways through the task are the same after each of the three.
    """
    reference = worked_course().tasks
    for seed in seeds:
        course = worked_course(seed)
        same = [ways(task) for task in course.tasks] == [ways(task) for task in reference]
        yield Trial(
            experiment=_NAME,
            room="taught",
            seed=seed,
            time_s=course.duration_s,
            problems=(*course.problems, *(() if same else (*course.complaints, "another task was learned"))),
            collisions=course.collisions,
            grazes=course.grazes,
        )
    first, second, third = _rooms()
    for number, place, room in (
        (1, first, "first, after one demonstration"),
        (2, second, "second, after two"),
        (3, first, "first, after three"),
        (3, second, "second, after three"),
        (3, third, "third, after three"),
        (3, first, "changed"),
    ):
        yield from run_trials(_NAME, place, reference[number - 1], room, seeds)


def generalization_tables(trials: Sequence[Trial]) -> Iterator[str]:
    """The ways after each demonstration (Figures 5.9 and 5.10), and which of them the robot took, as Markdown."""
    yield "| after demonstration | from | to | shown by |"
    yield "| --- | --- | --- | --- |"
    for number, task in enumerate(worked_course().tasks, start=1):
        for edge in task.topology.edges:
            yield f"| {number} | {edge.source} | {edge.target} | {_shown(edge)} |"
    yield ""
    yield "| room | order of the steps | trials |"
    yield "| --- | --- | --- |"
    runs = [trial for trial in trials if trial.room != "taught"]
    for (room, order), count in Counter((trial.room, ", ".join(trial.achieved)) for trial in runs).items():
        yield f"| {room} | {order} | {count} |"


def _rooms() -> tuple[World, ...]:
    return tuple(load_world(world_path(name)) for name in _ROOMS)


def _shown(edge: Edge) -> str:
    return ", ".join(name.removeprefix("generalize ") for name in edge.shown)
