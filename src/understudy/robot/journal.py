"""Whoever wants to know what a robot sensed, did and decided: recordings, displays, tests."""

from collections.abc import Mapping
from typing import Any, Protocol

from understudy.robot.command import Command
from understudy.robot.observation import Observation

__all__ = ["Journal", "NoJournal"]


class Journal(Protocol):
    """Is told everything, in the order in which it happens."""

    def observation(self, observation: Observation) -> None: ...

    def command(self, time_s: float, command: Command) -> None: ...

    def event(self, event: Mapping[str, Any]) -> None:
        """One event of our own: plain data with at least ``time_s`` and ``kind``."""
        ...


class NoJournal:
    """Keeps nothing."""

    def observation(self, observation: Observation) -> None:
        """Forgets it."""

    def command(self, time_s: float, command: Command) -> None:
        """Forgets it."""

    def event(self, event: Mapping[str, Any]) -> None:
        """Forgets it."""
