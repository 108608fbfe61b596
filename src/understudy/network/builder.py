"""Networks written in Python, so that they read like the task (§3.4).

Steps are values: ``do("PickUp", color="orange")``. Statements say how they belong together, and are made of steps,
parts and other statements: :func:`in_order`, :func:`directly`, :func:`any_order`, :func:`holding`. ``build`` makes the
network of them::

    box = do("PickUp", color="orange")
    carry = build(
        directly(
            do("Drop"),
            do("Track", color="green"),
            holding(box, in_order(do("Track", color="yellow"), do("Track", color="pink"))),
            do("Drop"),
        )
    )

A step is the object: wherever ``box`` stands, this picking up is meant, and a second ``do`` is a second step. What is
wrong is refused in the call in which it is said: a part is checked by ``part``, the whole by ``build``.

A learned task's evidence is not said here; it comes from demonstrations only.
"""

from collections.abc import Iterable
from pathlib import Path

from understudy.behaviors import Skill
from understudy.errors import NetworkError
from understudy.network.assembling import Assembled, assembled
from understudy.network.bundled import find_task
from understudy.network.clauses import (
    Clause,
    achieved,
    after,
    all_of,
    any_of,
    complete,
    event,
    given_behavior,
    holds,
    not_,
    possible,
    timed_out,
)
from understudy.network.conditions import Condition, ParameterValue
from understudy.network.definition import LinkType, Network
from understudy.network.document import load_task
from understudy.network.statements import (
    Controls,
    Item,
    Part,
    PartCase,
    PartSwitch,
    Statement,
    Step,
    Stored,
    called,
    every,
    named,
    repeat,
    statement,
    together,
    until,
    whenever,
    within,
)

__all__ = [
    "Part",
    "Statement",
    "Step",
    "achieved",
    "after",
    "all_of",
    "any_of",
    "any_order",
    "build",
    "called",
    "case",
    "choose",
    "complete",
    "directly",
    "do",
    "event",
    "every",
    "holding",
    "holds",
    "in_order",
    "inhibits",
    "named",
    "not_",
    "part",
    "possible",
    "repeat",
    "rivals",
    "stored",
    "switch",
    "timed_out",
    "until",
    "whenever",
    "within",
]


def do(behavior: str | Skill, /, *controls: Controls, **parameters: ParameterValue) -> Step:
    """A step: one use of a behavior.

    Args:
        behavior: a skill, which then checks the parameters at once; or the name of one.
        controls: :func:`named`, :func:`within`, :func:`until`, :func:`every`, :func:`whenever`.
        parameters: of the skill; missing ones take its defaults.

    Raises:
        NetworkError: something is none of these.
        SkillError: the skill does not take these parameters.
    """
    name, values = given_behavior(behavior, parameters)
    asked = Controls.all_of(controls, name)
    for field, what in ((asked.repeat, "repeat(...)"), (asked.name, "called(...)")):
        if field is not None:
            raise NetworkError(f"{what} is for parts only, and {name} is a step; put it into part(...)")
    return Step(behavior=name, parameters=values, controls=asked)


def in_order(*said: Step | Part | Statement) -> Statement:
    """One after the other: each begins when the one before has been achieved (ordering links)."""
    return _sequence(LinkType.ORDERING, said, "in_order")


def directly(*said: Step | Part | Statement) -> Statement:
    """One directly after the other: each begins while what the one before achieved still holds (enabling links)."""
    return _sequence(LinkType.ENABLING, said, "directly")


def any_order(*said: Step | Part | Statement) -> Statement:
    """All of them, as the robot comes across them."""
    return together(said, "any_order")


def holding(held: Step | Part | Statement, *said: Step | Part | Statement) -> Statement:
    """First the one; then all the others, in any order, while what it achieved holds (permanent links).

    If it gets lost, the first one is done again. The first one may have been named before: after ``box`` has stood in a
    sequence, ``holding(box, home)`` goes on with ``home``.
    """
    first, body = statement(held, "holding"), together(said, "holding")
    for item in body.items:
        if item in first.items:
            raise NetworkError(f"'{item}' cannot be done while it is held itself; name another step")
    links = tuple((source, target, LinkType.PERMANENT) for source in first.last for target in body.items)
    return together((first, body, Statement(items=first.items + body.items, links=links)), "holding")


def rivals(*items: Step | Part) -> Statement:
    """While one of them executes, the others keep still."""
    pairs = tuple((one, other) for one in items for other in items if one is not other)
    if not pairs:
        raise NetworkError("rivals takes at least two different steps")
    return _inhibiting("rivals", items, pairs)


def inhibits(rival: Step | Part, *others: Step | Part) -> Statement:
    """While the first one executes, the others keep still."""
    if not others:
        raise NetworkError("inhibits takes a step, and those that it keeps still")
    return _inhibiting("inhibits", (rival, *others), tuple((rival, other) for other in others))


def part(
    id_: str, /, *said: Step | Part | Statement | Network | Stored | Controls, when: Clause | Condition | None = None
) -> Part:
    """A network in a step's place.

    Args:
        id_: what it is called.
        said: its steps, parts and statements, or one network or :func:`stored` task; and controls: :func:`called`,
            :func:`repeat`, :func:`within`, :func:`until`, :func:`every`, :func:`whenever`.
        when: it is done only if this is so when its turn comes.

    Raises:
        NetworkError: what is said describes no network; the path begins with this part.
    """
    place = f"in part {id_!r}"
    controls = [one for one in said if isinstance(one, Controls)]
    contents = [one for one in said if not isinstance(one, Controls)]
    if len(contents) == 1 and isinstance(contents[0], Stored):
        controls.append(called(contents[0].name))
    inside = _inside(contents, "part", place)
    only = PartCase(name="", network=inside.network, ids=inside.ids, when=when)
    return _part(id_, (only,), (), controls, place)


def choose(id_: str, /, *said: PartCase | PartSwitch | Controls) -> Part:
    """A part that is one of several networks: the first :func:`case` of which ``when`` is so, until a :func:`switch`.

    Args:
        id_: what it is called.
        said: cases and switches; and controls as for :func:`part`.

    Raises:
        NetworkError: there is no case, or something is none of these.
    """
    for one in said:
        if not isinstance(one, PartCase | PartSwitch | Controls):
            raise NetworkError(
                f"it takes case(...) and switch(...), given {one!r:.60}; put steps into a case", path=f"in part {id_!r}"
            )
    cases = tuple(one for one in said if isinstance(one, PartCase))
    switches = tuple(one for one in said if isinstance(one, PartSwitch))
    return _part(id_, cases, switches, [one for one in said if isinstance(one, Controls)], f"in part {id_!r}")


def case(
    name: str, /, *said: Step | Part | Statement | Network | Stored, when: Clause | Condition | None = None
) -> PartCase:
    """One of the networks of :func:`choose`.

    Args:
        name: unique among its cases.
        said: its steps, parts and statements, or one network or :func:`stored` task.
        when: asked when the part begins; always so if left out.

    Raises:
        NetworkError: what is said describes no network; the path begins with this case.
    """
    inside = _inside(said, "case", f"in case {name!r}")
    return PartCase(name=name, network=inside.network, ids=inside.ids, when=when)


def switch(source: str, target: str, *, when: Clause | Condition) -> PartSwitch:
    """While the case ``source`` is executed and ``when`` is so, the case ``target`` is begun anew."""
    return PartSwitch(source=source, target=target, when=when)


def stored(name: str | Path) -> Stored:
    """A task from its document, or one that comes with the program by its name, to stand in a part or a case.

    Raises:
        NetworkError: there is none, or it is malformed.
    """
    task, network = load_task(find_task(name))
    return Stored(name=task.name, network=network)


def build(*said: Step | Part | Statement) -> Network:
    """The network of a task. Its components stand in the order in which they are first named.

    Raises:
        NetworkError: what is said describes none; the message names the step or link.
    """
    return assembled(said, where="build").network


def _sequence(type_: LinkType, said: tuple[Step | Part | Statement, ...], where: str) -> Statement:
    done: dict[Item, None] = {}
    steps: list[Statement] = []
    before: tuple[Item, ...] = ()
    for one in (statement(one, where) for one in said):
        for item in one.last:
            if item in done:
                raise NetworkError(
                    f"'{item}' stands twice in this order, and a step is done once; for another one write do(...) again"
                )
        fresh = one.without(done)
        links = tuple((source, target, type_) for source in before for target in fresh.first)
        steps += [one, Statement(items=before + fresh.first, links=links)]
        before = fresh.last
        done |= dict.fromkeys(one.items)
    return together(steps, where)


def _inhibiting(where: str, items: tuple[Item, ...], pairs: tuple[tuple[Item, Item], ...]) -> Statement:
    for item in items:
        if not isinstance(item, Step | Part):
            raise NetworkError(f"{where} takes steps and parts, given {item!r:.60}")
    return Statement(items=tuple(dict.fromkeys(items)), rivals=pairs)


def _inside(said: Iterable[object], where: str, place: str) -> Assembled:
    contents = tuple(said)
    if len(contents) == 1 and isinstance(contents[0], Network | Stored):
        only = contents[0]
        return Assembled(only.network if isinstance(only, Stored) else only, {})
    return assembled(contents, where=where, place=place)


def _part(
    id_: str, cases: tuple[PartCase, ...], switches: tuple[PartSwitch, ...], controls: list[Controls], place: str
) -> Part:
    named(id_)
    asked = Controls.all_of(controls, place)
    if asked.id is not None:
        raise NetworkError(f"a part is called by its first argument; take named({asked.id!r}) out", path=place)
    if not cases:
        raise NetworkError("it needs at least one case(...)", path=place)
    return Part(id=id_, cases=cases, switches=switches, controls=asked)
