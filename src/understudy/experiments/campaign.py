"""A campaign: all trials of some rows of an experiment, made once each, kept as they come, gone on with at any time."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self

from understudy.errors import CampaignError
from understudy.experiments.conducting import Made
from understudy.experiments.document import Row
from understudy.experiments.estimating import seconds_left
from understudy.experiments.experiment import Experiment
from understudy.experiments.store import Store
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit
from understudy.experiments.workforce import Workforce

__all__ = ["Campaign", "Standing"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Standing:
    """How far a campaign has come.

    Attributes:
        done: trials that are made.
        total: all that are asked for.
        failed: of those that are made.
        left_s: the time that it will still take, if anything is known of that.
    """

    done: int
    total: int
    failed: int
    left_s: float | None


class Campaign:
    """The trials of some rows with some seeds.

    In the folder there are the trials, ``trials.db``, and the recordings of those that failed. Rows and seeds may be
    others the next time: what is there is not made again.

    Args:
        experiment: with all that it names.
        rows: which of its rows.
        seeds: one a trial in each row.
        folder: is made if it is not there; one campaign at a time.

    Raises:
        CampaignError: the folder cannot be used, or holds the trials of another experiment.
    """

    def __init__(self, experiment: Experiment, rows: Sequence[Row], seeds: Sequence[int], folder: Path) -> None:
        self.experiment, self.rows, self.seeds, self.folder = experiment, tuple(rows), tuple(seeds), folder
        self.recordings = folder / "recordings"
        self.notes: list[str] = []
        """What went wrong beside the trials."""
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise CampaignError(f"{folder} cannot be made ({error.strerror}); name another --workspace") from None
        self._store = Store(folder / "trials.db", experiment)
        self._known, self._took_s = self._store.trials(), self._store.took_s()
        # Seed by seed, so that a campaign that is stopped has something of every row.
        self._units = [Unit(experiment=experiment, row=row, seed=seed) for seed in self.seeds for row in self.rows]

    @property
    def trials(self) -> list[Trial]:
        """Those that are made, row by row."""
        wanted = [(row.name, seed) for row in self.rows for seed in self.seeds]
        return [self._known[key] for key in wanted if key in self._known]

    @property
    def left(self) -> list[Unit]:
        """What is to be made."""
        return [unit for unit in self._units if (unit.row.name, unit.seed) not in self._known]

    def recordings_of(self, trial: Trial) -> tuple[str, ...]:
        """Files of a failed trial, as they are seen from the folder."""
        unit = Unit(experiment=self.experiment, row=self.experiment.row(trial.row), seed=trial.seed)
        files = sorted(self.recordings.glob(f"{unit.stem}-*.mcap"))
        return tuple(file.relative_to(self.folder).as_posix() for file in files)

    def standing(self, workers: int = 1) -> Standing:
        """How far it has come, and how long so many workers will still take."""
        made, left = self.trials, Counter(unit.row.name for unit in self.left)
        return Standing(
            done=len(made),
            total=len(self._units),
            failed=sum(not trial.success for trial in made),
            left_s=seconds_left(self._took_s, left, workers),
        )

    def go_on(self, workforce: Workforce, watch: Callable[[Standing], None] = lambda standing: None) -> None:
        """Makes all that is left.

        Args:
            workforce: who makes the trials.
            watch: is told after each of them.

        Raises:
            CampaignError: trials could not be made or kept. What was made until then is kept.
            MissingExtraError: an optional package is not installed.
        """
        for made in workforce.made(self.left):
            self._keep(made)
            self._store.add(made.trial, made.took_s)
            self._known[made.trial.row, made.trial.seed] = made.trial
            self._took_s.setdefault(made.trial.row, []).append(made.took_s)
            watch(self.standing(workforce.size))

    def _keep(self, made: Made) -> None:
        """Keeps the recordings of a trial; before the trial itself, so that none is without its recordings."""
        if made.note:
            self.notes.append(made.note)
        for name, content in made.recordings:
            file = self.recordings / name
            try:
                self.recordings.mkdir(exist_ok=True)
                file.write_bytes(content)
            except OSError as error:
                raise CampaignError(
                    f"{file} cannot be written: {error.strerror}; what was stored until now is kept: make room, and"
                    " give the same command again to go on"
                ) from None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Gives the folder free."""
        self._store.close()
