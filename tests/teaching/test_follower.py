"""Who follows a robot: it knows it by the marker on its back, and tells one bit."""

import math

import pytest

from understudy.errors import LearningError
from understudy.geometry import Point
from understudy.perception import Perception, Percepts, Thing
from understudy.robot import PIONEER, Color
from understudy.sim import Simulation
from understudy.teaching import CAREFUL, NAIVE, Manner, with_teacher

from .support import room


@pytest.mark.parametrize("away", [0.9, 1.3, 1.8])
@pytest.mark.parametrize("turned_deg", [0, 60, 180, 270])
def test_a_marker_on_a_robots_back_is_the_teacher(away: float, turned_deg: float) -> None:
    """It ends above the robot's body, and does not reach down to the floor."""
    start = {"name": "teacher", "at": [1.0 + away, 2.0], "heading_deg": turned_deg, "marker": "blue"}
    simulation = Simulation(room(start))
    robot, perception = simulation.robot(), Perception(PIONEER)
    for _ in range(5):
        percepts = perception.update(robot.sense())
        simulation.step()
    assert percepts.teacher is not None
    assert percepts.teacher.distance_m == pytest.approx(away, abs=0.3)
    assert not percepts.targets


@pytest.mark.parametrize(
    ("away", "bearing_deg", "told"),
    [(0.8, 0, True), (0.8, 60, True), (1.05, 0, True), (1.4, 0, False), (0.8, -85, False)],
)
def test_the_bit_says_near_and_before_it(away: float, bearing_deg: float, told: bool) -> None:
    bearing = math.radians(bearing_deg)
    place = Point((away + 0.1) * math.cos(bearing), (away + 0.1) * math.sin(bearing))
    teacher = Thing(id=1, color=Color.BLUE, position=place, radius=0.1, sensed=True, seen_s=0.0)
    assert with_teacher(Percepts(time_s=0.0, teacher=teacher)) is told


def test_nobody_in_sight_is_no_teacher() -> None:
    assert not with_teacher(Percepts(time_s=0.0))


@pytest.mark.parametrize("wrong", [{"pace": 0.0}, {"pace": 1.5}, {"shows_m": -0.1}, {"shows_m": math.inf}])
def test_what_is_out_of_range_is_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(LearningError, match="the teacher"):
        Manner(**wrong)  # type: ignore[arg-type]  # numbers all


def test_the_naive_manner_differs_in_everything() -> None:
    fields = ("looks_around", "waits", "pace", "shows_m", "trail")
    assert all(getattr(NAIVE, name) != getattr(CAREFUL, name) for name in fields)
