"""A planned task is done by a robot that nobody showed it to."""

from understudy.behaviors import installed_skills
from understudy.experiments import problems_of
from understudy.planning import plan_task, planning_problem
from understudy.sessions import perform
from understudy.sim import load_world, world_path


def test_the_orange_box_is_brought_to_the_green_target():
    skills, world = installed_skills(), load_world(world_path("transport"))
    network = plan_task(planning_problem("carried(orange, green) and visited(yellow)", skills)).network
    performed = perform("planned", network, world, skills, seed=7001)
    assert problems_of(performed, network) == []
    (box,) = performed.verdict.boxes
    green = next(target for target in world.targets if target.color == "green")
    assert box.distance_to(type(box)(*green.at)) < 1.2
