"""Many demonstrations at once: the same as one after the other, by the slow way."""

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from understudy.generalization import Merger, generalize
from understudy.generalization.values import typical
from understudy.network import Component, LinkType, Network

from . import reference
from .words import learned

LINKS = st.dictionaries(
    st.tuples(st.integers(0, 4), st.integers(0, 4)).filter(lambda pair: pair[0] < pair[1]),
    st.sampled_from(list(LinkType)),
    max_size=4,
)
VALUES = st.dictionaries(st.sampled_from(["x", "y"]), st.integers(0, 3).map(float), max_size=2)


@st.composite
def demonstrations(draw: st.DrawFn) -> list[Network]:
    """Demonstrations with links, numbers, and at times without an order between two steps."""
    found = []
    for number in range(1, draw(st.integers(2, 6)) + 1):
        word = draw(st.lists(st.sampled_from("ABC"), min_size=1, max_size=6))
        types = {pair: type_ for pair, type_ in draw(LINKS).items() if pair[1] < len(word)}
        network = learned(draw(st.sampled_from(["d", f"d{number}"])), " ".join(word), types)
        if draw(st.booleans()):
            network = replace(network, links=network.links[draw(st.integers(0, 2)) :])
        numbers = draw(st.one_of(st.just({}), VALUES))
        parts = []
        for part in network.components:
            assert isinstance(part, Component)
            values = draw(st.one_of(st.just(numbers), VALUES))
            occurrences = tuple(replace(one, values=values) for one in part.occurrences)
            parts.append(replace(part, parameters=dict(values), occurrences=occurrences))
        found.append(replace(network, components=tuple(parts)))
    return found


@settings(max_examples=200)
@given(demonstrations())
def test_a_merger_does_what_one_after_the_other_does(networks: list[Network]) -> None:
    slow, *others = networks
    merger = Merger(slow)
    fast = slow
    for network in others:
        slow = reference.generalize(slow, network)
        fast = generalize(fast, network).network
        merger.add(network)
        assert merger.network() == slow
        assert fast == slow


@given(st.lists(VALUES, max_size=8))
def test_typical_values_are_those_of_the_definition(shown: list[dict[str, float]]) -> None:
    assert typical(shown) == reference.typical(shown)


def test_the_network_at_the_end_is_all_that_is_needed() -> None:
    words = ["A B C", "A C B", "B A C", "A B B C"]
    merger = Merger(learned("d1", words[0]))
    task = learned("d1", words[0])
    for number, word in enumerate(words[1:], start=2):
        merger.add(learned(f"d{number}", word))
        task = reference.generalize(task, learned(f"d{number}", word))
    assert merger.network() == task
