"""Which step is meant: the ten seconds of §6.1."""

import pytest

from understudy.execution import Event, History
from understudy.network import Component, Network
from understudy.practice import attributions, without

NETWORK = Network(tuple(Component(id=id_, behavior="Track", parameters={"color": "green"}) for id_ in "abcd"))


def told(kind: str, time_s: float, component: str, **detail: object) -> Event:
    return Event(time_s=time_s, kind=kind, component=component, detail=detail)


RUN = (
    *(told("state", 0.0, id_, state="waiting", reason="ordering", **{"for": "a"}) for id_ in "bcd"),
    told("state", 0.0, "a", state="executing"),
    told("achieved", 5.0, "a", on_purpose=True),
    told("state", 5.0, "a", state="achieved"),
    told("achieved", 5.0, "d", on_purpose=False),
    told("state", 5.0, "b", state="searching", reason="world"),
    told("state", 5.0, "c", state="searching", reason="world"),
    told("state", 7.0, "c", state="executing"),
    told("achieved", 12.0, "c", on_purpose=True),
    told("state", 12.0, "c", state="achieved"),
)


@pytest.mark.parametrize(
    ("at_s", "meant"),
    [
        (2.0, ["a executing for 2.0 s"]),
        (6.0, ["a finished 1.0 s ago", "b searching for 1.0 s", "c searching for 1.0 s"]),
        (8.0, ["a finished 3.0 s ago", "c executing for 1.0 s", "b searching for 3.0 s"]),
        (13.0, ["c finished 1.0 s ago", "b searching for 8.0 s", "a finished 8.0 s ago"]),
        (15.0, ["c finished 3.0 s ago", "b searching for 10.0 s", "a finished 10.0 s ago"]),
        (16.0, ["c finished 4.0 s ago", "b searching for 11.0 s"]),
        (30.0, ["b searching for 25.0 s"]),
    ],
)
def test_finished_lately_goes_before_executing_before_searching(at_s: float, meant: list[str]) -> None:
    history = History(NETWORK, [event for event in RUN if event.time_s <= at_s])
    found = attributions(history, NETWORK, at_s)
    assert [f"{one.component} {one.told(at_s)}" for one in found] == meant


def test_what_was_taken_out_is_meant_no_more() -> None:
    """Nor is what was finished before that: the word is about what comes now."""
    found = attributions(History(NETWORK, RUN), without(NETWORK, "c"), 13.0)
    assert [one.component for one in found] == ["b", "a"]
