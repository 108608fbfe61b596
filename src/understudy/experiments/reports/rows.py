"""The table of an experiment: a line for each row, with the dissertation's figure and the goal beside ours."""

from collections import Counter
from collections.abc import Sequence

from understudy.experiments.document import Row
from understudy.experiments.experiment import Experiment
from understudy.experiments.kinds import KINDS
from understudy.experiments.summary import Table, summarise
from understudy.experiments.trial import Trial

__all__ = ["missed_goals", "rows_table"]


def rows_table(experiment: Experiment, trials: Sequence[Trial]) -> Table:
    """What the trials of each row come to; rows without trials are left out."""
    rates = all(KINDS[row.kind].is_rate for row in experiment.document.rows)
    return Table(
        title=experiment.document.title or experiment.name,
        head=(
            "row",
            "successes" if rates else "measured",
            "95 % interval" if rates else "95 % interval, or as said",
            "dissertation",
            "goal",
            "mean time",
            "slowest",
            "collisions",
            "grazes",
        ),
        rows=tuple(_told(row, mine) for row, mine in _by_row(experiment, trials)),
    )


def missed_goals(experiment: Experiment, trials: Sequence[Trial]) -> list[str]:
    """The rows that are below their goals, in words."""
    missed = []
    for row, mine in _by_row(experiment, trials):
        measured = KINDS[row.kind].measure(mine)
        if row.goal is not None and measured.value < row.goal:
            missed.append(f"{row.name}: {measured.told}, and the goal is {_goal(row)}")
    return missed


def _by_row(experiment: Experiment, trials: Sequence[Trial]) -> list[tuple[Row, list[Trial]]]:
    found = [(row, [trial for trial in trials if trial.row == row.name]) for row in experiment.document.rows]
    return [(row, mine) for row, mine in found if mine]


def _told(row: Row, trials: Sequence[Trial]) -> tuple[str, ...]:
    measured, found = KINDS[row.kind].measure(trials), summarise(trials)
    return (
        row.name,
        measured.told,
        measured.sure,
        row.dissertation,
        _goal(row),
        found.mean_time,
        found.slowest,
        _counts(found.collisions),
        _counts(found.grazes),
    )


def _goal(row: Row) -> str:
    if row.goal is None:
        return ""
    return f"{row.goal:.0%}" if KINDS[row.kind].is_rate else f"{row.goal:g}"


def _counts(counted: Counter[str]) -> str:
    return ", ".join(f"{count} {what}" for what, count in sorted(counted.items())) or "0"
