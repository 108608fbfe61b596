"""What tells two networks apart, by name: one sentence for every difference. What was seen in demonstrations is not."""

from collections.abc import Iterator, Mapping

from understudy.network.controls import Repeat, Timeout, Trigger
from understudy.network.definition import Component, Nab, Network

__all__ = ["differences"]


def differences(old: Network, new: Network, *, inside: str = "") -> tuple[str, ...]:
    """Every difference of what two networks say, at every depth.

    Args:
        old: one of them.
        new: the other, of which the sentences speak.
        inside: what the paths of their components begin with.

    Returns:
        Sentences such as ``the link a -> b is ordering, and was enabling``; none if the two execute the same.
    """
    return tuple(_differences(old, new, inside))


def _differences(old: Network, new: Network, inside: str) -> Iterator[str]:
    for id_ in (id_ for id_ in old.by_id if id_ not in new.by_id):
        yield f"{inside}{id_} is gone"
    for id_, part in new.by_id.items():
        if id_ not in old.by_id:
            yield f"{inside}{id_} ({_kind(part)}) is new"
        else:
            yield from _of_component(old.by_id[id_], part, inside + id_)
    kept = [id_ for id_ in new.by_id if id_ in old.by_id]
    before = [id_ for id_ in old.by_id if id_ in new.by_id]
    if kept != before:
        moved = next(id_ for id_, other in zip(kept, before, strict=True) if id_ != other)
        yield f"the components stand in another order, {inside}{moved} the first of them; the order settles ties"
    yield from _of_links(old, new, inside)
    for by, of in (pair for pair in old.inhibitions if pair not in new.inhibitions):
        yield f"{inside}{by} does not inhibit {inside}{of} any more"
    for by, of in (pair for pair in new.inhibitions if pair not in old.inhibitions):
        yield f"{inside}{by} inhibits {inside}{of} now"
    were = [f"{inside}{edge.source} -> {inside}{edge.target}" for edge in old.paths]
    are = [f"{inside}{edge.source} -> {inside}{edge.target}" for edge in new.paths]
    yield from (f"the way {step} is gone" for step in were if step not in are)
    yield from (f"the way {step} is new" for step in are if step not in were)


def _of_links(old: Network, new: Network, inside: str) -> Iterator[str]:
    types = {(link.source, link.target): link.type.value for link in new.links}
    were = {(link.source, link.target): link.type.value for link in old.links}
    for pair in were | types:
        link = f"{inside}{pair[0]} -> {inside}{pair[1]}"
        if pair not in types:
            yield f"the {were[pair]} link {link} is gone"
        elif pair not in were:
            yield f"the {types[pair]} link {link} is new"
        elif types[pair] != were[pair]:
            yield f"the link {link} is {types[pair]}, and was {were[pair]}"


def _of_component(old: Component | Nab, new: Component | Nab, path: str) -> Iterator[str]:
    if isinstance(old, Component) and isinstance(new, Component):
        if old.behavior != new.behavior:
            yield f"{path} is {new.behavior}, and was {old.behavior}"
        else:
            yield from _of_values(old.parameters, new.parameters, path)
    elif isinstance(old, Nab) and isinstance(new, Nab):
        yield from _of_nab(old, new, path)
    else:
        yield f"{path} is {_kind(new)}, and was {_kind(old)}"
    for what, was, now in (
        ("end", old.until, new.until),
        ("timeout", old.timeout, new.timeout),
        ("trigger", old.trigger, new.trigger),
    ):
        if was != now:
            yield f"the {what} of {path} is {_text(now)}, and was {_text(was)}"


def _of_values(old: Mapping[str, object], new: Mapping[str, object], path: str) -> Iterator[str]:
    for name in sorted(old.keys() | new.keys()):
        was, now = old.get(name, "left out"), new.get(name, "left out")
        if was != now:
            yield f"{name} of {path} is {now}, and was {was}"


def _of_nab(old: Nab, new: Nab, path: str) -> Iterator[str]:
    cases = {case.name: case for case in old.cases}
    if [case.name for case in old.cases] != [case.name for case in new.cases]:
        yield f"the cases of {path} are {_names(new)}, and were {_names(old)}"
    for case in new.cases:
        if case.name not in cases:
            continue
        inside = "/".join(filter(None, (path, case.name)))
        if cases[case.name].when != case.when:
            yield f"{inside} is begun if {_text(case.when)}, and was if {_text(cases[case.name].when)}"
        yield from _differences(cases[case.name].network, case.network, f"{inside}/")
    if old.switches != new.switches:
        was, now = (
            [f"{switch.source} -> {switch.target} when {switch.when}" for switch in nab.switches] for nab in (old, new)
        )
        yield f"the switches of {path} are {'; '.join(now) or 'none'}, and were {'; '.join(was) or 'none'}"
    if old.repeat != new.repeat:
        yield f"the loop of {path} is {_text(new.repeat)}, and was {_text(old.repeat)}"


def _kind(part: Component | Nab) -> str:
    return part.behavior if isinstance(part, Component) else "a network"


def _names(nab: Nab) -> str:
    return ", ".join(case.name or "the only one" for case in nab.cases)


def _text(control: object) -> str:
    match control:
        case None:
            return "none"
        case Timeout():
            return f"{control.seconds:g} s, then {control.then} {control.event}".rstrip()
        case Trigger():
            return f"every {control.every_s:g} s" if control.every_s is not None else f"on {control.on}"
        case Repeat():
            times = "" if control.times is None else f"{control.times} times"
            until = "" if control.until is None else f"until {control.until}"
            return ", ".join(filter(None, (times, until))) or "without end"
        case _:
            return str(control)
