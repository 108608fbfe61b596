"""The planner: operators and a goal handed to unified-planning, which knows the engines."""

import importlib
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from understudy.behaviors import Fact
from understudy.documents import write_new
from understudy.errors import MissingExtraError, PlanningError
from understudy.planning.domain import Facts, Operator

if TYPE_CHECKING:
    from unified_planning.model import Problem

__all__ = ["PLANNERS", "Planner", "solved", "strips", "write_pddl"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Planner:
    """A planner that unified-planning knows.

    Attributes:
        package: that must be installed.
        extra: of this package, which installs it.
        engine: what unified-planning calls it.
        settings: so that it finds a plan with the fewest steps, the same one each time.
    """

    package: str
    extra: str
    engine: str
    settings: Mapping[str, str] = field(default_factory=dict)


_EXTRAS = {"plan": "unified-planning up-pyperplan", "fast-downward": "unified-planning up-fast-downward"}

PLANNERS = {
    # Its best heuristic for shortest plans lets the order of sets settle ties, which Python changes from run to run.
    # And of what matters for a goal there is little: breadth-first search soon sees that there is no plan.
    "pyperplan": Planner(package="up_pyperplan", extra="plan", engine="pyperplan-opt", settings={"search": "bfs"}),
    "fast-downward": Planner(package="up_fast_downward", extra="fast-downward", engine="fast-downward-opt"),
}
"""By the names that people give them."""


def solved(
    operators: Sequence[Operator], start: Facts, goal: Iterable[Fact], *, planner: str = "pyperplan"
) -> tuple[str, ...] | None:
    """The names of the operators of a plan with the fewest steps; None if there is none.

    Raises:
        PlanningError: there is no planner of this name, or it cannot tell.
        MissingExtraError: it is not installed.
    """
    if planner not in PLANNERS:
        raise PlanningError(f"there is no planner called {planner!r}; there are: {', '.join(PLANNERS)}")
    chosen, goal = PLANNERS[planner], tuple(goal)
    if start.issuperset(goal):
        return ()
    if not operators:
        return None
    # First of all: unified-planning looks once for the planners that there are, as soon as it is used.
    _imported(chosen.package, chosen.extra)
    problem = strips(operators, start, goal)
    problem.environment.credits_stream = None  # else it writes whom it thanks among what the command says
    with problem.environment.factory.OneshotPlanner(name=chosen.engine, params=dict(chosen.settings)) as engine:
        result = engine.solve(problem)
    if result.plan is not None:
        return tuple(operators[int(action.action.name.rpartition("__")[2])].name for action in result.plan.actions)
    if not result.status.name.startswith("UNSOLVABLE"):
        raise PlanningError(f"{planner} gave up ({result.status.name}); try another: {', '.join(PLANNERS)}")
    return None


def strips(operators: Sequence[Operator], start: Facts, goal: Iterable[Fact], *, name: str = "task") -> "Problem":
    """The problem in unified-planning's terms: plain STRIPS, one action without parameters for each operator.

    Nothing is left for the planner to fill in, since few planners know what ``ends: near(*)`` means.

    Raises:
        MissingExtraError: unified-planning is not installed.
    """
    goal = tuple(goal)
    up = _imported("unified_planning.shortcuts", "plan")
    problem = up.Problem(_symbol(word=name) or "task")
    facts = sorted({*start, *goal}.union(*(one.needs | one.gives | one.ends for one in operators)))
    fluents = {fact: up.Fluent(_symbol(*fact.things, word=fact.word)) for fact in facts}
    for fact, fluent in fluents.items():
        problem.add_fluent(fluent, default_initial_value=fact in start)
    for number, one in enumerate(operators):
        action = up.InstantaneousAction(f"{_symbol(word=one.name)}__{number}")
        for fact in sorted(one.needs):
            action.add_precondition(fluents[fact])
        for fact in sorted(one.gives | one.ends):
            action.add_effect(fluents[fact], fact in one.gives)
        problem.add_action(action)
    for fact in goal:
        problem.add_goal(fluents[fact])
    return problem


def write_pddl(
    folder: Path, operators: Sequence[Operator], start: Facts, goal: Iterable[Fact], *, name: str
) -> tuple[Path, Path]:
    """Writes ``domain.pddl`` and ``problem.pddl``, for any other planner. Nothing is overwritten.

    Raises:
        MissingExtraError: unified-planning is not installed.
        UnderstudyError: one of the files exists, or cannot be written.
    """
    writer = _imported("unified_planning.io", "plan").PDDLWriter(strips(operators, start, goal, name=name))
    folder.mkdir(parents=True, exist_ok=True)
    files = folder / "domain.pddl", folder / "problem.pddl"
    for file, text in zip(files, (writer.get_domain(), writer.get_problem()), strict=True):
        write_new(file, text)
    return files


def _symbol(*things: str, word: str) -> str:
    """As a name in PDDL, of letters, digits and underscores: ``carried__light_orange__pink``."""
    return "__".join(re.sub(r"[^a-z0-9]+", "_", part.lower()).strip("_") for part in (word, *things))


def _imported(module: str, extra: str) -> Any:
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        missing = str(error.name).partition(".")[0]
        raise MissingExtraError(
            f"planning needs {missing}, which is not installed; pip install {_EXTRAS[extra]} (the extra {extra!r})"
        ) from None
