"""Observations made by hand, in milliseconds."""

import numpy as np
from hypothesis import strategies as st

from understudy.learning import History, Instance, Observed
from understudy.network import Interval, Network

STEP_MS = 25
"""The grid of random endpoints: half the default tolerance, so that ties, near ties and misses are all common."""


def seconds(ms: int) -> float:
    return ms / 1000


def interval(span: tuple[int, int]) -> Interval:
    return Interval(seconds(span[0]), seconds(span[1]))


def seen(start_s: float, end_s: float, behavior: str = "Visit", **changes: object) -> Observed:
    """An observation of a goal without parameters."""
    return Observed(instance=Instance(behavior), interval=Interval(start_s, end_s), **changes)  # type: ignore[arg-type]


def history(start_s: float, values: list[float], *, name: str = "distance_m", period_s: float = 0.1) -> History:
    times = np.array([round(start_s + period_s * tick, 6) for tick in range(len(values))])
    return History(names=(name,), times=times, values=np.array(values)[:, np.newaxis])


def tracked(start_s: float, values: list[float], *, color: str = "green", period_s: float = 0.1) -> Observed:
    """A target at these distances, tick by tick."""
    nearest = int(np.argmin(values))
    return Observed(
        instance=Instance("Track", (("color", color),)),
        interval=Interval(start_s, round(start_s + period_s * len(values), 6)),
        values={"distance_m": values[-1]},
        closest_s=round(start_s + period_s * nearest, 6),
        closest_m=values[nearest],
        history=history(start_s, values, period_s=period_s),
    )


def typed_links(network: Network) -> dict[tuple[str, str], str]:
    return {(link.source, link.target): link.type.value for link in network.links}


@st.composite
def spans(draw: st.DrawFn, max_length: int = 40) -> tuple[int, int]:
    """A random interval in milliseconds, sometimes of no length."""
    start = draw(st.integers(0, 60))
    return start * STEP_MS, (start + draw(st.integers(0, max_length))) * STEP_MS
