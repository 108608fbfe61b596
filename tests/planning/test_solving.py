"""The planner: what it is given, what is written for others, and what is said when it is not there."""

import sys

import pytest
from unified_planning.engines import PlanGenerationResult, PlanGenerationResultStatus
from unified_planning.io import PDDLReader
from unified_planning.shortcuts import get_environment

from understudy.behaviors import installed_skills
from understudy.errors import DocumentError, MissingExtraError, PlanningError
from understudy.planning import plan_task, planning_problem, solved, write_pddl

PROBLEM = planning_problem("carried(light orange, pink)", installed_skills())
ASKED = PROBLEM.operators(PROBLEM.goal), PROBLEM.start, PROBLEM.goal


@pytest.mark.parametrize(
    ("planner", "gone", "mend"),
    [
        ("pyperplan", "unified_planning.shortcuts", "unified-planning up-pyperplan (the extra 'plan')"),
        ("pyperplan", "up_pyperplan", "unified-planning up-pyperplan (the extra 'plan')"),
        ("fast-downward", "up_fast_downward", "unified-planning up-fast-downward (the extra 'fast-downward')"),
    ],
)
def test_a_missing_extra_is_one_clear_line(planner, gone, mend, monkeypatch):
    monkeypatch.setitem(sys.modules, gone, None)
    with pytest.raises(MissingExtraError) as caught:
        plan_task(PROBLEM, planner=planner)
    assert str(caught.value) == f"planning needs {gone.partition('.')[0]}, which is not installed; pip install {mend}"


def test_an_unknown_planner():
    with pytest.raises(PlanningError, match="no planner called 'shakey'; there are: pyperplan, fast-downward"):
        plan_task(PROBLEM, planner="shakey")


def test_a_planner_that_gives_up_has_not_said_that_there_is_no_plan(monkeypatch):
    class Tired:
        def __enter__(self):
            return self

        def __exit__(self, *_):
            return None

        def solve(self, problem):
            return PlanGenerationResult(PlanGenerationResultStatus.TIMEOUT, None, "tired")

    monkeypatch.setattr(get_environment().factory, "OneshotPlanner", lambda **_: Tired())
    with pytest.raises(PlanningError, match=r"pyperplan gave up \(TIMEOUT\); try another: pyperplan, fast-downward"):
        solved(*ASKED)


def test_what_is_written_for_other_planners_is_the_same_problem(tmp_path):
    domain, problem = write_pddl(tmp_path / "pddl", *ASKED, name="42 things!")
    read = PDDLReader().parse_problem(str(domain), str(problem))
    assert len(read.actions) == len(ASKED[0])
    with get_environment().factory.OneshotPlanner(name="pyperplan") as engine:
        assert len(engine.solve(read).plan.actions) == len(solved(*ASKED))
    with pytest.raises(DocumentError, match="nothing is overwritten"):
        write_pddl(tmp_path / "pddl", *ASKED, name="again")


def test_a_goal_out_of_reach_is_written_too(tmp_path):
    skills = {name: skill for name, skill in installed_skills().items() if name != "PickUp"}
    problem = planning_problem("holding(red)", skills | {"Drop": installed_skills()["Drop"]})
    _, file = write_pddl(tmp_path, problem.operators(problem.goal), problem.start, problem.goal, name="日本")
    assert "(holding__red)" in file.read_text(encoding="utf-8")
