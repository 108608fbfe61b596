"""Alternatives in words, in DOT and in pictures."""

from tests.figures.test_why import told
from tests.generalization.words import learned, tasks
from understudy.execution import History, explain
from understudy.figures import WhyWords, describe_difference, describe_task, to_dot
from understudy.figures.network_plan import plan
from understudy.figures.network_text import texts_of
from understudy.figures.ways import always_before, with_ways
from understudy.generalization import generalize
from understudy.network import LinkType, Network

FIRST = learned("monday", "A C B F D", {(0, 2): LinkType.PERMANENT, (1, 2): LinkType.ENABLING})
SECOND = generalize(FIRST, learned("tuesday", "A B F E", {(0, 1): LinkType.PERMANENT, (2, 3): LinkType.ENABLING}))
TASK = SECOND.network

WORDS = """\
week: 5 steps, some of them alternatives

  1. A
  2. B
       step 1 must hold all the while
  3. F
       then step 4 or 5, whichever comes first
  4. D
       shown in 1 of 2 demonstrations
       then all is done
  5. E
       shown in 1 of 2 demonstrations
       start while step 3 (F) still holds
     shown, but never done, since a direct way leads past:
  6. C
       shown in 1 of 2 demonstrations: monday

A step holds while what it achieved is still true. One that is needed and no longer holds is done again."""


def test_a_task_with_alternatives_in_words():
    assert describe_task("week", TASK, {}) == WORDS


def test_what_may_not_have_been_done_is_said_so():
    *_, task = tasks("A C", "B C")
    links = (*task.links, *learned("x", "A C", {(0, 1): LinkType.PERMANENT}).links)
    told_ = describe_task("t", Network(task.components, links, paths=task.paths), {})
    assert "     begin with step 1 or 2, whichever comes first:\n  1. A\n" in told_
    assert "step 1 (A) must hold all the while, if it was done" in told_
    assert "  3. C\n" in told_


def test_a_plain_task_says_nothing_of_it():
    assert "alternatives" not in describe_task("plain", FIRST, {})
    assert "shown" not in describe_task("plain", FIRST, {})


def test_a_difference_in_words():
    assert describe_difference(SECOND.difference, TASK, {}) == (
        "tuesday: 3 of 4 steps were known\n"
        "  between step 1 and step 2: it went on directly, where others did step 6 (C)\n"
        "  after step 3: step 5 (E), where others did step 4 (D)\n"
        "  never done from now on, since a direct way leads past: step 6 (C)"
    )
    again = generalize(TASK, learned("wednesday", "A B F D"))
    assert describe_difference(again.difference, again.network, {}) == (
        "wednesday: 4 of 4 steps were known, and it went a known way\n"
        "  for step 2 it is enough that step 1 has been done, since not all showed that it holds all the while"
    )


def test_dot_draws_every_step_of_the_ways_once():
    text = to_dot(TASK)
    steps = {("A-1", "C-1"), ("A-1", "B-1"), ("C-1", "B-1"), ("B-1", "F-1"), ("F-1", "D-1"), ("F-1", "E-1")}
    assert text.count(" -> ") == len(steps)
    for source, target in steps:
        assert f'"{source}" -> "{target}" [' in text
    assert '"C-1" [label="C\\nnever done; shown in 1 of 2 demonstrations", style="rounded,dashed"];' in text


def test_a_picture_has_every_step_of_the_ways():
    drawn = plan(TASK, texts_of(TASK, {}, {}, None).sizes)
    assert len(drawn.links) == 6
    assert drawn.boxes.keys() == TASK.by_id.keys()
    texts = texts_of(TASK, {}, {}, None).boxes
    assert [path for path, text in texts.items() if text.bypassed] == ["C-1"]


def test_drawn_as_plain_it_keeps_its_links():
    plain = with_ways(TASK)
    assert not plain.paths
    assert set(TASK.links) <= set(plain.links)
    assert with_ways(FIRST) is FIRST


def test_what_is_done_before_in_any_case():
    *_, task = tasks("A C", "B C")
    assert not always_before(task, "A-1", "C-1")
    assert always_before(TASK, "A-1", "F-1")
    assert always_before(TASK, "F-1", "E-1")


def story(events, path, at_s):
    return WhyWords(TASK, {}).story(explain(History(TASK, events), path, at_s))


def test_why_a_step_is_out_of_play():
    events = [
        told("state", 0.0, "F-1", state="executing"),
        told("state", 0.0, "C-1", state="bypassed"),
        told("state", 0.0, "D-1", state="waiting", reason="path", **{"for": "F-1"}),
        told("achieved", 3.0, "E-1", on_purpose=True),
        told("state", 3.0, "E-1", state="achieved"),
        told("state", 3.0, "D-1", state="bypassed", by="E-1"),
    ]
    never = story(events, "C-1", 1.0)
    assert "step 6, C, is not active; it does not lie on the way." in never
    assert "Why:   A direct way leads past it." in never
    assert "Acts:  Never, as long as the direct way is there." in never
    waiting = story(events, "D-1", 1.0)
    assert "Why:   Step 3 (F) comes first on the way, and is not done." in waiting
    assert "Acts:  If step 3 (F) were done." in waiting
    other = story(events, "D-1", 4.0)
    assert "Why:   Step 5 (E) was taken, from which no way leads to it." in other
    assert "Since: 3.0 s, when step 5 (E) was taken." in other
    assert "Acts:  Not in this run." in other
