"""What the robot says while it is taught, and what BAD does then."""

from collections.abc import Iterable, Mapping
from typing import Any

import pytest

from understudy.learning import Instance, Observer, Remarks
from understudy.robot import Cue

RED, GREEN = (Instance("Track", (("color", color),)) for color in ("red", "green"))
Distances = Mapping[Instance, float]


class Lesson:
    """A demonstration played by hand, a tenth of a second at a time."""

    def __init__(self) -> None:
        self.observer, self.remarks = Observer(), Remarks()
        self.tick = 0
        self.said: list[dict[str, Any]] = []
        self.step({}, [Cue.START])

    def step(
        self,
        seen: Distances,
        cues: Iterable[Cue] = (),
        *,
        looking: bool = True,
        in_view: bool = True,
        news: tuple[Mapping[str, Any], ...] = (),
    ) -> None:
        self.tick += 1
        time_s = self.tick / 10
        evaluated = {instance: {"distance_m": away} for instance, away in seen.items()}
        self.observer.step(time_s, evaluated, cues)
        self.said += self.remarks.step(
            time_s, self.observer, evaluated, cues, looking=looking, in_view=in_view, news=news
        )

    def last(self, seconds: float, seen: Distances, **how: Any) -> None:
        for _ in range(round(10 * seconds)):
            self.step(seen, **how)

    @property
    def told(self) -> list[str]:
        return [remark["what"] for remark in self.said]


def test_it_tells_what_it_took_note_of_the_nearest_first() -> None:
    lesson = Lesson()
    lesson.last(3.0, {RED: 1.5, GREEN: 0.9})
    lesson.step({RED: 1.5, GREEN: 0.9}, [Cue.HERE])
    lesson.last(1.4, {RED: 0.5, GREEN: 0.9})
    assert lesson.told == []
    lesson.last(0.1, {})
    [remark] = lesson.said
    assert (remark["about"], remark["cue"], remark["noted"]) == ("noted", "HERE", ["green", "red"])
    assert remark["what"] == "HERE: I took note of green, red"


def test_here_that_fell_on_nothing_is_told_but_take_and_drop_are_not() -> None:
    lesson = Lesson()
    lesson.step({}, [Cue.HERE])
    lesson.step({}, [Cue.TAKE])
    lesson.step({}, [Cue.DROP])
    lesson.last(3.0, {})
    assert lesson.told == ["HERE: I saw nothing to take note of"]


def test_what_comes_into_view_soon_after_the_word_is_meant() -> None:
    lesson = Lesson()
    lesson.step({}, [Cue.HERE])
    lesson.last(1.0, {})
    lesson.last(1.0, {RED: 1.5})
    assert lesson.told == ["HERE: I took note of red"]


def test_each_bad_takes_back_the_farthest_that_is_left() -> None:
    lesson = Lesson()
    lesson.last(3.0, {RED: 1.5, GREEN: 0.9})
    lesson.step({RED: 1.5, GREEN: 0.9}, [Cue.HERE])
    lesson.step({RED: 1.5, GREEN: 0.9}, [Cue.BAD])
    lesson.last(2.0, {RED: 1.5, GREEN: 0.9})
    assert lesson.told == ["HERE: I took note of green"]
    lesson.step({}, [Cue.BAD, Cue.BAD])
    found = lesson.observer.finish()
    assert [instance for _, _, instance in found.taken_back] == [RED, GREEN]
    assert found.notes[:2] == (
        "Track(color=red) was taken back: HERE at 3.2 s did not mean it.",
        "Track(color=green) was taken back: HERE at 3.2 s did not mean it.",
    )
    assert found.notes[2] == "BAD at 5.4 s was ignored: there was nothing to take back."


@pytest.mark.parametrize(("seconds", "count"), [(9.9, 1), (10.1, 0)])
def test_bad_comes_within_ten_seconds(seconds: float, count: int) -> None:
    lesson = Lesson()
    lesson.last(3.0, {RED: 1.5})
    lesson.step({RED: 1.5}, [Cue.HERE])
    lesson.last(seconds - 0.1, {})
    lesson.step({}, [Cue.BAD])
    assert len(lesson.observer.finish().taken_back) == count


def test_it_says_that_it_has_lost_its_teacher_and_again_but_not_when_busy() -> None:
    lesson = Lesson()
    lesson.last(1.9, {}, in_view=False)
    assert lesson.told == []
    lesson.last(12.0, {}, in_view=False)
    assert [remark["time_s"] for remark in lesson.said] == pytest.approx([2.1, 12.1])
    lesson.last(1.0, {})
    lesson.last(5.0, {}, in_view=False, looking=False)
    assert len(lesson.said) == 2
    assert {remark["about"] for remark in lesson.said} == {"lost"}


def test_it_asks_about_what_it_passed_closely_without_a_word() -> None:
    lesson = Lesson()
    lesson.last(3.0, {RED: 0.9, GREEN: 1.1})
    lesson.last(0.2, {})
    assert lesson.told == []
    lesson.last(2.0, {})
    assert lesson.told == ["Does red belong to it? Then say HERE"]


def test_it_does_not_ask_about_what_it_took_note_of_nor_about_glimpses_nor_gaps() -> None:
    lesson = Lesson()
    lesson.last(2.5, {RED: 0.9})
    lesson.step({RED: 0.9}, [Cue.HERE])
    lesson.last(2.0, {RED: 0.9})
    lesson.last(0.2, {})
    lesson.last(1.0, {RED: 0.9})
    lesson.last(3.0, {})
    lesson.last(1.5, {GREEN: 0.5})
    lesson.last(1.0, {})
    assert lesson.told == ["HERE: I took note of red"]


def test_it_tells_of_boxes_that_it_did_not_get() -> None:
    lesson = Lesson()
    lesson.step({}, news=({"kind": "missed", "time_s": 0.2, "what": "no box in view after TAKE"},))
    lesson.step({}, news=({"kind": "errand-failed", "time_s": 0.3, "skill": "PickUp"},))
    lesson.step({}, news=({"kind": "errand-failed", "time_s": 0.4, "skill": "Drop"},))
    assert lesson.told == ["TAKE: I see no box", "TAKE: I could not pick up the box"]


def test_nothing_is_said_before_start_and_after_done() -> None:
    lesson = Lesson()
    lesson.step({}, [Cue.DONE])
    lesson.step({}, [Cue.HERE])
    lesson.last(5.0, {}, in_view=False)
    assert lesson.said == []
