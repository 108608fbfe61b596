import itertools
from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from tests.figures.samples import component, layered, network, transport, visit, wide
from understudy.figures import layout
from understudy.figures.network_layers import arrange
from understudy.network import LinkType, Network, Trigger


@st.composite
def networks(draw):
    count = draw(st.integers(1, 10))
    pairs = [(a, b) for b in range(count) for a in range(b)]
    chosen = draw(st.lists(st.sampled_from(pairs), unique=True, max_size=20)) if pairs else []
    kinds = draw(st.lists(st.sampled_from(list(LinkType)), min_size=len(chosen), max_size=len(chosen)))
    links = [(f"c{a}", f"c{b}", kind) for (a, b), kind in zip(chosen, kinds, strict=True)]
    order = draw(st.permutations(range(count)))
    made = network([component(f"c{index}", "Track") for index in order], links)
    ids = st.sampled_from([one.id for one in made.components])
    rivals = draw(st.lists(st.tuples(ids, ids).filter(lambda pair: pair[0] != pair[1]), unique=True, max_size=5))
    waited_for = {link.source for link in made.links}
    duties = {id_ for id_ in draw(st.sets(ids)) if id_ not in waited_for}
    if len(duties) == count:
        duties.clear()
    beside = tuple(replace(one, trigger=Trigger(every_s=9)) if one.id in duties else one for one in made.components)
    return Network(beside, made.links, tuple(rivals)) if count > 1 else made


@st.composite
def sized(draw):
    made = draw(networks())
    size = st.tuples(st.floats(30, 300), st.floats(15, 90))
    return made, {one.id: draw(size) for one in made.components if draw(st.booleans())}


@given(sized())
def test_boxes_do_not_overlap_and_lie_on_the_sheet(case):
    made, sizes = case
    drawn = layout(made, sizes)
    places = list(drawn.places.values())
    assert len(places) == len(made.components)
    for index, a in enumerate(places):
        assert a.x >= -1e-6
        assert a.x + a.width <= drawn.width + 1e-6
        assert a.y >= 0
        assert a.bottom <= drawn.height + 1e-6
        for b in places[:index]:
            beside = a.x + a.width + 5 <= b.x or b.x + b.width + 5 <= a.x
            assert beside or a.bottom + 5 <= b.y or b.bottom + 5 <= a.y


@given(sized())
def test_every_link_runs_downwards_from_box_to_box(case):
    made, sizes = case
    drawn = layout(made, sizes)
    assert set(drawn.routes) == {(link.source, link.target) for link in made.links}
    for (source, target), route in drawn.routes.items():
        upper, lower = drawn.places[source], drawn.places[target]
        assert route[0][1] == upper.bottom
        assert upper.x <= route[0][0] <= upper.x + upper.width
        assert route[-1][1] == lower.y
        assert lower.x <= route[-1][0] <= lower.x + lower.width
        assert all(above[1] < below[1] for above, below in itertools.pairwise(route))


@given(sized())
def test_rivals_are_joined_once_from_edge_to_edge(case):
    made, sizes = case
    drawn = layout(made, sizes)
    assert {frozenset(pair) for pair in drawn.rivals} == {frozenset(pair) for pair in made.inhibitions}
    assert len(drawn.rivals) == len({frozenset(pair) for pair in made.inhibitions})
    for pair, route in drawn.rivals.items():
        for id_, (x, y) in zip(pair, (route[0], route[-1]), strict=True):
            place = drawn.places[id_]
            at_the_side = min(abs(x - place.x), abs(x - place.x - place.width)) < 1e-6
            level = at_the_side and place.y <= y <= place.bottom
            assert level or (y in (place.y, place.bottom) and place.x <= x <= place.x + place.width)


@given(sized())
def test_lines_below_a_layer_keep_apart(case):
    made, sizes = case
    drawn = layout(made, sizes)
    below = [(route[1], route[2]) for route in drawn.rivals.values() if len(route) == 4 and route[1][1] == route[2][1]]
    for ((a, y1), (b, _)), ((c, y2), (d, _)) in itertools.combinations(below, 2):
        assert y1 != y2 or b < c - 5 or d < a - 5


@given(sized())
def test_no_line_runs_through_a_box(case):
    made, sizes = case
    drawn = layout(made, sizes)
    downwards = [route for route in drawn.rivals.values() if all(a[1] < b[1] for a, b in itertools.pairwise(route))]
    for route in (*drawn.routes.values(), *downwards):
        for (x1, y1), (x2, y2) in itertools.pairwise(route):
            for place in drawn.places.values():
                if y1 < place.bottom - 1e-6 and y2 > place.y + 1e-6:
                    assert max(x1, x2) < place.x - 5 or min(x1, x2) > place.x + place.width + 5


@given(sized())
def test_the_same_network_gives_the_same_layout(case):
    made, sizes = case
    again = Network(tuple(made.components), tuple(made.links), tuple(made.inhibitions))
    assert layout(made, sizes) == layout(again, dict(reversed(sizes.items())))


@given(networks())
def test_arrow_heads_keep_apart(made):
    drawn = layout(made)
    for id_ in drawn.places:
        ends = sorted(route[-1][0] for (_, target), route in drawn.routes.items() if target == id_)
        assert all(b - a > 12 for a, b in itertools.pairwise(ends))


def test_a_chain_stands_in_one_straight_column():
    for task in (visit(), transport()):
        drawn = layout(task)
        assert len({round(place.middle, 6) for place in drawn.places.values()}) == 1
    assert all(len({round(x, 6) for x, _ in route}) == 1 for route in layout(visit()).routes.values())


def test_what_must_hold_all_the_while_fans_out_on_the_right():
    drawn = layout(transport())
    column = drawn.places["pick-up"]
    right = [max(x for x, _ in drawn.routes["pick-up", id_]) for id_ in ("light-orange", "orange")]
    assert column.x + column.width < right[0] < right[1]
    assert min(x for x, _ in drawn.routes["pick-up", "drop-2"]) < column.x


def test_a_fan_is_symmetric():
    drawn = layout(wide(5))
    first = drawn.places["first"]
    assert abs(first.middle - drawn.places["t2"].middle) < 0.5
    assert abs((first.middle - drawn.places["t0"].middle) - (drawn.places["t4"].middle - first.middle)) < 0.5


def test_crossings_that_can_be_avoided_are_avoided():
    # Written down, every link of the second to the third layer would cross another one.
    steps = [component(name, "Track") for name in ("a", "b", "c", "z", "y", "x")]
    layers = arrange(network(steps, [("a", "x", "ordering"), ("b", "y", "ordering"), ("c", "z", "enabling")]))
    place = {slot.source: index for row in layers.rows for index, slot in enumerate(row)}
    assert sorted("abc", key=place.get) == ["abc"["xyz".index(name)] for name in sorted("xyz", key=place.get)]


def test_long_links_pass_every_layer_between():
    layers = arrange(layered())
    for route in layers.routes.values():
        assert [slot.row for slot in route] == list(range(route[0].row, route[-1].row + 1))


def test_an_empty_network_has_an_empty_layout():
    drawn = layout(Network(()))
    assert (drawn.width, drawn.height, drawn.places, drawn.routes) == (0.0, 0.0, {}, {})
