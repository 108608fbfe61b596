"""Lessons by people of different skill (§4.5.6, Table 4.3): is the task learned that was meant, and why not?"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from understudy.experiments.experiment import Experiment
from understudy.experiments.judging import collisions_of
from understudy.experiments.summary import Table
from understudy.experiments.teaching import executed, reference, show, structure
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit
from understudy.geometry import Point
from understudy.network import Component, Network
from understudy.sessions import Taught
from understudy.sim.listening import meant_by

__all__ = ["causes_of", "causes_table", "lesson_trial"]

Step = tuple[str, str]
"""Behavior and color."""


def lesson_trial(unit: Unit) -> Trial:
    """Shows the task, and executes what was learned. A success has the steps that were meant, and does them.

    The steps must be those of the reference, in its order, and no others; whether the links are its own, too, is told
    in the details. A lesson with other steps is not executed.

    Raises:
        WorldError: the world has no teacher.
    """
    shown, meant = show(unit), reference(unit)
    learned = shown.lesson.network if shown.lesson is not None else None
    causes = tuple(dict.fromkeys(causes_of(shown.taught, learned, meant)))
    details = {"slips": len(shown.taught.slips), "remarks": len(shown.taught.remarks)}
    taught = unit.trial(
        ending="taught" if shown.taught.finished else "unfinished",
        stage=shown.taught.stage,
        time_s=round(shown.taught.demonstration.span.duration, 3),
        problems=(*collisions_of(shown.taught.verdict), *causes),
        details={**details, "links": "none"},
    )
    if causes or learned is None:
        return taught
    run = executed(unit, learned)
    same = structure(learned) == structure(meant)
    return replace(
        run,
        problems=(*taught.problems, *(f"executed: {problem}" for problem in run.problems)),
        collisions=dict(Counter(taught.collisions) + Counter(run.collisions)),
        grazes=dict(Counter(taught.grazes) + Counter(run.grazes)),
        details={**details, "links": "the reference's" if same else "others"},
    )


def causes_of(taught: Taught, learned: Network | None, meant: Network) -> Iterator[str]:
    """Why other steps were learned than were meant; nothing if they were not.

    Args:
        taught: the lesson; its slips, and what stands in its room, are the truth.
        learned: None if nothing was.
        meant: the reference.
    """
    mine, right = _steps(learned) if learned is not None else [], _steps(meant)
    if mine == right:
        return
    missing, surplus = Counter(right) - Counter(mine), Counter(mine) - Counter(right)
    seen = Counter(
        dict(one.instance.parameters).get("color")
        for one in taught.demonstration.observations
        if one.instance.behavior == "Track" and one.interval.duration >= 2.0
    )
    needed = Counter(color for behavior, color in right if behavior == "Track")
    forgotten = _forgotten(taught)
    for behavior, color in missing:
        if behavior != "Track":
            yield "the box was not picked up"
        elif color in forgotten:
            yield "HERE was forgotten"
        elif seen[color] >= needed[color]:
            yield "HERE came when the target was out of view"
        elif any("lost" in sentence for _, sentence in taught.remarks):
            yield "the robot lost its teacher, and did not see the target"
        else:
            yield "the robot was led where it did not see the target"
    colors = {str(target.color) for target in taught.stage.world.targets}
    for behavior, color in surplus:
        if behavior == "Track":
            if color not in colors:
                yield "a color was learned that is not there"
            else:
                yield "a visit was learned twice" if color in needed else "a distractor was learned"
    if not missing and not surplus:
        yield "the steps were learned in another order"


def _steps(network: Network) -> list[Step]:
    """In the order of their observation."""
    parts = (part for _, part in network.walk() if isinstance(part, Component))
    return [(part.behavior, str(part.parameters.get("color", ""))) for part in parts]


def _forgotten(taught: Taught) -> set[str | None]:
    """The colors of the targets for which HERE was forgotten."""
    world = taught.stage.world
    assert world.teacher is not None
    targets = [(target.color, Point(*target.at)) for target in world.targets]
    items = (world.teacher.script[slip.item] for slip in taught.slips if slip.kind == "forgotten")
    return {meant_by(item, targets) for item in items}


def causes_table(experiment: Experiment, trials: Sequence[Trial]) -> Table:
    """How often what went wrong, row by row; a lesson may fail for several reasons."""
    rows = [row.name for row in experiment.document.rows]
    counts: Mapping[str, Counter[str]] = {
        row: Counter(problem.partition(":")[0] for trial in trials if trial.row == row for problem in trial.problems)
        for row in rows
    }
    told = sum(counts.values(), Counter[str]())
    return Table(
        title="What went wrong",
        head=("cause", *rows),
        rows=tuple((cause, *(str(counts[row][cause]) for row in rows)) for cause, _ in told.most_common()),
    )
