"""The automaton against every permutation, every interleaving, and its own words."""

from itertools import islice
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.execution.strategies import networks
from understudy.errors import LanguageError, NetworkError
from understudy.language import Language, by_path, parse_word
from understudy.network import (
    Component,
    Edge,
    Happened,
    Link,
    LinkType,
    Nab,
    Network,
    flattened,
    load_task,
    task_path,
)
from understudy.network.builder import (
    achieved,
    any_order,
    build,
    case,
    choose,
    complete,
    directly,
    do,
    event,
    every,
    in_order,
    not_,
    part,
    repeat,
    switch,
    timed_out,
    until,
    whenever,
    within,
)

from .reference import linear_extensions, words
from .strategies import nested


@given(networks(max_components=6))
def test_the_words_of_a_flat_network_are_its_linear_extensions(network: Network) -> None:
    language = Language(network, spell=by_path)
    expected = linear_extensions(network)
    assert sorted(language.words()) == sorted(expected)
    assert language.count() == len(expected)
    assert language.longest == len(network.components)


@given(nested())
def test_the_words_of_networks_in_networks_are_all_interleavings(network: Network) -> None:
    expected = words(network)
    language = Language(network, spell=by_path)
    if len(expected) > 3000:
        expected = set(islice(sorted(expected), 3000))
        assert all(word in language for word in expected)
        return
    found = list(language.words())
    assert len(found) == len(set(found))
    assert set(found) == expected
    assert [len(word) for word in found] == sorted(map(len, found))
    assert language.finite
    assert language.longest == max(map(len, found))
    assert language.count() == len(found)
    shorter = max(map(len, found)) - 1
    assert language.count(longest=shorter) == sum(len(word) <= shorter for word in found)


@given(nested(), st.data())
def test_membership_says_where_a_word_leaves_the_language(network: Network, data: st.DataObject) -> None:
    language = Language(network, spell=by_path)
    expected = set(islice(sorted(words(network)), 300))
    if len(expected) == 300:
        return
    word = data.draw(
        st.lists(st.sampled_from(language.symbols), max_size=6).map(tuple) | st.sampled_from(sorted(expected))
    )
    told = language.membership(word)
    prefixes = {one[:count] for one in expected for count in range(len(one) + 1)}
    assert told.member is (word in expected) is (word in language)
    assert told.begins == max(count for count in range(len(word) + 1) if word[:count] in prefixes)
    begun = word[: told.begins]
    assert set(told.allowed) == {one[len(begun)] for one in expected if one[: len(begun)] == begun and one != begun}
    assert told.complete is (begun in expected)


class Counting(Random):
    """Chance that takes its turns."""

    def __init__(self, turn: int) -> None:
        super().__init__()
        self.turn = turn

    def randrange(self, start: int, stop: int | None = None, step: int = 1) -> int:
        assert start > self.turn
        return self.turn


@given(nested(), st.data())
def test_every_word_is_drawn_as_often_as_any_other(network: Network, data: st.DataObject) -> None:
    language = Language(network)
    total = language.count()
    assert total is not None
    longest = data.draw(st.sampled_from((float("inf"), language.longest, language.longest - 1)))
    some = language.count(longest=longest)
    assert some is not None
    if some > 200:
        return
    drawn = [language.sample(Counting(turn), longest=longest) for turn in range(some)]
    assert sorted(drawn) == sorted(language.words(longest=longest))


@given(nested())
def test_symbols_join_components_that_do_the_same(network: Network) -> None:
    own, joined = Language(network, spell=by_path), Language(network)
    if (own.count() or 0) > 2000:
        return
    behavior = {path: of.behavior for path, of in network.walk() if isinstance(of, Component)}
    assert {tuple(behavior[path] for path in word) for word in own.words()} == set(joined.words())


@given(networks(max_components=5), st.integers(0, 4))
def test_a_hierarchy_has_the_words_of_its_flat_network(inner: Network, place: int) -> None:
    before, after = Component(id="before", behavior="A"), Component(id="after", behavior="B")
    inner = Network(inner.components, inner.links)
    links = (("before", "inner"), ("inner", "after"), ("before", "after"))[:place]
    network = Network(
        (before, Nab.of("inner", inner), after),
        tuple(Link(source=a, target=b, type=LinkType.ORDERING) for a, b in links),
    )
    flat = flattened(network)
    named = set(Language(network, spell=by_path).words())
    assert named == {tuple(id_.replace(".", "/") for id_ in word) for word in Language(flat, spell=by_path).words()}


# -- what each control contributes --------------------------------------------------------------------------------

A, B, C = do("A"), do("B"), do("C")


def first(network: Network, count: int = 6, longest: float = float("inf")) -> list[str]:
    return ["".join(word) for word in islice(Language(network).words(longest=longest), count)]


def test_an_endless_loop_is_never_done() -> None:
    language = Language(build(part("on and on", in_order(A, B), repeat())))
    assert (language.count(), list(language.words())) == (0, [])
    told = language.membership(("A", "B", "A", "A"))
    assert (told.member, told.begins, told.allowed) == (False, 3, ("B",))


def test_a_loop_with_an_end_has_no_longest_word() -> None:
    language = Language(build(in_order(part("rounds", in_order(A, B), repeat(until=event("e"))), C)))
    assert (language.count(), language.finite) == (None, False)
    assert ["".join(word) for word in islice(language.words(), 3)] == ["ABC", "ABABC", "ABABABC"]
    assert language.count(longest=7) == 3
    with pytest.raises(LanguageError, match="no end to the words"):
        language.sample(Random(1))
    assert {language.sample(Random(seed), longest=5) for seed in range(20)} == {tuple("ABC"), tuple("ABABC")}


def test_a_loop_until_something_is_achieved_knows_whether_it_is() -> None:
    rounds = part("rounds", A, repeat(until=achieved(B)))
    assert first(build(in_order(B, rounds))) == ["BA"]
    assert first(build(rounds, B), 3, 4) == ["AB", "BA", "AAB"]


def test_cases_are_all_possible_unless_they_ask_for_what_is_known() -> None:
    either = choose("either", case("a", A, when=event("e")), case("b", B))
    assert first(build(in_order(either, C))) == ["AC", "BC"]
    assert first(build(in_order(part("maybe", A, when=event("e")), C))) == ["C", "AC"]
    assert first(build(in_order(C, choose("known", case("a", A, when=achieved(C)), case("b", B))))) == ["CA"]
    assert first(build(in_order(C, part("never", A, when=not_(achieved(C)))))) == ["C"]


def test_a_skipped_step_leaves_no_trace_and_may_be_asked_for() -> None:
    late = do("B", within(5, skip=True))
    assert first(build(in_order(A, late, C))) == ["AC", "ABC"]
    seen = part("then", C, when=timed_out(late))
    assert first(build(in_order(A, late, seen))) == ["A", "AB", "AC", "ABC"]
    never = do("B", within(5, signal="x"))
    assert first(build(in_order(never, part("then", C, when=timed_out(never))))) == ["B"]


def test_a_network_that_is_cut_short_may_still_finish_what_it_was_at() -> None:
    network = build(in_order(part("some", in_order(A, B), until(event("e"))), C))
    assert first(network, 9) == ["C", "AC", "CA", "ABC", "ACB", "CAB"]


def test_switches_break_off_and_begin_anew() -> None:
    network = build(choose("turns", case("a", in_order(A, B)), case("b", C), switch("a", "b", when=timed_out_free())))
    assert first(network, 9) == ["C", "AB", "AC", "ABC"]
    forced = build(choose("turns", case("a", in_order(A, B)), case("b", C), switch("a", "b", when=complete())))
    assert first(forced, 9) == ["ABC"]


def timed_out_free() -> Happened:
    return Happened(event="e")


def test_a_duty_comes_as_often_as_it_is_called() -> None:
    assert first(build(in_order(A, B), do("D", every(3))), 7, 3) == ["AB", "ABD", "ADB", "DAB"]
    partly = build(in_order(A, B), part("duty", directly(C, do("D")), whenever(event("e"))))
    found = first(partly, 99, 4)
    assert "ABC" in found  # the task is done, and what the duty was at is broken off
    assert "CADB" in found
    assert "DAB" not in found
    assert Language(partly).count() is None


def test_nothing_is_enumerated_to_find_a_word_or_to_test_one() -> None:
    many = [do("Track", color=f"color {number:02}") for number in range(40)]
    language = Language(build(any_order(*many), do("Drop")))
    word = next(language.words())
    assert len(word) == 41
    assert word in language
    assert word[::-1] in language
    told = language.membership((*word[:30], word[0]))
    assert (told.begins, len(told.allowed)) == (30, 11)
    with pytest.raises(LanguageError, match="more than 1000 states"):
        Language(build(any_order(*many)), limit=1000).count()


# -- words as people write them --------------------------------------------------------------------------------------


def test_a_word_is_read_as_it_is_written() -> None:
    _, network = load_task(task_path("hierarchical"))
    word = next(Language(network).words())
    assert parse_word(", ".join(word), network) == word
    assert parse_word("track(LIGHT green),pickup( orange ) ,Drop", network) == (
        "Track(light green)",
        "PickUp(orange)",
        "Drop",
    )
    assert parse_word("Dance(fast, slow), Drop", network) == ("Dance(fast, slow)", "Drop")
    assert parse_word("", network) == ()
    with pytest.raises(NetworkError, match="a bracket is missing"):
        parse_word("Track(orange, Drop", network)


def test_symbols_with_commas_of_their_own_are_read() -> None:
    network = build(do("pour, slowly"), do("lid", of="pot", kind="big"))
    assert parse_word("pour, slowly, lid(pot, big)", network) == ("pour, slowly", "lid(pot, big)")


def test_the_hierarchical_task_has_the_orders_of_its_four_visits() -> None:
    _, network = load_task(task_path("hierarchical"))
    language = Language(network)
    assert language.count() == 24
    assert {len(word) for word in language.words()} == {11}


def test_the_words_of_alternatives_are_their_ways() -> None:
    """Figure 5.7: the direct way wins, and after F either A or C."""
    steps = "START a, a c, c b, a b, b f, f a-2, f c-2, a-2 END, c-2 END"
    paths = tuple(Edge(source=source, target=target) for source, target in (one.split() for one in steps.split(", ")))
    network = Network(
        tuple(Component(id=id_, behavior=id_[0].upper()) for id_ in ("a", "c", "b", "f", "a-2", "c-2")), paths=paths
    )
    found = Language(network, spell=by_path)
    assert {tuple(word) for word in islice(found.words(), 9)} == {("a", "b", "f", "a-2"), ("a", "b", "f", "c-2")}
    assert ("a", "c", "b", "f", "a-2") not in found
