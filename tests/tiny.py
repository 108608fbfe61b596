"""A world so small that a lesson in it takes a moment."""

import yaml

__all__ = ["TINY", "world"]

TINY = {
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


def world(**changes: object) -> str:
    """The text of the world with other values."""
    return yaml.safe_dump(TINY | changes)
