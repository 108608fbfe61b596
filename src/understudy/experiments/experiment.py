"""An experiment with all that its document names: everything that a trial depends on, beside its seed."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from understudy.errors import ExperimentError
from understudy.experiments.document import ExperimentDocument, Row
from understudy.network import Network, Task
from understudy.sim import World

__all__ = ["Experiment"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Experiment:
    """A document, and the documents that it names.

    Attributes:
        document: the experiment's own.
        worlds: by the names that it uses.
        tasks: the same.
        called: what a user calls it on the command line: its name if it is bundled, else its file.
    """

    document: ExperimentDocument
    worlds: Mapping[str, World]
    tasks: Mapping[str, Task]
    called: str

    @property
    def name(self) -> str:
        return self.document.name

    def row(self, name: str) -> Row:
        """A row by its name.

        Raises:
            ExperimentError: there is none.
        """
        rows = {row.name: row for row in self.document.rows}
        if name not in rows:
            raise ExperimentError(f"there is no row {name!r}; choose one of: {', '.join(rows)}", source=self.name)
        return rows[name]

    def world(self, row: Row) -> World:
        """The world of a row as its document has it."""
        return self.worlds[row.world or self.document.world]

    def place(self, row: Row) -> World:
        """The world of a row with the teacher and the noise that the experiment gives it."""
        return self.furnished(self.world(row), row)

    def furnished(self, world: World, row: Row) -> World:
        """A world with the teacher and the noise that the experiment gives to a row.

        Raises:
            WorldError: they are none that a world can have.
        """
        changes = {
            "teacher": {**self.document.teacher, **row.teacher},
            "noise": {**self.document.noise, **row.noise},
        }
        if not any(changes.values()):
            return world
        data: dict[str, Any] = world.model_dump(mode="json", by_alias=True, exclude_defaults=True)
        for key, changed in changes.items():
            if changed:
                data[key] = {**data.get(key, {}), **changed}
        return World.from_data(data, source=f"the world {world.name!r}, as row {row.name!r} of {self.name} changes it")

    def task(self, row: Row) -> Network | None:
        """The task of a row; None if it is to be learned."""
        name = row.task or self.document.task
        return self.tasks[name].network() if name is not None else None

    def options(self, row: Row) -> dict[str, Any]:
        """What its kind is told."""
        return {**self.document.options, **row.options}

    def as_data(self) -> dict[str, Any]:
        """Everything in plain data."""
        return {
            "document": self.document.model_dump(mode="json", by_alias=True, exclude_defaults=True),
            "worlds": {name: world.model_dump(mode="json", by_alias=True) for name, world in self.worlds.items()},
            "tasks": {name: task.model_dump(mode="json", by_alias=True) for name, task in self.tasks.items()},
        }
