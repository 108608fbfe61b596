"""``python -m benchmarks``: all of them, or those named. ``make bench`` calls it.

One figure is no figure: run it on a quiet machine, and compare within one run only.
"""

import argparse
import os
import platform

os.environ.setdefault("OPENCV_FOR_THREADS_NUM", "1")  # as the command line has it
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # NumPy's: "on one core" is to mean it

from benchmarks import campaigns, control_loop, learning_links, merging, recordings, ros2_control, startup, ticks

BENCHMARKS = {
    "control": control_loop.main,
    "ticks": ticks.main,
    "links": learning_links.main,
    "merging": merging.main,
    "recordings": recordings.main,
    "ros2": ros2_control.main,
    "startup": startup.main,
    "campaigns": campaigns.main,
}


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("names", nargs="*", help=f"of {', '.join(BENCHMARKS)}; all if none is named")
    names = parser.parse_args().names or list(BENCHMARKS)
    if unknown := set(names) - BENCHMARKS.keys():
        parser.error(f"there is no benchmark {', '.join(sorted(unknown))}; there are: {', '.join(BENCHMARKS)}")
    print(f"Python {platform.python_version()} on {platform.machine()}, {os.cpu_count()} cores\n")
    for name in names:
        print(f"== {name}")
        BENCHMARKS[name]()
        print()


if __name__ == "__main__":
    main()
