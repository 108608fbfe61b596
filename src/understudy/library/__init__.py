"""The library that forgets nothing: tasks with every revision, and the demonstrations and runs that speak for them."""

from understudy.library.archive import Archive, export_task
from understudy.library.library import Library
from understudy.library.opening import exists
from understudy.library.records import (
    Cause,
    Entry,
    Revision,
    Sitting,
    SittingKind,
    name_and_number,
    network_of,
    shown_in,
)
from understudy.library.regression import Misfit, Regression, Unheld, regression
from understudy.library.replay import Replay, replays
from understudy.library.writing import Writing, check_name

__all__ = [
    "Archive",
    "Cause",
    "Entry",
    "Library",
    "Misfit",
    "Regression",
    "Replay",
    "Revision",
    "Sitting",
    "SittingKind",
    "Unheld",
    "Writing",
    "check_name",
    "exists",
    "export_task",
    "name_and_number",
    "network_of",
    "regression",
    "replays",
    "shown_in",
]
