"""Which experiments there are, and what each has to tell."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType

from understudy.experiments.delivery import delivery_tables, delivery_trials
from understudy.experiments.generalization import generalization_tables, generalization_trials
from understudy.experiments.hierarchical import hierarchical_tables, hierarchical_trials
from understudy.experiments.planned import planned_tables, planned_trials
from understudy.experiments.trials import Trial, taught_trials

__all__ = ["EXPERIMENTS", "Experiment"]


def _nothing(trials: Sequence[Trial]) -> Iterator[str]:
    yield from ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Experiment:
    """One experiment.

    Attributes:
        trials: runs it with these seeds; all trials in one room follow each other.
        tables: what there is to tell of its trials beside their success, as lines of Markdown.
    """

    trials: Callable[[Sequence[int]], Iterator[Trial]]
    tables: Callable[[Sequence[Trial]], Iterator[str]] = _nothing


EXPERIMENTS: Mapping[str, Experiment] = MappingProxyType(
    {
        "visit_targets": Experiment(trials=partial(taught_trials, "visit_targets")),
        "transport": Experiment(trials=partial(taught_trials, "transport")),
        "hierarchical": Experiment(trials=hierarchical_trials, tables=hierarchical_tables),
        "delivery": Experiment(trials=delivery_trials, tables=delivery_tables),
        "generalization": Experiment(trials=generalization_trials, tables=generalization_tables),
        "planned": Experiment(trials=planned_trials, tables=planned_tables),
    }
)
"""By name: §4.5.4.1, §4.5.4.3, §3.5.3, §3.5.2, §5.4.3, and tasks from goals (§3.3.1)."""
