"""What if one link had been another? Answered by running again from that moment."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from understudy.behaviors import Skill
from understudy.errors import NetworkError, RecordingError
from understudy.execution import Decision, Event, History, State
from understudy.network import LinkType, Network, expand_links, relinked
from understudy.perception import Percepts
from understudy.recording import Recording, outcome_of
from understudy.sessions.past import past_at
from understudy.sessions.recorded import limit_of, task_of, world_of
from understudy.sessions.running import Performed, perform

__all__ = ["Divergence", "WhatIf", "what_if"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Divergence:
    """The first moment at which two runs differ.

    Attributes:
        time_s: when.
        states: of the components that differ, what they did in the one and do in the other, by path.
    """

    time_s: float
    states: Mapping[str, tuple[State, State]]


@dataclass(frozen=True, slots=True, kw_only=True)
class WhatIf:
    """A run with one link changed, beside the one that was.

    Attributes:
        time_s: from when on the link was another.
        source, target: the paths of its components.
        was: its type.
        instead: what it was changed to; None: it was taken out.
        first: where the two runs part; None if they never do.
        performed: the run that was made now.
        done: whether the recorded run was done,
        reason: why not; empty if it was,
        ended_s: and when it ended, seconds since its beginning.
    """

    time_s: float
    source: str
    target: str
    was: LinkType
    instead: LinkType | None
    first: Divergence | None
    performed: Performed
    done: bool
    reason: str
    ended_s: float

    def as_record(self) -> dict[str, Any]:
        """As plain data."""
        first = self.first
        return {
            "time_s": self.time_s,
            "from": self.source,
            "to": self.target,
            "was": self.was.value,
            "instead": self.instead.value if self.instead is not None else None,
            "first_difference": None
            if first is None
            else {
                "time_s": first.time_s,
                "states": {path: [was.value, would.value] for path, (was, would) in first.states.items()},
            },
            "was_done": self.done,
            "reason": self.reason or None,
            "ended_s": round(self.ended_s, 1),
            "would": self.performed.as_record(),
        }


def what_if(
    recording: Recording,
    at_s: float,
    source: str,
    target: str,
    instead: LinkType | None,
    skills: Mapping[str, Skill],
    *,
    watch: Callable[[Percepts, Decision], None] | None = None,
) -> WhatIf:
    """Runs a recorded run again, in the same room with the same chance, with one link changed from a moment on.

    Args:
        recording: of a run in a simulated room.
        at_s: from this tick on.
        source, target: the paths of the link's components.
        instead: its type then; None takes it out.
        skills: by name.
        watch: is called after every tick that is made anew.

    Raises:
        RecordingError: it is no recording of a run in a simulated room; nothing is left to do at that moment; or the
            run cannot be repeated.
        NetworkError: there is no such link.
    """
    task, world = task_of(recording), world_of(recording)
    if task is None or world is None:
        raise RecordingError(
            f"{recording.info.path} holds no task or no simulated room, so it cannot be run again; name a run that"
            " understudy run has made in a simulated room"
        )
    document, network = task
    changed = relinked(network, source, target, instead)
    inside, home = expand_links(network).home_of(target)
    was = next(link.type for link in home.incoming[target[len(inside) :]] if inside + link.source == source)
    if instead is was:
        raise NetworkError(f"the link {source} -> {target} is {was} as it is; ask for another type, or for none")
    outcome = outcome_of(recording)
    if not 0 <= at_s <= outcome.time_s:
        raise RecordingError(
            f"{recording.info.path}: the run went on from 0 s to {outcome.time_s:.1f} s; ask within that"
        )
    past = past_at(recording, network, skills, at_s)
    performed = perform(
        document.name,
        changed,
        world,
        skills,
        seed=past.seed,
        limit_s=limit_of(recording),
        past=past,
        watch=watch,
    )
    return WhatIf(
        time_s=at_s,
        source=source,
        target=target,
        was=was,
        instead=instead,
        first=_first_difference(
            network, [Event.from_record(record) for record in recording.events()], performed.report.events, at_s
        ),
        performed=performed,
        done=outcome.done,
        reason=outcome.reason,
        ended_s=outcome.time_s,
    )


def _first_difference(network: Network, one: list[Event], other: tuple[Event, ...], from_s: float) -> Divergence | None:
    """Where two traces part, by what the components do; up to the end of the one that ends first."""
    was, would = History(network, one), History(network, other)
    times = sorted({event.time_s for event in (*one, *other)})
    for time_s in times:
        if from_s - 1e-6 <= time_s <= min(was.end_s, would.end_s):
            states = {
                path: (was.states(path, time_s)[-1].state, would.states(path, time_s)[-1].state)
                for path in network.by_path
            }
            differing = {path: pair for path, pair in states.items() if pair[0] is not pair[1]}
            if differing:
                return Divergence(time_s=time_s, states=differing)
    return None
