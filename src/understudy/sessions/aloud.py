"""A robot that is heard: what it says aloud reaches its simulated teacher."""

from collections.abc import Mapping
from typing import Any

from understudy.robot import Command, Journal, NoJournal, Observation
from understudy.sim import Simulation

__all__ = ["Aloud"]


class Aloud:
    """A journal that also lets the room hear the robot's remarks, and keeps them.

    Args:
        simulation: with the teacher.
        journal: is told everything.
    """

    def __init__(self, simulation: Simulation, journal: Journal | None = None) -> None:
        self._simulation = simulation
        self._journal = journal or NoJournal()
        self.remarks: list[tuple[float, str]] = []
        """When, and what the robot said."""

    def observation(self, observation: Observation) -> None:
        self._journal.observation(observation)

    def command(self, time_s: float, command: Command) -> None:
        self._journal.command(time_s, command)

    def event(self, event: Mapping[str, Any]) -> None:
        self._journal.event(event)
        if event["kind"] == "remark":
            self.remarks.append((event["time_s"], event["what"]))
            if self._simulation.teacher is not None:
                self._simulation.teacher.hear(event)
