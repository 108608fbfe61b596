"""The dissertation's experiments as repeated trials, with every seed and failure counted."""

from understudy.experiments.judging import problems_of
from understudy.experiments.trials import (
    EXPERIMENTS,
    Summary,
    Trial,
    run_trials,
    structure,
    summarise,
    taught_network,
    teaching_trials,
)

__all__ = [
    "EXPERIMENTS",
    "Summary",
    "Trial",
    "problems_of",
    "run_trials",
    "structure",
    "summarise",
    "taught_network",
    "teaching_trials",
]
