"""What a trace tells of every component, moment by moment: of a run that goes on, or from its recording."""

from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from understudy.errors import UnderstudyError
from understudy.execution.trace import Event, State
from understudy.network import START, Component, Nab, Network

__all__ = ["History", "StateChange"]

_SLACK_S = 1e-6
"""Ticks are a tenth of a second apart; what is nearer is the same moment."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StateChange:
    """A component's state as the trace told it.

    Attributes:
        time_s: when it came to be so.
        state: what the component does.
        why: ``reason``, ``for``, ``by`` and ``also``, as in the event.
    """

    time_s: float
    state: State
    why: dict[str, Any]

    @property
    def deciding(self) -> tuple[State, str, str]:
        """The state with the first condition that decides it; what else is missing is left out."""
        return self.state, str(self.why.get("reason", "")), str(self.why.get("for", self.why.get("by", "")))


class History:
    """The events of one run, by component and time.

    Args:
        network: the task.
        events: told so far; more can be :meth:`added <add>` as they come.
    """

    def __init__(self, network: Network, events: Iterable[Event] = ()) -> None:
        self.network = network
        self.events: list[Event] = []
        self._states: dict[str, list[StateChange]] = {path: [] for path in network.by_path}
        self._others: dict[str, list[int]] = {path: [] for path in network.by_path}
        for event in events:
            self.add(event)

    def add(self, event: Event) -> None:
        """The next event of the trace."""
        self.events.append(event)
        if event.component not in self._states:
            return  # about the whole run
        if event.kind == "state":
            state = State(event.detail["state"])
            why = {key: value for key, value in event.detail.items() if key != "state"}
            self._states[event.component].append(StateChange(time_s=event.time_s, state=state, why=why))
        else:
            self._others[event.component].append(len(self.events) - 1)

    @property
    def end_s(self) -> float:
        """When the latest event was told.

        Raises:
            UnderstudyError: none was.
        """
        if not self.events:
            raise UnderstudyError("its trace is empty: nothing was executed")
        return self.events[-1].time_s

    def component(self, path: str) -> Component | Nab:
        """The component with a path.

        Raises:
            UnderstudyError: there is none.
        """
        if path not in self.network.by_path:
            known = ", ".join(self.network.by_path)
            raise UnderstudyError(f"no component of this task is called {path!r}; there are: {known}")
        return self.network.by_path[path]

    def states(self, path: str, at_s: float) -> list[StateChange]:
        """The states of a component up to a moment, the latest last.

        Raises:
            UnderstudyError: no component has this path, or nothing had been told of it by then.
        """
        self.component(path)
        states = self._states[path]
        found = states[: bisect_right(states, at_s + _SLACK_S, key=lambda told: told.time_s)]
        if not found:
            begun = f"the run begins at {self.events[0].time_s:g} s" if self.events else "its trace is empty"
            raise UnderstudyError(f"nothing is known of {path!r} at {at_s:g} s: {begun}")
        return found

    def latest(self, path: str, at_s: float) -> StateChange | None:
        """The state of a component at a moment; None if nothing had been told of it by then."""
        states = self._states[path]
        index = bisect_right(states, at_s + _SLACK_S, key=lambda told: told.time_s)
        return states[index - 1] if index else None

    def suspended(self, at_s: float) -> bool:
        """Whether the run was suspended at a moment: a teacher was showing something (§6.2)."""
        kinds = [event.kind for event in self.events if event.time_s <= at_s + _SLACK_S]
        return next((kind == "suspended" for kind in reversed(kinds) if kind in ("suspended", "resumed")), False)

    def last(self, path: str, kind: str, at_s: float) -> Event | None:
        """The latest event of one kind about a component, up to a moment; None if there is none."""
        return next((self.events[index] for index in self._of(path, kind, at_s)), None)

    def holds(self, path: str, at_s: float) -> bool:
        """Whether a component's goal held after the tick at a moment; that of a NAB ends where it is begun anew."""
        index = next(self._of(path, "goal", at_s), -1)
        if index < 0 or not self.events[index].detail["holds"]:
            return False
        return not isinstance(self.component(path), Nab) or index > self._begun_anew(path, at_s)

    def achieved_s(self, path: str, at_s: float) -> float | None:
        """When a component was achieved, or passed over, as it counts after the tick at a moment; None if it was not,
        or has no past since then.
        """
        achieved = next(self._of(path, "achieved", at_s), -1)
        skipped = (i for i in self._of(path, "timeout", at_s) if self.events[i].detail["then"] == "skip")
        index = max(achieved, next(skipped, -1))
        return self.events[index].time_s if index > self._begun_anew(path, at_s) else None

    def _begun_anew(self, path: str, at_s: float) -> int:
        """The event by which a component lost its past: it was called, or a network around it was begun anew."""
        around = self._around(path)
        anew = [next(self._of(nab, kind, at_s), -1) for nab in around for kind in ("called", "round", "switch")]
        return max(next(self._of(path, "called", at_s), -1), *anew, -1)

    def _of(self, path: str, kind: str, at_s: float) -> Iterator[int]:
        """Where in the trace events of one kind about a component stand, up to a moment, the latest first.

        Their order within a tick is that of the tick's steps.
        """
        for index in reversed(self._others[path]):
            if self.events[index].kind == kind and self.events[index].time_s <= at_s + _SLACK_S:
                yield index

    def nab_of(self, path: str) -> str:
        """The NAB in which a component stands; empty for one of the whole task's own."""
        return next(iter(self._around(path)), "")

    def predecessors(self, path: str) -> list[str]:
        """The components from which links lead to one, and those after which it may come."""
        prefix, network = self.network.home_of(path)
        id_ = path[len(prefix) :]
        before = [link.source for link in network.incoming[id_]]
        if network.paths:
            before += [one for one in network.topology.predecessors.get(id_, ()) if one != START]
        return [prefix + one for one in dict.fromkeys(before)]

    def _around(self, path: str) -> list[str]:
        """The NABs in which a component stands, innermost first."""
        parts = path.split("/")
        prefixes = ("/".join(parts[:end]) for end in range(len(parts) - 1, 0, -1))
        return [prefix for prefix in prefixes if isinstance(self.network.by_path.get(prefix), Nab)]
