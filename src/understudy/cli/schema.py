"""``understudy schema``"""

import json
from enum import StrEnum
from typing import Annotated

import typer

__all__ = ["command"]


class Document(StrEnum):
    """The documents that a person may write."""

    WORLD = "world"
    TASK = "task"
    INTERVALS = "intervals"
    EXPERIMENT = "experiment"
    ROBOT = "robot"


def command(document: Annotated[Document, typer.Argument(help="Which document.")]) -> None:
    """Prints a document's JSON Schema."""
    match document:
        case Document.WORLD:
            from understudy.sim import World  # noqa: PLC0415

            schema = World.json_schema()
        case Document.TASK:
            from understudy.network import task_schema  # noqa: PLC0415

            schema = task_schema()
        case Document.INTERVALS:
            from understudy.learning import intervals_schema  # noqa: PLC0415

            schema = intervals_schema()
        case Document.EXPERIMENT:
            from understudy.experiments import experiment_schema  # noqa: PLC0415

            schema = experiment_schema()
        case Document.ROBOT:
            from understudy.ros2 import robot_schema  # noqa: PLC0415

            schema = robot_schema()
    typer.echo(json.dumps(schema, indent=2))
