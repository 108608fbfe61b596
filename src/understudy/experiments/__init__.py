"""The dissertation's experiments as repeated trials, with every seed and failure counted."""

from understudy.experiments.hierarchical import hierarchical_tables, hierarchical_trials, links_with_init, visits
from understudy.experiments.judging import problems_of
from understudy.experiments.registry import EXPERIMENTS, Experiment
from understudy.experiments.trials import (
    Summary,
    Trial,
    run_trials,
    structure,
    summarise,
    taught_network,
    taught_trials,
    teaching_trials,
)

__all__ = [
    "EXPERIMENTS",
    "Experiment",
    "Summary",
    "Trial",
    "hierarchical_tables",
    "hierarchical_trials",
    "links_with_init",
    "problems_of",
    "run_trials",
    "structure",
    "summarise",
    "taught_network",
    "taught_trials",
    "teaching_trials",
    "visits",
]
