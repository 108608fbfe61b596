from collections.abc import Sequence

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from understudy.learning import LearningSettings, Observed, construct
from understudy.network import Component, Interval, Link, LinkType, Network, expand_links, reduce_links

from . import reference
from .build import interval, seconds, seen, spans, tracked, typed_links

tolerances = st.sampled_from([0, 25, 50, 110])
Span = tuple[int, int]


def learned(observations: Sequence[Observed], **changes: object) -> tuple[dict[tuple[int, int], str], Network]:
    """The links by the observations' places in the given list, which their label carries."""
    labelled = [
        Observed(
            instance=type(observed.instance)(f"step{place}"),
            interval=observed.interval,
            values=observed.values,
            closest_s=observed.closest_s,
            history=observed.history,
        )
        for place, observed in enumerate(observations)
    ]
    network = construct(labelled, demonstration="d", settings=LearningSettings(**changes))  # type: ignore[arg-type]
    place_of = {component.id: int(component.behavior.removeprefix("step")) for component in network.components}
    return {(place_of[s], place_of[t]): type_ for (s, t), type_ in typed_links(network).items()}, network


def plain(all_spans: Sequence[Span]) -> list[Observed]:
    return [seen(*interval(span)) for span in all_spans]


@given(st.lists(spans(), max_size=12), tolerances)
@example([(0, 0), (0, 0), (50, 50), (75, 75), (100, 100)], 50)
def test_the_sweep_stores_what_all_pairs_store_less_what_is_implied(all_spans: list[Span], tolerance: int) -> None:
    links, _ = learned(plain(all_spans), tolerance_s=seconds(tolerance))
    assert links == reference.without_implied(reference.all_links(all_spans, tolerance))


@settings(deadline=None)  # the reference tries every path anew
@given(st.lists(spans(max_length=4), min_size=8, max_size=18), tolerances)
def test_also_where_most_intervals_are_short(all_spans: list[Span], tolerance: int) -> None:
    links, _ = learned(plain(all_spans), tolerance_s=seconds(tolerance))
    assert links == reference.without_implied(reference.all_links(all_spans, tolerance))


@given(st.lists(spans(), max_size=10), tolerances)
def test_the_full_set_can_be_had_back(all_spans: list[Span], tolerance: int) -> None:
    _, network = learned(plain(all_spans), tolerance_s=seconds(tolerance))
    full = expand_links(network)
    place_of = {component.id: int(component.behavior.removeprefix("step")) for component in network.components}
    pairs = {(place_of[s], place_of[t]): type_ for (s, t), type_ in typed_links(full).items()}
    assert pairs == reference.all_links(all_spans, tolerance)
    assert reduce_links(full) == network


@st.composite
def approached(draw: st.DrawFn) -> tuple[Span, int]:
    """An interval and, in it, the moment of closest approach."""
    span = draw(spans())
    return span, draw(st.integers(span[0] // 25, span[1] // 25)) * 25


@given(st.lists(approached(), max_size=12), tolerances)
def test_by_closest_approach_every_pair_keeps_the_order_of_the_approaches(
    approaches: list[tuple[Span, int]], tolerance: int
) -> None:
    observations = [seen(*interval(span), closest_s=seconds(moment)) for span, moment in approaches]
    links, _ = learned(observations, order="closest", tolerance_s=seconds(tolerance))
    full = reference.all_links(
        [span for span, _ in approaches], tolerance, moments=[moment for _, moment in approaches]
    )
    assert links == reference.without_implied(full)


@given(st.lists(approached(), max_size=12), tolerances, st.sampled_from(["onset", "closest"]))
def test_the_observed_order_is_enforced(approaches: list[tuple[Span, int]], tolerance: int, order: str) -> None:
    """§4.4.2: all the stages, and whatever was over before the other began is forced to come first."""
    observations = [seen(*interval(span), closest_s=seconds(moment)) for span, moment in approaches]
    links, network = learned(observations, order=order, tolerance_s=seconds(tolerance))
    assert len(network.components) == len(approaches)
    forced = reference.joined(links, len(approaches))
    for i, (a, _) in enumerate(approaches):
        for j, (b, _) in enumerate(approaches):
            if reference.earlier(a[1], b[0], tolerance):
                assert (i, j) in forced
    assert not any((j, i) in forced for i, j in forced)


@st.composite
def watched(draw: st.DrawFn) -> tuple[Span, list[float] | None]:
    """An interval, and perhaps a target's distance at every 25 ms of it."""
    span = draw(spans())
    ticks = (span[1] - span[0]) // 25
    if ticks == 0 or draw(st.booleans()):
        return span, None
    return span, draw(st.lists(st.sampled_from([0.5, 0.58, 0.7]), min_size=ticks, max_size=ticks))


@settings(max_examples=200)
@given(st.lists(watched(), max_size=9), tolerances)
def test_a_goal_with_parameters_is_permanent_only_where_it_held(
    watches: list[tuple[Span, list[float] | None]], tolerance: int
) -> None:
    observations = [
        seen(*interval(span)) if values is None else tracked(seconds(span[0]), values, period_s=0.025)
        for span, values in watches
    ]
    not_held = {}
    for i, (a, values) in enumerate(watches):
        for j, (b, _) in enumerate(watches):
            if values is not None:
                during = [value for tick, value in enumerate(values) if b[0] <= a[0] + 25 * tick < b[1]]
                not_held[i, j] = not during or any(abs(value - values[-1]) > 0.1001 for value in during)
    links, _ = learned(observations, tolerance_s=seconds(tolerance))
    with_values = [i for i, (_, values) in enumerate(watches) if values is not None]
    full = reference.all_links([span for span, _ in watches], tolerance, not_held=not_held, with_values=with_values)
    assert links == reference.without_implied(full)


def test_only_the_pole_that_was_left_last_enables_the_next_step() -> None:
    first, second = tracked(0.0, [0.5] * 40), tracked(1.0, [0.5] * 35, color="pink")
    network = construct([first, second, seen(2.0, 9.0, "PickUp")], demonstration="d")
    assert {pair: type_ for pair, type_ in typed_links(network).items() if pair[1] == "pick-up-1"} == {
        ("track-pink-1", "pick-up-1"): "enabling"
    }


def test_ties_stay_in_order_of_appearance() -> None:
    network = construct([seen(1, 5, "b"), seen(1, 5, "a"), seen(0, 9, "c")], demonstration="d")
    assert [component.id for component in network.components] == ["c-1", "b-1", "a-1"]
    assert typed_links(network) == {("c-1", "b-1"): "permanent", ("c-1", "a-1"): "permanent"}


def test_a_link_carries_its_evidence() -> None:
    network = construct([seen(0, 5, "a"), seen(3, 8, "b")], demonstration="tuesday")
    [link] = network.links
    [evidence] = link.evidence
    assert (evidence.demonstration, evidence.relation, evidence.note) == ("tuesday", "overlaps", "")
    assert (evidence.source, evidence.target) == (Interval(0, 5), Interval(3, 8))


def test_the_note_says_why_a_target_in_view_is_no_permanent_condition() -> None:
    leaving = tracked(0.0, [0.3 + 0.01 * tick for tick in range(100)])
    network = construct([leaving, seen(2, 6, "PickUp")], demonstration="d")
    [link] = network.links
    assert link.type is LinkType.ORDERING
    assert link.evidence[0].relation == "includes"
    assert "distance_m went from 0.50 to 0.89, learned 1.29" in link.evidence[0].note


def test_the_far_target_seen_first_and_visited_last_comes_last_by_closest_approach() -> None:
    far = tracked(0.0, [3.0 - 0.02 * tick for tick in range(100)], color="pink")
    near = tracked(2.0, [1.0 - 0.05 * tick for tick in range(15)], color="green")
    by_onset = construct([far, near], demonstration="d")
    assert [component.id for component in by_onset.components] == ["track-pink-1", "track-green-1"]
    by_approach = construct([far, near], demonstration="d", settings=LearningSettings(order="closest"))
    [link] = by_approach.links
    assert (link.source, link.target, link.type) == ("track-green-1", "track-pink-1", LinkType.ORDERING)
    assert link.evidence[0].relation == "includes"
    assert "closest approach at 3.4 s, then 9.9 s" in link.evidence[0].note


def test_a_component_carries_what_was_learned() -> None:
    observed = tracked(0.0, [0.9, 0.4, 0.51239999])
    [component] = construct([observed], demonstration="d").components
    assert component.id == "track-green-1"
    assert component.parameters == {"color": "green", "distance_m": 0.512}
    [occurrence] = component.occurrences
    assert occurrence.values == {"distance_m": 0.51239999}
    assert occurrence.closest_s == pytest.approx(0.1)


def test_ten_thousand_in_a_row_make_a_chain() -> None:
    network = construct([seen(3 * i, 3 * i + 2) for i in range(10_000)], demonstration="d")
    assert len(network.links) == 9_999


@st.composite
def networks(draw: st.DrawFn) -> Network:
    """Random directed acyclic graphs, which no intervals need to have given."""
    size = draw(st.integers(0, 9))
    pairs = [(i, j) for i in range(size) for j in range(i + 1, size)]
    chosen = draw(st.lists(st.sampled_from(pairs), unique=True)) if pairs else []
    return Network(
        components=tuple(Component(id=str(i), behavior="a") for i in range(size)),
        links=tuple(Link(source=str(i), target=str(j), type=draw(st.sampled_from(list(LinkType)))) for i, j in chosen),
    )


@given(networks())
def test_reduction_takes_out_the_implied_ordering_links_and_no_others(network: Network) -> None:
    full = {(int(link.source), int(link.target)): link.type.value for link in network.links}
    reduced = {(int(link.source), int(link.target)): link.type.value for link in reduce_links(network).links}
    assert reduced == reference.without_implied(full)
    size = len(network.components)
    assert reference.joined(reduced, size) == reference.joined(full, size)
    expanded = {(int(link.source), int(link.target)) for link in expand_links(network).links}
    assert expanded == reference.joined(full, size)
