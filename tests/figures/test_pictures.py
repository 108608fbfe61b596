"""Every picture with realistic contents: nothing is clipped, and no text lies on another."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.text import Text

from tests.figures import nested, samples
from understudy.behaviors import installed_skills
from understudy.execution.trace import Event, State
from understudy.figures import (
    Mark,
    Trajectory,
    draw_arena,
    draw_network,
    draw_observations,
    draw_progress,
    draw_progress_average,
    marks_of_cues,
    marks_of_run,
)
from understudy.figures.progress import rows_of
from understudy.learning import learn
from understudy.network import Component, Network
from understudy.robot import Cue


def arena(**changes):
    task = samples.transport()
    events, _ = samples.run(task)
    box = Trajectory(
        name="orange box",
        points=np.array([[30.0, 2.75, 1.35], [60.0, 1.9, 3.4], [78.0, 1.2, 4.9]]),
        color="orange",
        dashed=True,
        body="box",
    )
    teacher = Trajectory(
        name="teacher", points=np.array([[0, 1.4, 1.2], [40, 1.9, 3.5], [60, 0.8, 4.7]]), color="blue", body="person"
    )
    return draw_arena(
        samples.room(**changes), [samples.drive(), box, teacher], marks_of_run(events, task), subtitle="on its own"
    )


def lying():
    room = samples.room(
        arena={"size": [6, 2]}, walls=[], boxes=[], robots=[{"name": "robot", "at": [0.4, 1]}],
        targets=[{"color": color, "at": [1.2 * (1 + index), 1]} for index, color in enumerate(samples.VISITED[:4])],
    )  # fmt: skip
    path = np.column_stack(
        [np.linspace(0, 40, 99), np.linspace(0.4, 5.5, 99), 1 + 0.5 * np.sin(np.linspace(0, 13, 99))]
    )
    marks = [
        Mark(time_s=8.0 * index, text=f"Track {color}", color=color) for index, color in enumerate(samples.VISITED)
    ]
    return draw_arena(room, [Trajectory(name="robot", points=path)], marks)


def with_states():
    task = samples.transport()
    states = dict(zip(task.topological_order, [*list(State)[:6], "achieved"], strict=True))
    return draw_network(task, states, installed_skills(), title="fetch, at 41 s")


def nested_states():
    task = nested.controls()
    states = dict(zip(task.by_path, itertools.cycle(reversed(State))))
    return draw_network(task, states, installed_skills(), title="at 41 s")


def progress(task, title, subtitle=""):
    events, duration = samples.run(task, begin=100.0)
    return draw_progress(task, events, duration, begin=100.0, title=title, subtitle=subtitle)


def averaged():
    task = samples.visit()
    runs = [
        [(id_, 10.0 * step * (1 + run / 5)) for step, id_ in enumerate(task.topological_order, 1)] for run in range(5)
    ]
    return draw_progress_average(task, [*runs, runs[0][:3]])


def doors():
    return samples.room(doors=[{"hinge": [1.4, 3.3], "to": [2.25, 3.3], "open_deg": 10}])


PICTURES = {
    "arena": arena,
    "arena, wide": lying,
    "arena, at the start": lambda: draw_arena(samples.room(), note="at the start"),
    "arena, doors": lambda: draw_arena(doors(), [samples.drive()], doors=[70.0]),
    "arena, doors, at the start": lambda: draw_arena(doors(), note="at the start"),
    "arena, empty": lambda: draw_arena(samples.room()),
    "transport": lambda: draw_network(samples.transport(), title="fetch"),
    "defaults": lambda: draw_network(samples.loose(), None, installed_skills()),
    "visit": lambda: draw_network(samples.visit()),
    "pancakes": lambda: draw_network(samples.pancakes(), title="pancakes " * 20),
    "wide": lambda: draw_network(samples.wide()),
    "layered": lambda: draw_network(samples.layered()),
    "single": lambda: draw_network(samples.single(), title="a title that is much wider than the only box"),
    "nothing": lambda: draw_network(Network(())),
    "states": with_states,
    "states of networks": nested_states,
    "hierarchical": lambda: draw_network(nested.hierarchical(), None, installed_skills(), title="§3.5.3.3"),
    "hierarchical, from outside": lambda: draw_network(nested.hierarchical(), title="§3.5.3.3", depth=1),
    "delivery": lambda: draw_network(nested.delivery(), None, installed_skills()),
    "rivals": lambda: draw_network(nested.rivals()),
    "controls": lambda: draw_network(nested.controls(), None, installed_skills()),
    "deep": lambda: draw_network(nested.deep()),
    "branches": lambda: draw_network(nested.branches(), None, installed_skills()),
    "large": lambda: draw_network(nested.large()),
    "observations": lambda: draw_observations(samples.demonstration()),
    "lesson": lambda: draw_observations(learn(samples.demonstration()), cues=[(64.0, Cue.DROP), (63.0, Cue.HERE)]),
    "progress": lambda: progress(samples.transport(), "fetch"),
    "progress, not done": lambda: progress(samples.transport(), "fetch", "Not done: the time limit of 300 s."),
    "progress of labels": lambda: progress(samples.pancakes(), "pancakes"),
    "progress of networks": lambda: draw_progress(nested.controls(), nested.run_of_controls(), 115.0, title="a patrol"),
    "progress of cases": lambda: draw_progress(nested.delivery(), nested.run_of_delivery(), 75.0, title="a delivery"),
    "averaged": averaged,
    "averaged networks": lambda: draw_progress_average(
        nested.hierarchical(), [[(path, 7.0 * step) for step, path in enumerate(nested.hierarchical().by_path)]] * 3
    ),
}


@pytest.fixture(params=PICTURES, scope="module")
def drawn(request):
    figure = PICTURES[request.param]()
    figure.canvas.draw()
    texts = [text for text in figure.findobj(Text) if text.get_visible() and text.get_text().strip()]
    return figure, [(text.get_text(), text.get_window_extent()) for text in texts if text.axes is not None]


def test_no_text_is_clipped(drawn):
    figure, texts = drawn
    for text, extent in texts:
        assert figure.bbox.x0 <= extent.x0, text
        assert extent.x1 <= figure.bbox.x1, text
        assert figure.bbox.y0 <= extent.y0, text
        assert extent.y1 <= figure.bbox.y1, text


def test_no_text_lies_on_another(drawn):
    _, texts = drawn
    for (one, a), (other, b) in itertools.combinations(texts, 2):
        across = min(a.x1, b.x1) - max(a.x0, b.x0)
        down = min(a.y1, b.y1) - max(a.y0, b.y0)
        # Two pixels at 160 dots an inch are less than a point.
        assert across < 2 or down < 2, (one, other)


def texts_of(figure):
    return [text.get_text() for text in figure.axes[0].texts]


def test_an_arena_names_things_and_numbers_marks():
    texts = texts_of(arena())
    assert {"green", "yellow", "light orange", "orange", "orange box", "start", "1 m"} <= set(texts)
    assert [texts.count(str(number)) for number in range(1, 8)] == [2] * 7
    assert {"robot", "80 s", "Track light orange", "32.0 s", "already so when its turn came"} <= set(texts)


def test_boxes_may_be_said_to_stand_where_they_once_stood():
    assert "orange box, at the start" in texts_of(draw_arena(samples.room(), note="at the start"))


def test_a_door_is_drawn_as_it_stands_in_the_end_and_where_it_was_at_the_start():
    assert "door, at the start" in texts_of(draw_arena(doors(), note="at the start"))
    swung, stayed = (len(draw_arena(doors(), doors=[opened]).axes[0].lines) for opened in (70.0, 11.0))
    assert swung == stayed + 2


def test_an_arena_is_to_scale():
    figure = draw_arena(samples.room())
    discs = [patch for patch in figure.axes[0].patches if type(patch).__name__ == "Circle"]
    (x1, y1), (x2, y2) = discs[0].center, discs[3].center
    scale = (x1 - x2) / (3.2 - 1.0)
    assert (y1 - y2) / (5.2 - 0.9) == pytest.approx(scale)
    assert discs[0].radius == pytest.approx(0.10 * scale)


def test_marks_of_a_run_tell_what_was_found_from_what_was_done():
    task = samples.transport()
    marks = marks_of_run(samples.run(task)[0], task)
    assert [mark.text for mark in marks[:3]] == ["Drop", "Track green", "PickUp orange"]
    assert [mark.found for mark in marks] == [True] + [False] * 6
    assert marks[1].color == "green"
    assert marks_of_cues([(3.0, Cue.HERE)], on="teacher") == (Mark(time_s=3.0, text="HERE", on="teacher"),)


def test_a_lesson_shows_the_reasons_for_what_was_left_out():
    texts = texts_of(draw_observations(learn(samples.demonstration())))
    assert {"seen for 1.2 s only (at least 2 s)", "no cue while it was true", "left out"} <= set(texts)
    assert {"0.52 m, 88°", "HERE", "TAKE", "DROP"} <= set(texts)


def test_a_demonstration_alone_leaves_nothing_out():
    assert "left out" not in texts_of(draw_observations(samples.demonstration()))


def test_a_clock_that_began_long_ago_is_counted_from_the_start():
    assert texts_of(draw_observations(samples.demonstration(begin=1.7e9))) == texts_of(
        draw_observations(samples.demonstration())
    )


def test_progress_gives_the_moments_since_the_beginning():
    texts = texts_of(progress(samples.visit(), "visit"))
    assert {"0.0 s", "8.0 s", "40.0 s", "complete 41.0 s"} <= set(texts)


def test_progress_tells_of_every_part_and_round():
    texts = texts_of(PICTURES["progress of networks"]())
    assert {"1", "2.1", "2.2", "5.2", "skipped", "2×, last 90.0 s", "2", "58.0 s"} <= set(texts)
    assert {"inhibited", "called", "out of time", "round or case begins"} <= set(texts)
    assert not {"inhibited", "called", "round or case begins"} & set(texts_of(progress(samples.visit(), "visit")))
    letters = texts_of(PICTURES["progress of cases"]())
    assert (letters.count("b"), letters.count("a")) == (2, 2)


def test_progress_shows_a_lesson_and_what_was_bad():
    told = (
        Event(time_s=1.0, kind="suspended"),
        Event(time_s=4.0, kind="resumed"),
        Event(time_s=5.5, kind="corrected", component="green", detail={"word": "BAD", "said_s": 5.0, "others": []}),
    )
    task = Network((Component(id="green", behavior="Track", parameters={"color": "green"}),))
    assert {"being shown, COME to GO", "BAD: taken out"} <= set(texts_of(draw_progress(task, told, 10.0)))
    in_vain = replace(told[2], detail={**told[2].detail, "note": "it is the only step"})
    quiet = draw_progress(task, [in_vain], 10.0)
    assert not {"being shown, COME to GO", "BAD: taken out"} & set(texts_of(quiet))


def test_parts_stand_below_what_they_are_parts_of():
    rows = rows_of(nested.hierarchical())
    assert [row.number for row in rows.values()][:6] == ["1", "1.1", "1.2", "1.3", "1.3.1", "1.3.2"]
    assert rows["transport"].indent < rows["transport/gate"].indent < rows["transport/gate/yellow"].indent


def test_a_network_needs_no_mark_beside_those_of_its_steps():
    marks = marks_of_run(nested.run_of_controls(), nested.controls())
    assert [mark.text for mark in marks] == [
        "Track yellow", "Track pink", "Track red", "Track blue", "Drop", "Track pink", "Track red", "PickUp orange",
    ]  # fmt: skip


def test_averages_are_those_of_the_runs_that_got_there():
    texts = texts_of(averaged())
    assert "10.0 s ± 0.0 s" not in texts
    # Six runs reach the first step: 10, 12, 14, 16, 18 and once more 10 s.
    assert f"{np.mean([10, 12, 14, 16, 18, 10]):.1f} s ± {np.std([10, 12, 14, 16, 18, 10], ddof=1):.1f} s" in texts
    assert texts.count("6 of 6") == 3
    assert texts.count("5 of 6") == 3


def test_letters_that_the_font_lacks_are_boxes_and_no_warnings():
    task = samples.network([samples.component("a", "煮 water \U0001f6f8")], [])
    assert "□ water □" in texts_of(draw_network(task))


def test_labels_from_documents_are_no_formulas():
    task = samples.network([samples.component("a", "pay $5 and $6_x$\nat once \t now")], [])
    assert "pay $5 and $6_x$ at once now" in " ".join(texts_of(draw_network(task)))
