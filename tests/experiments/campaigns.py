"""A small experiment for the tests of campaigns: a room of nine square metres, seconds of simulated time a trial."""

from pathlib import Path
from typing import Any

import yaml

__all__ = ["SEEDS", "write_tiny"]

SEEDS = range(1, 5)

WORLD = {
    "understudy": "world/1",
    "name": "tiny",
    "seed": 1,
    "arena": {"size": [3.0, 3.0]},
    "targets": [{"color": "green", "at": [2.4, 1.5]}],
    "robots": [{"name": "learner", "at": [0.5, 0.9], "heading_deg": 0}],
    "teacher": {
        "at": [1.3, 0.9],
        "script": [{"say": "START"}, {"walk": [2.4, 0.9]}, {"walk": [2.6, 0.8]}, {"wait": 1.0}, {"say": "DONE"}],
    },
}

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
    (folder / "room.yaml").write_text(yaml.safe_dump(WORLD), encoding="utf-8")
    path = folder / "tiny.yaml"
    path.write_text(yaml.safe_dump(EXPERIMENT | changes), encoding="utf-8")
    return path
