"""What a report can tell beside its rows. A further table is a function, and a line here."""

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType

from understudy.experiments.delivery import delivery_table
from understudy.experiments.experiment import Experiment
from understudy.experiments.generalization import ways_table
from understudy.experiments.hierarchical import links_table, visits_table
from understudy.experiments.lessons import causes_table
from understudy.experiments.orders import orders_table
from understudy.experiments.summary import Table
from understudy.experiments.trial import Trial

__all__ = ["TABLES"]

TABLES: Mapping[str, Callable[[Experiment, Sequence[Trial]], Table]] = MappingProxyType(
    {
        "orders": orders_table,
        "visits": visits_table,
        "links": links_table,
        "conditions": delivery_table,
        "ways": ways_table,
        "causes": causes_table,
    }
)
"""By the names that documents use: each from the experiment and all its trials, of which there is at least one."""
