"""From a goal to a task."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from understudy.behaviors import Fact, Skill
from understudy.errors import NoPlanError, PlanningError
from understudy.network import Network
from understudy.planning.deordering import PartialOrder
from understudy.planning.domain import EVERYTHING, Domain, Facts, Operator, Things, domain_of
from understudy.planning.goals import goal_name, in_words, read_goal
from understudy.planning.loosening import loosened
from understudy.planning.missing import conflicts, unreachable
from understudy.planning.networks import network_of
from understudy.planning.relevance import relevant
from understudy.planning.solving import solved

__all__ = ["Plan", "PlanningProblem", "plan_task", "planning_problem"]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningProblem:
    """A goal, with all that is known of how to reach it.

    Attributes:
        goal: what shall be so at the end.
        start: what is so at first.
        domain: what the skills can do.
    """

    goal: tuple[Fact, ...]
    start: Facts
    domain: Domain

    @property
    def name(self) -> str:
        """For the task: ``carried orange pink``."""
        return goal_name(self.goal)

    def __str__(self) -> str:
        return in_words(self.goal)

    def operators(self, goal: Sequence[Fact]) -> tuple[Operator, ...]:
        """What matters of the domain for a goal; what it speaks of first, first, so that the plan follows its words."""
        named = [thing for fact in goal for thing in fact.things]

        def place(operator: Operator) -> int:
            things = {thing for fact in operator.gives for thing in fact.things}
            return min((named.index(thing) for thing in things.intersection(named)), default=0)

        return tuple(sorted(relevant(self.domain.operators, goal), key=place))


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """A plan, and the task that it is.

    Attributes:
        problem: what was asked.
        steps: in the order that their reasons demand, and no other.
        network: the task.
    """

    problem: PlanningProblem
    steps: PartialOrder
    network: Network


def planning_problem(
    goal: str, skills: Mapping[str, Skill], things: Things = EVERYTHING, *, given: str = ""
) -> PlanningProblem:
    """What is asked, from a person's words.

    Args:
        goal: ``carried(orange, pink) and visited(green)``.
        skills: by name.
        things: what there is, colors by kind.
        given: what is so at first, in the same words. Nothing else is taken to be so, and the task then works from
            any situation in which it is.

    Raises:
        PlanningError: the words cannot be read, or mean nothing to the skills.
        SkillError: what a skill says of itself has no meaning.
    """
    domain = domain_of(skills, things)
    start = read_goal(given, domain) if given else ()
    return PlanningProblem(goal=read_goal(goal, domain), start=frozenset(start), domain=domain)


def plan_task(problem: PlanningProblem, *, planner: str = "pyperplan") -> Plan:
    """Plans, and makes a task of the plan.

    Raises:
        NoPlanError: there is no plan; the message says what is missing.
        PlanningError: there is nothing to do, or no such planner.
        MissingExtraError: the planner is not installed.
    """
    blocked = unreachable(problem.domain, problem.start, problem.goal)
    if blocked:
        raise NoPlanError(str(problem), blocked)

    def solve(goal: Sequence[Fact]) -> tuple[str, ...] | None:
        return solved(problem.operators(goal), problem.start, goal, planner=planner)

    names = solve(problem.goal)
    if names is None:
        raise NoPlanError(str(problem), conflicts(problem.domain, problem.goal, lambda part: solve(part) is not None))
    if not names:
        raise PlanningError(f"there is nothing to do for {problem}: it is given")
    by_name = {one.name: one for one in problem.domain.operators}
    steps = loosened([by_name[name] for name in names], problem.start, frozenset(problem.goal))
    return Plan(problem=problem, steps=steps, network=network_of(steps))
