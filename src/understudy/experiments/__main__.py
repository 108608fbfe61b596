"""``python -m understudy.experiments``: the table of trials, as Markdown. ``make trials`` calls it."""

import argparse
import os

os.environ.setdefault("OPENCV_FOR_THREADS_NUM", "1")  # as the command line has it; read when OpenCV is loaded

from understudy.experiments.trials import (
    EXPERIMENTS,
    run_trials,
    summarise,
    taught_network,
    teaching_trials,
)

__all__ = ["main"]


def main() -> None:
    """Runs the trials and prints them."""
    parser = argparse.ArgumentParser(prog="python -m understudy.experiments", description=__doc__)
    parser.add_argument("names", nargs="*", default=list(EXPERIMENTS), help="of experiments; all if none is named")
    parser.add_argument("--trials", type=int, default=5, help="executions a room (default 5)")
    parser.add_argument("--seed", type=int, default=1, help="of the first trial; the next ones count up")
    arguments = parser.parse_args()
    print("| experiment | room | successes | 95 % interval | mean time | slowest | collisions | grazes |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    failures: list[str] = []
    seeds = range(arguments.seed, arguments.seed + arguments.trials)
    for name in arguments.names:
        world, network = taught_network(name)
        for room in ("taught", "same", "changed"):
            trials = list(
                teaching_trials(name, seeds) if room == "taught" else run_trials(name, world, network, room, seeds)
            )
            found = summarise(trials)
            print(
                f"| {name} | {room} | {found.successes} of {found.trials} | {found.low:.0%} to {found.high:.0%} "
                f"| {found.mean_time_s:.0f} s | {found.slowest_s:.0f} s | {found.collisions} | {found.grazes} |",
                flush=True,
            )
            failures += [
                f"{t.experiment}, {t.room} room, seed {t.seed}: {'; '.join(t.problems)}" for t in trials if t.problems
            ]
    print("\nFailures: " + ("none" if not failures else ""))
    for failure in failures:
        print(f"- {failure}")


if __name__ == "__main__":
    main()
