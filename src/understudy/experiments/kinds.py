"""The kinds of trials. A further one is a function from a unit of work to a trial, and a line here.

Such a function gives the same trial for the same unit, in any process: all chance comes from the unit's seed.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from understudy.experiments.chain_trials import ChainOptions, chain_trial, measured_limit
from understudy.experiments.delivery import DeliveryOptions, delivery_trial
from understudy.experiments.document import Options
from understudy.experiments.generalization import GeneralizationOptions, course_trial, generalised_trial
from understudy.experiments.lessons import lesson_trial
from understudy.experiments.planned import PlanningOptions, planned_trial
from understudy.experiments.summary import Measured, success_rate
from understudy.experiments.teaching import run_trial, teach_and_run_trial, teach_trial
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit

__all__ = ["KINDS", "Kind"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Kind:
    """How trials are made, and measured.

    Attributes:
        trial: makes one. An :class:`~understudy.errors.UnderstudyError` that it raises makes a failed trial.
        options: what it takes beside the row.
        measure: of at least one trial; the rate of successes, or another figure.
    """

    trial: Callable[[Unit], Trial]
    options: type[Options] = Options
    measure: Callable[[Sequence[Trial]], Measured] = success_rate

    @property
    def is_rate(self) -> bool:
        """Whether it is told as a share of the trials, as a rate of successes is."""
        return self.measure is success_rate


KINDS: Mapping[str, Kind] = MappingProxyType(
    {
        "teach": Kind(trial=teach_trial),
        "run": Kind(trial=run_trial),
        "teach and run": Kind(trial=teach_and_run_trial),
        "lesson": Kind(trial=lesson_trial),
        "deliver": Kind(trial=delivery_trial, options=DeliveryOptions),
        "teach in turn": Kind(trial=course_trial, options=GeneralizationOptions),
        "run generalised": Kind(trial=generalised_trial, options=GeneralizationOptions),
        "run planned": Kind(trial=planned_trial, options=PlanningOptions),
        "pass on": Kind(trial=chain_trial, options=ChainOptions, measure=measured_limit),
    }
)
"""By the names that documents use."""
