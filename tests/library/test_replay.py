"""A reading is the cheapest way from what happened to a word of the task; and what fits is said rightly."""

from collections.abc import Iterator
from datetime import UTC, datetime
from itertools import islice

from hypothesis import given
from hypothesis import strategies as st

from understudy.behaviors import installed_skills
from understudy.figures import describe_regression
from understudy.language import Language, symbol_of
from understudy.library import Regression, Sitting, regression, replays
from understudy.network import Component, Link, LinkType, Network, Task, relinked, task_text
from understudy.network.builder import any_order, build, directly, do, event, holding, in_order, part, repeat

from ..generalization.words import learned, paths_of, tasks, walks

WORDS = st.text("ABC", max_size=6)


def networks() -> Iterator[Network]:
    a, b, c = do("A"), do("B"), do("C")
    yield build(in_order(do("A"), do("B"), do("C"), do("A")))
    yield build(any_order(do("A"), do("B"), do("C")))
    yield build(in_order(any_order(do("A"), do("A")), do("B")))
    yield build(in_order(part("rounds", in_order(a, b), repeat(2)), c))
    yield build(in_order(part("rounds", do("B"), repeat(3, until=event("enough"))), do("C")))
    yield from tasks("A B C", "A C B A", "B B")


def common(one: tuple[str, ...], other: tuple[str, ...]) -> int:
    """The length of the longest common subsequence, from its recurrence."""
    rows = [[0] * (len(other) + 1) for _ in range(len(one) + 1)]
    for i, first in enumerate(one):
        for j, second in enumerate(other):
            rows[i + 1][j + 1] = rows[i][j] + 1 if first == second else max(rows[i][j + 1], rows[i + 1][j])
    return rows[-1][-1]


@given(WORDS, st.sampled_from(list(networks())))
def test_a_reading_is_the_cheapest_one(text: str, network: Network) -> None:
    word = tuple(text)
    words = set(Language(network).words(longest=9))
    assert words
    cheapest = min(len(word) + len(other) - 2 * common(word, other) for other in words)
    readings = list(islice(replays(word, network, shown=False), 50))
    assert readings
    for reading in readings:
        assert len(reading.extra) + len(reading.missing) == cheapest
        places = [place for place, _ in reading.matched]
        assert sorted([*places, *reading.extra]) == list(range(len(word)))
        for place, path in reading.matched:
            component = network.by_path[path]
            assert isinstance(component, Component)
            assert symbol_of(component) == word[place]
    assert all(reading.fits == (word in words) for reading in readings)


@given(WORDS, walks())
def test_what_was_shown_is_read_along_all_ways(text: str, shown: list[str]) -> None:
    *_, task = tasks(*shown)
    word = tuple(text)
    symbols = {id_: part.behavior for id_, part in task.by_id.items() if isinstance(part, Component)}
    ways = [tuple(symbols[id_] for id_ in way) for way in paths_of(task.topology)]
    cheapest = min(len(word) + len(way) - 2 * common(word, way) for way in ways)
    first = next(replays(word, task, shown=True))
    # A plain task may be done in other orders than the one of its topological form, too.
    assert len(first.extra) + len(first.missing) == cheapest


def demonstration(network: Network, number: int = 1, name: str = "shown") -> Sitting:
    return Sitting(
        task="task",
        kind="demonstration",
        number=number,
        name=name,
        revision=1,
        made_at=datetime(2000, 1, 1, tzinfo=UTC),
        shown=task_text(Task.of(name, network)),
    )


def run(*achieved: str, number: int = 1, done: bool = True) -> Sitting:
    return Sitting(
        task="task",
        kind="run",
        number=number,
        name="run",
        revision=1,
        made_at=datetime(2000, 1, 1, tzinfo=UTC),
        achieved=achieved,
        done=done,
    )


@st.composite
def lessons(draw: st.DrawFn) -> list[Network]:
    found = []
    for number, word in enumerate(draw(walks(letters="AB", max_length=4, max_words=3)), start=1):
        pairs = [(a, b) for b in range(len(word.split())) for a in range(b)]
        types = draw(st.dictionaries(st.sampled_from(pairs), st.sampled_from(LinkType))) if pairs else {}
        found.append(learned(f"d{number}", word, types))
    return found


@given(lessons())
def test_every_demonstration_fits_the_task_that_was_made_of_it(lessons: list[Network]) -> None:
    from understudy.generalization import generalize

    task = lessons[0]
    for lesson in lessons[1:]:
        task = generalize(task, lesson).network
    sittings = [demonstration(lesson, number) for number, lesson in enumerate(lessons, start=1)]
    assert regression(task, sittings, {}).fits == tuple(sittings)


CARRY = build(
    in_order(
        do("Drop"),
        holding(do("PickUp", color="orange"), do("Track", color="green", distance_m=0.5, angle_deg=90)),
        do("Drop"),
    )
)


def told(task: Network, *sittings: Sitting, before: Network = CARRY) -> tuple[Regression, str]:
    found = regression(task, sittings, {1: CARRY}, before)
    return found, describe_regression(found, installed_skills())


def test_what_is_taken_out_is_named() -> None:
    shorter = build(in_order(do("Drop"), do("Track", color="green"), do("Drop")))
    steps = tuple(CARRY.topological_order)
    found, words = told(shorter, demonstration(CARRY), run(*steps), run(*steps[:2], number=2, done=False))
    assert [str(one.sitting) for one in found.broken] == ["demonstration 1", "run 1"]
    assert words.splitlines() == [
        "demonstration 1 (shown) no longer fits: not in the task: pick up the orange box",
        "run 1 no longer fits: not in the task: pick up the orange box",
    ]


def test_what_is_put_in_and_what_comes_elsewhere_is_named() -> None:
    other = build(in_order(do("Drop"), do("Track", color="green"), do("PickUp", color="orange"), do("Drop")))
    assert "at another place: " in told(other, demonstration(CARRY))[1]
    longer = build(
        in_order(
            *(do("Drop"), do("PickUp", color="orange"), do("Track", color="green")),
            do("Track", color="red"),
            do("Drop"),
        )
    )
    _, words = told(longer, demonstration(CARRY))
    assert words.endswith("missing here: go to the red target")


def test_a_condition_that_did_not_hold_is_named() -> None:
    loose = build(in_order(do("Drop"), directly(do("PickUp", color="orange"), do("Track", color="green")), do("Drop")))
    found, words = told(CARRY, demonstration(loose), before=loose)
    assert [one.asked for one in found.broken[0].unheld] == [LinkType.PERMANENT]
    assert words.endswith(
        "for go to the green target the task wants that pick up the orange box holds all the while, and it did not"
    )
    assert told(loose, demonstration(CARRY))[0].broken == ()


def test_a_step_may_be_either_of_two_that_do_the_same() -> None:
    held = Link(source="a-1", target="b-1", type=LinkType.PERMANENT)
    components = tuple(Component(id=id_, behavior=id_[0].upper()) for id_ in ("a-1", "a-2", "b-1"))
    task = Network(components, (held,))
    first = learned("d1", "A A B", {(0, 2): LinkType.PERMANENT})
    second = learned("d2", "A A B", {(1, 2): LinkType.PERMANENT})
    neither = learned("d3", "A A B")
    found, _ = told(task, demonstration(first), demonstration(second, 2), demonstration(neither, 3), before=task)
    assert [one.number for one in found.fits] == [1, 2]
    assert len(found.before[0].unheld) == 1


def test_what_did_not_fit_before_is_told_apart() -> None:
    shorter = build(in_order(do("Drop"), do("PickUp", color="orange")))
    still = relinked(CARRY, *CARRY.topological_order[1:3], LinkType.ORDERING)
    found, words = told(still, demonstration(shorter), demonstration(CARRY, 2))
    assert (len(found.fits), len(found.broken), len(found.before)) == (1, 0, 1)
    assert "demonstration 1 (shown) does not fit, and did not before" in words
    assert words.endswith("1 demonstration fits")


def test_a_task_that_is_never_done_has_no_examples_and_says_so() -> None:
    endless = build(part("rounds", do("Drop"), repeat()))
    found, words = told(endless, demonstration(CARRY))
    assert words == "Nothing was replayed: the task is never done, so that nothing can be an example of it"
    found, words = told(CARRY, demonstration(build(do("Drop"))), before=endless)
    assert len(found.broken) == 1, "whether it fitted before is not known, so it is asked about"


def test_a_task_in_too_many_orders_is_not_replayed_and_says_so() -> None:
    many = build(any_order(*(do("Track", color="green") for _ in range(20))))
    found, words = told(many, run(*CARRY.topological_order))
    assert not found.broken
    assert words.startswith("Nothing was replayed: ")
