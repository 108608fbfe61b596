"""The dissertation's experiments as repeated trials, with every seed and failure counted."""

from understudy.experiments.delivery import DeliveryTrial, delivery_tables, delivery_trial, delivery_trials, disturbed
from understudy.experiments.delivery_rooms import CONDITIONS, Condition
from understudy.experiments.generalization import (
    Course,
    generalization_tables,
    generalization_trials,
    ways,
    worked_course,
)
from understudy.experiments.hierarchical import hierarchical_tables, hierarchical_trials, links_with_init, visits
from understudy.experiments.judging import problems_of
from understudy.experiments.planned import planned_tables, planned_trials
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
    "CONDITIONS",
    "EXPERIMENTS",
    "Condition",
    "Course",
    "DeliveryTrial",
    "Experiment",
    "Summary",
    "Trial",
    "delivery_tables",
    "delivery_trial",
    "delivery_trials",
    "disturbed",
    "generalization_tables",
    "generalization_trials",
    "hierarchical_tables",
    "hierarchical_trials",
    "links_with_init",
    "planned_tables",
    "planned_trials",
    "problems_of",
    "run_trials",
    "structure",
    "summarise",
    "taught_network",
    "taught_trials",
    "teaching_trials",
    "visits",
    "ways",
    "worked_course",
]
