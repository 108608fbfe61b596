"""Networks in networks, drawn: nothing overlaps, nothing sticks out, whatever stands in whatever."""

import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.execution.strategies import hierarchies
from tests.figures import nested
from understudy.figures.network_plan import BORDER, plan
from understudy.figures.network_text import texts_of
from understudy.network import Nab

SAMPLES = ("hierarchical", "delivery", "rivals", "controls", "deep", "branches", "large")


def planned(network, depth=None):
    texts = texts_of(network, {}, {}, depth)
    return texts, plan(network, texts.sizes)


def apart(a, b, by=4.0):
    return (
        a.x + a.width + by <= b.x
        or b.x + b.width + by <= a.x
        or a.y + a.height + by <= b.y
        or b.y + b.height + by <= a.y
    )


def inside(part, whole, by=0.0):
    return (
        part.x >= whole.x + by - 1e-6
        and part.y >= whole.y + by - 1e-6
        and part.x + part.width <= whole.x + whole.width - by + 1e-6
        and part.bottom <= whole.bottom - by + 1e-6
    )


def holds_point(place, point, by=0.0):
    x, y = point
    return place.x + by - 1e-6 <= x <= place.x + place.width - by + 1e-6 and place.y - 1e-6 <= y <= place.bottom + 1e-6


def surroundings(network, drawn):
    """For every box the box or panel just around it, or None; and who stands beside it there."""
    around, beside = {}, {}

    def read(part, prefix, outer):
        paths = [prefix + component.id for component in part.components]
        for component, path in zip(part.components, paths, strict=True):
            around[path], beside[path] = outer, [other for other in paths if other != path]
            if isinstance(component, Nab) and path in drawn.boxes:
                for case in component.cases:
                    below = "/".join(filter(None, (path, case.name))) + "/"
                    if any(drawn_path.startswith(below) for drawn_path in drawn.boxes):
                        read(case.network, below, drawn.panels.get(below, drawn.boxes[path]))

    read(network, "", None)
    return around, beside


def check(network, depth=None):
    texts, drawn = planned(network, depth)
    around, beside = surroundings(network, drawn)
    assert set(drawn.boxes) == set(around)
    for path, place in drawn.boxes.items():
        outer = around[path]
        if outer is None:
            assert place.x >= -1e-6
            assert place.y >= -1e-6
            assert place.x + place.width <= drawn.width + 1e-6
            assert place.bottom <= drawn.height + 1e-6
        else:
            assert inside(place, outer, BORDER)
        for other in beside[path]:
            assert apart(place, drawn.boxes[other])
        # What is written fits.
        text = texts.boxes.get(path) or texts.headings[path]
        assert text.size[0] <= place.width + 1e-6
        assert text.size[1] <= place.height + 1e-6
        if path in texts.headings:
            ceiling = place.y + BORDER + text.size[1]
            assert all(below.y >= ceiling - 1e-6 for one, below in drawn.boxes.items() if one.startswith(f"{path}/"))
    for one, other in itertools.combinations(drawn.panels.items(), 2):
        (a, first), (b, second) = one, other
        if not a.startswith(b) and not b.startswith(a):
            assert apart(first, second)
    for below, panel in drawn.panels.items():
        width, height = texts.panels[below].size
        assert width <= panel.width
        assert all(place.y >= panel.y + 8.0 + height for path, place in drawn.boxes.items() if path.startswith(below))
    check_lines(texts, drawn, around)


def check_lines(texts, drawn, around):
    frames = {path.rpartition("/")[0] + "/" if "/" in path else "": outer for path, outer in around.items()}
    for line in (*drawn.links, *drawn.rivals):
        outer = frames[line.inside]
        for point in line.route:
            assert outer is None or holds_point(outer, point, BORDER)
    for line in drawn.rivals:
        # Rivals are joined without running through any box of their network.
        for (x1, y1), (x2, y2) in itertools.pairwise(line.route):
            for path, place in drawn.boxes.items():
                if (x1 == x2 or y1 == y2) and path.startswith(line.inside) and "/" not in path[len(line.inside) :]:
                    over = min(x2, x1) < place.x + place.width - 1e-6 and max(x1, x2) > place.x + 1e-6
                    down = min(y1, y2) < place.bottom - 1e-6 and max(y1, y2) > place.y + 1e-6
                    assert not (over and down)
    labels = {}
    for line in drawn.switches:
        box = drawn.boxes[line.path]
        assert all(holds_point(box, point, BORDER) for point in line.route)
        assert inside(line.label, box, BORDER)
        assert texts.switches[line.path][line.number].size == (line.label.width, line.label.height)
        labels.setdefault(line.path, []).append(line.label)
        assert all(apart(line.label, panel, 2.0) for panel in drawn.panels.values() if not inside(box, panel))
    for mine in labels.values():
        assert all(apart(a, b, 0.0) for a, b in itertools.combinations(mine, 2))


@given(hierarchies(), st.none() | st.integers(0, 2))
@settings(max_examples=60)
def test_everything_stands_where_it_belongs(network, depth):
    check(network, depth)


@pytest.mark.parametrize("name", SAMPLES)
@pytest.mark.parametrize("depth", [None, 0, 1])
def test_the_samples_too(name, depth):
    check(getattr(nested, name)(), depth)


@given(hierarchies())
@settings(max_examples=20)
def test_the_same_network_gives_the_same_plan(network):
    assert planned(network)[1] == planned(network)[1]


def test_depth_says_how_much_is_shown():
    shown = {depth: set(planned(nested.hierarchical(), depth)[1].boxes) for depth in (0, 1, 2, None)}
    assert shown[0] == {"transport", "visit"}
    assert shown[1] == {path for path in shown[None] if path.count("/") < 2}
    assert shown[2] == shown[None] == set(nested.hierarchical().by_path)


def test_every_line_is_there():
    drawn = planned(nested.hierarchical())[1]
    assert len(drawn.links) == nested.hierarchical().link_count
    ways = [(line.first_held, line.last_held) for line in planned(nested.rivals())[1].rivals]
    assert sorted(ways) == [(False, True), (True, False), (True, False), (True, True)]
    assert [line.number for line in planned(nested.branches())[1].switches] == [0, 1, 2, 3]


def test_duties_stand_beside_the_sequence():
    drawn = planned(nested.controls())[1].boxes
    right = max(drawn[path].x + drawn[path].width for path in ("green", "patrol", "pick-up"))
    assert drawn["look"].middle == drawn["greet"].middle
    assert drawn["look"].x > right - 100
    assert drawn["greet"].x > drawn["patrol"].x + drawn["patrol"].width
