"""Tasks from goals: what the skills need and give becomes a planning domain, and a plan becomes a network."""

from understudy.planning.deordering import GOAL, START, CausalLink, PartialOrder, Threat, deordered
from understudy.planning.domain import EVERYTHING, Domain, Facts, Operator, Things, domain_of
from understudy.planning.goals import goal_name, in_words, read_goal
from understudy.planning.loosening import loosened
from understudy.planning.missing import conflicts, reachable, unreachable
from understudy.planning.networks import Reason, network_of, reasons_of
from understudy.planning.planner import Plan, PlanningProblem, plan_task, planning_problem
from understudy.planning.relevance import relevant
from understudy.planning.solving import PLANNERS, Planner, solved, strips, write_pddl

__all__ = [
    "EVERYTHING",
    "GOAL",
    "PLANNERS",
    "START",
    "CausalLink",
    "Domain",
    "Facts",
    "Operator",
    "PartialOrder",
    "Plan",
    "Planner",
    "PlanningProblem",
    "Reason",
    "Things",
    "Threat",
    "conflicts",
    "deordered",
    "domain_of",
    "goal_name",
    "in_words",
    "loosened",
    "network_of",
    "plan_task",
    "planning_problem",
    "reachable",
    "read_goal",
    "reasons_of",
    "relevant",
    "solved",
    "strips",
    "unreachable",
    "write_pddl",
]
