"""How long it takes to learn the links of a task, by the shape and the number of its intervals.

"Sweep" is finding the pairs, with relation; "network" is all of
``construct``: ids, components, the sweep, a link object with its evidence for each pair, and the network's own checks.
"All pairs" is what comparing every interval with every later one, as §4.4.1 says, would have stored.
"""

import random
import statistics
import time
from collections.abc import Callable

from understudy.learning import HALF_A_TICK_S, Instance, Observed, construct
from understudy.learning.instants import micros, micros_array
from understudy.learning.pairs import linked_pairs
from understudy.network import Interval

__all__ = ["run"]

SIZES = (100, 1_000, 10_000)
REPEATS = 3

# By shape, the mean length of an interval in seconds; one begins every second, give or take.
SHAPES = {"disjoint": 0.0, "realistic": 3.0, "50 deep": 50.0}


def run() -> list[dict[str, str | int | float]]:
    """One row for each shape and size; times are medians, in seconds."""
    return [measure(shape, size) for shape in SHAPES for size in SIZES]


def measure(shape: str, size: int) -> dict[str, str | int | float]:
    observations = made_up(size, SHAPES[shape])
    starts = micros_array(observed.interval.start for observed in observations)
    ends = micros_array(observed.interval.end for observed in observations)
    slack = micros(HALF_A_TICK_S)
    return {
        "shape": shape,
        "intervals": size,
        "all_pairs": sum(int((starts - start > slack).sum()) for start in starts),
        "links": len(construct(observations, demonstration="benchmark").links),
        "sweep_s": median_time(lambda: linked_pairs(starts, ends, starts, slack)),
        "network_s": median_time(lambda: construct(observations, demonstration="benchmark")),
    }


def made_up(size: int, length_s: float, seed: int = 0) -> list[Observed]:
    """Observations of twenty kinds, in order of onset."""
    chance = random.Random(seed)
    observations = []
    for second in range(size):
        start = second + chance.uniform(0.0, 0.4)
        end = start + (chance.uniform(0.5, 1.5) * length_s or 0.5)
        instance = Instance("Visit", (("color", str(second % 20)),))
        observations.append(Observed(instance=instance, interval=Interval(start, end)))
    return observations


def median_time(work: Callable[[], object]) -> float:
    times = []
    for _ in range(REPEATS):
        begun = time.perf_counter()
        work()
        times.append(time.perf_counter() - begun)
    return statistics.median(times)


def main() -> None:
    print(f"{'shape':<10} {'intervals':>9} {'all pairs':>11} {'links':>8} {'sweep':>11} {'network':>11}")
    for row in run():
        print(
            f"{row['shape']:<10} {row['intervals']:>9,} {row['all_pairs']:>11,} {row['links']:>8,} "
            f"{1000 * float(row['sweep_s']):>8.1f} ms {1000 * float(row['network_s']):>8.1f} ms"
        )


if __name__ == "__main__":
    main()
