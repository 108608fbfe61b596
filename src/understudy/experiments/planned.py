"""Tasks that nobody showed and nobody wrote: planned from goals (§3.3.1), and executed."""

from collections.abc import Iterator, Sequence
from itertools import groupby

from understudy.behaviors import installed_skills
from understudy.experiments.trials import Trial, run_trials, summarise
from understudy.planning import plan_task, planning_problem
from understudy.sim import load_world, world_path

__all__ = ["planned_tables", "planned_trials"]

_GOALS = (
    ("transport", "carried(orange, orange)"),
    ("transport", "carried(orange, green) and visited(yellow)"),
    ("hierarchical", "carried(orange, green) and visited(pink)"),
)
"""Each with the world in which it is to be reached."""


def planned_trials(seeds: Sequence[int]) -> Iterator[Trial]:
    """Every goal in its room and in that room with everything elsewhere; one trial a seed in each.

    Raises:
        MissingExtraError: the planner is not installed.
    """
    tasks = [
        (load_world(world_path(world)), plan_task(planning_problem(goal, installed_skills()))) for world, goal in _GOALS
    ]
    for room in ("same", "changed"):
        for world, plan in tasks:
            yield from run_trials(str(plan.problem), world, plan.network, room, seeds)


def planned_tables(trials: Sequence[Trial]) -> Iterator[str]:
    """Each goal for itself, as lines of Markdown."""
    yield "| goal | room | successes | mean time | slowest |"
    yield "| --- | --- | --- | --- | --- |"
    for (goal, room), grouped in groupby(trials, key=lambda trial: (trial.experiment, trial.room)):
        found = summarise(list(grouped))
        times = f"{found.mean_time_s:.0f} s | {found.slowest_s:.0f} s"
        yield f"| `{goal}` | {room} | {found.successes} of {found.trials} | {times} |"
