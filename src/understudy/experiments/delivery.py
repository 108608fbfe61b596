"""The delivery task from all four initial conditions, and with things moved in mid-run (§3.5.2.5).

``python -m understudy.experiments.delivery`` prints the table as Markdown.
"""

import argparse
import os

os.environ.setdefault("OPENCV_FOR_THREADS_NUM", "1")  # as the command line has it; read when OpenCV is loaded

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from understudy.behaviors import installed_skills
from understudy.errors import WorldError
from understudy.execution import Decision
from understudy.geometry import Point
from understudy.network import load_task, task_path
from understudy.perception import Percepts
from understudy.sessions import Performed, Stage, perform
from understudy.sim import World, load_world, world_path

__all__ = [
    "CONDITIONS",
    "LIMIT_S",
    "MOVES",
    "Condition",
    "DeliveryTrial",
    "Move",
    "delivery_table",
    "delivery_trial",
    "delivery_trials",
    "disturbed",
    "main",
]

Room = Literal["home", "other"]
Move = Literal["", "box", "robot"]
"""What is moved in mid-run: nothing, the box, or the robot."""

LIMIT_S = 600.0
"""Simulated time allowed: to search both rooms and to open the door takes two minutes, with luck."""

MOVES: tuple[Move, ...] = ("box", "robot")

RUNS = 4
"""Of each condition, the first of them with the door open (§3.5.2.5)."""

_OPEN_DEG = 80.0
_DELIVERED_M = 0.9
"""The box lies at home if its middle is at most so far from the beacon's, and the robot if it is half a metre more."""

_WALL_M, _APART_M, _DOOR_M = 0.6, 0.7, 1.3
"""Nothing is put nearer to a wall, to another thing, or to the middle of the door."""

_FIRST_S, _LAST_S = 5.0, 2.0
"""Nothing is moved earlier than this, nor so shortly before the end that the robot could not notice."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Condition:
    """Where the robot and the box are at first (§3.5.2.3)."""

    robot: Room
    box: Room

    def __str__(self) -> str:
        return f"robot {self.robot}, box {self.box}"


CONDITIONS = tuple(Condition(robot=robot, box=box) for robot in ("home", "other") for box in ("home", "other"))


@dataclass(frozen=True, slots=True, kw_only=True)
class DeliveryTrial:
    """One run.

    Attributes:
        condition, door_open, move, seed: which.
        time_s: simulated time until it was done, or given up.
        problems: what was wrong; empty for a success.
        switches: how often the robot switched between its networks.
        moved: what was moved, whereto and when.
        grazes: soft contacts.
    """

    condition: Condition
    door_open: bool
    move: Move
    seed: int
    time_s: float
    problems: tuple[str, ...]
    switches: int
    moved: str
    grazes: int


def delivery_trials(seeds: Iterable[int]) -> Iterator[DeliveryTrial]:
    """Four runs of every condition for each seed; every run has a seed of its own, ``100 * seed`` and on."""
    for seed in seeds:
        for number, condition in enumerate(CONDITIONS):
            for run in range(RUNS):
                yield delivery_trial(condition, 100 * seed + RUNS * number + run, door_open=run == 0)


def disturbed(trial: DeliveryTrial, move: Move) -> DeliveryTrial:
    """The same run again, in which something is moved before the moment at which it was done."""
    return delivery_trial(
        trial.condition,
        trial.seed,
        door_open=trial.door_open,
        move=move,
        before_s=max(_FIRST_S, trial.time_s - _LAST_S),
    )


def delivery_trial(
    condition: Condition, seed: int, *, door_open: bool, move: Move = "", before_s: float = 60.0
) -> DeliveryTrial:
    """One run, in a room that is drawn by its seed.

    Args:
        condition: where robot and box are at first.
        seed: of the room, and of all chance.
        door_open: at first.
        move: what is moved in mid-run.
        before_s: when it is moved at the latest.
    """
    rng = np.random.default_rng(seed)
    world = _room(condition, rng, seed, door_open=door_open)
    _, network = load_task(task_path("delivery"))
    hand = _Hand(world, move, float(rng.uniform(_FIRST_S, before_s)), rng)
    performed = perform(
        "delivery",
        network,
        world,
        installed_skills(),
        seed=seed,
        limit_s=LIMIT_S,
        watch=hand.watch,
        prepare=hand.prepare,
    )
    report = performed.report
    return DeliveryTrial(
        condition=condition,
        door_open=door_open,
        move=move,
        seed=seed,
        time_s=report.duration_s,
        problems=tuple(_problems(performed)),
        switches=sum(event.kind == "switch" for event in report.events),
        moved=hand.did,
        grazes=sum(performed.verdict.grazes.values()),
    )


def _problems(performed: Performed) -> list[str]:
    """What was wrong, as somebody sees it who knows the truth."""
    report, stage = performed.report, performed.stage
    home = stage.referee.targets()[_beacon(stage.world)]
    problems = []
    if not report.done:
        executing = [event for event in report.events if event.detail.get("state") in ("executing", "searching")]
        problems.append(f"{report.ending}; last at {executing[-1].component if executing else 'nothing'}")
    if report.done and performed.verdict.boxes[0].distance_to(home) > _DELIVERED_M:
        problems.append(f"the box lies {performed.verdict.boxes[0].distance_to(home):.2f} m from the beacon")
    robot = stage.referee.robot_pose(stage.robot.name).position
    if report.done and robot.distance_to(home) > _DELIVERED_M + 0.5:
        problems.append(f"the robot is {robot.distance_to(home):.2f} m from the beacon")
    return problems + [f"ran into a {what} ({count} ×)" for what, count in performed.verdict.collisions.items()]


class _Hand:
    """Moves something, once, somewhere, in mid-run."""

    def __init__(self, world: World, move: Move, when_s: float, rng: np.random.Generator) -> None:
        self._world, self._move, self._when_s, self._rng = world, move, when_s, rng
        self._stage: Stage | None = None
        self.did = ""

    def prepare(self, stage: Stage) -> None:
        self._stage = stage

    def watch(self, percepts: Percepts, decision: Decision) -> None:
        stage = self._stage
        if not self._move or self.did or stage is None or percepts.time_s < self._when_s:
            return
        room: Room = "home" if self._rng.random() < 0.5 else "other"
        robot, box = stage.referee.robot_pose(stage.robot.name).position, stage.referee.boxes()[0]
        place = _place(self._world, room, self._rng, apart_from=[box if self._move == "robot" else robot])
        heading = float(self._rng.uniform(-180, 180))
        if self._move == "box":
            stage.simulation.move_box(0, place, heading)
        else:
            stage.simulation.move_robot(place, heading, stage.robot.name)
        self.did = f"the {self._move} to ({place[0]:.1f}, {place[1]:.1f}) at {percepts.time_s:.0f} s"


def _room(condition: Condition, rng: np.random.Generator, seed: int, *, door_open: bool) -> World:
    """The bundled world with robot and box at random in the rooms of the condition."""
    world = load_world(world_path("delivery"))
    box = _place(world, condition.box, rng)
    robot = _place(world, condition.robot, rng, apart_from=[Point(*box)])
    opening = _OPEN_DEG * float(rng.choice((-1.0, 1.0)))
    heading, turned = float(rng.uniform(-180, 180)), float(rng.uniform(-45, 45))
    return world.model_copy(
        update={
            "seed": seed,
            "boxes": (world.boxes[0].model_copy(update={"at": box, "heading_deg": round(turned, 1)}),),
            "robots": (world.robots[0].model_copy(update={"at": robot, "heading_deg": round(heading, 1)}),),
            "doors": (world.doors[0].model_copy(update={"open_deg": opening if door_open else 0.0}),),
        }
    )


def _place(
    world: World, room: Room, rng: np.random.Generator, *, apart_from: Sequence[Point] = ()
) -> tuple[float, float]:
    """A free place in a room: the one on the beacon's side of the door, or the other."""
    width, depth = world.arena.size
    door = Point(*(np.array(world.doors[0].hinge) + np.array(world.doors[0].to)) / 2)
    home = Point(*world.targets[_beacon(world)].at)
    others = [home, *apart_from]
    for _ in range(1000):
        x, y = rng.uniform(_WALL_M, width - _WALL_M), rng.uniform(_WALL_M, depth - _WALL_M)
        place = Point(round(x, 3), round(y, 3))
        here = (y < door.y) is (home.y < door.y)
        if (
            here is (room == "home")
            and abs(y - door.y) >= _WALL_M
            and place.distance_to(door) >= _DOOR_M
            and all(place.distance_to(other) >= _APART_M for other in others)
        ):
            return place.x, place.y
    raise WorldError(f"no free place found in the {room} room", source=world.name)


def _beacon(world: World) -> int:
    """The target that is no post of the door."""
    door = [Point(*world.doors[0].hinge), Point(*world.doors[0].to)]
    return next(i for i, t in enumerate(world.targets) if all(Point(*t.at).distance_to(end) > 0.5 for end in door))


def _print(line: str) -> None:
    print(line, flush=True)


def delivery_table(seeds: Sequence[int], tell: Callable[[str], None] = _print) -> list[DeliveryTrial]:
    """Runs all trials and prints them as a Markdown table, with every failure and what was wrong.

    Args:
        seeds: for each, four runs of each condition; and as many with the box moved in mid-run, and with the robot.
        tell: is given the lines.
    """
    tell("| moved in mid-run | condition | successes | mean time | slowest | switches | grazes |")
    tell("| --- | --- | --- | --- | --- | --- | --- |")
    every: list[DeliveryTrial] = []
    quiet = list(delivery_trials(seeds))
    for move in ("", *MOVES):
        trials = [disturbed(trial, move) for trial in quiet] if move else quiet
        for condition in CONDITIONS:
            mine = [trial for trial in trials if trial.condition == condition]
            good = sum(not trial.problems for trial in mine)
            times = [trial.time_s for trial in mine]
            tell(
                f"| {move or 'nothing'} | {condition} | {good} of {len(mine)} | {sum(times) / len(mine):.0f} s "
                f"| {max(times):.0f} s | {sum(trial.switches for trial in mine)} | {sum(t.grazes for t in mine)} |"
            )
        every += trials
    failures = [trial for trial in every if trial.problems]
    tell("\nFailures: " + ("none" if not failures else ""))
    for trial in failures:
        opened = "door open" if trial.door_open else "door closed"
        moved = f", {trial.moved}" if trial.moved else ""
        tell(f"- seed {trial.seed}, {trial.condition}, {opened}{moved}: {'; '.join(trial.problems)}")
    return every


def main() -> None:
    """Runs the trials and prints them."""
    parser = argparse.ArgumentParser(prog="python -m understudy.experiments.delivery", description=__doc__)
    parser.add_argument("--trials", type=int, default=1, help="rounds of 16 runs, and 32 with things moved (default 1)")
    parser.add_argument("--seed", type=int, default=1, help="of the first round; the next ones count up")
    arguments = parser.parse_args()
    delivery_table(range(arguments.seed, arguments.seed + arguments.trials))


if __name__ == "__main__":
    main()
