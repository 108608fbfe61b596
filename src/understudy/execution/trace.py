"""What happened in a run, and why: one event for every change of state and every refusal (semantics §3)."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from types import MappingProxyType
from typing import Any

__all__ = ["Event", "State"]


class State(StrEnum):
    """What a component is doing, as people are told."""

    WAITING = "waiting"
    """Needed, but a precondition is missing; the event says which."""
    INHIBITED = "inhibited"
    """A rival executes."""
    SEARCHING = "searching"
    """Active, but its world precondition does not hold, or its actuators are another's."""
    EXECUTING = "executing"
    ACHIEVED = "achieved"
    """Achieved, and nobody needs it now."""
    SKIPPED = "skipped"
    """It ran out of time, and is passed over."""
    RESTING = "resting"
    """A duty that is not called now."""
    BYPASSED = "bypassed"
    """Another way was taken, or a direct one leads past it."""
    UNUSED = "unused"
    """A part of a network that is not in use now, and not achieved."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """One entry of the trace.

    Attributes:
        time_s: of the observation that brought it about.
        kind: ``state`` (a component's state, with reasons), ``goal`` (its goal came true, or ceased to be),
            ``achieved`` (``on_purpose``: by the robot's own doing, the beep of A.4), ``timeout`` (and what follows,
            ``then``), ``called`` (a duty), ``case`` (the case with which a NAB begins), ``switch`` (``to`` another
            case), ``round`` (a loop begins its ``number``-th), ``taken`` (the way goes on here, ``instead_of`` other
            candidates, or ``past`` what is bypassed), ``event`` (heard of from outside), ``avoid``, ``complete``,
            ``stopped``; and in practice ``heard`` (a ``cue``), ``corrected`` (the step that a ``word``, said at
            ``said_s``, was about, ``how``, ``since_s``, and the ``others`` that it may have been about),
            ``suspended``, ``resumed``.
        component: its path, where it is about one.
        detail: what else belongs to it, plain data: the new state, the reason of a refusal, the component in the way.
    """

    time_s: float
    kind: str
    component: str = ""
    detail: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))

    def as_record(self) -> dict[str, Any]:
        """As it stands in a recording: one flat JSON object."""
        record: dict[str, Any] = {"time_s": self.time_s, "kind": self.kind}
        if self.component:
            record["component"] = self.component
        return record | dict(self.detail)

    @classmethod
    def from_record(cls, record: Mapping[str, Any]) -> "Event":
        """The event that stands in a recording.

        Raises:
            KeyError: the record is none of an event: it has no time, or no kind.
        """
        detail = {key: value for key, value in record.items() if key not in ("time_s", "kind", "component")}
        return cls(
            time_s=float(record["time_s"]),
            kind=str(record["kind"]),
            component=str(record.get("component", "")),
            detail=detail,
        )
