"""The equivalent flat network of a hierarchical one: the same behaviors, linked among each other (§3.7).

Who waits for a network waits for its final steps; a network that waits keeps its first steps waiting, and by them all
others. So a link that begins or ends at a network becomes several:

| link | from | to | type |
| --- | --- | --- | --- |
| from a network | its final steps | the first steps | ordering, whatever it was: what a network achieved stays so |
| ordering | the behavior | the first steps | ordering |
| enabling | the behavior | the first steps | enabling |
| permanent | the behavior | every step | permanent |

These are the links that no others imply; :func:`~understudy.network.expand_links` gives all of them, "to and from all
the behaviors of a subtask".
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

from understudy.errors import NetworkError
from understudy.network.conditions import Achieved, After, AllOf, AnyOf, Condition, Not, TimedOut
from understudy.network.definition import Component, Link, LinkType, Nab, Network

__all__ = ["flattened"]


def flattened(network: Network) -> Network:
    """The flat network that does what a hierarchical one does.

    Its components are the behaviors in document order; their ids are their paths, with dots instead of slashes. How far
    the two behave alike, and where they differ for a tick, stands in ``docs/processing-model.md``.

    Args:
        network: a hierarchy; a flat network comes back as it is.

    Raises:
        NetworkError: a network in it has no flat equivalent, or two paths become one id; the error's path is that of
            the component.
    """
    if network.flat:
        return network
    _check(network, "", stoppable=False)
    components = tuple(_components(network, ""))
    ids = [component.id for component in components]
    for id_ in ids:
        if ids.count(id_) > 1:
            raise NetworkError(f"two components would be called {id_!r}; give one of them another id", path=id_)
    return Network(components, tuple(_links(network, "")), tuple(_inhibitions(network, "")))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Steps:
    """Flat ids of what a component consists of: itself, or all behaviors of its network."""

    every: tuple[str, ...]
    first: tuple[str, ...]
    final: tuple[str, ...]


def _steps(part: Component | Nab, path: str) -> _Steps:
    if isinstance(part, Component):
        own = (f"{path}{part.id}".replace("/", "."),)
        return _Steps(every=own, first=own, final=own)
    inside = _inside(part, path)
    steps = {inner.id: _steps(inner, inside) for inner in part.network.components}
    return _Steps(
        every=tuple(id_ for one in steps.values() for id_ in one.every),
        first=tuple(id_ for one, links in part.network.incoming.items() if not links for id_ in steps[one].first),
        final=tuple(id_ for one in part.network.sinks for id_ in steps[one].final),
    )


def _inside(nab: Nab, path: str) -> str:
    """What the paths of a network's components begin with, as in :meth:`Network.walk`."""
    return "/".join(filter(None, (f"{path}{nab.id}", nab.cases[0].name))) + "/"


def _components(network: Network, path: str) -> Iterator[Component]:
    for part in network.components:
        if isinstance(part, Nab):
            yield from _components(part.network, _inside(part, path))
            continue
        (id_,) = _steps(part, path).every
        until, trigger = part.until, part.trigger
        if until is not None:
            until = _renamed(until, network, path, part.id)
        if trigger is not None and trigger.on is not None:
            trigger = replace(trigger, on=_renamed(trigger.on, network, path, part.id))
        yield replace(part, id=id_, until=until, trigger=trigger)


def _links(network: Network, path: str) -> Iterator[Link]:
    steps = {part.id: _steps(part, path) for part in network.components}
    for link in network.links:
        source, target = steps[link.source], steps[link.target]
        type_ = LinkType.ORDERING if isinstance(network.by_id[link.source], Nab) else link.type
        held = target.every if type_ is LinkType.PERMANENT else target.first
        for pair in product(source.final, held):
            yield Link(source=pair[0], target=pair[1], type=type_, evidence=link.evidence)
    for part in network.components:
        if isinstance(part, Nab):
            yield from _links(part.network, _inside(part, path))


def _inhibitions(network: Network, path: str) -> Iterator[tuple[str, str]]:
    steps = {part.id: _steps(part, path) for part in network.components}
    for source, target in network.inhibitions:
        yield from product(steps[source].every, steps[target].every)
    for part in network.components:
        if isinstance(part, Nab):
            yield from _inhibitions(part.network, _inside(part, path))


def _renamed(condition: Condition, network: Network, path: str, component: str) -> Condition:
    """A condition in the ids of the flat network; a network is achieved when its final steps are."""
    match condition:
        case Achieved():
            final = _steps(network.by_id[condition.component], path).final
            each = tuple(Achieved(component=id_) for id_ in final)
            return each[0] if len(each) == 1 else AllOf(of=each)
        case TimedOut():
            return TimedOut(component=_steps(network.by_id[condition.component], path).final[0])
        case After() if path:
            raise NetworkError(
                "'after' counts from the beginning of the network around it, which a flat network does not have",
                path=f"{path}{component}",
            )
        case Not():
            return Not(of=_renamed(condition.of, network, path, component))
        case AllOf() | AnyOf():
            return replace(condition, of=tuple(_renamed(part, network, path, component) for part in condition.of))
        case _:
            return condition


def _check(network: Network, path: str, *, stoppable: bool) -> None:
    """Refuses what has no flat equivalent.

    Args:
        network: to be looked at, with all that is inside.
        path: of its components begins with this.
        stoppable: something around it may stop it before it is complete.
    """
    if network.paths:
        raise NetworkError("a network with alternatives has no flat equivalent", path=f"{path}paths")
    for part in network.components:
        place = f"{path}{part.id}"
        if path and part.trigger is not None:
            raise NetworkError(
                "a duty inside of a network rests when the network does; a flat one has none", path=place
            )
        if isinstance(part, Component):
            continue
        _check_plain(part, place)
        asking = [link for link in network.incoming[part.id] if isinstance(network.by_id[link.source], Component)]
        stops = stoppable or any(link.type is LinkType.PERMANENT for link in asking)
        stops = stops or any(target == part.id for _, target in network.inhibitions)
        enabling = next((link for link in asking if link.type is LinkType.ENABLING), None)
        if enabling is not None and not _first_steps_once(part.network, stoppable=stops):
            raise NetworkError(
                f"{enabling.source!r} enables it as a whole: what is done again inside does not ask for it, but the "
                "same step of a flat network would; make the link an ordering or a permanent one",
                path=place,
            )
        _check(part.network, _inside(part, path), stoppable=stops)
    for source, target in network.inhibitions:
        if (target, source) in network.inhibitions and isinstance(network.by_id[source], Nab):
            raise NetworkError(
                f"it and {target!r} inhibit each other, which their steps in a flat network would do by turns, for "
                "ever; keep one of the two inhibitions",
                path=f"{path}{source}",
            )


def _check_plain(nab: Nab, place: str) -> None:
    """Refuses the control structures that only a network in a component's place can have."""
    has = [
        name
        for name, there in (
            ("cases", len(nab.cases) > 1 or nab.cases[0].when is not None),
            ("switches", nab.switches),
            ("repeat", nab.repeat),
            ("until", nab.until),
            ("timeout", nab.timeout),
            ("trigger", nab.trigger),
        )
        if there
    ]
    if has:
        raise NetworkError(
            f"a network with {' and '.join(has)} has no flat equivalent; only one that is always executed once has",
            path=place,
        )
    if not nab.network.components:
        raise NetworkError("a network without components has no flat equivalent; take it out", path=place)


def _first_steps_once(network: Network, *, stoppable: bool) -> bool:
    """Whether the first steps of a network begin with it, all of them, and never again after another one did."""
    if network.inhibitions or any(isinstance(part, Nab) for part in network.components):
        return False
    asked_again = any(link.type is not LinkType.ORDERING for link in network.links if not network.incoming[link.source])
    return not network.links or not (stoppable or asked_again)
