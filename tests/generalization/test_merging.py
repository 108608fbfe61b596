"""What must hold after any demonstrations, and what is refused."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.errors import LearningError
from understudy.generalization import generalize
from understudy.generalization.values import typical
from understudy.network import (
    END,
    START,
    Component,
    Happened,
    Interval,
    LinkType,
    Nab,
    Network,
    Occurrence,
    Timeout,
    Trigger,
    expand_links,
)

from .words import edges_of, learned, paths_of, symbols_of, tasks, walks, without_evidence

ORDERING, ENABLING, PERMANENT = LinkType.ORDERING, LinkType.ENABLING, LinkType.PERMANENT


def shown_path(network: Network, name: str) -> list[str]:
    """The way that one demonstration took."""
    next_ = {edge.source: edge.target for edge in network.topology.edges if name in edge.shown}
    way, id_ = [], next_[START]
    while id_ != END:
        way.append(id_)
        id_ = next_[id_]
    assert len(next_) == len(way) + 1
    return way


@given(walks())
def test_every_demonstration_is_a_way_through_the_task(words: list[str]) -> None:
    *_, task = tasks(*words)
    symbols = symbols_of(task)
    for number, word in enumerate(words, start=1):
        way = shown_path(task, f"d{number}")
        assert [symbols[id_] for id_ in way] == word.split()
        assert [id_ for id_ in task.topology.ids if f"d{number}" in task.topology.shown_by[id_]] == way
        assert {one.id for one in task.components if f"d{number}" in names_in(one)} == set(way)
    assert len(list(paths_of(task.topology))) >= len(set(words))


def names_in(component: object) -> list[str]:
    assert isinstance(component, Component)
    return [one.demonstration for one in component.occurrences]


@given(walks(max_words=3))
def test_a_task_is_plain_as_long_as_all_show_the_same(words: list[str]) -> None:
    *_, task = tasks(*words)
    assert (not task.paths) == (len(set(words)) == 1)


LinkTypes = dict[tuple[int, int], LinkType]


@st.composite
def lessons(draw: st.DrawFn) -> list[tuple[str, LinkTypes]]:
    words = draw(walks(letters="AB", max_length=4, max_words=3))
    found = []
    for word in words:
        length = len(word.split())
        pairs = [(a, b) for a in range(length) for b in range(a + 1, length)]
        chosen = draw(st.lists(st.sampled_from(pairs), unique=True, max_size=4)) if pairs else []
        found.append((word, {pair: draw(st.sampled_from(list(LinkType))) for pair in chosen}))
    return found


@given(lessons())
def test_links_are_those_of_the_definition(lessons: list[tuple[str, LinkTypes]]) -> None:
    """§5.1.2 over all demonstrations at once: the least restrictive of those that show both, else an order."""
    networks = {f"d{number}": learned(f"d{number}", *lesson) for number, lesson in enumerate(lessons, start=1)}
    task, *others = networks.values()
    for other in others:
        task = generalize(task, other).network
    found = {(link.source, link.target): link.type for link in expand_links(task).links}
    ways = {name: shown_path(task, name) for name in networks}
    own = {}
    for name, network in networks.items():
        ids = dict(zip(network.topological_order, ways[name], strict=True))
        own[name] = {(ids[link.source], ids[link.target]): link.type for link in expand_links(network).links}
    for first in task.by_id:
        for last in task.by_id:
            both = [own[name].get((first, last)) for name, way in ways.items() if first in way and last in way]
            if not task.topology.leads(first, last):
                assert (first, last) not in found
            elif both:
                assert found[first, last] is min((type_ for type_ in both if type_), key=lambda type_: type_.strength)
            else:
                assert found[first, last] is ORDERING


def test_without_alternatives_steps_that_one_did_not_order_are_not_ordered() -> None:
    one = learned("d1", "A B")
    other = replace(learned("d2", "A B"), links=())
    assert generalize(one, other).network.links == ()
    assert generalize(other, one).network.links == ()


def test_a_link_keeps_what_all_say_of_it() -> None:
    one, other = learned("d1", "A B C", {(0, 1): PERMANENT}), learned("d2", "A B", {(0, 1): ENABLING})
    (link,) = generalize(one, other).network.links
    assert (link.source, link.target, link.type) == ("A-1", "B-1", ENABLING)
    assert [evidence.demonstration for evidence in link.evidence] == ["d1", "d2"]


def test_the_same_name_twice_is_told_apart() -> None:
    task = learned("d1", "A B")
    task = generalize(task, learned("d1", "A C")).network
    task = generalize(task, learned("d1", "A C")).network
    assert task.demonstrations == ("d1", "d1 (2)", "d1 (3)")
    assert names_in(task.by_id["C-1"]) == ["d1 (2)", "d1 (3)"]


def test_what_has_no_evidence_is_called_by_the_names_given() -> None:
    written = without_evidence(learned("", "A B"))
    task = generalize(written, without_evidence(learned("", "A C")), names=("plan", "lesson")).network
    assert task.topology.shown_by == {
        "A-1": ("plan", "lesson"),
        "B-1": ("plan",),
        "C-1": ("lesson",),
        END: ("plan", "lesson"),
    }


def test_ids_stay_unique_and_known_ones_stay() -> None:
    *_, task = tasks("A B A", "B A A B", "A A A A")
    assert {"A-1", "B-1", "A-2"} <= set(task.by_id)


def test_what_changed_is_told() -> None:
    task = learned("d1", "A B C D", {(0, 1): PERMANENT})
    changed = generalize(task, learned("d2", "A B D E")).difference
    assert changed.merged == ("A-1", "B-1", "D-1")
    assert changed.added == ("E-1",)
    first, last = changed.branches
    assert (first.after, first.before, first.steps, first.instead) == ("B-1", "D-1", (), ("C-1",))
    assert (last.after, last.before, last.steps, last.instead) == ("D-1", END, ("E-1",), ())
    assert changed.bypassed == ("C-1", "E-1")
    (relaxed,) = changed.relaxed
    assert (relaxed.source, relaxed.target, relaxed.was, relaxed.now) == ("A-1", "B-1", PERMANENT, ORDERING)


def test_nothing_changes_when_it_is_shown_again() -> None:
    *_, task = tasks("A B", "A C")
    again = generalize(task, learned("d3", "A B"))
    assert edges_of(again.network) == edges_of(task)
    changed = again.difference
    assert (changed.added, changed.branches, changed.bypassed) == ((), (), ())


@pytest.mark.parametrize(
    ("part", "reason"),
    [
        (Nab.of("n", learned("d", "A")), "only steps that are behaviors"),
        (Component(id="n", behavior="N", trigger=Trigger(on=Happened(event="bell"))), "duty"),
    ],
)
def test_what_has_no_place_in_an_alignment_is_refused(part: Component | Nab, reason: str) -> None:
    odd = replace(learned("d1", "A"), components=(*learned("d1", "A").components, part))
    for pair in ((odd, learned("d2", "A")), (learned("d2", "A"), odd)):
        with pytest.raises(LearningError, match=reason):
            generalize(*pair)


def test_a_demonstration_has_neither_alternatives_nor_controls() -> None:
    *_, task = tasks("A B", "A C")
    with pytest.raises(LearningError, match="alternatives"):
        generalize(learned("d1", "A"), task)
    patient = replace(learned("d1", "A"), components=(Component(id="A-1", behavior="A", timeout=Timeout(seconds=3)),))
    with pytest.raises(LearningError, match="timeout"):
        generalize(learned("d1", "A"), patient)
    assert generalize(patient, learned("d1", "A")).network.by_id["A-1"].timeout


def step(name: str, **values: float) -> Network:
    occurrence = Occurrence(demonstration=name, interval=Interval(0, 1), values=values)
    return Network(
        (Component(id="A-1", behavior="A", parameters={"color": "red", **values}, occurrences=(occurrence,)),)
    )


def parameters(*networks: Network) -> dict[str, object]:
    task, *others = networks
    for other in others:
        task = generalize(task, other).network
    (component,) = task.components
    assert isinstance(component, Component)
    return dict(component.parameters)


def test_numbers_that_were_shown_together_stay_together() -> None:
    right, left = step("d1", distance_m=0.5, angle_deg=10.0), step("d2", distance_m=0.7, angle_deg=170.0)
    assert parameters(right, left) == {"color": "red", "distance_m": 0.7, "angle_deg": 170.0}  # no mean: the last one
    near = step("d3", distance_m=0.52, angle_deg=12.0)
    assert parameters(right, left, near) == {"color": "red", "distance_m": 0.52, "angle_deg": 12.0}
    assert parameters(left, right, near)["angle_deg"] == 12.0
    far = step("d4", distance_m=1.9, angle_deg=175.0)
    assert parameters(right, near, left, far)["distance_m"] in (0.52, 0.7)


@given(st.lists(st.fixed_dictionaries({"x": st.integers(0, 9), "y": st.integers(0, 9)}), min_size=1, max_size=6))
def test_typical_values_are_among_those_shown(shown: list[dict[str, float]]) -> None:
    assert typical(shown) in shown
    alike = [{"x": 1.0, "y": 2.0}] * (len(shown) + 1)
    assert typical([*shown, *alike]) == {"x": 1.0, "y": 2.0}  # what most show


def test_numbers_that_somebody_wrote_stay() -> None:
    written = replace(step("d1", distance_m=0.5))
    (component,) = written.components
    assert isinstance(component, Component)
    written = Network((replace(component, parameters={"color": "red", "distance_m": 1.0}),))
    assert parameters(written, step("d2", distance_m=0.6)) == {"color": "red", "distance_m": 1.0}


def test_another_color_is_another_step() -> None:
    green = Network((Component(id="A-1", behavior="A", parameters={"color": "green"}),))
    assert len(generalize(step("d1"), green).network.components) == 2


def test_the_links_of_a_step_that_got_another_id_follow_it() -> None:
    merged = generalize(learned("d1", "A B A"), learned("d2", "A A B A", {(0, 1): ENABLING})).network
    (link,) = merged.links
    assert (link.source, link.target, link.type) == ("A-3", "A-1", ENABLING)
