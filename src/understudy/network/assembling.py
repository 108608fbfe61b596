"""From statements to the network that they describe; and the place in words for whatever is wrong with it."""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from understudy.behaviors import Instance
from understudy.errors import NetworkError
from understudy.network.clauses import Clause, settled
from understudy.network.conditions import Condition
from understudy.network.controls import Repeat, Switch, Trigger
from understudy.network.definition import Case, Component, Link, Nab, Network
from understudy.network.naming import component_ids
from understudy.network.statements import Item, Part, Statement, Step, together

__all__ = ["Assembled", "assembled"]

_PLACE = re.compile(r"(components|links|inhibitions)\[(\d+)\]")
_CASE = re.compile(r"cases\[(\d+)\]")


@dataclass(frozen=True, slots=True)
class Assembled:
    """A network, with the id of every step that was given for it."""

    network: Network
    ids: Mapping[Item, str]


def assembled(said: Iterable[object], *, where: str, place: str = "") -> Assembled:
    """The network of statements.

    Args:
        said: steps, parts, statements.
        where: the call in which they stand, for messages.
        place: what the network is called in messages; empty for the whole task.

    Raises:
        NetworkError: they describe none; the error's path says where, in the words of who wrote them.
    """
    try:
        return _assembled(together(said, where))
    except NetworkError as error:
        raise NetworkError(error.problem, path=", ".join(filter(None, (place, error.path)))) from None


def _assembled(whole: Statement) -> Assembled:
    _check_borders(whole)
    ids = _ids(whole.items)
    rank = {item: index for index, item in enumerate(whole.items)}
    components = tuple(_component(item, ids) for item in whole.items)
    links = tuple(
        Link(source=ids[source], target=ids[target], type=type_)
        for source, target, type_ in sorted(whole.links, key=lambda link: (rank[link[0]], rank[link[1]]))
    )
    rivals = tuple((ids[one], ids[other]) for one, other in whole.rivals)
    try:
        return Assembled(Network(components, links, rivals), ids)
    except NetworkError as error:
        again = "" if error.path != "links" else "; who is to be done twice needs a second do(...)"
        raise NetworkError(error.problem + again, path=_in_words(error.path, whole.items, links)) from None


def _check_borders(whole: Statement) -> None:
    for part in (item for item in whole.items if isinstance(item, Part)):
        inside = part.inside
        for item in whole.items:
            if item in inside:
                raise NetworkError(
                    f"it is in part {part.id!r} already, and no link crosses the border of a part; speak of the part "
                    "itself, or make another step with do(...)",
                    path=_label(item),
                )


def _ids(items: Iterable[Item]) -> dict[Item, str]:
    """The given ids; for the others those that a learned task would have."""
    ids: dict[Item, str] = {}
    nameless: list[Step] = []
    for item in items:
        given = item.id if isinstance(item, Part) else item.controls.id
        ids[item] = given or ""  # keeps the order
        if isinstance(item, Step) and given is None:
            nameless.append(item)
    made = component_ids(map(_instance, nameless), taken=set(ids.values()))
    for step, id_ in zip(nameless, made, strict=True):
        ids[step] = id_
    return ids


def _instance(step: Step) -> Instance:
    words = tuple((name, value) for name, value in step.parameters.items() if isinstance(value, str))
    return Instance(step.behavior, words)


def _component(item: Item, ids: Mapping[Item, str]) -> Component | Nab:
    def so(clause: Clause | Condition | None, what: str, known: Mapping[Item, str] = ids) -> Condition | None:
        return None if clause is None else _settled(clause, known, f"{_label(item)}, {what}")

    controls = item.controls
    ending = so(controls.until, "until")
    duty = None
    if isinstance(controls.trigger, float):
        duty = Trigger(every_s=controls.trigger)
    elif controls.trigger is not None:
        duty = Trigger(on=so(controls.trigger, "whenever"))
    if isinstance(item, Step):
        return Component(
            id=ids[item],
            behavior=item.behavior,
            parameters=item.parameters,
            until=ending,
            timeout=controls.timeout,
            trigger=duty,
        )
    loop = controls.repeat
    inside = {case.name: case.ids for case in item.cases}
    return Nab(
        id=ids[item],
        cases=tuple(
            Case(name=case.name, network=case.network, when=so(case.when, f"{case.name or 'its'} when"))
            for case in item.cases
        ),
        switches=tuple(
            Switch(
                source=switch.source,
                target=switch.target,
                when=_settled(
                    switch.when,
                    inside.get(switch.source, {}),
                    f"{_label(item)}, switch from {switch.source!r} to {switch.target!r}",
                ),
            )
            for switch in item.switches
        ),
        repeat=None if loop is None else Repeat(times=loop.times, until=so(loop.until, "repeat until")),
        task=controls.name or "",
        until=ending,
        timeout=controls.timeout,
        trigger=duty,
    )


def _settled(clause: Clause | Condition, ids: Mapping[Item, str], path: str) -> Condition:
    def id_of(step: object) -> str:
        if isinstance(step, str):
            return step
        for item, id_ in ids.items():
            if item is step:
                return id_
        known = ", ".join(map(str, ids)) or "none"
        raise NetworkError(f"it asks for {step!s:.60}, which is no step of that network; there are: {known}", path=path)

    try:
        return settled(clause, id_of)
    except NetworkError as error:
        raise NetworkError(error.problem, path=path) from None


def _label(item: Item) -> str:
    return f"part {item.id!r}" if isinstance(item, Part) else f"step {str(item)!r}"


def _in_words(path: str, items: tuple[Item, ...], links: tuple[Link, ...]) -> str:
    """``components[2].until`` as ``step 'Track(green)', until``."""
    found = _PLACE.match(path)
    if found is None:
        return "" if path in ("links", "components") else path
    kind, index = found[1], int(found[2])
    rest = path[found.end() :]
    if kind == "components":
        item = items[index]
        words = _label(item)
        if isinstance(item, Part):
            rest = _CASE.sub(lambda case: f"case {item.cases[int(case[1])].name!r}", rest)
    else:
        words = f"the link from {links[index].source!r} to {links[index].target!r}" if kind == "links" else "rivals"
        rest = ""
    return ", ".join(filter(None, (words, *rest.split("."))))
