"""A small experiment for the tests of campaigns: a room of nine square metres, seconds of simulated time a trial."""

from pathlib import Path
from typing import Any

import yaml

from tests.tiny import TINY

__all__ = ["SEEDS", "write_tiny"]

SEEDS = range(1, 5)

EXPERIMENT = {
    "understudy": "experiment/1",
    "name": "tiny",
    "world": "room.yaml",
    "limit_s": 30,
    "rows": [
        {"name": "taught", "kind": "teach", "goal": 0.5},
        {"name": "elsewhere", "kind": "run", "room": "changed"},
        {"name": "both", "kind": "teach and run", "dissertation": "9 of 10"},
    ],
}


def write_tiny(folder: Path, **changes: Any) -> Path:
    """The experiment's file, with its world beside it."""
    (folder / "room.yaml").write_text(yaml.safe_dump(TINY), encoding="utf-8")
    path = folder / "tiny.yaml"
    path.write_text(yaml.safe_dump(EXPERIMENT | changes), encoding="utf-8")
    return path
