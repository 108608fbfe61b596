"""Rules against every prefix of every word; what is told of those who break one; and how tasks compare."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.errors import LanguageError
from understudy.language import DROP_BEFORE_PICK_UP, Grammar, Language, check, compare, violations
from understudy.network import Component, Edge, Network, load_task, task_names, task_path
from understudy.network.builder import any_order, build, directly, do, every, in_order, named, part, repeat, within

from .reference import words
from .strategies import nested

LAST_DROP = Grammar(
    name="empty at last",
    says="the last PickUp or Drop is a Drop",
    productions="S -> p A | d S | eps; A -> p A | d S",
    letters={"p": "PickUp", "d": "Drop"},
)
RULES = {"drop before picking up": DROP_BEFORE_PICK_UP, "empty at last": LAST_DROP}


def drop_before_pick_up(behaviors: list[str], *, done: bool) -> bool:
    """§3.6: for a current p there is a d preceding it, but following the previous p or the start."""
    for place, behavior in enumerate(behaviors):
        if behavior == "PickUp":
            since = max((i for i in range(place) if behaviors[i] == "PickUp"), default=-1)
            if "Drop" not in behaviors[since + 1 : place]:
                return False
    return True


def empty_at_last(behaviors: list[str], *, done: bool) -> bool:
    of_gripper = [behavior for behavior in behaviors if behavior != "Track"]
    return not done or not of_gripper or of_gripper[-1] == "Drop"


KEPT = {"drop before picking up": drop_before_pick_up, "empty at last": empty_at_last}


@given(nested(), st.sampled_from(sorted(RULES)))
def test_the_shortest_way_to_break_a_rule(network: Network, name: str) -> None:
    behavior = {path: of.behavior for path, of in network.walk() if isinstance(of, Component)}
    all_words = words(network)
    if len(all_words) > 2000:
        return
    broken = [
        word[:count]
        for word in all_words
        for count in range(len(word) + 1)
        if not KEPT[name]([behavior[path] for path in word[:count]], done=word[:count] in all_words)
    ]
    violation = check(network, RULES[name])
    if violation is None:
        assert not broken
        return
    assert violation.paths in broken
    assert len(violation.paths) == min(map(len, broken))
    assert violation.word == tuple(behavior[path] for path in violation.paths)
    if name == "empty at last":
        assert violation.offender == ""
        assert "but the task can end after" in str(violation)
        return
    assert violation.offender == violation.paths[-1]
    earlier = [path for path in violation.paths[:-1] if behavior[path] == "PickUp"]
    assert violation.since == (earlier[-1] if earlier else "")


@pytest.mark.parametrize("name", task_names())
def test_the_bundled_tasks_keep_all_rules(name: str) -> None:
    assert violations(load_task(task_path(name))[1]) == []


def test_the_offenders_are_named() -> None:
    box, other = do("PickUp", named("box"), color="orange"), do("PickUp", named("other"), color="red")
    network = build(directly(do("Drop"), do("Track", color="green"), part("carry", in_order(box, do("Track"), other))))
    (violation,) = violations(network)
    assert (violation.since, violation.offender) == ("carry/box", "carry/other")
    assert str(violation) == (
        "before every PickUp there is a Drop, after the PickUp before it or the beginning; but 'carry/other' can "
        "follow 'carry/box' without it: Drop, Track(green), PickUp(orange), Track, PickUp(red)"
    )
    assert "but 'pick-up-1' can come without it: PickUp" in str(*violations(build(do("PickUp"))))


def test_a_loop_that_never_ends_is_checked() -> None:
    box = do("PickUp", named("box"))
    assert violations(build(part("ever", in_order(do("Drop"), box), repeat()))) == []
    (violation,) = violations(build(in_order(do("Drop"), part("ever", box, repeat()))))
    assert violation.paths == ("drop-1", "ever/box", "ever/box")


def test_duties_are_checked_while_the_task_lasts() -> None:
    duty = part("duty", in_order(do("PickUp")), every(5))
    (violation,) = violations(build(do("Drop"), do("Track", color="green"), duty))
    assert violation.paths == ("duty/pick-up-1",)
    waiting = part("duty", in_order(do("Track", color="pink"), do("PickUp")), every(5))
    (violation,) = violations(
        build(in_order(do("Drop"), waiting), do("Track", color="green"), do("Track", color="red"))
    )
    assert violation.paths == ("drop-1", *("duty/track-pink-1", "duty/pick-up-1") * 2)


def test_a_drop_that_may_be_skipped_is_none() -> None:
    network = build(in_order(do("Drop"), do("PickUp"), do("Drop", within(5, skip=True)), do("PickUp")))
    (violation,) = violations(network)
    assert violation.paths == ("drop-1", "pick-up-1", "pick-up-2")


def test_what_the_rule_does_not_see_costs_nothing() -> None:
    many = [do("Track", color=f"color {number}") for number in range(40)]
    inner = part("visits", *(do("Track", color=f"other {number}") for number in range(40)))
    (violation,) = check_all(build(in_order(inner, do("PickUp")), *many))
    assert len(violation.paths) == 41
    assert violations(build(in_order(do("Drop"), inner, do("PickUp")), *many)) == []


def check_all(network: Network) -> list[object]:
    return list(violations(network, limit=500))


def test_letters_can_mean_a_behavior_with_its_words() -> None:
    careful = Grammar(
        name="green first",
        says="the green target comes before every other",
        productions="S -> g F | eps; F -> g F | t F | eps",
        letters={"g": "Track(green)", "t": "Track"},
    )
    green, red = do("Track", color="green"), do("Track", color="red")
    assert check(build(in_order(green, any_order(red, do("Drop")))), careful) is None
    violation = check(build(in_order(do("Drop"), any_order(green, red))), careful)
    assert violation is not None
    assert violation.paths == ("drop-1", "track-red-1")


@pytest.mark.parametrize(
    ("productions", "message"),
    [
        ("S > t S", "written as S → t S or S → ε, given 'S > t S'"),
        ("S → t", "written as S → t S"),
        ("S → x S", "no behavior is given for the letter 'x'"),
        ("S → t B", "nothing says what becomes of 'B'"),
        ("", "at least one production"),
    ],
)
def test_what_is_no_grammar(productions: str, message: str) -> None:
    with pytest.raises(LanguageError, match=message):
        Grammar(name="x", says="y", productions=productions, letters={"t": "Track"})


@given(nested(size=2), nested(size=2))
def test_two_tasks_compared(first: Network, second: Network) -> None:
    one, other = Language(first), Language(second)
    if (one.count() or 0) > 2000 or (other.count() or 0) > 2000:
        return
    a, b = set(one.words()), set(other.words())
    found = compare(one, other)
    for witness, of in ((found.both, a & b), (found.only_first, a - b), (found.only_second, b - a)):
        assert (witness is None) is (not of)
        if witness is not None:
            assert witness in of
            assert len(witness) == min(map(len, of))
    expected = (
        "equal" if a == b else "included" if a < b else "includes" if a > b else "overlapping" if a & b else "disjoint"
    )
    assert found.relation == expected


def test_tasks_with_no_end_of_words_can_be_compared() -> None:
    step, other = do("Track"), do("Drop")
    ever = Language(build(in_order(part("rounds", step, repeat(until=None, times=3)), other)))
    some = Language(build(in_order(do("Track"), do("Track"), do("Track"), do("Drop"))))
    assert compare(ever, some).relation == "equal"
    duty = Language(build(in_order(do("Track"), do("Drop")), do("Track", every(3))))
    found = compare(duty, some)
    assert found.relation == "includes"
    assert found.only_first == ("Track", "Drop")


def test_the_rule_is_kept_on_every_way_or_on_none() -> None:
    """A drop by the way, which another way leads past, is none to rely on."""

    def task(*steps: str) -> Network:
        parts = {"d": "Drop", "t": "Track", "p": "PickUp"}
        paths = tuple(Edge(source=source, target=target) for source, target in (step.split() for step in steps))
        return Network(tuple(Component(id=id_, behavior=name) for id_, name in parts.items()), paths=paths)

    assert violations(task("START d", "d t", "t p", "p END")) == []
    (either,) = violations(task("START d", "START t", "d p", "t p", "p END"))
    assert (either.offender, either.paths) == ("p", ("t", "p"))
    (past,) = violations(task("START d", "START t", "d t", "t p", "p END"))
    assert past.paths == ("t", "p")
