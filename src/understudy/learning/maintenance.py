"""Whether a parameterised goal held while something else was done (§4.3; semantics §4).

The interval of a goal with parameters says when it could be *evaluated*. A robot that carries a box past a target sees
the target all the while, at a hundred different distances. Read from its mere visibility, a permanent ``Track`` link
would forbid the robot to move.
"""

from collections.abc import Mapping

from understudy.learning.observations import Observed
from understudy.network import Interval

__all__ = ["departure"]

ROUNDING = 1e-9
"""A value that strays by its whole tolerance still holds; 0.40 - 0.30 is a little more than 0.10 in binary."""


def departure(observed: Observed, during: Interval, tolerances: Mapping[str, float]) -> str:
    """How the values strayed from the learned ones in the meantime; empty if they held all through.

    Args:
        observed: whose values. Without a history (goals without parameters, annotated intervals) they hold.
        during: half-open, like all observed intervals.
        tolerances: by name of the value; one that is missing must not change at all.
    """
    history = observed.history
    if history is None:
        return ""
    inside = (history.times >= during.start) & (history.times < during.end)
    if not inside.any():
        return "its values were not seen then"
    strayed = []
    for column, name in enumerate(history.names):
        values, learned = history.values[inside, column], observed.values[name]
        if abs(values - learned).max() > tolerances.get(name, 0.0) + ROUNDING:
            strayed.append(f"{name} went from {values.min():.2f} to {values.max():.2f}, learned {learned:.2f}")
    return "; ".join(strayed)
