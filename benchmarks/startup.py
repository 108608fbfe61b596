"""How soon the command line answers."""

import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

__all__ = ["main"]

ROUNDS = 9


def seconds(*command: str) -> float:
    rounds = []
    for _ in range(ROUNDS):
        begun = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)
        rounds.append(time.perf_counter() - begun)
    return statistics.median(rounds)


def main() -> None:
    program = shutil.which("understudy", path=str(Path(sys.executable).parent)) or "understudy"
    print(f"understudy --help   {seconds(program, '--help'):.3f} s")
    print(f"python -c pass      {seconds(sys.executable, '-c', 'pass'):.3f} s")


if __name__ == "__main__":
    main()
