"""How much faster than real time a robot lives: simulator with all sensors, perception and control at 10 Hz.

Other programs on the machine only ever make it slower. So the processor's time is told beside the wall's, which
counts the others' turns, too; and everything is repeated, with the spread of the repetitions.

For comparison, quoted and not measured here: IR-SIM runs at 47 times real time with a laser only, Stage at 590 times
with a laser only and no physics, each on a like machine.
"""

import statistics
import time
from collections.abc import Mapping

import cv2

from understudy.behaviors import Skill, installed_skills
from understudy.clock import CONTROL_PERIOD_S
from understudy.execution import Controller
from understudy.learning import learn
from understudy.network import Network
from understudy.perception import Perception
from understudy.sessions import teach
from understudy.sim import Simulation, World, load_world, world_path

__all__ = ["main", "run"]

WORLDS = ("visit_targets", "transport")
REPETITIONS, SEEDS, STEPS = 9, 3, 250
PARTS = ("sense", "perceive", "decide", "simulate")
QUOTED = "quoted, on like machines: IR-SIM 47 (laser only), Stage 590 (laser only, no physics)"


def run(name: str) -> list[dict[str, float]]:
    """Milliseconds of a control step, once for every repetition: ``wall``, and of the processor's time ``cpu``, of
    which ``sense``, ``perceive``, ``decide`` and ``simulate`` are the parts.

    All repetitions do the same work: the same runs of the task that the robot was taught in this world.
    """
    world, skills = load_world(world_path(name)), installed_skills()
    network = learn(teach(world, skills).demonstration).network
    alone = world.model_copy(update={"teacher": None})
    _repetition(alone, network, skills)  # whatever is made once only
    return [_repetition(alone, network, skills) for _ in range(REPETITIONS)]


def _repetition(world: World, network: Network, skills: Mapping[str, Skill]) -> dict[str, float]:
    spent = dict.fromkeys((*PARTS, "cpu", "wall"), 0.0)
    for seed in range(SEEDS):
        robot = Simulation(world, seed=seed).robot()
        perception, controller = Perception(robot.spec), Controller(network, skills, robot.spec, seed=seed)
        begun = time.perf_counter()
        for _ in range(STEPS):
            moments = [time.process_time()]
            observation = robot.sense()
            moments.append(time.process_time())
            percepts = perception.update(observation)
            moments.append(time.process_time())
            command = controller.tick(percepts).command
            moments.append(time.process_time())
            robot.act(command)
            robot.wait()
            moments.append(time.process_time())
            for part, before, after in zip(PARTS, moments, moments[1:], strict=False):
                spent[part] += after - before
        spent["wall"] += time.perf_counter() - begun
    spent["cpu"] = sum(spent[part] for part in PARTS)
    return {what: 1000 * seconds / (SEEDS * STEPS) for what, seconds in spent.items()}


def main() -> None:
    columns = ("wall", "cpu", *PARTS)
    print(f"{REPETITIONS} repetitions of {SEEDS} runs of {STEPS} steps; OpenCV on {cv2.getNumThreads()} thread")
    print(f"{'ms a control step':<24} {' '.join(f'{column:>9}' for column in columns)}   times real time, on one core")
    for name in WORLDS:
        rows = run(name)
        for word, choose in (("median", statistics.median), ("least", min), ("most", max)):
            row = {column: choose(row[column] for row in rows) for column in columns}
            figures = " ".join(f"{row[column]:>9.3f}" for column in columns)
            print(f"{name:<15} {word:<8} {figures} {1000 * CONTROL_PERIOD_S / row['cpu']:>17.0f}")
    print(QUOTED)


if __name__ == "__main__":
    main()
