"""Camera and laser merged, and working memory (§3.5.3.2, Figure 3.9)."""

import math

import numpy as np
import pytest
from pytest import approx

from understudy.errors import RobotError
from understudy.geometry import Point, Pose
from understudy.perception import Perception, Percepts
from understudy.robot import PIONEER, Color, GripperReading, Observation, Scan

from .scenes import Pillar, observed

AHEAD: Pillar = (Color.GREEN, Point(2.0, 0.0))


def watch(perception: Perception, pillars: list[Pillar], poses: list[Pose], start_s: float = 0.0) -> Percepts:
    """One observation for each pose, 0.1 s apart; the percepts of the last one."""
    for index, pose in enumerate(poses):
        percepts = perception.update(observed(round(start_s + index * 0.1, 9), pillars, pose))
    return percepts


def test_a_target_is_believed_at_the_third_sighting() -> None:
    perception = Perception(PIONEER)
    assert watch(perception, [AHEAD], [Pose()] * 2).targets == []
    [thing] = watch(perception, [AHEAD], [Pose()], 0.2).targets
    assert (thing.color, thing.sensed, thing.followed) == (Color.GREEN, True, True)
    assert thing.position.distance_to(AHEAD[1]) < 0.05
    assert thing.distance_m == approx(1.9, abs=0.06)
    assert thing.angle_deg == approx(90, abs=2)


def test_a_false_blob_that_comes_once_is_not_believed() -> None:
    perception = Perception(PIONEER)
    watch(perception, [AHEAD], [Pose()])
    percepts = watch(perception, [], [Pose()] * 30, 0.1)
    assert percepts.targets == []
    assert perception.targets.tracks == []


def test_a_blob_without_anything_behind_it_is_not_believed() -> None:
    """Light on a wall has a color, but the laser meets nothing there that stands free."""
    perception = Perception(PIONEER)
    for index in range(10):
        picture = observed(index * 0.1, [AHEAD])
        seen = Observation(time_s=index * 0.1, scan=observed(0.0, []).scan, image=picture.image)
        percepts = perception.update(seen)
    assert percepts.targets == []


def test_the_laser_keeps_hold_of_what_has_left_the_picture() -> None:
    """Turning away by 80°: the camera loses the target at 24°, the laser keeps it (Figure 3.9)."""
    perception = Perception(PIONEER)
    turn = [Pose(heading=math.radians(degrees)) for degrees in range(0, 81, 4)]
    [thing] = watch(perception, [AHEAD], [Pose(), Pose(), *turn]).targets
    assert (thing.sensed, thing.followed) == (True, True)
    assert thing.angle_deg == approx(10, abs=2)


def test_what_is_behind_is_remembered_and_no_longer_followed() -> None:
    perception = Perception(PIONEER)
    turn = [Pose(heading=math.radians(degrees)) for degrees in range(0, 161, 4)]
    [thing] = watch(perception, [AHEAD], [Pose(), Pose(), *turn]).targets
    assert not thing.sensed
    assert not thing.followed
    assert thing.position.distance_to(turn[-1].to_local(AHEAD[1])) < 0.05


def test_what_the_laser_alone_meets_again_is_sensed_but_not_followed() -> None:
    perception = Perception(PIONEER)
    away = [Pose(heading=math.radians(degrees)) for degrees in range(0, 161, 4)]
    back = [Pose(heading=math.radians(degrees)) for degrees in range(160, 59, -4)]
    [thing] = watch(perception, [AHEAD], [Pose(), Pose(), *away, *back]).targets
    assert (thing.sensed, thing.followed) == (True, False)


def test_a_target_that_was_taken_away_is_forgotten() -> None:
    perception = Perception(PIONEER)
    assert watch(perception, [AHEAD], [Pose()] * 5).targets
    assert watch(perception, [], [Pose()] * 12, 0.5).targets == []


def test_a_target_that_is_hidden_is_not_forgotten() -> None:
    perception = Perception(PIONEER)
    watch(perception, [AHEAD], [Pose()] * 5)
    in_between: Pillar = (Color.RED, Point(1.0, 0.0))
    colors = {thing.color for thing in watch(perception, [AHEAD, in_between], [Pose()] * 20, 0.5).targets}
    assert colors == {Color.GREEN, Color.RED}


NEAR = [(Color.GREEN, Point(1.8, 0.0)), (Color.RED, Point(0.9, 0.0))]
FAR = [(Color.GREEN, Point(2.4, 0.0)), (Color.RED, Point(0.9, 0.0))]


@pytest.mark.parametrize(("pillars", "seconds", "there"), [(NEAR, 18.0, True), (NEAR, 22.0, False), (FAR, 40.0, True)])
def test_what_the_robot_is_near_to_and_never_meets_is_forgotten_in_the_end(
    pillars: list[Pillar], seconds: float, there: bool
) -> None:
    """As a target behind a wall: nothing contradicts it, and it cannot be reached from here."""
    perception = Perception(PIONEER)
    watch(perception, pillars[:1], [Pose()] * 5)
    percepts = watch(perception, pillars, [Pose()] * round(10 * seconds), 0.5)
    assert (percepts.nearest_target(Color.GREEN) is not None) is there


def test_a_contradiction_now_and_then_does_not_add_up() -> None:
    perception = Perception(PIONEER)
    watch(perception, [AHEAD], [Pose()] * 5)
    for index in range(12):
        watch(perception, [], [Pose()], 0.5 + index * 0.2)
        assert watch(perception, [AHEAD], [Pose()], 0.6 + index * 0.2).targets


def test_a_color_misread_now_and_then_is_outvoted() -> None:
    perception = Perception(PIONEER)
    watch(perception, [AHEAD], [Pose()] * 5)
    watch(perception, [(Color.LIGHT_GREEN, AHEAD[1])], [Pose()] * 2, 0.5)
    [thing] = watch(perception, [AHEAD], [Pose()], 0.7).targets
    assert thing.color == Color.GREEN


def test_the_teacher_is_recognised_up_to_two_metres() -> None:
    for distance, seen in ((1.5, True), (2.6, False)):
        perception = Perception(PIONEER)
        percepts = watch(perception, [(Color.BLUE, Point(distance, 0.0))], [Pose()] * 5)
        assert (percepts.teacher is not None) is seen
        assert percepts.targets == []


@pytest.mark.parametrize("distance", [0.9, 1.5, 2.5])
def test_a_box_stands_where_its_foot_is(distance: float) -> None:
    perception = Perception(PIONEER)
    box: Pillar = (Color.ORANGE, Point(distance, 0.1))
    for index in range(5):
        percepts = perception.update(observed(index * 0.1, [], boxes=[box]))
    [thing] = percepts.boxes
    assert thing.color == Color.ORANGE
    assert thing.position.distance_to(box[1]) < 0.03 + 0.05 * distance
    assert percepts.targets == []


def test_a_false_blob_beside_a_box_does_not_move_it() -> None:
    perception = Perception(PIONEER)
    for step in range(6):
        perception.update(observed(step / 10, [], boxes=[(Color.ORANGE, Point(1.0, 0.0))]))
    [box] = perception.update(observed(0.6, [], boxes=[(Color.PINK, Point(1.0, 0.15))])).boxes
    assert box.color == Color.ORANGE
    assert box.position.distance_to(Point(1.0, 0.0)) < 0.05


def test_a_box_is_not_forgotten_while_it_slides_out_of_the_picture() -> None:
    """Slowly driven up to, its foot is cut off first; from then on memory must do (§4.5.4.3)."""
    perception = Perception(PIONEER)
    box: Pillar = (Color.ORANGE, Point(1.2, 0.03))
    for index in range(420):
        pose = Pose(max(0.0, (index - 5) * 0.002), 0.0, 0.0)
        percepts = perception.update(observed(round(index * 0.1, 9), [], pose, boxes=[box]))
        assert index < 3 or len(percepts.boxes) == 1, pose


def test_the_gripper_knows_the_color_of_the_box_that_it_took() -> None:
    perception = Perception(PIONEER)
    box: Pillar = (Color.ORANGE, Point(0.8, 0.0))
    for index in range(5):
        perception.update(observed(index * 0.1, [], boxes=[box], gripper=GripperReading(aperture=1.0, lift=0.0)))
    at_the_box = Pose(0.47, 0.0, 0.0)
    for index, aperture in enumerate([1.0, 1.0, 1.0, 0.45, 0.45]):
        held = GripperReading(aperture=aperture, lift=0.0, beam_broken=True)
        percepts = perception.update(observed(0.5 + index * 0.1, [], at_the_box, gripper=held))
        assert percepts.gripper is not None
        assert percepts.gripper.holding is (aperture < 0.5)
    assert percepts.gripper is not None
    assert percepts.gripper.color == Color.ORANGE
    assert percepts.boxes == []  # it is not on the floor for the taking


def test_a_flicker_of_the_beam_is_no_box() -> None:
    perception = Perception(PIONEER)
    for index, broken in enumerate([False, True, False, True, False]):
        percepts = perception.update(observed(index * 0.1, [], gripper=GripperReading(beam_broken=broken)))
        assert percepts.gripper is not None
        assert percepts.gripper.empty


def test_readings_that_are_not_numbers_are_refused() -> None:
    blind = Observation(time_s=0.0, scan=Scan(ranges=np.full(181, np.nan, np.float32)))
    with pytest.raises(RobotError):
        Perception(PIONEER).update(blind)


def test_what_is_remembered_beside_the_robot_is_an_obstacle_still() -> None:
    """A robot that turns on the spot must not sweep its back into what its laser has just lost sight of."""
    perception = Perception(PIONEER)
    beside: Pillar = (Color.GREEN, Point(0.8, 0.0))
    turn = [Pose(heading=math.radians(degrees)) for degrees in range(0, 121, 4)]
    percepts = watch(perception, [beside], [Pose(), Pose(), *turn])
    assert not percepts.targets[0].sensed
    here = turn[-1].to_local(beside[1])
    assert np.hypot(*(percepts.obstacles - here).T).min() == approx(0.1, abs=0.06)


def test_sonars_see_what_is_beside_and_behind() -> None:
    sonar = np.full(16, np.inf, np.float32)
    sonar[[3, 11]] = 0.5  # ahead, where the laser sees better, and behind
    scan = observed(0.0, []).scan
    near = Perception(PIONEER).update(Observation(time_s=0.0, scan=scan, sonar=sonar)).obstacles
    near = near[np.hypot(*near.T) < 1.0]
    assert len(near) == 1
    assert near[0][0] == approx(-0.7, abs=0.02)


def test_a_gap_in_the_sweep_is_not_free_space() -> None:
    scan = observed(0.0, [AHEAD]).scan
    scan.ranges[85:96] = np.nan
    scan.ranges[84] = 0.6
    percepts = Perception(PIONEER).update(Observation(time_s=0.0, scan=scan))
    ahead = percepts.obstacles[np.abs(percepts.obstacles[:, 1]) < 0.06]
    assert np.allclose(np.hypot(ahead[:, 0] - PIONEER.laser.x, ahead[:, 1]), 0.6, atol=1e-6)
    assert len(ahead) >= 10


def test_a_larger_picture_of_the_same_shape_is_seen_the_same() -> None:
    perception = Perception(PIONEER)
    for index in range(3):
        small = observed(index * 0.1, [AHEAD])
        assert small.image is not None
        large = np.repeat(np.repeat(small.image, 4, axis=0), 4, axis=1)
        percepts = perception.update(Observation(time_s=index * 0.1, scan=small.scan, image=large))
    [thing] = percepts.targets
    assert thing.angle_deg == approx(90, abs=2)


def test_a_picture_of_another_shape_is_refused() -> None:
    square = Observation(time_s=0.0, scan=observed(0.0, []).scan, image=np.zeros((100, 100, 3), np.uint8))
    with pytest.raises(RobotError, match=r"shape \(100, 100, 3\); the pioneer's has \(120, 160, 3\)"):
        Perception(PIONEER).update(square)


def test_a_far_target_does_not_lend_its_color_to_a_near_one() -> None:
    perception = Perception(PIONEER)
    near: Pillar = (Color.RED, Point(1.1, 0.0))
    far: Pillar = (Color.PINK, Point(2.6, 0.32))
    turn = [Pose(heading=math.radians(degrees)) for degrees in range(-30, 31, 2)]
    things = watch(perception, [near, far], turn).targets
    assert [(thing.color, round(thing.position.distance, 1)) for thing in things] == [
        (Color.RED, 1.1),
        (Color.PINK, 2.6),
    ]
    tracks = {track.color: track.votes for track in perception.targets.tracks}
    assert set(tracks[Color.RED]) == {Color.RED}
    assert set(tracks[Color.PINK]) == {Color.PINK}


def test_a_target_just_outside_the_picture_does_not_get_the_color_of_one_behind_it() -> None:
    """The laser meets only the near one, and the camera only the far one, at its border."""
    perception = Perception(PIONEER)
    near: Pillar = (Color.GREEN, Point(1.26, 0.0))
    far: Pillar = (Color.RED, Point(2.8, 0.10))
    looking = [Pose(heading=math.radians(degrees)) for degrees in (0, 0, 0, 0, 10, 20, *[27] * 30)]
    things = watch(perception, [near, far], looking).targets
    assert things[0].color == Color.GREEN
    assert things[0].position.distance < 1.5
    assert set(perception.targets.tracks[0].votes) == {Color.GREEN}


def test_a_teacher_who_goes_behind_a_target_is_not_where_the_target_is() -> None:
    perception = Perception(PIONEER)
    pole: Pillar = (Color.YELLOW, Point(0.7, 0.0))
    walk = [Point(1.0, -0.05 * step) for step in range(7, -1, -1)]
    for step, place in enumerate([walk[0]] * 5 + walk[1:] + [walk[-1]] * 5):
        percepts = perception.update(observed(step / 10, [pole, (Color.BLUE, place)]))
        if step == 4:
            assert percepts.teacher is not None
        assert percepts.teacher is None or percepts.teacher.position.distance_to(place) < 0.15
    assert percepts.teacher is None
    assert [thing.color for thing in percepts.targets] == [Color.YELLOW]
    assert percepts.targets[0].sensed


def test_without_pictures_the_laser_still_finds_obstacles() -> None:
    percepts = Perception(PIONEER).update(observed(0.0, [AHEAD], blind=True))
    assert percepts.targets == []
    assert np.hypot(*(percepts.obstacles - (1.9, 0.0)).T).min() < 0.02
