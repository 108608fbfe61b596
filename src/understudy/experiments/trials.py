"""Taught once, executed again and again: §4.5.4.1 and §4.5.4.3 as repeated trials.

Every trial has a seed of its own, from which it can be repeated alone. A changed room is the taught one rearranged at
random by that seed (:func:`understudy.sim.rearranged`).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from scipy.stats import binomtest

from understudy.behaviors import installed_skills
from understudy.errors import LearningError
from understudy.experiments.judging import problems_of
from understudy.learning import learn
from understudy.network import Component, Network
from understudy.sessions import perform, teach
from understudy.sim import World, load_world, rearranged, world_path

__all__ = [
    "Summary",
    "Trial",
    "run_trials",
    "structure",
    "summarise",
    "taught_network",
    "taught_trials",
    "teaching_trials",
]

_RIGHT_DEG = 45.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """One execution.

    Attributes:
        experiment, room, seed: which; the room is ``taught``, ``same`` or ``changed``, or what else it is called.
        time_s: simulated time until it was done, or given up.
        problems: what was wrong; empty for a success.
        collisions, grazes: how many hard and soft contacts.
        achieved: paths in the order in which they were achieved; empty for a demonstration.
    """

    experiment: str
    room: str
    seed: int
    time_s: float
    problems: tuple[str, ...]
    collisions: int
    grazes: int
    achieved: tuple[str, ...] = ()

    @property
    def success(self) -> bool:
        return not self.problems

    @property
    def named(self) -> str:
        """Which it is, for a reader."""
        return f"{self.experiment}, {self.room} room, seed {self.seed}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Summary:
    """Several trials of one kind; ``low`` and ``high`` bound the rate of success with 95 % confidence, exactly."""

    trials: int
    successes: int
    low: float
    high: float
    mean_time_s: float
    slowest_s: float
    collisions: int
    grazes: int


def taught_network(experiment: str, seed: int | None = None) -> tuple[World, Network]:
    """The room of an experiment, and what the robot learns in it from one demonstration."""
    world = load_world(world_path(experiment))
    taught = teach(world, installed_skills(), seed=seed)
    return world, learn(taught.demonstration).network


def structure(network: Network) -> tuple[tuple[str, ...], ...]:
    """What two lessons of one task must have in common: the steps, on which side targets are passed, and the links."""
    steps = tuple((path, _side(part)) for path, part in network.walk() if isinstance(part, Component))
    return steps + tuple((link.source, link.target, link.type.value) for link in network.links)


def _side(component: Component) -> str:
    angle = component.parameters.get("angle_deg")
    if not isinstance(angle, float):
        return ""
    return "right" if angle < _RIGHT_DEG else "left" if angle > 180 - _RIGHT_DEG else "ahead"


def teaching_trials(experiment: str, seeds: Sequence[int]) -> Iterator[Trial]:
    """Shows the task once for every seed; a success is a clean demonstration from which the same task is learned.

    The reference is what is learned with the world's own seed, which the tests compare with the text (§4.5.4).
    """
    world, reference = taught_network(experiment)
    for seed in seeds:
        taught = teach(world, installed_skills(), seed=seed)
        problems = [f"ran into a {what} ({count} ×)" for what, count in taught.verdict.collisions.items()]
        try:
            if structure(learn(taught.demonstration).network) != structure(reference):
                problems.append("another task was learned")
        except LearningError as error:  # a failed trial, too
            problems.append(str(error))
        yield Trial(
            experiment=experiment,
            room="taught",
            seed=seed,
            time_s=taught.demonstration.span.duration,
            problems=tuple(problems),
            collisions=sum(taught.verdict.collisions.values()),
            grazes=sum(taught.verdict.grazes.values()),
        )


def run_trials(
    experiment: str, world: World, network: Network, room: str, seeds: Sequence[int], *, limit_s: float = 300.0
) -> Iterator[Trial]:
    """Executes a task once for every seed.

    Args:
        experiment: its name, for the records.
        world: the room in which it was taught.
        network: the task.
        room: ``changed`` is the room rearranged by the seed of each trial; by any other name it is as it was.
        seeds: one a trial.
        limit_s: the time allowed; §4.5.4.1 allows 5 minutes.
    """
    for seed in seeds:
        place = rearranged(world, seed) if room == "changed" else world
        performed = perform(experiment, network, place, installed_skills(), seed=seed, limit_s=limit_s)
        yield Trial(
            experiment=experiment,
            room=room,
            seed=seed,
            time_s=performed.report.duration_s,
            problems=tuple(problems_of(performed, network)),
            collisions=sum(performed.verdict.collisions.values()),
            grazes=sum(performed.verdict.grazes.values()),
            achieved=tuple(path for path, _ in performed.report.achieved),
        )


def taught_trials(experiment: str, seeds: Sequence[int]) -> Iterator[Trial]:
    """Teaches a task anew, then executes what one demonstration taught in the same room and in changed ones."""
    world, network = taught_network(experiment)
    yield from teaching_trials(experiment, seeds)
    for room in ("same", "changed"):
        yield from run_trials(experiment, world, network, room, seeds)


def summarise(trials: Sequence[Trial]) -> Summary:
    """Counts, and how sure one can be of the rate."""
    successes = sum(trial.success for trial in trials)
    interval = binomtest(successes, len(trials)).proportion_ci(confidence_level=0.95, method="exact")
    return Summary(
        trials=len(trials),
        successes=successes,
        low=float(interval.low),
        high=float(interval.high),
        mean_time_s=sum(trial.time_s for trial in trials) / len(trials),
        slowest_s=max(trial.time_s for trial in trials),
        collisions=sum(trial.collisions for trial in trials),
        grazes=sum(trial.grazes for trial in trials),
    )
