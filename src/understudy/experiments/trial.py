"""One trial: what came out of a row of an experiment with one seed."""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Self

__all__ = ["Trial"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """What came out: plain data, and nothing in it but what follows from experiment, row and seed.

    Attributes:
        experiment, row, seed: which it is.
        ending: ``complete``, ``time limit`` or ``timeout`` of a run; ``taught`` or ``unfinished`` of a demonstration;
            ``error`` if it could not be made.
        time_s: simulated time until it was done, or given up.
        problems: what was wrong, in words; empty for a success.
        collisions: hard contacts, by what was hit.
        grazes: short and soft ones.
        achieved: the paths of components with the moments at which they were achieved, in that order.
        path: where the robot truly was, twice a second: seconds, metres, metres.
        learned: the task document of what was learned in it.
        details: whatever else its kind tells.
    """

    experiment: str
    row: str
    seed: int
    ending: str
    time_s: float = 0.0
    problems: tuple[str, ...] = ()
    collisions: Mapping[str, int] = field(default_factory=dict)
    grazes: Mapping[str, int] = field(default_factory=dict)
    achieved: tuple[tuple[str, float], ...] = ()
    path: tuple[tuple[float, float, float], ...] = ()
    learned: str = ""
    details: Mapping[str, Any] = field(default_factory=dict)

    @property
    def success(self) -> bool:
        return not self.problems

    @property
    def order(self) -> tuple[str, ...]:
        """What was achieved, in that order."""
        return tuple(path for path, _ in self.achieved)

    def __str__(self) -> str:
        """Which it is, for a reader."""
        told = ", ".join(f"{key.replace('_', ' ')}: {value}" for key, value in self.details.items() if value != "")
        return f"{self.experiment}, {self.row}, seed {self.seed}" + (f" ({told})" if told else "")

    def as_record(self) -> dict[str, Any]:
        """As plain data, for JSON."""
        record = {item.name: getattr(self, item.name) for item in fields(self)}
        return {key: dict(value) if isinstance(value, Mapping) else value for key, value in record.items()}

    @classmethod
    def from_record(cls, record: Mapping[str, Any]) -> Self:
        """The trial of a record that was JSON in between."""
        whole = dict(record)
        whole["problems"] = tuple(whole["problems"])
        for key in ("achieved", "path"):
            whole[key] = tuple(map(tuple, whole[key]))
        return cls(**whole)
