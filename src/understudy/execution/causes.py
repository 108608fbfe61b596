"""What happened when a component's state came to be what it is."""

from dataclasses import dataclass
from typing import Literal

from understudy.execution.history import History, StateChange
from understudy.execution.trace import State

__all__ = ["Cause", "cause_of"]

_Kind = Literal[
    "began",
    "begun",
    "ended",
    "achieved",
    "skipped",
    "called",
    "reached",
    "lost",
    "came",
    "went",
    "took",
    "freed",
    "inhibited",
    "released",
    "finished",
    "taken",
    "removed",
    "changed",
]


@dataclass(frozen=True, slots=True, kw_only=True)
class Cause:
    """What happened when a component's state came to be what it is.

    Attributes:
        kind: the run ``began``; a network was ``begun``, or begun anew, or ``ended``; a component was ``achieved``, was
            ``skipped``, was ``called``; its goal was ``reached`` or ``lost``; what the component needs to act ``came``
            or ``went``; another ``took`` its actuators or ``freed`` them; a rival ``inhibited`` it or ``released`` it;
            it ``finished``, some time after it was achieved; another component was ``taken`` on the way instead; a
            teacher ``removed`` it; or none of these happened to it or to those on which it hangs: something else
            ``changed``.
        component: whom it happened to; the component itself, or another one.
        time_s: when.
    """

    kind: _Kind
    component: str
    time_s: float


def cause_of(history: History, path: str, since: StateChange, before: StateChange | None) -> Cause:
    """What brought about a component's state.

    Args:
        history: of the run.
        path: of the component.
        since: the state, from when it began.
        before: the state until then; None if there was none.
    """
    moment = _Moment(history, path, since, before)
    if since.state in (State.EXECUTING, State.SEARCHING):
        kind, other = moment.of_activity()
    else:
        kind, other = moment.of_rest()
    return Cause(kind=kind, component=other, time_s=since.time_s)


_Found = tuple[_Kind, str]


@dataclass(frozen=True, slots=True)
class _Moment:
    """One change of a component's state."""

    history: History
    path: str
    since: StateChange
    before: StateChange | None

    def of_rest(self) -> _Found:
        """Why it is not active any more, or not yet."""
        path, state = self.path, self.since.state
        waits_for = str(self.since.why.get("for", ""))
        if state is State.SKIPPED:
            return "skipped", path
        if self.since.why.get("reason") == "removed":
            return "removed", path
        if state is State.INHIBITED:
            return "inhibited", str(self.since.why["by"])
        if state is State.BYPASSED and "by" in self.since.why:
            return "taken", str(self.since.why["by"])
        if state in (State.ACHIEVED, State.RESTING) and self._now("achieved", path):
            return "achieved", path
        if state is State.ACHIEVED and self._now("goal", path):
            return "reached", path
        if self.before is None:
            return "began", ""
        if state is State.UNUSED:
            return "ended", self.history.nab_of(path)
        if state is State.ACHIEVED and self.before.state in (State.EXECUTING, State.SEARCHING):
            return "finished", path
        if waits_for and self._now("goal", waits_for):
            return "lost", waits_for
        waited_for = str(self.before.why.get("for", ""))
        if waited_for and self._now("achieved", waited_for):
            return "achieved", waited_for
        return self._woken() or ("changed", path)

    def of_activity(self) -> _Found:
        """Why it is active now, or why it ceased or began to execute."""
        before = self.before
        if before is None:
            return "began", ""
        if before.state is State.WAITING:
            for source in self.history.predecessors(self.path):
                # The condition that came true last: an achievement, or a goal that holds again.
                if self._now("achieved", source):
                    return "achieved", source
                if self._now("goal", source):
                    return "reached", source
        if before.state not in (State.EXECUTING, State.SEARCHING):
            return self._woken() or ("changed", self.path)
        if self.since.state is State.EXECUTING:
            held_up_by = str(before.why.get("by", ""))
            return ("freed", held_up_by) if held_up_by else ("came", self.path)
        taken_by = str(self.since.why.get("by", ""))
        return ("took", taken_by) if taken_by else ("went", self.path)

    def _woken(self) -> _Found | None:
        """What made it needed again, where it was not asked before."""
        path, before = self.path, self.before
        if self._now("called", path):
            return "called", path
        if before is not None and before.state is State.UNUSED:
            return "begun", self.history.nab_of(path)
        if before is not None and before.state is State.INHIBITED:
            return "released", str(before.why["by"])
        if self._now("goal", path) and not self.history.holds(path, self.since.time_s):
            return "lost", path
        return None

    def _now(self, kind: str, of: str) -> bool:
        event = self.history.last(of, kind, self.since.time_s)
        return event is not None and event.time_s == self.since.time_s
