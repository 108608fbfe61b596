"""What tells two networks apart, and networks with one link changed."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.execution.strategies import hierarchies
from understudy.errors import NetworkError
from understudy.network import (
    Achieved,
    Case,
    Component,
    Happened,
    Link,
    LinkType,
    Nab,
    Network,
    Repeat,
    Switch,
    Timeout,
    Trigger,
    differences,
    edited,
    expand_links,
    relinked,
)

A, B = Component(id="a", behavior="Track", parameters={"color": "red"}), Component(id="b", behavior="Drop")
AB = Link(source="a", target="b", type=LinkType.ENABLING)
FLAT = Network((A, B), (AB,))
GATE = Nab(
    id="gate", cases=(Case(name="wide", network=FLAT, when=Happened(event="go")), Case(name="any", network=FLAT))
)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (FLAT, Network((A,)), ("b is gone", "the enabling link a -> b is gone")),
        (Network((A,)), Network((A, B)), ("b (Drop) is new",)),
        (Network((A, B)), FLAT, ("the enabling link a -> b is new",)),
        (FLAT, relinked(FLAT, "a", "b", LinkType.ORDERING), ("the link a -> b is ordering, and was enabling",)),
        (Network((A,)), Network((replace(A, behavior="PickUp"),)), ("a is PickUp, and was Track",)),
        (
            Network((A,)),
            Network((replace(A, parameters={"color": "pink", "angle_deg": 90.0}),)),
            ("angle_deg of a is 90.0, and was left out", "color of a is pink, and was red"),
        ),
        (
            Network((A, B)),
            Network((B, A)),
            ("the components stand in another order, b the first of them; the order settles ties",),
        ),
        (Network((A, B), (), (("a", "b"),)), Network((A, B)), ("a does not inhibit b any more",)),
        (Network((A, B)), Network((A, B), (), (("a", "b"),)), ("a inhibits b now",)),
        (
            Network((A, B)),
            Network((replace(A, timeout=Timeout(seconds=5, then="skip")), replace(B, trigger=Trigger(every_s=9)))),
            ("the timeout of a is 5 s, then skip, and was none", "the trigger of b is every 9 s, and was none"),
        ),
        (
            Network((A, B)),
            Network((replace(A, until=Achieved(component="b")), B)),
            ("the end of a is achieved b, and was none",),
        ),
        (Network((Nab.of("a", FLAT),)), Network((A,)), ("a is Track, and was a network",)),
        (
            Network((Nab.of("n", FLAT),)),
            Network((Nab.of("n", FLAT, repeat=Repeat(times=2)),)),
            ("the loop of n is 2 times, and was none",),
        ),
        (
            Network((GATE,)),
            Network((relinked(Network((GATE,)), "gate/any/a", "gate/any/b", None).components[0],)),
            ("the enabling link gate/any/a -> gate/any/b is gone",),
        ),
        (
            Network((GATE,)),
            Network((replace(GATE, switches=(Switch(source="any", target="wide", when=Happened(event="go")),)),)),
            ("the switches of gate are any -> wide when event go, and were none",),
        ),
        (
            Network((GATE,)),
            Network((replace(GATE, cases=(replace(GATE.cases[0], when=Happened(event="now")), GATE.cases[1])),)),
            ("gate/wide is begun if event now, and was if event go",),
        ),
        (
            Network((GATE,)),
            Network((replace(GATE, cases=(Case(network=FLAT),)),)),
            ("the cases of gate are the only one, and were wide, any",),
        ),
    ],
)
def test_every_difference_has_a_sentence(old: Network, new: Network, told: tuple[str, ...]) -> None:
    assert differences(old, new) == told
    assert differences(new, old)


@given(hierarchies(), hierarchies())
def test_only_equal_networks_have_no_difference(one: Network, other: Network) -> None:
    assert differences(one, one) == ()
    assert (differences(one, other) == ()) is (_plain(one) == _plain(other))


def _plain(network: Network) -> object:
    """Everything that is executed, links and inhibitions in any order."""
    parts = tuple(
        part
        if isinstance(part, Component)
        else (replace(part, cases=(), task=""), [(case.name, case.when, _plain(case.network)) for case in part.cases])
        for part in network.components
    )
    links = {(link.source, link.target, link.type) for link in network.links}
    ways = {(edge.source, edge.target) for edge in network.paths}
    return parts, links, set(network.inhibitions), ways


@given(hierarchies(), st.data())
def test_one_link_is_changed_and_nothing_else(network: Network, data: st.DataObject) -> None:
    """Of the full set: whoever came before another over the changed link still does, if only in order."""
    full = expand_links(network)
    links = [
        (inside + link.source, inside + link.target, link.type)
        for path in full.by_path
        for inside, home in [full.home_of(path)]
        for link in home.incoming[path[len(inside) :]]
    ]
    if not links:
        return
    source, target, type_ = data.draw(st.sampled_from(links))
    new = data.draw(st.sampled_from([None, *LinkType]))
    told = set(differences(full, expand_links(relinked(network, source, target, new))))
    gone = f"the {type_.value} link {source} -> {target} is gone"
    changed = f"the link {source} -> {target} is {new}, and was {type_}"
    # What a longer way implies cannot be taken out alone.
    implied = (
        {f"the link {source} -> {target} is ordering, and was {type_}"} if type_ is not LinkType.ORDERING else set()
    )
    assert told in ([set()] if new is type_ else [{gone}, implied] if new is None else [{changed}])


@given(hierarchies())
def test_home_is_where_a_component_stands(network: Network) -> None:
    for path, part in network.walk():
        inside, home = network.home_of(path)
        assert path == inside + part.id
        assert home.by_id[part.id] is part
        assert edited(network, inside, lambda same: same) == network
    with pytest.raises(KeyError):
        network.home_of("nowhere/at/all")
    with pytest.raises(KeyError):
        edited(network, "nowhere/", lambda same: same)


def test_a_link_that_is_not_there_is_refused_with_those_that_are() -> None:
    with pytest.raises(NetworkError, match=r"no link b -> a; to a lead: none"):
        relinked(FLAT, "b", "a", LinkType.ORDERING)
    with pytest.raises(NetworkError, match=r"no link c -> b; to b lead: a -> b"):
        relinked(FLAT, "c", "b", LinkType.ORDERING)
    with pytest.raises(NetworkError, match=r"'c'; there are: a, b"):
        relinked(FLAT, "a", "c", LinkType.ORDERING)
