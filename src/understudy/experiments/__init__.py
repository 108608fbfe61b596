"""Experiments as documents, the dissertation's among them; their trials, with every seed and failure counted."""

from understudy.experiments.campaign import Campaign, Standing
from understudy.experiments.chain_trials import ChainOptions, chain_trial, measured_limit
from understudy.experiments.chains import Chain, Transmission, chain_of, steps_in_order
from understudy.experiments.conducting import Made, conduct, make
from understudy.experiments.delivery_rooms import CONDITIONS, Condition
from understudy.experiments.document import ExperimentDocument, Learning, Limits, Options, Row, experiment_schema
from understudy.experiments.experiment import Experiment
from understudy.experiments.fingerprint import fingerprint
from understudy.experiments.generalization import Course, course, ways
from understudy.experiments.hierarchical import links_with_init, visits
from understudy.experiments.judging import collisions_of, problems_of
from understudy.experiments.kinds import KINDS, Kind
from understudy.experiments.loading import experiment_names, find_experiment, load_experiment
from understudy.experiments.summary import Measured, Summary, Table, success_rate, summarise
from understudy.experiments.tables import TABLES
from understudy.experiments.teaching import executed, reference, structure
from understudy.experiments.transfer import TransferLimit, transfer_limit
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit, Witness
from understudy.experiments.workforce import Alone, DaskWorkers, Workforce

__all__ = [
    "CONDITIONS",
    "KINDS",
    "TABLES",
    "Alone",
    "Campaign",
    "Chain",
    "ChainOptions",
    "Condition",
    "Course",
    "DaskWorkers",
    "Experiment",
    "ExperimentDocument",
    "Kind",
    "Learning",
    "Limits",
    "Made",
    "Measured",
    "Options",
    "Row",
    "Standing",
    "Summary",
    "Table",
    "TransferLimit",
    "Transmission",
    "Trial",
    "Unit",
    "Witness",
    "Workforce",
    "chain_of",
    "chain_trial",
    "collisions_of",
    "conduct",
    "course",
    "executed",
    "experiment_names",
    "experiment_schema",
    "find_experiment",
    "fingerprint",
    "links_with_init",
    "load_experiment",
    "make",
    "measured_limit",
    "problems_of",
    "reference",
    "steps_in_order",
    "structure",
    "success_rate",
    "summarise",
    "transfer_limit",
    "visits",
    "ways",
]
