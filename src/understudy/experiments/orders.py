"""In which orders the steps of a task were achieved, and how often each."""

from collections import Counter
from collections.abc import Sequence

from understudy.experiments.experiment import Experiment
from understudy.experiments.summary import Table
from understudy.experiments.trial import Trial

__all__ = ["orders_table"]


def orders_table(experiment: Experiment, trials: Sequence[Trial]) -> Table:
    """The orders of all runs, the most frequent first; demonstrations have none."""
    runs = [trial for trial in trials if trial.achieved]
    orders = Counter((trial.row, ", ".join(_steps(trial))) for trial in runs)
    rows = [row.name for row in experiment.document.rows]
    told = sorted(orders.items(), key=lambda item: (rows.index(item[0][0]), -item[1]))
    return Table(
        title="Order of the steps",
        head=("row", "order", "trials"),
        rows=tuple((row, order, str(count)) for (row, order), count in told),
    )


def _steps(trial: Trial) -> list[str]:
    """Without the networks themselves, each of which is achieved with its last step."""
    inner = {path.rpartition("/")[0] for path in trial.order}
    return [path for path in trial.order if path not in inner]
