"""Tasks that nobody showed and nobody wrote: planned from goals (§3.3.1), and executed."""

from functools import lru_cache

from understudy.behaviors import installed_skills
from understudy.experiments.document import Options
from understudy.experiments.teaching import executed
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit
from understudy.network import Network
from understudy.planning import plan_task, planning_problem

__all__ = ["PlanningOptions", "planned_trial"]


class PlanningOptions(Options):
    """What a row of planned tasks takes.

    Attributes:
        plan: the goal, in the words of ``understudy plan``.
    """

    plan: str


@lru_cache(maxsize=32)
def _planned(goal: str) -> Network:
    return plan_task(planning_problem(goal, installed_skills())).network


def planned_trial(unit: Unit) -> Trial:
    """Plans the task and executes it.

    Raises:
        PlanningError: the goal cannot be read, or there is no plan.
        MissingExtraError: the planner is not installed.
    """
    return executed(unit, _planned(PlanningOptions.model_validate(unit.options).plan))
