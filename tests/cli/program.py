"""The command line in a process of its own."""

import subprocess
import sys
from pathlib import Path

__all__ = ["PROGRAM", "understudy"]

PROGRAM = [sys.executable, "-c", "from understudy.cli import main; main()"]


def understudy(*arguments: object, folder: Path, expect: int = 0) -> subprocess.CompletedProcess[str]:
    """Runs a command in a folder."""
    done = subprocess.run(
        [*PROGRAM, *map(str, arguments)], cwd=folder, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == expect, done.stdout + done.stderr
    assert "Traceback" not in done.stderr
    return done
