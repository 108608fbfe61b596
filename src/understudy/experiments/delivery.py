"""The delivery task from all four initial conditions, and with things moved in mid-run (§3.5.2.5).

The dissertation ran each condition four times, once with the door open: so do sixteen seeds that follow each other.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from understudy.behaviors import installed_skills
from understudy.experiments.delivery_rooms import CONDITIONS, Hand, Movable, beacon_of, draw_room
from understudy.experiments.document import Options
from understudy.experiments.experiment import Experiment
from understudy.experiments.judging import collisions_of
from understudy.experiments.summary import Table, summarise
from understudy.experiments.teaching import reference
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit
from understudy.sessions import Performed, perform

__all__ = ["DeliveryOptions", "delivery_table", "delivery_trial"]

_DELIVERED_M = 0.9
"""The box lies at home if its middle is at most so far from the beacon's, and the robot if it is half a metre more."""

_FIRST_S, _LAST_S = 5.0, 2.0
"""Nothing is moved earlier than this, nor so shortly before the end that the robot could not notice."""


class DeliveryOptions(Options):
    """What a row of deliveries takes.

    Attributes:
        moved: what is moved in mid-run.
    """

    moved: Movable | None = None


def delivery_trial(unit: Unit) -> Trial:
    """One run; the seed decides on the condition, on the door and on all chance.

    What is moved is moved before the moment at which the same run is done if nothing is.
    """
    moved = DeliveryOptions.model_validate(unit.options).moved
    if moved is None:
        return _run(unit, None, 0.0)
    quiet = _run(replace(unit, folder=None, witness=None), None, 0.0)
    return _run(unit, moved, max(_FIRST_S, quiet.time_s - _LAST_S))


def _run(unit: Unit, moved: Movable | None, before_s: float) -> Trial:
    condition = CONDITIONS[unit.seed % len(CONDITIONS)]
    door_open = unit.seed // len(CONDITIONS) % 4 == 0
    rng = np.random.default_rng(unit.seed)
    world = draw_room(unit.place, condition, rng, door_open=door_open)
    network = unit.experiment.task(unit.row) or reference(unit)
    hand = Hand(moved, float(rng.uniform(_FIRST_S, before_s)) if moved is not None else 0.0, rng)
    performed = perform(
        unit.experiment.name,
        network,
        world,
        installed_skills(),
        seed=unit.seed,
        limit_s=unit.limit_s,
        recording=unit.recording("run"),
        watch=hand.watch,
        prepare=hand.prepare,
    )
    switches = sum(event.kind == "switch" for event in performed.report.events)
    door = "open" if door_open else "closed"
    details = {"at first": str(condition), "door": door, "moved": hand.did, "switches": switches}
    return unit.trial_of(performed, network, _problems(performed), details=details)


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
    return problems + collisions_of(performed.verdict)


def delivery_table(experiment: Experiment, trials: Sequence[Trial]) -> Table:
    """The trials by what is where at first, and how often the robot switched between its networks."""
    rows = []
    for row in dict.fromkeys(trial.row for trial in trials):
        for condition in map(str, CONDITIONS):
            mine = [trial for trial in trials if (trial.row, trial.details.get("at first")) == (row, condition)]
            if mine:
                found, switches = summarise(mine), sum(trial.details["switches"] for trial in mine)
                rows.append((row, condition, found.rate, found.mean_time, found.slowest, str(switches)))
    return Table(
        title="By what is where at first",
        head=("row", "at first", "successes", "mean time", "slowest", "switches"),
        rows=tuple(rows),
    )
