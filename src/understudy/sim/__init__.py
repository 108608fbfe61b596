"""The simulator: world documents, simulated robots and teachers, and the referee who knows the truth.

A demonstration::

    world = load_world(world_path("visit_targets"))
    simulation = Simulation(world)
    robot = simulation.robot()
    while not simulation.teacher_done:
        observation = robot.sense()
        robot.act(decide(observation))
        robot.wait()
"""

from understudy.sim.habits import LEVELS, Habits, Skilled
from understudy.sim.rearrange import rearranged
from understudy.sim.referee import Collision, CollisionKind, Referee
from understudy.sim.simulated_robot import SimRobot
from understudy.sim.simulation import Simulation
from understudy.sim.slips import Slip
from understudy.sim.world import World, load_world, world_names, world_path

__all__ = [
    "LEVELS",
    "Collision",
    "CollisionKind",
    "Habits",
    "Referee",
    "SimRobot",
    "Simulation",
    "Skilled",
    "Slip",
    "World",
    "load_world",
    "rearranged",
    "world_names",
    "world_path",
]
