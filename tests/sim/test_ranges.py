"""Laser and sonars against plain geometry."""

import math

import numpy as np
import pytest

from tests.sim.support import QUIET, make_world, simulate
from understudy.geometry import Point, Pose
from understudy.robot import PIONEER
from understudy.sim import Simulation


def analytic(origin: Point, angle: float, discs: list[tuple[float, float, float]], size: tuple[float, float]) -> float:
    """Distance along a ray to the nearest disc or outer wall, ray by ray."""
    ux, uy = math.cos(angle), math.sin(angle)
    met = []
    for axis, (place, direction) in enumerate(((origin.x, ux), (origin.y, uy))):
        if abs(direction) > 1e-12:
            met.append(((size[axis] if direction > 0 else 0.0) - place) / direction)
    for x, y, radius in discs:
        along = (x - origin.x) * ux + (y - origin.y) * uy
        beside = (x - origin.x) * uy - (y - origin.y) * ux
        if along > 0 and abs(beside) < radius:
            met.append(along - math.sqrt(radius**2 - beside**2))
    return min(met)


TARGETS = [
    {"color": "red", "at": [1.2, 3.1]},
    {"color": "green", "at": [2.9, 2.4], "radius": 0.15},
    {"color": "pink", "at": [2.1, 4.9]},
    {"color": "yellow", "at": [0.5, 0.5], "height": 0.25},  # below the laser, above the sonars
]
ROOM = {"targets": TARGETS, "teacher": {"at": [1.9, 3.4]}, "boxes": [{"color": "orange", "at": [2.0, 2.8]}]}
DISCS = [(1.2, 3.1, 0.10), (2.9, 2.4, 0.15), (2.1, 4.9, 0.10), (1.9, 3.4, 0.15)]


@pytest.mark.parametrize("heading_deg", [90, 40, -160])
def test_laser_ranges_equal_plain_geometry(heading_deg: float) -> None:
    simulation = simulate(**ROOM, robots=[{"name": "learner", "at": [2.0, 2.0], "heading_deg": heading_deg}])
    scan = simulation.robot().sense().scan
    pose = Pose(2.0, 2.0, math.radians(heading_deg))
    origin = pose.to_parent(Point(PIONEER.laser.x, 0.0))
    angles = [pose.heading + scan.angle_min + i * scan.angle_increment for i in range(181)]
    expected = [analytic(origin, angle, DISCS, (4.0, 6.0)) for angle in angles]
    assert scan.ranges.dtype == np.float32
    assert scan.ranges == pytest.approx(expected, abs=1e-4)


def test_the_laser_errs_as_much_as_it_should() -> None:
    simulation = Simulation(make_world(noise={**QUIET, "laser": 0.015}))
    robot = simulation.robot()
    truth = simulate().robot().sense().scan.ranges
    errors = []
    for _ in range(30):
        errors.append(robot.sense().scan.ranges - truth)
        robot.wait()
    assert float(np.std(errors)) == pytest.approx(0.015, rel=0.1)
    assert abs(float(np.mean(errors))) < 0.001


def test_nothing_within_reach_is_infinity() -> None:
    simulation = simulate(
        arena={"size": [30, 30]},
        robots=[{"name": "learner", "at": [15, 15]}],
        targets=[{"color": "red", "at": [22, 15]}],
    )
    observation = simulation.robot().sense()
    assert observation.scan.ranges[90] == pytest.approx(6.8, abs=1e-4)
    assert np.isinf(observation.scan.ranges).sum() >= 170
    assert observation.sonar.dtype == np.float32
    assert np.isinf(observation.sonar).all()  # 6.7 m is beyond their 5 m


def test_sonars_give_the_nearest_echo_in_their_cone() -> None:
    simulation = simulate(**ROOM)
    sonar = simulation.robot().sense().sonar
    discs = [*DISCS, (0.5, 0.5, 0.10)]
    pose = Pose(2.0, 2.0, math.pi / 2)
    for reading, mount in zip(sonar.tolist(), PIONEER.sonar_poses, strict=True):
        origin = pose.to_parent(mount.position)
        cone = np.linspace(-0.5, 0.5, 41) * PIONEER.sonar_cone
        echoes = [analytic(origin, pose.heading + mount.heading + float(a), discs, (4.0, 6.0)) for a in cone]
        # Three rays, a few centimetres off, stand for the cone: they may miss what is thin, but see nothing else.
        assert min(echoes) - 0.08 <= reading <= max(echoes) + 0.08
    assert sonar[0] == pytest.approx(2.0 - 0.18, abs=0.06)  # left: the wall


def test_a_low_target_is_met_by_sonars_alone() -> None:
    simulation = simulate(
        targets=[{"color": "yellow", "at": [2.0, 3.0], "height": 0.25}],
        robots=[{"name": "learner", "at": [2.0, 2.0], "heading_deg": 80}],
    )
    observation = simulation.robot().sense()
    assert observation.sonar[3] == pytest.approx(0.7, abs=0.05)
    assert observation.scan.ranges[100] > 3.0


def test_another_robot_is_met_at_its_housing_and_its_body() -> None:
    simulation = simulate(
        robots=[{"name": "learner", "at": [2.0, 1.0], "heading_deg": 90}, {"name": "other", "at": [2.0, 3.0]}]
    )
    observation = simulation.robot().sense()
    assert observation.scan.ranges[90 - 2] == pytest.approx(3.0 - 0.08 - 1.1, abs=0.01)
    assert min(observation.sonar[3], observation.sonar[4]) == pytest.approx(3.0 - 0.19 - 1.2, abs=0.06)
