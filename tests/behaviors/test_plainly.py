"""What the skills compute quickly for many points, against the same written down plainly, point by point."""

import math

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.typing import NDArray
from pytest import approx

from understudy.behaviors import Avoid, Drive, Head
from understudy.behaviors.stand import choose_direction
from understudy.geometry import Point, wrap_angle
from understudy.robot import PIONEER

avoid = Avoid(PIONEER)
places = st.builds(Point, st.floats(-3, 3), st.floats(-3, 3))
around = st.lists(st.builds(Point, st.floats(-1.5, 1.5), st.floats(-1.5, 1.5)), max_size=12)
bearings = st.floats(-3.1, 3.1)


def rows(points: list[Point]) -> NDArray[np.float64]:
    return np.array(points, float).reshape(-1, 2)


def columns(points: list[Point]) -> NDArray[np.float64]:
    """The same, as perception lays them out."""
    return np.asfortranarray(rows(points))


def plainly_steered(head: Head, obstacles: list[Point], aim: Point | None) -> Drive:
    """The free direction nearest to the wanted one, tried one after the other."""
    reach = 1.0 if aim is None else min(1.0, aim.distance)
    near = [point for point in obstacles if point.distance < reach + 0.29]
    near = [point for point in near if aim is None or point.distance_to(aim) >= 0.22]

    def free(bearing: float) -> bool:
        c, s = math.cos(bearing), math.sin(bearing)
        ways = [(c * x + s * y, c * y - s * x) for x, y in near]
        return not any(0.05 < along < reach and abs(across) < 0.29 for along, across in ways)

    offsets = sorted(range(-112, 113, 7), key=lambda degrees: (abs(degrees), degrees))
    bearing = next((one for one in (head.bearing + math.radians(o) for o in offsets) if free(one)), None)
    if bearing is None:
        return Drive(angular=math.copysign(0.6, head.bearing))
    bearing = wrap_angle(bearing)
    slower = max(0.0, math.cos(min(math.pi / 2, 1.5 * abs(bearing))))
    return Drive(linear=head.speed * slower, angular=max(-1.2, min(1.2, 2.0 * bearing)))


@given(bearings, around, st.none() | places)
def test_the_free_direction_nearest_to_the_wanted_one_is_taken(
    bearing: float, obstacles: list[Point], aim: Point | None
) -> None:
    head = Head(bearing=bearing, speed=0.4)
    expected = plainly_steered(head, obstacles, aim)
    for layout in (rows, columns):
        steered = avoid.steer(head, layout(obstacles), aim, 0.1)
        assert (steered.linear, steered.angular) == (approx(expected.linear), approx(expected.angular))


@given(st.builds(Drive, linear=st.floats(-0.2, 0.5), angular=st.floats(-1.5, 1.5)), around, st.none() | places)
def test_points_that_are_far_off_do_not_change_what_is_safe(
    drive: Drive, obstacles: list[Point], aim: Point | None
) -> None:
    guarded = avoid.guard(drive, rows(obstacles), aim, 0.1)
    far = [Point(x, y) for x, y in ((4.0, 0.0), (0.0, -3.0), (-2.5, 2.5))]
    assert avoid.guard(drive, columns(far + obstacles), aim, 0.1) == guarded


def plainly_chosen(
    target: Point,
    distance: float,
    bearing: float,
    heading: float,
    obstacles: list[Point],
    previous: float | None,
    avoided: list[float],
) -> dict[int, float]:
    """What each direction costs, by degrees."""
    costs = {}
    for degrees in range(0, 360, 10):
        direction = wrap_angle(math.radians(degrees) - heading)
        stand = Point(target.x + distance * math.cos(direction), target.y + distance * math.sin(direction))
        away, travel = stand.distance, stand.bearing
        final = wrap_angle(direction + math.pi - bearing)
        cost = away + 0.35 * abs(travel) * min(1.0, away / 0.3) + 0.70 * abs(wrap_angle(final - travel))
        along = min(1.0, max(0.0, (target.x * stand.x + target.y * stand.y) / max(away, 1e-6) ** 2))
        if target.distance_to(Point(along * stand.x, along * stand.y)) < min(distance, 0.43) - 0.02:
            cost += 1.0
        rooms = [point.distance_to(stand) for point in obstacles if 0.22 < point.distance_to(target) < distance + 0.52]
        if rooms:
            cost += 10.0 if min(rooms) < 0.34 else max(0.0, 0.52 - min(rooms)) * 8.0
        for other in avoided:
            cost += 3.0 if abs(wrap_angle(math.radians(degrees) - other)) < math.radians(35) else 0.0
        if previous is not None and abs(wrap_angle(math.radians(degrees) - previous)) >= math.radians(6):
            cost += 1.2
        costs[degrees] = cost
    return costs


@given(
    places,
    st.floats(0.4, 2.0),
    st.floats(-1.5, 1.5),
    bearings,
    around,
    st.none() | st.integers(0, 35),
    st.lists(bearings, max_size=2),
)
def test_the_cheapest_stand_is_chosen(
    target: Point,
    distance: float,
    bearing: float,
    heading: float,
    near: list[Point],
    kept: int | None,
    avoided: list[float],
) -> None:
    assume(abs(target.distance - distance) > 0.01)  # from where the robot stands, the way has no direction
    obstacles = [Point(target.x + x, target.y + y) for x, y in near]
    previous = None if kept is None else wrap_angle(math.radians(10 * kept))
    costs = plainly_chosen(target, distance, bearing, heading, obstacles, previous, avoided)
    for layout in (rows, columns):
        chosen = choose_direction(
            target, 0.1, distance, bearing, heading, obstacles=layout(obstacles), previous=previous, avoided=avoided
        )
        # Of two that cost the same, either may come out.
        assert costs[round(math.degrees(chosen)) % 360] == approx(min(costs.values()), abs=1e-6)
