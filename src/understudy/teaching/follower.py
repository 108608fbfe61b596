"""What a follower tells its teacher: one bit, from its own senses."""

import math

from understudy.perception import Percepts

__all__ = ["with_teacher"]

_NEAR_M = 1.1
"""It follows at 0.6 m, and falls a little behind a teacher that drives."""

_BEFORE = math.radians(80)


def with_teacher(percepts: Percepts) -> bool:
    """Whether the follower has its teacher near and before it."""
    teacher = percepts.teacher
    return teacher is not None and teacher.distance_m <= _NEAR_M and abs(teacher.bearing) <= _BEFORE
