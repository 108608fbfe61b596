"""``python -m understudy.experiments``: the tables of trials, as Markdown. ``make trials`` calls it."""

import argparse
import os
from itertools import groupby

os.environ.setdefault("OPENCV_FOR_THREADS_NUM", "1")  # as the command line has it; read when OpenCV is loaded

from understudy.errors import MissingExtraError
from understudy.experiments.registry import EXPERIMENTS
from understudy.experiments.trials import Trial, summarise

__all__ = ["main"]


def main() -> None:
    """Runs the trials and prints them."""
    parser = argparse.ArgumentParser(prog="python -m understudy.experiments", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(EXPERIMENTS)}; all if none is named")
    parser.add_argument("--trials", type=int, default=5, help="executions a room, or condition (default 5)")
    parser.add_argument("--seed", type=int, default=1, help="of the first trial; the next ones count up")
    arguments = parser.parse_args()
    names = arguments.names or list(EXPERIMENTS)
    if unknown := [name for name in names if name not in EXPERIMENTS]:
        parser.error(f"there is no experiment {unknown[0]!r}; there are: {', '.join(EXPERIMENTS)}")
    if arguments.trials < 1 or arguments.seed < 0:
        parser.error("there is at least one trial, and a seed is not negative")
    seeds = range(arguments.seed, arguments.seed + arguments.trials)
    print("| experiment | room | successes | 95 % interval | mean time | slowest | collisions | grazes |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    all_trials: list[Trial] = []
    told: list[str] = []
    for name in names:
        trials: list[Trial] = []
        try:
            for room, grouped in groupby(EXPERIMENTS[name].trials(seeds), key=lambda trial: trial.room):
                in_room = list(grouped)
                trials += in_room
                found = summarise(in_room)
                print(
                    f"| {name} | {room} | {found.successes} of {found.trials} | {found.low:.0%} to {found.high:.0%} "
                    f"| {found.mean_time_s:.0f} s | {found.slowest_s:.0f} s | {found.collisions} | {found.grazes} |",
                    flush=True,
                )
        except MissingExtraError as error:
            told += ["", f"{name} was left out: {error}"]
            continue
        all_trials += trials
        if lines := list(EXPERIMENTS[name].tables(trials)):
            told += ["", f"{name}:", "", *lines]
    print(*told, sep="\n")
    failures = [trial for trial in all_trials if trial.problems]
    print("\nFailures: " + ("none" if not failures else ""))
    for t in failures:
        print(f"- {t.named}: {'; '.join(t.problems)}")


if __name__ == "__main__":
    main()
