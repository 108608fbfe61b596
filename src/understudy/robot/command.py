"""What a robot is told to do for the next control period."""

from dataclasses import dataclass
from typing import Literal

__all__ = ["STOP", "Command"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Command:
    """Speeds for the wheels and, where it should change, a posture for the gripper.

    Attributes:
        linear: forward speed, m/s.
        angular: turning speed, rad/s, left positive.
        paddles: open or close them; None leaves them as they are.
        lift: raise or lower the gripper; None leaves it as it is.
    """

    linear: float = 0.0
    angular: float = 0.0
    paddles: Literal["open", "close"] | None = None
    lift: Literal["up", "down"] | None = None


STOP = Command()
"""Stand still; the gripper keeps what it holds."""
