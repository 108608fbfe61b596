"""The corrections of a practice run, written down and made again."""

import json

import pytest

from understudy.errors import DocumentError, NetworkError
from understudy.network import END, Component, Link, LinkType, Network
from understudy.practice import Attribution, Correction, inserted, minutes_of, read_minutes, reassigned, without
from understudy.robot import Cue

TASK = Network(
    tuple(Component(id=id_, behavior="Track", parameters={"color": id_}) for id_ in ("green", "red", "pink")),
    tuple(Link(source=a, target=b, type=LinkType.ORDERING) for a, b in (("green", "red"), ("red", "pink"))),
)
PIECE = Network((Component(id="blue", behavior="Drop"),))


def about(component: str) -> tuple[Attribution, ...]:
    return (Attribution(component=component, how="finished", since_s=1.0),)


def corrections() -> tuple[Correction, ...]:
    """BAD about red, GO in vain, COME before pink."""
    shorter = without(TASK, "red")
    return (
        Correction(word=Cue.BAD, time_s=2.0, meant=about("red"), before=TASK, after=shorter),
        Correction(word=Cue.GO, time_s=3.0, meant=(), before=shorter, after=shorter, note="in vain"),
        Correction(
            word=Cue.COME,
            time_s=4.0,
            meant=about("pink"),
            before=shorter,
            after=inserted(shorter, "pink", PIECE),
            piece=PIECE,
        ),
    )


def written() -> object:
    return json.loads(json.dumps({"task": "colors", **minutes_of("colors", TASK, corrections())}))


def test_minutes_are_read_as_they_were_written() -> None:
    assert read_minutes(written(), source="report") == ("colors", TASK, corrections())


def test_what_was_shown_can_be_put_to_the_end() -> None:
    task = reassigned(corrections(), 3, END)[-1].after
    assert task.sinks == ("blue",)
    assert [part.id for part in task.components] == ["green", "pink", "blue"]
    with pytest.raises(NetworkError, match="no step was called 'END' then; there were: green, red, pink"):
        reassigned(corrections(), 1, END)
    with pytest.raises(NetworkError, match=r"of GO at 3\.0 s nothing was learned that could go elsewhere"):
        reassigned(corrections(), 2, "pink")


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        ({"task": "x"}, "no report of a practice run"),
        ([], "no report of a practice run"),
        ({"task": "x", "before": {}, "corrections": [{"word": "BOO"}]}, r"corrections\[0\].word"),
        ({"task": "x", "before": {"understudy": "task/1"}, "corrections": []}, "report: before"),
    ],
)
def test_what_is_no_report_is_refused(data: object, problem: str) -> None:
    with pytest.raises(DocumentError, match=problem):
        read_minutes(data, source="report")
