"""The flat equivalent: which links it needs, what it is called, what has none; and the counts of §3.7."""

from dataclasses import replace

import pytest

from understudy.errors import NetworkError
from understudy.network import (
    Achieved,
    After,
    AllOf,
    Case,
    Component,
    Edge,
    Happened,
    Holds,
    Link,
    LinkType,
    Nab,
    Network,
    Repeat,
    Timeout,
    Trigger,
    expand_links,
    flattened,
    load_task,
    reduce_links,
    task_path,
)

ORDERING, ENABLING, PERMANENT = LinkType


def link(source: str, target: str, type_: LinkType = ORDERING) -> Link:
    return Link(source=source, target=target, type=type_)


def steps(*ids: str) -> tuple[Component, ...]:
    return tuple(Component(id=id_, behavior="Track") for id_ in ids)


CHAIN = Network(steps("x", "y"), (link("x", "y"),))
OPEN = Network(steps("x", "y"))


def around(inner: Nab, *links: Link, inhibitions: tuple[tuple[str, str], ...] = ()) -> Network:
    before, after = steps("a", "c")
    return Network((before, inner, after), links, inhibitions)


def told(network: Network) -> set[tuple[str, str, str]]:
    return {(link.source, link.target, link.type.value) for link in network.links}


def test_who_waits_for_a_network_waits_for_its_final_steps() -> None:
    flat = flattened(around(Nab.of("n", CHAIN), link("a", "n"), link("n", "c", PERMANENT)))
    assert [component.id for component in flat.components] == ["a", "n.x", "n.y", "c"]
    assert told(flat) == {("a", "n.x", "ordering"), ("n.x", "n.y", "ordering"), ("n.y", "c", "ordering")}
    assert reduce_links(flat) == flat
    assert expand_links(flat).link_count == 6


def test_a_permanent_condition_is_one_of_every_step() -> None:
    flat = flattened(around(Nab.of("n", CHAIN), link("a", "n", PERMANENT)))
    assert {("a", "n.x", "permanent"), ("a", "n.y", "permanent")} < told(flat)


def test_an_enabling_condition_is_one_of_the_first_steps() -> None:
    assert told(flattened(around(Nab.of("n", OPEN), link("a", "n", ENABLING)))) == {
        ("a", "n.x", "enabling"),
        ("a", "n.y", "enabling"),
    }


def test_inhibitions_are_those_of_every_step() -> None:
    flat = flattened(around(Nab.of("n", OPEN), inhibitions=(("a", "n"), ("n", "c"))))
    assert flat.inhibitions == (("a", "n.x"), ("a", "n.y"), ("n.x", "c"), ("n.y", "c"))


def test_conditions_speak_of_the_flat_components() -> None:
    duty = Component(id="d", behavior="Drop", trigger=Trigger(on=Achieved(component="n")))
    watching = replace(CHAIN.components[1], until=Achieved(component="x"))
    inner = Nab.of("n", Network((CHAIN.components[0], watching), CHAIN.links))
    flat = flattened(Network((inner, Nab.of("m", OPEN), replace(duty, until=Achieved(component="m")), duty_free())))
    assert flat.by_id["n.y"].until == Achieved(component="n.x")
    assert flat.by_id["d"].trigger == Trigger(on=Achieved(component="n.y"))
    assert flat.by_id["d"].until == AllOf(of=(Achieved(component="m.x"), Achieved(component="m.y")))


def duty_free() -> Component:
    return Component(id="z", behavior="Drop", timeout=Timeout(seconds=3.0))


@pytest.mark.parametrize(
    ("nab", "message"),
    [
        (Nab(id="n", cases=(Case(network=OPEN, when=Holds(behavior="Drop")),)), "with cases has no flat equivalent"),
        (Nab.of("n", OPEN, repeat=Repeat(times=2)), "with repeat has"),
        (
            replace(Nab.of("n", OPEN), until=Happened(event="e"), timeout=Timeout(seconds=2.0)),
            "with until and timeout has",
        ),
        (replace(Nab.of("n", OPEN), trigger=Trigger(every_s=2.0)), "a duty inside of a network rests"),
        (Nab.of("n", Network(())), "a network without components"),
    ],
)
def test_what_has_no_flat_equivalent(nab: Nab, message: str) -> None:
    with pytest.raises(NetworkError, match=message) as caught:
        flattened(Network((*steps("a"), Nab.of("outer", Network((*steps("b"), nab))))))
    assert caught.value.path == "outer/n"


def test_what_would_mean_something_else_in_a_flat_network() -> None:
    duty = Component(id="d", behavior="Drop", trigger=Trigger(every_s=2.0))
    with pytest.raises(NetworkError, match="a duty inside of a network") as caught:
        flattened(Network((Nab.of("n", Network((*steps("x"), duty))),)))
    assert caught.value.path == "n/d"
    late = replace(OPEN.components[0], until=After(seconds=2.0))
    with pytest.raises(NetworkError, match="'after' counts from the beginning of the network") as caught:
        flattened(Network((Nab.of("n", Network((late,))),)))
    assert caught.value.path == "n/x"
    with pytest.raises(NetworkError, match="inhibit each other") as caught:
        flattened(around(Nab.of("n", OPEN), inhibitions=(("a", "n"), ("n", "a"))))
    assert caught.value.path == "n"


def test_an_enabling_link_to_what_may_begin_twice_is_refused() -> None:
    again = Network(steps("x", "y"), (link("x", "y", PERMANENT),))  # x is done again if it is undone
    with pytest.raises(NetworkError, match="'a' enables it as a whole") as caught:
        flattened(around(Nab.of("n", again), link("a", "n", ENABLING)))
    assert caught.value.path == "n"
    assert flattened(around(Nab.of("n", CHAIN), link("a", "n", ENABLING))).link_count == 2
    stopped = (link("a", "n", ENABLING), link("c", "n", PERMANENT))  # y is begun again if c is undone
    with pytest.raises(NetworkError, match="'a' enables it as a whole"):
        flattened(around(Nab.of("n", CHAIN), *stopped))


def test_two_paths_must_not_become_one_id() -> None:
    with pytest.raises(NetworkError, match=r"two components would be called 'n\.x'"):
        flattened(Network((Nab.of("n", OPEN), *steps("n.x"))))


def test_the_links_of_the_hierarchical_task_are_31_and_60() -> None:
    """§3.7: all links, with one to ``Init`` from every component of every network, in which none is stored here."""
    _, hierarchy = load_task(task_path("hierarchical"))
    flat = flattened(hierarchy)
    to_init = sum(1 for _ in hierarchy.walk()), len(flat.components)
    assert (hierarchy.link_count, flat.link_count) == (8, 12)
    assert reduce_links(flat) == flat
    assert (expand_links(hierarchy).link_count, expand_links(flat).link_count) == (17, 49)
    assert to_init == (14, 11)
    assert (17 + to_init[0], 49 + to_init[1]) == (31, 60)


def test_alternatives_have_no_flat_equivalent() -> None:
    steps_ = (("START", "x"), ("START", "y"), ("x", "END"), ("y", "END"))
    ways = Network(steps("x", "y"), paths=tuple(Edge(source=source, target=target) for source, target in steps_))
    with pytest.raises(NetworkError, match="a network with alternatives has no flat equivalent") as caught:
        flattened(around(Nab.of("n", ways)))
    assert caught.value.path == "n/paths"
    assert flattened(ways) is ways
