"""The figures of §4.5: of each row an example, and what all of its trials have in common."""

import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from understudy.behaviors import installed_skills
from understudy.errors import LearningError
from understudy.experiments.campaign import Campaign
from understudy.experiments.conducting import conduct
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit, Witness
from understudy.figures import draw_progress_average, save
from understudy.figures.sheet import DPI
from understudy.learning import LearningSettings, learn
from understudy.network import Network
from understudy.sessions import Performed, Taught
from understudy.sessions.pictures import picture_demonstration, picture_run, picture_task

__all__ = ["Picture", "pictures_of"]

_COMPARED = 40
"""So many other runs are drawn behind the example; of more one sees no single one."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A picture in a report.

    Attributes:
        row: that it is of.
        name: of its file, without the suffix.
        caption: below it.
        png: its content.
    """

    row: str
    name: str
    caption: str
    png: bytes

    @property
    def width(self) -> int:
        """In the pixels of a page, which are 96 an inch; the picture has more, for sharp screens and for paper."""
        width_px = int.from_bytes(self.png[16:20], "big")  # where every PNG file has it
        return round(width_px * 96 / DPI)


def pictures_of(campaign: Campaign) -> Iterator[Picture]:
    """All pictures, row by row. The example is the first success, made again; if there is none, the first failure."""
    drawn: set[str] = set()
    for row in campaign.rows:
        mine = [trial for trial in campaign.trials if trial.row == row.name]
        if not mine:
            continue
        example = next((trial for trial in mine if trial.success), mine[0])
        seen: list[tuple[Taught | Performed, Network | None]] = []
        unit = Unit(experiment=campaign.experiment, row=row, seed=example.seed)
        conduct(replace(unit, witness=_noting(seen)))
        with tempfile.TemporaryDirectory(prefix="understudy-") as folder:
            drawings = _Drawings(unit, example, mine, Path(folder))
            for number, (what, network) in enumerate(seen, start=1):
                if isinstance(what, Taught):
                    yield from drawings.demonstration(what, network, number, drawn)
                elif network is not None:
                    yield from drawings.run(what, network, number)


def _noting(seen: list[tuple[Taught | Performed, Network | None]]) -> Witness:
    return lambda what, network: seen.append((what, network))


class _Drawings:
    """The pictures of one row."""

    def __init__(self, unit: Unit, example: Trial, trials: Sequence[Trial], folder: Path) -> None:
        self._unit, self._example, self._trials, self._folder = unit, example, trials, folder
        self._outcome = "" if example.success else f", which failed: {'; '.join(example.problems)}"

    def demonstration(self, taught: Taught, network: Network | None, number: int, drawn: set[str]) -> Iterator[Picture]:
        """The room, what was observed, and what was learned, unless another row has shown the same."""
        settings: LearningSettings = self._unit.experiment.document.learning.settings
        try:
            lesson = learn(taught.demonstration, settings)
        except LearningError:
            return
        stem = self._stem(number)
        picture_demonstration(taught, lesson, stem)
        yield self._picture(stem, "room", f"The demonstration with seed {self._example.seed}{self._outcome}")
        yield self._picture(stem, "observations", "When which goal was observed, and what became of it")
        if network is not None and repr(network) not in drawn:
            drawn.add(repr(network))
            task = stem.with_name(f"{stem.name}-task")
            picture_task(taught.demonstration.name, network, installed_skills(), task)
            yield self._picture(stem, "task", "What was learned")

    def run(self, performed: Performed, network: Network, number: int) -> Iterator[Picture]:
        """The room, with other trials in it if it is always the same; the example's progress; and that of all."""
        stem, others = self._stem(number), []
        if self._unit.row.room == "same" and self._example.path:
            others = [np.array(trial.path) for trial in self._trials if trial.path and trial is not self._example]
        picture_run(performed, network, stem, others=others[:_COMPARED])
        yield self._picture(stem, "room", f"The run with seed {self._example.seed}{self._outcome}")
        yield self._picture(stem, "progress", f"Its progress, with seed {self._example.seed}")
        runs = [trial.achieved for trial in self._trials if trial.achieved]
        average = draw_progress_average(network, runs, title=f"{self._unit.row.name}: progress of {len(runs)} runs")
        save(average, stem.with_name(f"{stem.name}-average"))
        yield self._picture(stem, "average", f"When each step was achieved, in all {len(runs)} runs")

    def _stem(self, number: int) -> Path:
        return self._folder / f"{self._unit.stem}-{number}"

    def _picture(self, stem: Path, what: str, caption: str) -> Picture:
        file = stem.with_name(f"{stem.name}-{what}.png")
        return Picture(row=self._unit.row.name, name=file.stem, caption=caption, png=file.read_bytes())
