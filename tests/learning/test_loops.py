"""REPEAT … UNTIL: what becomes a round, what ends the loop, and what is said of words in vain (§4.6)."""

import pytest

from understudy.errors import DocumentError
from understudy.learning import Lesson, learn, parse_intervals
from understudy.network import Holds, LinkType, Nab, Network, Repeat


def lesson(*cues: tuple[float, str], seen: str = "a 0 4, b 11 14, c 15 19, d 24 35, e 40 50") -> Lesson:
    """What is learned where ``seen`` was observed: letters from one second to another."""
    intervals = [
        {"label": label, "start": float(start), "end": float(end)}
        for label, start, end in (one.split() for one in seen.split(", "))
    ]
    words = [{"time": time_s, "cue": word} for time_s, word in cues]
    return learn(parse_intervals({"understudy": "intervals/1", "name": "n", "intervals": intervals, "cues": words}))


def ids(network: Network) -> list[str]:
    return list(network.by_path)


def test_a_round_is_a_network_in_a_components_place() -> None:
    found = lesson((10.0, "REPEAT"), (25.0, "UNTIL"))
    assert ids(found.network) == ["a-1", "repeat-1", "repeat-1/b-1", "repeat-1/c-1", "e-1"]
    loop = found.network.by_path["repeat-1"]
    assert isinstance(loop, Nab)
    assert loop.repeat == Repeat(until=Holds(behavior="d"))
    assert [(link.source, link.target) for link in loop.network.links] == [("b-1", "c-1")]
    assert {(link.source, link.target): link.type for link in found.network.links} == dict.fromkeys(
        [("a-1", "repeat-1"), ("repeat-1", "e-1")], LinkType.ORDERING
    )
    assert "what ends the loop, by UNTIL at 25.0 s" in [one.reason for one in found.dropped]
    assert found.notes == ()


def test_what_holds_all_the_while_is_a_permanent_condition_of_the_loop() -> None:
    found = lesson((10.0, "REPEAT"), (25.0, "UNTIL"), seen="a 0 30, b 11 14, d 24 35")
    assert {(link.source, link.target): link.type for link in found.network.links} == {
        ("a-1", "repeat-1"): LinkType.PERMANENT
    }


def test_the_words_that_point_make_steps_as_ever() -> None:
    """REPEAT and UNTIL point at no step; what HERE points at is one, and does not end the loop."""
    words = (12.0, "HERE"), (16.0, "HERE"), (45.0, "HERE")
    found = lesson((10.0, "REPEAT"), *words, (25.0, "UNTIL"))
    assert ids(found.network) == ["repeat-1", "repeat-1/b-1", "repeat-1/c-1", "e-1"]
    again = lesson((10.0, "REPEAT"), (12.0, "HERE"), (25.0, "UNTIL"), (30.0, "HERE"))
    assert ids(again.network) == ["repeat-1", "repeat-1/b-1"]


def test_what_was_so_when_the_word_came_ends_the_loop() -> None:
    """Not what comes a moment later, but for want of anything else; a word may come too early."""
    seen = "b 11 14, d 20 35, e 24.5 50"
    early, late = (
        lesson((10.0, "REPEAT"), (24.0, "UNTIL"), seen=seen),
        lesson((10.0, "REPEAT"), (19.0, "UNTIL"), seen=seen),
    )
    assert "d-1" not in early.network.by_path
    assert early.network.by_path["repeat-1"] == late.network.by_path["repeat-1"]


def test_two_loops_one_after_the_other() -> None:
    found = lesson((10.0, "REPEAT"), (15.0, "UNTIL"), (20.0, "REPEAT"), (45.0, "UNTIL"))
    assert ids(found.network) == ["a-1", "repeat-1", "repeat-1/b-1", "repeat-2", "repeat-2/d-1"]


@pytest.mark.parametrize(
    ("cues", "note"),
    [
        ([(10.0, "UNTIL")], "UNTIL at 10.0 s was ignored, since no REPEAT came before it."),
        ([(10.0, "REPEAT")], "REPEAT at 10.0 s had no UNTIL after it"),
        ([(5.0, "REPEAT"), (9.0, "UNTIL")], "UNTIL at 9.0 s fell on nothing new"),
        ([(20.0, "REPEAT"), (25.0, "UNTIL")], "Nothing was shown between REPEAT at 20.0 s and UNTIL at 25.0 s"),
        ([(5.0, "REPEAT"), (10.0, "REPEAT"), (25.0, "UNTIL")], "A second REPEAT at 10.0 s was ignored"),
    ],
)
def test_words_in_vain_are_told(cues: list[tuple[float, str]], note: str) -> None:
    found = lesson(*cues)
    assert [note in one for one in found.notes] == [True]
    assert len(found.network.flat * ["flat"]) == (0 if "second" in note else 1)


def test_other_words_are_no_cues() -> None:
    with pytest.raises(DocumentError, match=r"cues\[0\].cue"):
        lesson((1.0, "DONE"))
