"""How much sooner two workers finish a campaign than one, and whether a worker's memory stays flat."""

import tempfile
import time
from pathlib import Path

import psutil

from understudy.experiments import Campaign, DaskWorkers, Standing, find_experiment

__all__ = ["main"]

TRIALS = 60
LONG = 500
EVERY = 100


def seconds(workers: int) -> tuple[float, float]:
    """For a campaign: all of it, and without the start and the end of the workers."""
    experiment = find_experiment("visit_targets")
    begun = time.perf_counter()
    with (
        tempfile.TemporaryDirectory() as folder,
        Campaign(experiment, [experiment.row("changed")], range(1, TRIALS + 1), Path(folder)) as campaign,
        DaskWorkers(workers) as force,
    ):
        there = time.perf_counter()
        campaign.go_on(force)
        made = time.perf_counter()
    return time.perf_counter() - begun, made - there


def megabytes_of_the_worker() -> float:
    """What is resident of the one worker there is."""
    processes = psutil.Process().children(recursive=True)
    [worker] = [process for process in processes if "spawn_main" in " ".join(process.cmdline())]
    return worker.memory_info().rss / 1e6


def memory() -> None:
    experiment = find_experiment("visit_targets")

    def tell(standing: Standing) -> None:
        if standing.done % EVERY == 0 or standing.done == EVERY // 10:
            print(f"after {standing.done:4d} trials  {megabytes_of_the_worker():6.1f} MB")

    with (
        tempfile.TemporaryDirectory() as folder,
        Campaign(experiment, [experiment.row("same")], range(1, LONG + 1), Path(folder)) as campaign,
        DaskWorkers(1) as force,
    ):
        campaign.go_on(force, tell)


def main() -> None:
    one, two = seconds(1), seconds(2)
    for what, alone, both in zip(("whole campaign", "trials alone"), one, two, strict=True):
        print(f"{what:<16} one worker {alone:6.1f} s   two {both:6.1f} s   {both / alone:.2f}")
    memory()


if __name__ == "__main__":
    main()
