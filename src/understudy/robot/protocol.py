"""The one seam between Understudy and a robot, simulated or real."""

from typing import Protocol

from understudy.robot.command import Command
from understudy.robot.observation import Observation
from understudy.robot.spec import RobotSpec

__all__ = ["Robot"]


class Robot(Protocol):
    """A robot that senses and acts once in a control period.

    The loop of every controller is ``sense``, decide, ``act``, ``wait``.
    """

    @property
    def spec(self) -> RobotSpec: ...

    def sense(self) -> Observation:
        """The newest readings; cues that arrived since the last call are handed over once."""
        ...

    def act(self, command: Command) -> None:
        """Takes the command for the period that begins; out-of-range speeds are clipped to the spec."""
        ...

    def wait(self) -> None:
        """Lets the rest of the control period pass: a simulation steps, a real robot sleeps."""
        ...

    def stop(self) -> None:
        """Stands still at once. May be called at any time, any number of times."""
        ...
