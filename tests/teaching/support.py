"""A quiet room with a few targets, for one robot or two."""

from typing import Any

from understudy.sim import World

__all__ = ["QUIET", "room"]

QUIET = {
    "laser": 0.0,
    "sonar": 0.0,
    "image": 0.0,
    "illumination": 0.0,
    "odometry_scale": 0.0,
    "odometry_heading": 0.0,
    "false_blobs": 0.0,
    "beam_misreads": 0.0,
}


def room(*robots: dict[str, Any], **more: Any) -> World:
    """A room of 5 by 4 m, with a robot at (1, 2) that looks along x, and others."""
    first = {"name": "learner", "at": [1.0, 2.0], "heading_deg": 0}
    return World.from_data(
        {
            "understudy": "world/1",
            "name": "quiet",
            "arena": {"size": [5.0, 4.0]},
            "robots": [first, *robots],
            "noise": QUIET,
            **more,
        }
    )
