"""A unit of work: one trial that is to be made. What comes out of it follows from experiment, row and seed alone."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from understudy.experiments.document import Row
from understudy.experiments.experiment import Experiment
from understudy.experiments.trial import Trial
from understudy.network import Network
from understudy.sessions import Performed, Stage, Taught, file_stem
from understudy.sim import World, rearranged

__all__ = ["Unit", "Witness"]

Witness = Callable[[Taught | Performed, Network | None], None]
"""Is shown what was taught or performed, and the task that was learned or executed, if there is one."""

_EVERY = 5
"""Of the robot's path every fifth place is kept, two a second."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Unit:
    """One trial to be made.

    Attributes:
        experiment: with all that it names.
        row: which of its rows.
        seed: of the trial.
        folder: where to leave recordings; None records nothing.
        witness: is shown each demonstration, and each run with its task; for pictures.
    """

    experiment: Experiment
    row: Row
    seed: int
    folder: Path | None = None
    witness: Witness | None = None

    @property
    def place(self) -> World:
        """The row's world, with the teacher and the noise that the experiment gives it."""
        return self.experiment.place(self.row)

    @property
    def room(self) -> World:
        """The room of this trial: that place, or the same with everything elsewhere.

        Raises:
            WorldError: no such room was found within the limits.
        """
        if self.row.room == "same":
            return self.place
        return rearranged(self.place, self.seed, **self.row.limits.model_dump(exclude_none=True))

    @property
    def options(self) -> dict[str, Any]:
        """What the kind is told."""
        return self.experiment.options(self.row)

    @property
    def limit_s(self) -> float:
        """Simulated seconds allowed to a run."""
        return self.experiment.document.limit_s

    @property
    def stem(self) -> str:
        """Of files of this trial."""
        return f"{file_stem(self.row.name)}-seed-{self.seed}"

    def recording(self, what: str) -> Path | None:
        """The file for a recording, if any is wanted.

        Args:
            what: it is of, ``run`` or ``demonstration``.
        """
        return self.folder / f"{self.stem}-{what}.mcap" if self.folder is not None else None

    def trial(self, *, ending: str, stage: Stage | None = None, **found: Any) -> Trial:
        """The trial that came out.

        Args:
            ending: how it ended.
            stage: where it took place; contacts and path are read from it.
            found: the other attributes of the trial.
        """
        if stage is not None:
            verdict = stage.verdict()
            path = stage.robot_path[::_EVERY, :3].round(2).tolist()
            seen = {"collisions": dict(verdict.collisions), "grazes": dict(verdict.grazes)}
            found = {**seen, "path": tuple(map(tuple, path)), **found}
        return Trial(experiment=self.experiment.name, row=self.row.name, seed=self.seed, ending=ending, **found)

    def trial_of(self, performed: Performed, network: Network, problems: list[str], **found: Any) -> Trial:
        """The trial of a run.

        Args:
            performed: the run.
            network: its task.
            problems: what was wrong with it.
            found: the other attributes of the trial.
        """
        if self.witness is not None:
            self.witness(performed, network)
        report = performed.report
        return self.trial(
            ending=report.ending,
            stage=performed.stage,
            time_s=round(report.duration_s, 3),
            problems=tuple(problems),
            achieved=report.achieved,
            **found,
        )
