"""A free order: against its definition step by step, and what it must keep."""

from itertools import permutations
from math import log

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from understudy.errors import LearningError
from understudy.generalization import free_order, generalize
from understudy.generalization.explaining import COST, SLIP, WORTH_IT, covers, explaining_order
from understudy.language import Language
from understudy.network import LinkType, Network, expand_links, reduce_links

from .words import learned

ORDERING, ENABLING, PERMANENT = LinkType.ORDERING, LinkType.ENABLING, LinkType.PERMANENT

Order = NDArray[np.bool_]


def of_words(*words: str) -> list[Network]:
    return [learned(f"d{number}", word) for number, word in enumerate(words, start=1)]


def pairs_of(network: Network) -> set[str]:
    return {f"{link.source[0]}{link.target[0]}" for link in network.links}


def value(order: Order, words: list[tuple[int, ...]]) -> float:
    """What an order is worth by the definition, moment by moment."""
    total = 0.0
    for word in words:
        for moment, step in enumerate(word):
            left = word[moment:]
            ready = [one for one in left if not any(order[other, one] for other in left)]
            total += log((1 - SLIP) * (step in ready) / len(ready) + SLIP / len(left))
    for u, v in zip(*np.nonzero(covers(order)), strict=True):
        both = [word for word in words if u in word and v in word]
        total -= COST * sum(abs(word.index(v) - word.index(u)) for word in both) / max(len(both), 1)
    return total


def is_order(order: Order) -> bool:
    return not (order & order.T).any() and not (order.astype(int) @ order.astype(int) > 0)[~order].any()


@st.composite
def orders_shown(draw: st.DrawFn, most: int = 4) -> list[tuple[int, ...]]:
    """Words of the same few steps, of which some are left out at times."""
    count = draw(st.integers(1, most))
    word = st.permutations(range(count)).flatmap(
        lambda order: st.integers(0, len(order) - 1).map(lambda cut: tuple(order[: len(order) - cut // 2]))
    )
    return draw(st.lists(word, min_size=1, max_size=5))


@settings(max_examples=60)
@given(orders_shown())
def test_no_single_pair_makes_the_order_better(words: list[tuple[int, ...]]) -> None:
    count = 1 + max(step for word in words for step in word)
    order = explaining_order(words, count)
    assert is_order(order)
    reached = value(order, words)
    for u, v in permutations(range(count), 2):
        other = order.copy()
        other[u, v] ^= True
        if is_order(other):
            assert value(other, words) <= reached + 10 * WORTH_IT


@given(orders_shown(most=6), st.randoms())
def test_which_demonstration_comes_first_does_not_matter(words: list[tuple[int, ...]], chance: object) -> None:
    shuffled = words[:]
    chance.shuffle(shuffled)  # type: ignore[attr-defined]
    letters = [" ".join("ABCDEF"[step] for step in word) for word in words]
    others = [" ".join("ABCDEF"[step] for step in word) for word in shuffled]
    assert pairs_of(free_order(of_words(*letters)).network) == pairs_of(free_order(of_words(*others)).network)


@given(st.lists(st.lists(st.sampled_from("ABC"), min_size=1, max_size=5), min_size=1, max_size=5))
def test_who_does_not_deviate_is_a_word_of_the_task_and_who_does_is_none(words: list[list[str]]) -> None:
    try:
        found = free_order(of_words(*map(" ".join, words)))
    except LearningError:
        counts = [sum(letter in word for word in words) for letter in "ABC"]
        assert all(2 * count <= len(words) for count in counts)
        return
    language = Language(found.network)
    odd = {one.demonstration for one in found.deviations}
    for number, word in enumerate(words, start=1):
        assert (word in language) == (f"d{number}" not in odd)


def test_steps_in_both_orders_are_free_and_the_rest_is_not() -> None:
    found = free_order(of_words("A B C D", "A C B D", "A B C D", "A C B D"))
    assert pairs_of(found.network) == {"AB", "AC", "BD", "CD"}
    assert found.deviations == ()
    assert not found.network.paths


def test_one_demonstration_is_done_as_it_was_shown() -> None:
    assert pairs_of(free_order(of_words("A B C D E")).network) == {"AB", "BC", "CD", "DE"}


def test_a_slip_in_many_is_told() -> None:
    found = free_order(of_words(*["A B C D E"] * 6, "A C B D E", *["A B C D E"] * 5))
    assert pairs_of(found.network) == {"AB", "BC", "CD", "DE"}
    (slip,) = found.deviations
    assert (slip.demonstration, slip.inverted) == ("d7", (("B-1", "C-1"),))
    link = next(link for link in found.network.links if link.source == "B-1")
    assert [one.demonstration for one in link.evidence] == [f"d{n}" for n in range(1, 13) if n != 7]


def test_steps_of_few_and_steps_left_out_are_told() -> None:
    found = free_order(of_words("A B C", "A B C", "A B C A", "A C"))
    repeated, short = found.deviations
    assert [part.id for part in repeated.extra] == ["A-2"]
    assert short.left_out == ("B-1",)
    assert set(found.network.by_id) == {"A-1", "B-1", "C-1"}


@pytest.mark.parametrize("type_", [ENABLING, PERMANENT])
def test_what_something_depends_on_is_never_freed(type_: LinkType) -> None:
    """An order that both show, and that explains too little to be kept, stays where both ask for more than an order."""
    words = ["C A D B", "D A C B"]
    free = free_order(of_words(*words)).network
    assert ("A-1", "B-1") not in {(link.source, link.target) for link in expand_links(free).links}
    kept = [learned(f"d{n}", word, {(1, 3): type_}) for n, word in enumerate(words, start=1)]
    found = free_order(kept).network
    assert next(link.type for link in found.links if (link.source, link.target) == ("A-1", "B-1")) is type_


def test_the_least_restrictive_is_asked_for() -> None:
    one, other = learned("d1", "A B", {(0, 1): PERMANENT}), learned("d2", "A B", {(0, 1): ENABLING})
    (link,) = free_order([one, other]).network.links
    assert link.type is ENABLING
    assert [one.demonstration for one in link.evidence] == ["d1", "d2"]


def test_a_generalised_task_is_taken_apart() -> None:
    words = ["A B C D", "A C B D", "A B C D"]
    one, two, three = of_words(*words)
    task = generalize(one, two).network
    at_once = free_order([one, two, three])
    later = free_order([task, three])
    assert later.demonstrations == at_once.demonstrations
    assert pairs_of(later.network) == pairs_of(at_once.network)
    assert free_order([at_once.network]).network.by_id.keys() == at_once.network.by_id.keys()
    assert reduce_links(later.network) == later.network


def test_nothing_in_common_is_refused() -> None:
    with pytest.raises(LearningError, match="more than half of the 2 demonstrations"):
        free_order(of_words("A", "B"))
