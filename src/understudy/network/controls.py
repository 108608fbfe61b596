"""Control structures: timeouts, duties, loops, switches (§3.5.2.3, §3.6); and what can be wrong with them."""

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from understudy.errors import NetworkError
from understudy.network.conditions import (
    Achieved,
    After,
    AllOf,
    AnyOf,
    Complete,
    Condition,
    Happened,
    Not,
    TimedOut,
    atoms,
)

if TYPE_CHECKING:
    from understudy.network.definition import Component, Nab, Network

__all__ = ["Repeat", "Switch", "Timeout", "Trigger", "check_controls", "check_timeout"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Timeout:
    """What happens to a component that has been active for too long without being achieved.

    Attributes:
        seconds: of activity since the component was last begun, or since it was last told of.
        then: ``skip`` goes on as if the component were not there; ``stop`` ends the run, not done; ``signal`` tells
            the event ``event`` and tries on.
        event: the name of the signal (:class:`~understudy.network.conditions.Happened`).
    """

    seconds: float
    then: Literal["skip", "stop", "signal"] = "stop"
    event: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trigger:
    """When a component beside the sequence is asked for: a duty. Exactly one of the two.

    Between its calls it rests. Once called it goes before all others in taking its actuators, and is done when its goal
    is achieved; then it rests until it is called again. A task is complete without its duties.

    Attributes:
        every_s: so many seconds after the network was begun, and again after it was last done.
        on: each time when this comes true.
    """

    every_s: float | None = None
    on: Condition | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Repeat:
    """A loop (§3.6, reinstantiation): after each round the network is begun anew.

    Attributes:
        times: at most so many rounds; without it and ``until`` there is no end.
        until: no further round once this is so at the end of one (repeat-until, §4.6).
    """

    times: int | None = None
    until: Condition | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Switch:
    """While the case ``source`` is executed and ``when`` is so, the case ``target`` is begun anew (§3.5.2.3)."""

    source: str
    target: str
    when: Condition


def check_controls(part: "Component | Nab", network: "Network", path: str) -> None:
    """Refuses what a component's controls cannot mean.

    Args:
        part: the component.
        network: in which it stands.
        path: of the component in the document.

    Raises:
        NetworkError: with the place and what would be valid.
    """
    if part.timeout is not None:
        check_timeout(part.timeout, f"{path}.timeout")
    if part.until is not None:
        _check_condition(part.until, network, f"{path}.until")
    if part.trigger is not None:
        _check_trigger(part, network, f"{path}.trigger")
    cases = getattr(part, "cases", None)
    if cases is not None:
        _check_nab(part, network, path)  # type: ignore[arg-type]  # a component has no cases


def check_timeout(timeout: Timeout, path: str) -> None:
    """Refuses a timeout that cannot be meant.

    Raises:
        NetworkError: its time is no positive number, or the event does not fit what follows.
    """
    if not (math.isfinite(timeout.seconds) and timeout.seconds > 0):
        raise NetworkError(f"a timeout is a positive number of seconds, given {timeout.seconds!r}", path=path)
    if timeout.then == "signal" and not timeout.event:
        raise NetworkError("a timeout that signals needs the name of an event", path=f"{path}.event")
    if timeout.then != "signal" and timeout.event:
        raise NetworkError(f"a timeout that says {timeout.then!r} tells no event; say 'signal'", path=f"{path}.then")


def _check_trigger(part: "Component | Nab", network: "Network", path: str) -> None:
    trigger = part.trigger
    assert trigger is not None
    if (trigger.every_s is None) is (trigger.on is None):
        raise NetworkError("a trigger is either 'every' or 'on'", path=path)
    if trigger.every_s is not None and not (math.isfinite(trigger.every_s) and trigger.every_s > 0):
        raise NetworkError(f"'every' is a positive number of seconds, given {trigger.every_s!r}", path=f"{path}.every")
    if trigger.on is not None:
        _check_condition(trigger.on, network, f"{path}.on")
    waiting = [link.target for link in network.outgoing[part.id]]
    if waiting:
        raise NetworkError(
            f"{part.id!r} is a duty beside the sequence, and {waiting[0]!r} cannot wait for it; take the link out, or "
            "the trigger",
            path=path,
        )
    if not network.sinks:
        raise NetworkError("a network of duties alone is never done; give it a component without a trigger", path=path)


def _check_nab(nab: "Nab", network: "Network", path: str) -> None:
    if not nab.cases:
        raise NetworkError("a network in a component's place needs at least one case", path=path)
    names = [case.name for case in nab.cases]
    for index, case in enumerate(nab.cases):
        at = f"{path}.cases[{index}]"
        if len(names) > 1 and (not case.name or "/" in case.name):
            raise NetworkError(f"a case needs a name without '/', given {case.name!r}", path=f"{at}.name")
        if case.name in names[:index]:
            raise NetworkError(f"the name {case.name!r} is used twice; every case needs its own", path=f"{at}.name")
        if case.when is not None:
            _check_condition(case.when, network, f"{at}.when")
    if nab.repeat is not None:
        if nab.repeat.times is not None and nab.repeat.times < 1:
            raise NetworkError(f"a loop runs at least once, given {nab.repeat.times}", path=f"{path}.repeat.times")
        if nab.repeat.until is not None:
            _check_condition(nab.repeat.until, network, f"{path}.repeat.until")
    by_name = {case.name: case for case in nab.cases}
    for index, switch in enumerate(nab.switches):
        at = f"{path}.switches[{index}]"
        for end, name in (("from", switch.source), ("to", switch.target)):
            if name not in by_name:
                raise NetworkError(f"no case is called {name!r}; there are: {', '.join(by_name)}", path=f"{at}.{end}")
        _check_condition(switch.when, by_name[switch.source].network, f"{at}.when", switching=True)
    reached = _reached(nab)
    for index, case in enumerate(nab.cases):
        if case.name not in reached:
            raise NetworkError(
                f"the case {case.name!r} can never be reached: one before it is taken whenever it could be; put it "
                "first, change its condition, or switch to it",
                path=f"{path}.cases[{index}]",
            )


def _reached(nab: "Nab") -> set[str]:
    """The cases that can begin: by their own condition, or by a switch from one that can."""
    reached: set[str] = set()
    asked: list[Condition] = []
    for case in nab.cases:
        if case.when is not None and case.when in asked:
            continue
        reached.add(case.name)
        if case.when is None:
            break
        asked.append(case.when)
    while new := {switch.target for switch in nab.switches if switch.source in reached} - reached:
        reached |= new
    return reached


def _check_condition(condition: Condition, network: "Network", path: str, *, switching: bool = False) -> None:
    for part in _parts(condition):
        if isinstance(part, AllOf | AnyOf) and not part.of:
            raise NetworkError("'all' and 'any' take at least one condition", path=path)
    ids: Collection[str] = network.by_id
    for atom in atoms(condition):
        match atom:
            case Achieved(component=id_) | TimedOut(component=id_) if id_ not in ids:
                raise NetworkError(
                    f"no component of this network is called {id_!r}; there are: {', '.join(sorted(ids))}", path=path
                )
            case TimedOut(component=id_) if network.by_id[id_].timeout is None:
                raise NetworkError(f"{id_!r} has no timeout, so it never times out; give it one", path=path)
            case Complete() if not switching:
                raise NetworkError("'complete' is for switches only; here it never comes true", path=path)
            case After(seconds=seconds) if not (math.isfinite(seconds) and seconds >= 0):
                raise NetworkError(f"'after' is a number of seconds, given {seconds!r}", path=path)
            case Happened(event=""):
                raise NetworkError("an event needs a name", path=path)
            case _:
                pass


def _parts(condition: Condition) -> Iterator[Condition]:
    yield condition
    inside = (
        condition.of if isinstance(condition, AllOf | AnyOf) else (condition.of,) if isinstance(condition, Not) else ()
    )
    for part in inside:
        yield from _parts(part)
