"""What many trials come to: counts, how sure one can be of a rate, and tables of whatever else they tell."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from scipy.stats import binomtest

from understudy.experiments.trial import Trial

__all__ = ["Measured", "Summary", "Table", "success_rate", "summarise"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Measured:
    """What a row measures.

    Attributes:
        value: to be compared with the goal.
        told: ``98 of 100``.
        sure: how sure one can be of it: ``93% to 100%``; if not with 95 %, it says with what.
    """

    value: float
    told: str
    sure: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """Something to be told in rows and columns.

    Attributes:
        title: above it.
        head: of the columns.
        rows: as many texts in each.
    """

    title: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def markdown(self) -> list[str]:
        """Its lines, without the title."""
        return [
            f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in row)} |"
            for row in (self.head, ("---",) * len(self.head), *self.rows)
        ]


@dataclass(frozen=True, slots=True, kw_only=True)
class Summary:
    """Several trials of one kind; ``low`` and ``high`` bound the rate of success with 95 % confidence, exactly.

    Times are those of all trials, the failed ones among them; contacts are counted by what was touched.
    """

    trials: int
    successes: int
    low: float
    high: float
    mean_time_s: float
    slowest_s: float
    collisions: Counter[str]
    grazes: Counter[str]

    @property
    def rate(self) -> str:
        return f"{self.successes} of {self.trials}"

    @property
    def mean_time(self) -> str:
        return f"{self.mean_time_s:.0f} s"

    @property
    def slowest(self) -> str:
        return f"{self.slowest_s:.0f} s"


def summarise(trials: Sequence[Trial]) -> Summary:
    """Counts, and how sure one can be of the rate (Clopper-Pearson)."""
    successes = sum(trial.success for trial in trials)
    interval = binomtest(successes, len(trials)).proportion_ci(confidence_level=0.95, method="exact")
    return Summary(
        trials=len(trials),
        successes=successes,
        low=float(interval.low),
        high=float(interval.high),
        mean_time_s=sum(trial.time_s for trial in trials) / len(trials),
        slowest_s=max(trial.time_s for trial in trials),
        collisions=sum((Counter(trial.collisions) for trial in trials), Counter()),
        grazes=sum((Counter(trial.grazes) for trial in trials), Counter()),
    )


def success_rate(trials: Sequence[Trial]) -> Measured:
    """The rate of successes: what most kinds measure."""
    found = summarise(trials)
    return Measured(value=found.successes / found.trials, told=found.rate, sure=f"{found.low:.0%} to {found.high:.0%}")
