"""From the parts of a task document to the network that they describe."""

from collections.abc import Callable, Mapping
from difflib import get_close_matches

from understudy.errors import NetworkError
from understudy.network.conditions import (
    Achieved,
    After,
    AllOf,
    AnyOf,
    Complete,
    Condition,
    Happened,
    Holds,
    Not,
    Possible,
    TimedOut,
)
from understudy.network.controls import Repeat, Switch, Timeout, Trigger
from understudy.network.definition import Case, Component, Link, Nab, Network
from understudy.network.evidence import Interval, LinkEvidence, Occurrence
from understudy.network.parts import (
    CasePart,
    ComponentPart,
    ConditionPart,
    InhibitionPart,
    LinkPart,
    NetworkPart,
    TimeoutPart,
    TriggerPart,
)
from understudy.network.topology import Edge

__all__ = ["Fetch", "network_of"]

Fetch = Callable[[str, str], tuple[str, Network]]
"""From the file that ``task:`` names, and the place where it does, to that task's name and network."""

_OUTPUTS, _INPUTS = ("Effects", "Active"), ("UseBehavior", "ActivLevel", "Inhibit", "Preconditions", "Continue")
_LINK_PORTS, _INHIBITION_PORTS = ("Effects", "Preconditions"), ("Active", "Inhibit")


def network_of(part: NetworkPart, fetch: Fetch, *, path: str = "", outside: Mapping[str, str] | None = None) -> Network:
    """The network of a document's part.

    Args:
        part: components, links, inhibitions.
        fetch: loads the task that a component names.
        path: of the part in the document.
        outside: ids of the networks around this one, with the place where they stand.

    Raises:
        NetworkError: it describes none; the message names the place.
    """
    outside = dict(outside or {})
    ids = [component.id for component in part.components]
    inside = outside | dict.fromkeys(ids, path or "the whole task")
    components = tuple(
        _component(component, fetch, f"{_below(path)}components[{index}]", inside)
        for index, component in enumerate(part.components)
    )
    links = tuple(_link(link, ids, outside, f"{_below(path)}links[{index}]") for index, link in enumerate(part.links))
    inhibitions = tuple(
        _inhibition(inhibition, ids, outside, f"{_below(path)}inhibitions[{index}]")
        for index, inhibition in enumerate(part.inhibitions)
    )
    paths = tuple(Edge(source=step.source, target=step.target, shown=step.shown) for step in part.paths)
    try:
        return Network(components, links, inhibitions, paths)
    except NetworkError as error:
        raise NetworkError(error.problem, path=_below(path) + error.path) from None


def _below(path: str) -> str:
    return f"{path}." if path else ""


def _component(part: ComponentPart, fetch: Fetch, path: str, outside: Mapping[str, str]) -> Component | Nab:
    until = _condition(part.until) if part.until is not None else None
    timeout, trigger = _timeout(part.timeout), _trigger(part.trigger)
    if part.behavior is not None:
        return Component(
            id=part.id,
            behavior=part.behavior,
            parameters=part.parameters,
            occurrences=tuple(
                Occurrence(
                    demonstration=seen.demonstration,
                    interval=Interval(*seen.interval),
                    values=seen.values,
                    cues=seen.cues,
                    closest_s=seen.closest_s,
                )
                for seen in part.seen
            ),
            until=until,
            timeout=timeout,
            trigger=trigger,
        )
    name, repeat = part.name or "", None
    if part.repeat is not None:
        ending = _condition(part.repeat.until) if part.repeat.until is not None else None
        repeat = Repeat(times=part.repeat.times, until=ending)
    if part.cases is not None:
        cases = tuple(_case(case, fetch, f"{path}.cases[{index}]", outside) for index, case in enumerate(part.cases))
    elif part.network is not None:
        cases = (Case(network=network_of(part.network, fetch, path=f"{path}.network", outside=outside)),)
    else:
        assert part.task is not None
        name, network = fetch(part.task, f"{path}.task")
        cases = (Case(network=network),)
    return Nab(
        id=part.id,
        cases=cases,
        switches=tuple(
            Switch(source=switch.source, target=switch.target, when=_condition(switch.when)) for switch in part.switches
        ),
        repeat=repeat,
        task=name,
        until=until,
        timeout=timeout,
        trigger=trigger,
    )


def _case(part: CasePart, fetch: Fetch, path: str, outside: Mapping[str, str]) -> Case:
    when = _condition(part.when) if part.when is not None else None
    if part.network is not None:
        network = network_of(part.network, fetch, path=f"{path}.network", outside=outside)
    else:
        assert part.task is not None
        _, network = fetch(part.task, f"{path}.task")
    return Case(name=part.name, network=network, when=when)


def _condition(part: ConditionPart) -> Condition:
    if part.holds is not None:
        return Holds(behavior=part.holds.behavior, parameters=part.holds.parameters)
    if part.possible is not None:
        return Possible(behavior=part.possible.behavior, parameters=part.possible.parameters)
    if part.event is not None:
        return Happened(event=part.event)
    if part.achieved is not None:
        return Achieved(component=part.achieved)
    if part.timed_out is not None:
        return TimedOut(component=part.timed_out)
    if part.after is not None:
        return After(seconds=part.after)
    if part.not_ is not None:
        return Not(of=_condition(part.not_))
    if part.all is not None:
        return AllOf(of=tuple(map(_condition, part.all)))
    if part.any is not None:
        return AnyOf(of=tuple(map(_condition, part.any)))
    return Complete()


def _timeout(part: TimeoutPart | None) -> Timeout | None:
    return None if part is None else Timeout(seconds=part.seconds, then=part.then, event=part.event)


def _trigger(part: TriggerPart | None) -> Trigger | None:
    if part is None:
        return None
    return Trigger(every_s=part.every, on=_condition(part.when) if part.when is not None else None)


def _link(part: LinkPart, ids: list[str], outside: Mapping[str, str], path: str) -> Link:
    source, target = _ends(part, ids, outside, path, _LINK_PORTS)
    return Link(
        source=source,
        target=target,
        type=part.type,
        evidence=tuple(
            LinkEvidence(
                demonstration=evidence.demonstration,
                source=Interval(*evidence.from_interval),
                target=Interval(*evidence.to_interval),
                relation=evidence.relation,
                note=evidence.note,
            )
            for evidence in part.because
        ),
    )


def _inhibition(part: InhibitionPart, ids: list[str], outside: Mapping[str, str], path: str) -> tuple[str, str]:
    return _ends(part, ids, outside, path, _INHIBITION_PORTS)


def _ends(
    part: LinkPart | InhibitionPart, ids: list[str], outside: Mapping[str, str], path: str, ports: tuple[str, str]
) -> tuple[str, str]:
    """Both ends by their ids; a port may be named (``grasp.Effects``), and must be the one that the link connects."""
    return (
        _end(part.source, ids, outside, f"{path}.from", ports[0], _OUTPUTS),
        _end(part.target, ids, outside, f"{path}.to", ports[1], _INPUTS),
    )


def _end(given: str, ids: list[str], outside: Mapping[str, str], path: str, wanted: str, there: tuple[str, ...]) -> str:
    if given in ids:
        return given
    id_, dot, port = given.rpartition(".")
    if dot and id_ in ids:
        if port == wanted:
            return id_
        close = get_close_matches(port, there, n=1)
        hint = f", did you mean {close[0]!r}?" if close and close[0] != port else ""
        known = f"is not the one that this connects; it is {wanted!r}" if port in there else f"is none{hint}"
        raise NetworkError(
            f"{id_!r} has the ports {', '.join(there)} at this end of a link, and {port!r} {known}", path=path
        )
    if given in outside:
        raise NetworkError(
            f"{given!r} stands outside of this network ({outside[given]}), and a link does not cross its border; link "
            "the components that contain both ends",
            path=path,
        )
    return given  # the network itself says what is wrong with it
