"""The dissertation's experiments as repeated trials, with every seed and failure counted."""

from understudy.experiments.judging import problems_of
from understudy.experiments.trials import EXPERIMENTS, Summary, Trial, run_trials, summarise, taught_network

__all__ = ["EXPERIMENTS", "Summary", "Trial", "problems_of", "run_trials", "summarise", "taught_network"]
