"""How much faster than real time a robot lives: simulator with all sensors, perception and control at 10 Hz.

For comparison, quoted and not measured here: IR-SIM runs at 47 times real time with a laser only, Stage at 590 times
with a laser only and no physics, each on a like machine.
"""

import statistics
import time

from understudy.behaviors import installed_skills
from understudy.clock import CONTROL_PERIOD_S
from understudy.execution import Controller
from understudy.learning import learn
from understudy.perception import Perception
from understudy.sessions import teach
from understudy.sim import Simulation, load_world, world_path

__all__ = ["main", "run"]

WORLDS = ("visit_targets", "transport")
ROUNDS, STEPS = 7, 250
PARTS = ("sense", "perceive", "decide", "simulate")


def run(name: str) -> dict[str, float]:
    """Milliseconds of each part of a control step, as medians over rounds, and how many times real time that is.

    ``best`` is the least disturbed round's: other programs on the machine only ever make it slower.
    """
    world, skills = load_world(world_path(name)), installed_skills()
    network = learn(teach(world, skills).demonstration).network
    rounds: list[dict[str, float]] = []
    for seed in range(ROUNDS):
        simulation = Simulation(world.model_copy(update={"teacher": None}), seed=seed)
        robot = simulation.robot()
        perception, controller = Perception(robot.spec), Controller(network, skills, robot.spec, seed=seed)
        spent = dict.fromkeys(PARTS, 0.0)
        for _ in range(STEPS):
            moments = [time.perf_counter()]
            observation = robot.sense()
            moments.append(time.perf_counter())
            percepts = perception.update(observation)
            moments.append(time.perf_counter())
            command = controller.tick(percepts).command
            moments.append(time.perf_counter())
            robot.act(command)
            robot.wait()
            moments.append(time.perf_counter())
            for part, begun, ended in zip(PARTS, moments, moments[1:], strict=False):
                spent[part] += ended - begun
        rounds.append({part: 1000 * seconds / STEPS for part, seconds in spent.items()})
    row = {part: statistics.median(one[part] for one in rounds) for part in PARTS}
    wholes = [sum(one.values()) for one in rounds]
    whole, best = statistics.median(wholes), min(wholes)
    times = {"times_real_time": 1000 * CONTROL_PERIOD_S / whole, "best": 1000 * CONTROL_PERIOD_S / best}
    return {**row, "whole": whole, **times}


def main() -> None:
    heads = " ".join(f"{part:>9}" for part in (*PARTS, "whole"))
    print(f"{'ms a control step':<18} {heads}   times real time   best round")
    for name in WORLDS:
        row = run(name)
        parts = " ".join(f"{row[part]:>9.3f}" for part in (*PARTS, "whole"))
        print(f"{name:<18} {parts} {row['times_real_time']:>17.0f} {row['best']:>12.0f}")


if __name__ == "__main__":
    main()
