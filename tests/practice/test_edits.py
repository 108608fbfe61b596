"""Steps taken out and pieces put in: what stays, and what comes before what."""

from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.execution.strategies import networks
from understudy.errors import NetworkError
from understudy.network import END, Achieved, Case, Component, Edge, Happened, Link, LinkType, Nab, Network, Trigger
from understudy.practice import inserted, without


def before(network: Network) -> set[tuple[str, str]]:
    """Which components come before which, over any number of links."""
    pairs = {(link.source, link.target) for link in network.links}
    while more := {(a, d) for a, b in pairs for c, d in pairs if b == c} - pairs:
        pairs |= more
    return pairs


def strong(network: Network) -> set[tuple[str, str, LinkType]]:
    """The links that say more than an order."""
    return {(link.source, link.target, link.type) for link in network.links if link.type is not LinkType.ORDERING}


@given(networks(), st.data())
def test_without_a_step_everything_else_is_as_it_was(network: Network, data: st.DataObject) -> None:
    assume(len(network.components) > 1)
    gone = data.draw(st.sampled_from(sorted(network.by_id)))
    left = without(network, gone)
    assert [part for part in network.components if part.id != gone] == list(left.components)
    assert before(left) == {pair for pair in before(network) if gone not in pair}
    assert strong(left) == {link for link in strong(network) if gone not in link}
    assert set(left.inhibitions) == {pair for pair in network.inhibitions if gone not in pair}


@given(networks(), networks(max_components=3), st.data())
def test_a_piece_stands_where_the_step_stood(network: Network, piece: Network, data: st.DataObject) -> None:
    step = data.draw(st.sampled_from(sorted(network.by_id)))
    result = inserted(network, step, piece)
    new = [part.id for part in result.components if part.id not in network.by_id]
    assert len(new) == len(piece.components)
    names = dict(zip([part.id for part in piece.components], new, strict=True))
    order = before(result)
    old = {pair for pair in order if not set(pair) & set(new)}
    assert old == before(network)
    assert {pair for pair in order if set(pair) <= set(new)} == {(names[a], names[b]) for a, b in before(piece)}
    for id_ in new:
        assert (id_, step) in order
    for source, target in before(network):
        if target == step:
            assert all((source, id_) in order for id_ in new)

    # Nothing leads around the piece but what has to hold all the while, and that holds in the piece, too.
    entering = {link.source: link.type for link in result.incoming[step] if link.source not in new}
    lasting = {link.source for link in network.incoming[step] if link.type is LinkType.PERMANENT}
    assert entering == dict.fromkeys(lasting, LinkType.PERMANENT)
    for source in lasting:
        assert all((source, id_, LinkType.PERMANENT) in strong(result) for id_ in new)
    within = {(a, b, kind) for a, b, kind in strong(result) if {a, b} <= set(new)}
    assert within == {(names[a], names[b], kind) for a, b, kind in strong(piece)}
    elsewhere = {link for link in strong(network) if link[1] != step}
    assert {link for link in strong(result) if link[1] != step and not set(link[:2]) & set(new)} == elsewhere


TRACK = Network((Component(id="track-green-1", behavior="Track", parameters={"color": "green"}),))
TASK = Network(
    (*TRACK.components, Component(id="drop-1", behavior="Drop")),
    (Link(source="track-green-1", target="drop-1", type=LinkType.ENABLING),),
)


def test_new_steps_get_the_next_free_number() -> None:
    assert [part.id for part in inserted(TASK, "drop-1", TRACK).components] == [
        "track-green-1",
        "track-green-2",
        "drop-1",
    ]


def test_steps_of_a_network_in_a_step() -> None:
    nested = Network((Nab.of("part", TASK), Component(id="last", behavior="Drop")))
    assert list(without(nested, "part/track-green-1").by_path) == ["part", "part/drop-1", "last"]
    alone = Network((Nab.of("part", TRACK), *TASK.components[1:]))
    assert list(without(alone, "part/track-green-1").by_path) == ["drop-1"]
    longer = inserted(nested, "part/drop-1", TRACK)
    assert list(longer.by_path) == ["part", "part/track-green-1", "part/track-green-2", "part/drop-1", "last"]


def test_what_cannot_be_is_refused() -> None:
    with pytest.raises(NetworkError, match=r"'track-green-1' is the only step of the task"):
        without(TRACK, "track-green-1")
    nested = Network((Nab.of("part", TRACK),))
    with pytest.raises(NetworkError, match=r"'part' is the only step of the task"):
        without(nested, "part/track-green-1")
    cases = (Case(name="one", network=TRACK, when=Happened(event="go")), Case(name="other", network=TASK))
    with pytest.raises(NetworkError, match=r"the only step of the case 'part/one'"):
        without(Network((Nab(id="part", cases=cases),)), "part/one/track-green-1")
    with pytest.raises(NetworkError, match=r"no step is called 'x'; there are: track-green-1, drop-1"):
        without(TASK, "x")
    asked = Network((*TRACK.components, Component(id="b", behavior="Drop", until=Achieved(component="track-green-1"))))
    with pytest.raises(NetworkError, match="no component of this network is called 'track-green-1'"):
        without(asked, "track-green-1")


def with_alternatives() -> Network:
    """Either a or b, then c, and x on a way that is bypassed; d at the end."""
    steps = (
        ("START", "a", "1"), ("START", "b", "2"), ("a", "c", "1"), ("b", "c", "2"),
        ("c", "x", "1"), ("c", "d", "2"), ("x", "d", "1"), ("d", "END", "12"),
    )  # fmt: skip
    return Network(
        tuple(Component(id=id_, behavior="A") for id_ in "abcxd"),
        (Link(source="c", target="d", type=LinkType.PERMANENT),),
        paths=tuple(Edge(source=source, target=target, shown=tuple(shown)) for source, target, shown in steps),
    )


def test_a_step_is_taken_out_of_the_ways() -> None:
    task = without(with_alternatives(), "c")
    assert {(edge.source, edge.target): edge.shown for edge in task.paths} == {
        ("START", "a"): ("1",), ("START", "b"): ("2",), ("a", "x"): ("1",), ("a", "d"): (), ("b", "x"): (),
        ("b", "d"): ("2",), ("x", "d"): ("1",), ("d", "END"): ("1", "2"),
    }  # fmt: skip
    assert task.topology.bypassed == ("x",)
    assert not task.links
    assert without(with_alternatives(), "a").topology.candidates["START"] == ("b",)


def test_what_is_put_in_has_no_way_around_it() -> None:
    """§6.3.3: a new step before the last one of a generalised task."""
    piece = Network((Component(id="n", behavior="A"), Component(id="m", behavior="A")))
    task = inserted(with_alternatives(), "d", piece)
    topology = task.topology
    assert topology.candidates["c"] == ("n",)
    assert topology.candidates["n"] == ("m",)
    assert topology.candidates["m"] == ("d",)
    assert topology.bypassed == ("x",)
    assert topology.shown_by["n"] == ("1", "2")
    assert {(link.source, link.target) for link in task.links} == {("c", "d"), ("c", "n"), ("c", "m")}


def test_a_direct_way_is_closed_where_the_task_knows_what_is_shown() -> None:
    """§5.2: a transition that feedback marks as wrong. No second step is made of what was there and passed by."""
    shown = Network((Component(id="seen", behavior="B"),))
    parts = tuple(replace(part, behavior="B") if part.id == "x" else part for part in with_alternatives().components)
    links = (*with_alternatives().links, Link(source="b", target="d", type=LinkType.ENABLING))
    task = inserted(replace(with_alternatives(), components=parts, links=links), "d", shown)
    assert [part.id for part in task.components] == list("abcxd")
    assert {(edge.source, edge.target): edge.shown for edge in task.paths} == {
        ("START", "a"): ("1",), ("START", "b"): ("2",), ("a", "c"): ("1",), ("b", "c"): ("2",),
        ("c", "x"): ("1", "2"), ("x", "d"): ("1", "2"), ("d", "END"): ("1", "2"),
    }  # fmt: skip
    assert not task.topology.bypassed
    assert {(link.source, link.target): link.type for link in task.links} == dict.fromkeys(
        [("c", "d"), ("c", "x")], LinkType.PERMANENT
    )


def test_only_what_was_passed_by_is_known() -> None:
    """An alternative that can be taken is no way around anything: what is shown is done in any case, then."""
    piece = Network((Component(id="seen", behavior="A"),))
    task = inserted(with_alternatives(), "c", piece)
    assert task.topology.candidates["a"] == task.topology.candidates["b"] == ("seen",)
    assert len(inserted(with_alternatives(), "d", visits("AA")).components) == 7


def test_a_piece_after_everything_else() -> None:
    task = inserted(TASK, END, TRACK)
    assert [part.id for part in task.components] == ["track-green-1", "drop-1", "track-green-2"]
    assert task.sinks == ("track-green-2",)
    assert before(task) == {
        ("track-green-1", "drop-1"),
        ("track-green-1", "track-green-2"),
        ("drop-1", "track-green-2"),
    }
    ways = inserted(with_alternatives(), END, TRACK)
    assert ways.topology.candidates["d"] == ("track-green-1",)
    assert ways.topology.candidates["track-green-1"] == (END,)
    on_duty = replace(TASK.components[1], id="bell", trigger=Trigger(every_s=5.0))
    assert inserted(Network((*TASK.components, on_duty), TASK.links), END, TRACK).sinks == ("track-green-2",)


def visits(letters: str) -> Network:
    """A task that does one after the other: a number is added to every letter."""
    ids = [f"{letter}-{letters[: index + 1].count(letter)}" for index, letter in enumerate(letters)]
    steps = tuple(Component(id=id_, behavior=id_[0]) for id_ in ids)
    links = tuple(Link(source=a, target=b, type=LinkType.ORDERING) for a, b in pairwise(ids))
    return Network(steps, links)


def letters(network: Network) -> str:
    return "".join(network.by_id[id_].behavior for id_ in network.topological_order)  # type: ignore[union-attr]


def test_the_two_mistakes_that_look_alike() -> None:
    """A C B A was meant, and B is done after A (§6.1): each has its word, and a wrong guess takes more words."""
    assert letters(without(visits("ABCBA"), "B-1")) == "ACBA"
    assert letters(inserted(visits("ABA"), "B-1", visits("C"))) == "ACBA"

    guessed = without(visits("ABA"), "B-1")
    assert letters(guessed) == "AA"
    assert letters(inserted(guessed, "A-2", visits("CB"))) == "ACBA"
    guessed = inserted(visits("ABCBA"), "B-1", visits("C"))
    assert letters(guessed) == "ACBCBA"
    assert letters(without(without(guessed, "C-1"), "B-2")) == "ACBA"
