"""How much longer a campaign will take."""

from collections.abc import Mapping, Sequence
from statistics import fmean

__all__ = ["seconds_left"]


def seconds_left(took_s: Mapping[str, Sequence[float]], left: Mapping[str, int], workers: int) -> float | None:
    """The time until all is done, seconds; None while nothing is known.

    Trials of one row take about as long as each other, and those of different rows do not; a row of which none is known
    counts as all others together.

    Args:
        took_s: what the trials took, by row.
        left: how many are to be made, by row.
        workers: as many are made at a time.
    """
    every = [seconds for row in took_s.values() for seconds in row]
    if not every:
        return None
    work_s = sum(count * fmean(took_s.get(row) or every) for row, count in left.items())
    return work_s / max(1, min(workers, sum(left.values())))
