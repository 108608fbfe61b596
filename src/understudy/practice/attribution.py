"""Which step a teacher means who says BAD or COME: the one that has just been finished, or the current one (§6.1)."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from understudy.execution import History, State
from understudy.network import Component, Network

__all__ = ["REACTION_S", "Attribution", "attributions"]

REACTION_S = 10.0
"""Nobody reacts to a step that has just begun; within this time a word is about the one that was finished (§6.1)."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Attribution:
    """One step that a word may be about.

    Attributes:
        component: its path; END of a COME that is about what comes after everything else.
        how: it was ``finished`` lately; it is ``executing``; it is the one that the robot is ``searching`` for; or the
            teacher ``said`` afterwards that it was meant.
        since_s: since when, seconds on the robot's clock.
    """

    component: str
    how: Literal["finished", "executing", "searching", "said"]
    since_s: float

    def told(self, at_s: float) -> str:
        """``finished 4.2 s ago``."""
        ago = f"{at_s - self.since_s:.1f} s"
        match self.how:
            case "said":
                return "as was said afterwards"
            case "finished":
                return f"finished {ago} ago"
            case _:
                return f"{self.how} for {ago}"


def attributions(
    history: History, network: Network, at_s: float, *, reaction_s: float = REACTION_S
) -> tuple[Attribution, ...]:
    """The steps that a word may be about, the one that it is taken for first.

    First what the robot finished last, by its own doing, if that was within the reaction time; then what it executes;
    then what it searches for, in the order of the document; then what else it finished within that time.

    Args:
        history: of the run until then.
        network: the task as it is now. What was taken out of it is meant no more; and if that was finished last, the
            word is about the current step.
        at_s: when the word was said.
        reaction_s: how long a finished step counts before the current one.
    """
    finished = sorted(_finished(history, at_s, reaction_s), key=lambda one: -one.since_s)
    current = list(_current(history, at_s))
    seen: set[str] = set()
    result = []
    for one in (*finished[:1], *current, *finished[1:]):
        if one.component in network.by_path and one.component not in seen:
            seen.add(one.component)
            result.append(one)
    return tuple(result)


def _steps(history: History) -> list[str]:
    return [path for path, part in history.network.walk() if isinstance(part, Component)]


def _finished(history: History, at_s: float, reaction_s: float) -> Iterator[Attribution]:
    for path in _steps(history):
        event = history.last(path, "achieved", at_s)
        # What came true by itself is nothing that the robot did.
        if event is not None and event.detail.get("on_purpose") and at_s - event.time_s <= reaction_s:
            yield Attribution(component=path, how="finished", since_s=event.time_s)


def _current(history: History, at_s: float) -> Iterator[Attribution]:
    states = {path: history.latest(path, at_s) for path in _steps(history)}
    now = {path: state for path, state in states.items() if state is not None}
    for path, told in now.items():
        if told.state is State.EXECUTING:
            yield Attribution(component=path, how="executing", since_s=told.time_s)
    for path, told in now.items():
        if told.state is State.SEARCHING:
            yield Attribution(component=path, how="searching", since_s=told.time_s)
