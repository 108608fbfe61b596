"""Behavior networks as definitions: components, links, evidence, the document."""

from understudy.network.definition import Component, Link, LinkType, Network, ParameterValue
from understudy.network.document import Task, load_task, parse_task, save_task, task_schema, task_text
from understudy.network.evidence import Interval, LinkEvidence, Occurrence

__all__ = [
    "Component",
    "Interval",
    "Link",
    "LinkEvidence",
    "LinkType",
    "Network",
    "Occurrence",
    "ParameterValue",
    "Task",
    "load_task",
    "parse_task",
    "save_task",
    "task_schema",
    "task_text",
]
