"""Networks written in Python: what a document can say, said in other words; and what is refused, where."""

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.execution.strategies import hierarchies
from understudy.behaviors import installed_skills
from understudy.errors import NetworkError, SkillError
from understudy.network import (
    Achieved,
    AllOf,
    AnyOf,
    Component,
    Condition,
    LinkType,
    Nab,
    Network,
    Not,
    Repeat,
    Task,
    TimedOut,
    load_task,
    parse_task,
    task_names,
    task_path,
    task_text,
)
from understudy.network.builder import (
    Part,
    Statement,
    Step,
    achieved,
    all_of,
    any_of,
    any_order,
    build,
    called,
    case,
    choose,
    complete,
    directly,
    do,
    event,
    every,
    holding,
    in_order,
    inhibits,
    named,
    not_,
    part,
    repeat,
    rivals,
    stored,
    switch,
    timed_out,
    until,
    whenever,
    within,
)

from .built import delivery, hierarchical

BUILT = {"hierarchical": hierarchical, "delivery": delivery}


@pytest.mark.parametrize("name", sorted(BUILT.keys() & set(task_names())))
def test_a_bundled_task_reads_the_same(name: str) -> None:
    assert BUILT[name]() == load_task(task_path(name))[1]


@pytest.mark.parametrize("name", sorted(BUILT))
def test_what_is_built_can_be_saved(name: str) -> None:
    network = BUILT[name]()
    document = Task.of(name, network)
    assert document.network() == network
    assert task_text(document).startswith(f"understudy: task/1\nname: {name}\n")


# -- everything that a document says ---------------------------------------------------------------------------


def clause(condition: Condition) -> Any:
    match condition:
        case Achieved():
            return achieved(condition.component)
        case TimedOut():
            return timed_out(condition.component)
        case Not():
            return not_(clause(condition.of))
        case AllOf():
            return all_of(*map(clause, condition.of))
        case AnyOf():
            return any_of(*map(clause, condition.of))
        case _:
            return condition


def controls(of: Component | Nab) -> Iterator[Any]:
    if of.until is not None:
        yield until(clause(of.until))
    if of.timeout is not None:
        yield within(of.timeout.seconds, skip=of.timeout.then == "skip", signal=of.timeout.event)
    if of.trigger is not None and of.trigger.every_s is not None:
        yield every(of.trigger.every_s)
    if of.trigger is not None and of.trigger.on is not None:
        yield whenever(clause(of.trigger.on))
    if isinstance(of, Nab) and of.repeat is not None:
        yield repeat(of.repeat.times, until=clause(of.repeat.until) if of.repeat.until is not None else None)
    if isinstance(of, Nab) and of.task:
        yield called(of.task)


def item(of: Component | Nab) -> Step | Part:
    if isinstance(of, Component):
        return do(of.behavior, named(of.id), *controls(of), **of.parameters)
    whens = [clause(one.when) if one.when is not None else None for one in of.cases]
    if len(of.cases) == 1 and not of.cases[0].name and not of.switches:
        return part(of.id, *controls(of), *statements(of.network), when=whens[0])
    cases = (case(one.name, *statements(one.network), when=when) for one, when in zip(of.cases, whens, strict=True))
    switches = (switch(one.source, one.target, when=clause(one.when)) for one in of.switches)
    return choose(of.id, *cases, *switches, *controls(of))


def statements(network: Network) -> Iterator[Any]:
    items = {of.id: item(of) for of in network.components}
    yield from items.values()
    say: dict[LinkType, Callable[..., Statement]] = dict(zip(LinkType, (in_order, directly, holding), strict=True))
    for link in network.links:
        yield say[link.type](items[link.source], items[link.target])
    for one, other in network.inhibitions:
        yield inhibits(items[one], items[other])


def in_place(network: Network) -> Network:
    """The links in the builder's order, at every depth: by the places of their ends."""
    rank = {of.id: index for index, of in enumerate(network.components)}
    components = tuple(
        of
        if isinstance(of, Component)
        else replace(of, cases=tuple(replace(one, network=in_place(one.network)) for one in of.cases))
        for of in network.components
    )
    links = tuple(sorted(network.links, key=lambda link: (rank[link.source], rank[link.target])))
    return Network(components, links, network.inhibitions)


@given(hierarchies())
def test_every_network_can_be_written(network: Network) -> None:
    assert build(*statements(network)) == in_place(network)


# -- sequences and groups ---------------------------------------------------------------------------------------

Expression = str | tuple[str, tuple[Any, ...]]


def expressions() -> st.SearchStrategy[Expression]:
    leaf = st.sampled_from(("Track", "PickUp", "Drop"))
    return st.recursive(
        leaf,
        lambda inner: st.one_of(
            st.tuples(
                st.sampled_from(("in_order", "directly", "any_order")),
                st.lists(inner, min_size=1, max_size=3).map(tuple),
            ),
            st.tuples(st.just("holding"), st.lists(inner, min_size=2, max_size=3).map(tuple)),
        ),
        max_leaves=8,
    )


def spoken(expression: Expression) -> Step | Statement:
    if isinstance(expression, str):
        return do(expression)
    say: dict[str, Callable[..., Statement]] = {
        "in_order": in_order,
        "directly": directly,
        "any_order": any_order,
        "holding": holding,
    }
    return say[expression[0]](*map(spoken, expression[1]))


class Meant:
    """What an expression means, by its structure: where it begins and ends, and which leaves are linked."""

    def __init__(self, expression: Expression, leaves: list[str]) -> None:
        self.links: dict[tuple[int, int], LinkType] = {}
        if isinstance(expression, str):
            self.all = self.first = self.last = [len(leaves)]
            leaves.append(expression)
            return
        kind, parts = expression[0], [Meant(inner, leaves) for inner in expression[1]]
        self.all = [leaf for inner in parts for leaf in inner.all]
        for inner in parts:
            self.links |= inner.links
        if kind == "any_order":
            self.first = [leaf for inner in parts for leaf in inner.first]
            self.last = [leaf for inner in parts for leaf in inner.last]
        elif kind == "holding":
            held, *body = parts
            self.first = held.first
            self.last = [leaf for inner in body for leaf in inner.last]
            for inner in body:
                self.links |= {(source, target): LinkType.PERMANENT for source in held.last for target in inner.all}
        else:
            type_ = LinkType.ORDERING if kind == "in_order" else LinkType.ENABLING
            self.first, self.last = parts[0].first, parts[-1].last
            for before, after in pairwise(parts):
                self.links |= {(source, target): type_ for source in before.last for target in after.first}


@given(expressions())
def test_statements_mean_what_their_structure_says(expression: Expression) -> None:
    leaves: list[str] = []
    meant = Meant(expression, leaves)
    network = build(spoken(expression))
    assert [of.behavior for of in network.components if isinstance(of, Component)] == leaves
    rank = {of.id: index for index, of in enumerate(network.components)}
    assert {(rank[link.source], rank[link.target]): link.type for link in network.links} == meant.links


def test_ids_are_those_of_a_learned_task() -> None:
    network = build(do("Drop"), do("Track", color="light green", distance_m=0.6), do("Drop"), do("Drop", named("x")))
    assert [of.id for of in network.components] == ["drop-1", "track-light-green-1", "drop-2", "x"]
    assert [of.id for of in build(do("Drop"), do("Drop", named("drop-1"))).components] == ["drop-2", "drop-1"]


def test_a_step_that_was_named_before_can_be_held() -> None:
    box, gate, green, drop = do("PickUp"), do("Track", color="pink"), do("Track", color="green"), do("Drop")
    first = build(in_order(holding(box, in_order(gate, green)), drop))
    assert build(in_order(box, holding(box, gate), holding(box, green), drop)) == first
    assert [(link.source, link.target, str(link.type)) for link in first.links] == [
        ("pick-up-1", "track-pink-1", "permanent"),
        ("pick-up-1", "track-green-1", "permanent"),
        ("track-pink-1", "track-green-1", "ordering"),
        ("track-green-1", "drop-1", "ordering"),
    ]


def test_the_more_restrictive_of_two_links_counts() -> None:
    one, other = do("Track"), do("Drop")
    for said in ((in_order(one, other), directly(one, other)), (directly(one, other), in_order(one, other))):
        assert [link.type for link in build(*said).links] == [LinkType.ENABLING]


def test_a_stored_task_is_a_part_of_its_name() -> None:
    task, network = load_task(task_path("hierarchical"))
    (inner,) = build(part("first", stored("hierarchical"), repeat(2))).components
    assert isinstance(inner, Nab)
    assert (inner.task, inner.network, inner.repeat) == (task.name, network, Repeat(times=2))
    (plain,) = build(part("first", network)).components
    assert isinstance(plain, Nab)
    assert plain.task == ""


def test_conditions_know_steps_and_ids() -> None:
    goal = do("Track", within(9, skip=True), color="green")
    said = in_order(goal, part("rest", do("Drop"), when=not_(timed_out(goal))))
    by_id = in_order(goal, part("rest", do("Drop"), when=not_(timed_out("track-green-1"))))
    document = """{"understudy": "task/1", "name": "x", "components": [
        {"id": "track-green-1", "behavior": "Track", "parameters": {"color": "green"},
         "timeout": {"seconds": 9, "then": "skip"}},
        {"id": "rest", "cases": [{"when": {"not": {"timed_out": "track-green-1"}},
                                  "network": {"components": [{"id": "drop-1", "behavior": "Drop"}]}}]}],
        "links": [{"from": "track-green-1", "to": "rest", "type": "ordering"}]}"""
    assert build(said) == build(by_id) == parse_task(json.loads(document))[1]


# -- what is refused --------------------------------------------------------------------------------------------


def orange() -> Step:
    return do("Track", color="orange")


def circle() -> Statement:
    one, other = orange(), do("Drop")
    return any_order(in_order(one, other), in_order(other, one))


ONE, BOX = orange(), do("PickUp", color="orange")

REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "a step twice": (
        lambda: in_order(ONE, BOX, ONE),
        r"^'Track\(orange\)' stands twice in this order.*write do\(\.\.\.\) again",
    ),
    "a circle": (lambda: build(circle()), "run in a circle: .*needs a second do"),
    "nothing": (build, "^build takes at least one step"),
    "text": (lambda: in_order("Track"), r"given 'Track'; a step is do\('Track', \.\.\.\)"),  # type: ignore[arg-type]
    "a list": (lambda: in_order([ONE]), "given .*; give them one by one"),  # type: ignore[arg-type]
    "a case outside": (lambda: build(case("x", ONE)), r"case\('x', …\); that belongs into"),  # type: ignore[arg-type]
    "a network outside": (lambda: build(build(ONE)), "a network as a whole is a part"),  # type: ignore[arg-type]
    "a number": (lambda: do("Track", 60), "Track: 60 says nothing of a step"),  # type: ignore[arg-type]
    "a parameter of another kind": (lambda: do("Track", color=None), "color must be text or a number, given None"),  # type: ignore[arg-type]
    "no time": (lambda: do("Track", within(0)), "within: a timeout is a positive number"),
    "both": (lambda: within(3, skip=True, signal="x"), "not both"),
    "no period": (lambda: every(-1), "a positive number, given -1"),
    "no round": (lambda: repeat(0), "at least once, a whole number of times, given 0"),
    "twice": (lambda: do("Track", within(3), within(4)), "Track has a second timeout"),
    "a step in a loop": (lambda: do("Track", repeat(3)), "for parts only, and Track is a step"),
    "across a border": (
        lambda: build(part("fetch", in_order(ONE, BOX)), in_order(BOX, do("Drop"))),
        r"^step 'PickUp\(orange\)': it is in part 'fetch' already",
    ),
    "waiting for a duty": (
        lambda: part("fetch", in_order(do("Drop", every(3)), ONE)),
        "^in part 'fetch', step 'Drop', trigger: 'drop-1' is a duty",
    ),
    "a stranger in a condition": (
        lambda: part("fetch", ONE, do("Drop", whenever(achieved(BOX)))),
        r"^in part 'fetch', step 'Drop', whenever: it asks for PickUp\(orange\).*there are: Track\(orange\), Drop",
    ),
    "no timeout": (
        lambda: part("fetch", ONE, do("Drop", until(timed_out(ONE)))),
        "^in part 'fetch', step 'Drop', until: 'track-orange-1' has no timeout",
    ),
    "text for a condition": (lambda: build(do("Drop", until("bell"))), "^step 'Drop', until: a condition is needed"),  # type: ignore[arg-type]
    "an unreachable case": (
        lambda: build(choose("d", case("x", ONE), case("y", BOX))),
        "^part 'd', case 'y': the case 'y' can never be reached",
    ),
    "an unknown case": (
        lambda: build(choose("d", case("x", ONE), switch("x", "z", when=complete()))),
        "^part 'd', .*no case is called 'z'",
    ),
    "a switch that asks for another case": (
        lambda: build(choose("d", case("x", ONE), switch("x", "x", when=achieved(BOX)))),
        r"^part 'd', switch from 'x' to 'x': it asks for PickUp\(orange\).*there are: Track\(orange\)$",
    ),
    "a step for a case": (lambda: choose("d", ONE), "^in part 'd': it takes case"),  # type: ignore[arg-type]
    "no case": (lambda: choose("d"), "^in part 'd': it needs at least one case"),
    "a part in a part": (lambda: part("outer", part("inner", circle())), "^in part 'inner': the links run in a circle"),
    "a case in a part": (lambda: case("a", circle()), "^in case 'a': the links run in a circle"),
    "one id twice": (lambda: build(part("x", ONE), part("x", BOX)), "^part 'x', id: the id 'x' is used twice"),
    "a slash": (lambda: part("a/b", ONE), "an id is text without '/', given 'a/b'"),
    "holding itself": (lambda: holding(BOX, BOX), "cannot be done while it is held itself"),
    "a rival alone": (lambda: rivals(ONE), "at least two different steps"),
    "an unknown task": (lambda: stored("nothing"), "no such task among: .*hierarchical"),
    "a nameless event": (lambda: event(""), "an event needs a name"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused(name: str) -> None:
    call, message = REFUSED[name]
    with pytest.raises(NetworkError, match=message):
        call()


def test_a_skill_checks_its_parameters_at_once() -> None:
    track = installed_skills()["Track"]
    assert do(track, color="orange").behavior == "Track"
    with pytest.raises(SkillError, match="Track has no parameter 'colour'; it takes color"):
        do(track, colour="orange")
