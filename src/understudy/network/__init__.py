"""Behavior networks as definitions: components, links, control structures, evidence, the document."""

from understudy.network.bundled import find_task, task_names, task_path
from understudy.network.conditions import (
    Achieved,
    After,
    AllOf,
    AnyOf,
    Complete,
    Condition,
    Happened,
    Holds,
    Not,
    Possible,
    TimedOut,
    atoms,
)
from understudy.network.controls import Repeat, Switch, Timeout, Trigger
from understudy.network.definition import Case, Component, Link, LinkType, Nab, Network, ParameterValue
from understudy.network.difference import differences
from understudy.network.document import Task, load_task, parse_task, save_task, task_data, task_schema, task_text
from understudy.network.editing import edited, relinked
from understudy.network.evidence import Interval, LinkEvidence, Occurrence
from understudy.network.flattening import flattened
from understudy.network.naming import component_ids
from understudy.network.reduction import expand_links, reduce_links
from understudy.network.topology import END, START, Edge, Topology

__all__ = [
    "END",
    "START",
    "Achieved",
    "After",
    "AllOf",
    "AnyOf",
    "Case",
    "Complete",
    "Component",
    "Condition",
    "Edge",
    "Happened",
    "Holds",
    "Interval",
    "Link",
    "LinkEvidence",
    "LinkType",
    "Nab",
    "Network",
    "Not",
    "Occurrence",
    "ParameterValue",
    "Possible",
    "Repeat",
    "Switch",
    "Task",
    "TimedOut",
    "Timeout",
    "Topology",
    "Trigger",
    "atoms",
    "component_ids",
    "differences",
    "edited",
    "expand_links",
    "find_task",
    "flattened",
    "load_task",
    "parse_task",
    "reduce_links",
    "relinked",
    "save_task",
    "task_data",
    "task_names",
    "task_path",
    "task_schema",
    "task_text",
]
