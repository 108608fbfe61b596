"""The delivery task from all four initial conditions, and with things moved in mid-run (§3.5.2.5).

The dissertation ran each condition four times, once with the door open: so do four seeds that follow each other.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from understudy.behaviors import installed_skills
from understudy.experiments.delivery_rooms import CONDITIONS, Condition, Hand, Movable, beacon_of, draw_room
from understudy.experiments.trials import Trial
from understudy.network import load_task, task_path
from understudy.sessions import Performed, perform

__all__ = ["DeliveryTrial", "delivery_tables", "delivery_trial", "delivery_trials", "disturbed"]

_NAME = "delivery"

_LIMIT_S = 600.0
"""Simulated time allowed: to search both rooms and to open the door takes two minutes, with luck."""

_DELIVERED_M = 0.9
"""The box lies at home if its middle is at most so far from the beacon's, and the robot if it is half a metre more."""

_FIRST_S, _LAST_S = 5.0, 2.0
"""Nothing is moved earlier than this, nor so shortly before the end that the robot could not notice."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DeliveryTrial(Trial):
    """One run; its room is ``undisturbed``, ``box moved`` or ``robot moved``.

    Attributes:
        condition: where robot and box were at first.
        door_open: at first.
        switches: how often the robot switched between its networks, or began one anew.
        moved: what was moved, whereto and when.
    """

    condition: Condition
    door_open: bool
    switches: int
    moved: str

    @property
    def named(self) -> str:
        door = "door open" if self.door_open else "door closed"
        told = [self.experiment, self.room, f"seed {self.seed}", str(self.condition), door, self.moved]
        return ", ".join(filter(None, told))


def delivery_trials(seeds: Sequence[int]) -> Iterator[DeliveryTrial]:
    """One run of each condition a seed; then all of them again with the box moved in mid-run, and with the robot."""
    quiet = []
    for seed in seeds:
        for condition in CONDITIONS:
            quiet.append(delivery_trial(condition, seed))
            yield quiet[-1]
    for move in ("box", "robot"):
        yield from (disturbed(trial, move) for trial in quiet)


def disturbed(trial: DeliveryTrial, move: Movable) -> DeliveryTrial:
    """The same run again, in which something is moved before the moment at which it was done."""
    return delivery_trial(trial.condition, trial.seed, move=move, before_s=max(_FIRST_S, trial.time_s - _LAST_S))


def delivery_trial(
    condition: Condition, seed: int, *, move: Movable | None = None, before_s: float = 60.0
) -> DeliveryTrial:
    """One run.

    Args:
        condition: where robot and box are at first.
        seed: of their places, and of all chance; with every fourth the door is open at first.
        move: what is moved in mid-run.
        before_s: when it is moved at the latest.
    """
    rng = np.random.default_rng([seed, CONDITIONS.index(condition)])
    door_open = seed % 4 == 0
    world = draw_room(condition, rng, door_open=door_open)
    _, network = load_task(task_path(_NAME))
    hand = Hand(move, float(rng.uniform(_FIRST_S, before_s)), rng)
    performed = perform(
        _NAME,
        network,
        world,
        installed_skills(),
        seed=seed,
        limit_s=_LIMIT_S,
        watch=hand.watch,
        prepare=hand.prepare,
    )
    report = performed.report
    return DeliveryTrial(
        experiment=_NAME,
        room=f"{move} moved" if move else "undisturbed",
        seed=seed,
        time_s=report.duration_s,
        problems=tuple(_problems(performed)),
        collisions=sum(performed.verdict.collisions.values()),
        grazes=sum(performed.verdict.grazes.values()),
        achieved=tuple(path for path, _ in report.achieved),
        condition=condition,
        door_open=door_open,
        switches=sum(event.kind == "switch" for event in report.events),
        moved=hand.did,
    )


def _problems(performed: Performed) -> list[str]:
    """What was wrong, as somebody sees it who knows the truth."""
    report, stage = performed.report, performed.stage
    home = stage.referee.targets()[beacon_of(stage.world)]
    problems = []
    if not report.done:
        states = [event for event in report.events if event.detail.get("state") in ("executing", "searching")]
        problems.append(f"{report.ending}; last at {states[-1].component if states else 'nothing'}")
    box, robot = performed.verdict.boxes[0], stage.referee.robot_pose(stage.robot.name).position
    if report.done and box.distance_to(home) > _DELIVERED_M:
        problems.append(f"the box lies {box.distance_to(home):.2f} m from the beacon")
    if report.done and robot.distance_to(home) > _DELIVERED_M + 0.5:
        problems.append(f"the robot is {robot.distance_to(home):.2f} m from the beacon")
    return problems + [f"ran into a {what} ({count} ×)" for what, count in performed.verdict.collisions.items()]


def delivery_tables(trials: Sequence[Trial]) -> Iterator[str]:
    """The trials by initial condition, as lines of Markdown."""
    yield "| moved in mid-run | at first | successes | mean time | slowest | switches |"
    yield "| --- | --- | --- | --- | --- | --- |"
    runs = [trial for trial in trials if isinstance(trial, DeliveryTrial)]
    for room in dict.fromkeys(run.room for run in runs):
        for condition in CONDITIONS:
            mine = [run for run in runs if run.room == room and run.condition == condition]
            times = [run.time_s for run in mine]
            yield (
                f"| {'nothing' if room == 'undisturbed' else room.removesuffix(' moved')} | {condition} "
                f"| {sum(run.success for run in mine)} of {len(mine)} | {sum(times) / len(times):.0f} s "
                f"| {max(times):.0f} s | {sum(run.switches for run in mine)} |"
            )
