"""Why a component is active or not: the first condition that decides it, since when, by what event (§3.3.2).

Everything is read from the trace that the tick makes; :mod:`understudy.figures` puts it into words.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from understudy.execution.causes import Cause, cause_of
from understudy.execution.history import History, StateChange
from understudy.execution.trace import State

__all__ = ["Explanation", "Missing", "explain"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Missing:
    """A condition that keeps a component from being active, or an active one from executing.

    Attributes:
        kind: the link that is not satisfied (``ordering``, ``enabling``, ``permanent``); a rival that executes
            (``inhibited``) or has executed in the last tick; the actuators, which are another's (``locked``); its world
            precondition (``world``); a NAB none of whose parts executes (``parts``); the network in which it stands is
            not in use (``unused``), or it was ``removed`` from the task in practice; it is a duty that is not called
            (``resting``); nobody needs it (``level``). Where there are alternatives: another component comes first on
            the way (``path``); or none that is still open leads to it (``bypassed``), since another component was taken
            or, if none is named, in every run.
        component: the path of the other component on which it hangs; empty if there is none.
        lacks: of a link, whether its predecessor has not been ``achieved``, or has been and its goal does not ``hold``.
    """

    kind: Literal[
        "ordering",
        "enabling",
        "permanent",
        "inhibited",
        "locked",
        "world",
        "parts",
        "unused",
        "removed",
        "resting",
        "level",
        "path",
        "bypassed",
    ]
    component: str = ""
    lacks: Literal["", "achieved", "hold"] = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Explanation:
    """Why a component was what it was.

    Attributes:
        component: its path.
        time_s: the moment that was asked for.
        state: what it did.
        since_s: since when, for the same first reason.
        missing: what keeps it from executing, the condition that decides it first; empty while it executes.
        cause: what happened then.
        because: the same for the component on which the first of the missing conditions hangs.
    """

    component: str
    time_s: float
    state: State
    since_s: float
    missing: tuple[Missing, ...]
    cause: Cause
    because: "Explanation | None" = None

    @property
    def active(self) -> bool:
        """The port ``Active``: executing or searching."""
        return self.state in (State.EXECUTING, State.SEARCHING)

    def chain(self) -> "Iterator[Explanation]":
        """This one, the one of the component on which it hangs, and so on."""
        here: Explanation | None = self
        while here is not None:
            yield here
            here = here.because

    def as_record(self) -> dict[str, Any]:
        """As plain data."""
        return {
            "component": self.component,
            "time_s": self.time_s,
            "active": self.active,
            "state": self.state.value,
            "since_s": self.since_s,
            "missing": [
                {
                    key: value
                    for key, value in (("kind", m.kind), ("component", m.component), ("lacks", m.lacks))
                    if value
                }
                for m in self.missing
            ],
            "cause": {"kind": self.cause.kind, "component": self.cause.component, "time_s": self.cause.time_s},
            "because": None if self.because is None else self.because.as_record(),
        }


def explain(history: History, path: str, at_s: float) -> Explanation:
    """Why a component is active or not at a moment.

    Args:
        history: of the run.
        path: of the component.
        at_s: seconds on the robot's clock; the last tick at or before it counts.

    Raises:
        UnderstudyError: no component has this path, or the moment is before the run.
    """
    return _explain(history, path, at_s, frozenset())


def _explain(history: History, path: str, at_s: float, asked: frozenset[str]) -> Explanation:
    told = history.states(path, at_s)
    index = len(told) - 1
    while index and told[index - 1].deciding == told[index].deciding:
        index -= 1
    since, before = told[index], told[index - 1] if index else None
    missing = tuple(_missing(history, path, told[-1], at_s))
    other = next((one.component for one in missing), "")
    because = None
    if other and other not in asked | {path}:
        because = _explain(history, other, at_s, asked | {path})
    return Explanation(
        component=path,
        time_s=at_s,
        state=since.state,
        since_s=since.time_s,
        missing=missing,
        cause=cause_of(history, path, since, before),
        because=because,
    )


def _missing(history: History, path: str, told: StateChange, at_s: float) -> Iterator[Missing]:
    """What keeps a component from executing, in the order in which the tick asks."""
    why = told.why
    match told.state:
        case State.INHIBITED:
            yield Missing(kind="inhibited", component=why["by"])
        case State.UNUSED if why.get("reason") == "removed":
            yield Missing(kind="removed")
        case State.UNUSED:
            yield Missing(kind="unused", component=history.nab_of(path))
        case State.RESTING:
            yield Missing(kind="resting")
        case State.ACHIEVED | State.SKIPPED:
            yield Missing(kind="level")
        case State.BYPASSED:
            yield Missing(kind="bypassed", component=why.get("by", ""))
        case State.SEARCHING if why["reason"] == "locked":
            yield Missing(kind="locked", component=why["by"])
        case State.SEARCHING if why["reason"] == "parts":
            yield Missing(kind="parts", component=_searching_part(history, path, at_s))
        case State.SEARCHING:
            yield Missing(kind="world")
        case State.WAITING if why["reason"] == "unused":
            yield Missing(kind="unused", component=history.nab_of(path))
        case _:
            pass
    links = [why] if told.state is State.WAITING and why["reason"] != "unused" else []
    for link in (*links, *why.get("also", ())):
        achieved = history.achieved_s(link["for"], at_s) is not None
        yield Missing(kind=link["reason"], component=link["for"], lacks="hold" if achieved else "achieved")


def _searching_part(history: History, path: str, at_s: float) -> str:
    """Of a NAB that is active while nothing in it executes, what does not: an active part, else one that waits."""
    inside = [one for one in history.network.by_path if history.nab_of(one) == path]
    states = {one: history.states(one, at_s)[-1].state for one in inside}
    for wanted in (State.SEARCHING, State.INHIBITED, State.WAITING):
        for one, state in states.items():
            if state is wanted:
                return one
    return ""
