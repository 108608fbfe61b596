"""The skills of the delivery task (§3.5.2.2), from percepts alone."""

import json
import math
from dataclasses import replace
from random import Random

import numpy as np
import pytest
from numpy.typing import NDArray

from understudy.behaviors import Drive, Head, Memory, Motion, Skill, Strip, Wander, installed_skills
from understudy.behaviors.get_box import GET_BOX
from understudy.behaviors.go_through_door import GO_THROUGH_DOOR
from understudy.behaviors.go_to import GO_TO
from understudy.behaviors.localize import LOCALIZE
from understudy.behaviors.open_door import OPEN_DOOR
from understudy.behaviors.skill import Action
from understudy.errors import SkillError
from understudy.geometry import Point, Pose
from understudy.perception import Attention, Doorway, GripperState, Percepts, Thing
from understudy.robot import PIONEER, Color, Odometry

DELIVERY = (LOCALIZE, GET_BOX, GO_TO, OPEN_DOOR, GO_THROUGH_DOOR)
POSTS = (Color.GREEN, Color.YELLOW)
WIDE, SHUT = (-0.5, 0.4), (0.3, 0.4)
EMPTY = GripperState(holding=False, empty=True, color=None, open=False, raised=True, blocked=False)
PUSHING = GripperState(
    holding=False, empty=False, color=None, open=True, raised=False, blocked=True, pushing=Color.ORANGE
)


def at(
    x: float,
    y: float = 0.0,
    heading_deg: float = 0.0,
    *,
    gap: tuple[float, float] | None = SHUT,
    time_s: float = 0.0,
    gripper: GripperState = EMPTY,
    boxes: tuple[Thing, ...] = (),
    beacon: Thing | None = None,
    leaf: bool = False,
    posts_seen_s: float | None = None,
) -> Percepts:
    """A robot at a pose of the doorway's frame: x is negative in the home room, from where it leads through."""
    robot = Pose(x, y, math.radians(heading_deg))
    middle = robot.to_local(Point(0.0, 0.0))
    frame = Pose(middle.x, middle.y, -robot.heading)
    posts = [
        Thing(id=0, color=color, position=robot.to_local(Point(0.0, y)), radius=0.1, sensed=True, seen_s=time_s)
        for color, y in zip(POSTS, (0.7, -0.7), strict=True)
    ]
    met = [robot.to_local(Point(0.0, y / 20)) for y in range(-11, 12)] if leaf else []
    return Percepts(
        time_s=time_s,
        odometry=Odometry(pose=robot),
        boxes=boxes,
        gripper=gripper,
        landmarks={thing.color: thing for thing in (*posts, *((beacon,) if beacon else ()))},
        doorways=(
            Doorway(
                posts=POSTS,
                frame=frame,
                half_width=0.6,
                gap=gap,
                seen_s=time_s if posts_seen_s is None else posts_seen_s,
            ),
        ),
        obstacles=np.array(met).reshape(-1, 2),
    )


def box(x: float, y: float = 0.0, color: Color = Color.ORANGE) -> Thing:
    return Thing(id=1, color=color, position=Point(x, y), radius=0.05, sensed=True, seen_s=0.0)


def goal(skill: Skill, percepts: Percepts, **parameters: object) -> bool:
    return skill.abstract.goal(percepts, skill.complete(parameters))


def step(skill: Skill, percepts: Percepts, memory: Memory | None = None, **parameters: object) -> tuple[Action, Memory]:
    return skill.primitive.step(percepts, skill.complete(parameters), memory or {}, Random(0))


NOWHERE = Percepts(time_s=0.0, gripper=EMPTY)


def test_they_are_installed_and_words_are_checked() -> None:
    assert set(installed_skills()) >= {skill.name for skill in DELIVERY}
    assert GO_TO.complete({"place": "home"})["beacon"] is Color.PINK
    with pytest.raises(SkillError, match=r"GoTo: place is 'attic'; it is one of: home, door"):
        GO_TO.complete({"place": "attic"})
    with pytest.raises(SkillError, match="room is 3; it is one of: home, other"):
        GO_THROUGH_DOOR.complete({"room": 3})
    with pytest.raises(SkillError, match="needs a value for 'room'"):
        GO_THROUGH_DOOR.complete({})


def test_what_they_need_to_have_watched() -> None:
    door = Attention(doorways=frozenset({(Color.RED, Color.YELLOW)}))
    assert OPEN_DOOR.attention(OPEN_DOOR.complete({"left_post": "red"})) == door
    assert GO_TO.attention(GO_TO.complete({"place": "home"})).colors == {Color.PINK}
    assert GET_BOX.attention(GET_BOX.complete({"color": "orange"})) == Attention()
    assert (door | Attention(landmarks=frozenset({Color.PINK}))).colors == {Color.RED, Color.YELLOW, Color.PINK}


def test_where_nobody_watches_a_door_there_is_nothing_to_observe() -> None:
    """What is learned in rooms without doors does not change because these skills are there."""
    for percepts in (NOWHERE, replace(NOWHERE, gripper=PUSHING, boxes=(box(1.0),))):
        for skill in DELIVERY:
            assert not skill.abstract.observe(percepts)


def test_what_they_observe_holds() -> None:
    percepts = at(-1.5, gap=WIDE, gripper=PUSHING, beacon=beacon(0.7, color=Color.RED))
    seen = {
        skill.name: list(skill.abstract.observe(percepts)) for skill in DELIVERY if skill.abstract.observe(percepts)
    }
    assert set(seen) == {"Localize", "GetBox", "GoTo", "OpenDoor", "GoThroughDoor"}
    assert len(seen["GoTo"]) == 2
    for skill in DELIVERY:
        for instance in seen[skill.name]:
            assert goal(skill, percepts, **dict(instance.parameters))


def test_localize() -> None:
    assert not goal(LOCALIZE, NOWHERE)
    assert goal(LOCALIZE, at(-1.0))
    assert goal(LOCALIZE, at(-1.0), room="home")
    assert not goal(LOCALIZE, at(-1.0), room="other")
    assert goal(LOCALIZE, at(1.0), room="other")
    assert LOCALIZE.abstract.precondition(NOWHERE, LOCALIZE.complete({}))
    action, memory = step(LOCALIZE, NOWHERE)
    assert action == Wander().step(NOWHERE, {}, Random(0))[0]
    assert memory


def test_a_room_is_searched_before_the_next_one() -> None:
    wander = Wander()
    for seed in range(20):
        percepts = at(-1.6, heading_deg=20, gap=WIDE)
        _, memory = wander._look(percepts, {"turned": 7.0, "heading": 0.0, "until": 0.0, "side": 1.0}, Random(seed))
        reach = memory["length"] * math.cos(memory["heading"])
        assert reach <= 0.61


@pytest.mark.parametrize(
    ("percepts", "possible"),
    [
        (at(-1.5, boxes=(box(1.0),)), True),
        (at(-1.5, boxes=(box(2.0),)), False),
        (at(-1.5, boxes=(box(1.0, color=Color.RED),)), False),
        (at(-0.6, boxes=(box(1.5),)), True),
        (at(-0.6, y=1.5, boxes=(box(1.5),)), False),
        (at(-1.5, boxes=(box(2.0),), gripper=PUSHING), True),
        (replace(NOWHERE, boxes=(box(2.0),)), True),
    ],
)
def test_a_box_in_the_other_room_is_out_of_reach(percepts: Percepts, possible: bool) -> None:
    assert GET_BOX.abstract.precondition(percepts, GET_BOX.complete({"color": "orange"})) is possible


def test_get_box_draws_it_in_leaves_the_paddles_open_and_lets_another_one_go() -> None:
    assert goal(GET_BOX, at(-1.0, gripper=PUSHING), color="orange")
    assert not goal(GET_BOX, at(-1.0, gripper=PUSHING), color="red")
    let_in = replace(PUSHING, pushing=None)
    memory: Memory = {}
    for _ in range(20):
        action, memory = step(GET_BOX, at(-1.0, gripper=let_in), memory, color="orange")
        assert (action.drive, action.paddles) == (Drive(linear=0.12), "open")
    speeds = []
    for _ in range(30):
        action, memory = step(GET_BOX, at(-1.0, gripper=let_in), memory, color="orange")
        assert isinstance(action.drive, Drive)
        speeds.append(action.drive.linear)
    assert min(speeds) < 0, "it backs off from what is not the box"


def test_get_box_goes_to_the_box_of_this_room() -> None:
    action, _ = step(GET_BOX, at(-1.5, boxes=(box(1.8), box(1.0, 1.0))), color="orange")
    assert isinstance(action.drive, Head)
    assert action.drive.bearing == pytest.approx(math.pi / 4)


def test_a_box_behind_a_leaf_is_come_to_from_another_side() -> None:
    seen = at(-2.5, boxes=(box(0.95),))
    before, behind = ([[x, y / 20] for y in range(-6, 7)] for x in (0.7, 1.1))
    ring = [[0.95 + 0.4 * math.cos(a / 5), 0.4 * math.sin(a / 5)] for a in range(32)]
    for points, around in ((before, True), (behind, False), (ring, False)):
        action, memory = step(GET_BOX, replace(seen, obstacles=np.array(points)), color="orange")
        assert (memory.get("phase") == "around") is around
        assert (action.pushing is None) is around, "what stands before it would push it along"
        if around:
            assert isinstance(action.drive, Head)
            assert abs(action.drive.bearing) > math.radians(30)
    # It gets there, and takes the box from there.
    memory = {"phase": "around", "side": math.pi, "since_s": 0.0}
    there = at(-2.5, boxes=(box(0.95),), leaf=True)
    action, memory = step(GET_BOX, there, memory, color="orange")
    assert memory["straight_on"]
    assert action.pushing is not None
    # A box that does not come nearer is come to from another side, too.
    memory = {"phase": "approach", "nearest": 0.5, "since_s": 0.0, "straight_on": True}
    assert step(GET_BOX, at(-2.5, boxes=(box(0.95),), time_s=6.1), memory, color="orange")[1]["phase"] == "around"
    # Neither does it try for ever.
    memory = {"phase": "around", "side": 0.0, "since_s": 0.0}
    assert step(GET_BOX, at(-2.5, boxes=(box(0.95),), time_s=15.1), memory, color="orange")[1]["straight_on"]


def beacon(distance: float, bearing_deg: float = 0.0, seen_s: float = 0.0, color: Color = Color.PINK) -> Thing:
    reach, bearing = distance + 0.1, math.radians(bearing_deg)
    place = Point(reach * math.cos(bearing), reach * math.sin(bearing))
    return Thing(id=0, color=color, position=place, radius=0.1, sensed=True, seen_s=seen_s)


def test_go_to_home() -> None:
    assert goal(GO_TO, at(-2.0, beacon=beacon(0.7)), place="home")
    assert not goal(GO_TO, at(-2.0, beacon=beacon(0.9)), place="home")
    assert not goal(GO_TO, at(-2.0, beacon=beacon(0.7, 60)), place="home")
    assert not goal(GO_TO, at(-2.0, beacon=beacon(0.7), time_s=6.0), place="home"), "it was not seen lately"
    assert not GO_TO.abstract.precondition(at(-2.0), GO_TO.complete({"place": "home"}))
    far, near = at(-2.0, beacon=beacon(2.0, 30)), at(-2.0, beacon=beacon(0.66, 40))
    assert isinstance(step(GO_TO, far, place="home")[0].drive, Head)
    turning = step(GO_TO, near, place="home")[0].drive
    assert isinstance(turning, Drive)
    assert turning.angular > 0


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_go_to_door_is_on_the_robots_own_side(side: float) -> None:
    facing = 0.0 if side < 0 else 180.0
    assert goal(GO_TO, at(1.5 * side, heading_deg=facing), place="door")
    assert not goal(GO_TO, at(1.5 * side, heading_deg=facing + 30), place="door")
    assert not goal(GO_TO, at(1.0 * side, heading_deg=facing), place="door")
    action, memory = step(GO_TO, at(1.5 * side, heading_deg=facing + 90), place="door")
    assert action.drive == Drive(angular=-0.6)
    assert memory == {"there": True}
    # Being moved a little by the turning does not make it drive again.
    action, _ = step(GO_TO, at(1.7 * side, heading_deg=facing + 90), memory, place="door")
    assert isinstance(action.drive, Drive)
    action, _ = step(GO_TO, at(1.7 * side, heading_deg=facing + 90), place="door")
    assert isinstance(action.drive, Head)


@pytest.mark.parametrize(("room", "side"), [("home", -1.0), ("other", 1.0)])
def test_go_through_door(room: str, side: float) -> None:
    assert goal(GO_THROUGH_DOOR, at(1.0 * side), room=room)
    assert not goal(GO_THROUGH_DOOR, at(0.8 * side), room=room)
    assert not goal(GO_THROUGH_DOOR, at(-1.0 * side), room=room)
    facing = 0.0 if side > 0 else 180.0
    action, _ = step(GO_THROUGH_DOOR, at(-1.5 * side, heading_deg=facing, gap=WIDE), room=room)
    assert isinstance(action.drive, Head)
    # Through the middle of what is free: 5 cm towards the right post, which for the way home is at the left.
    assert action.drive.bearing == pytest.approx(math.atan2(-0.05 * side, 0.8))
    assert action.pushing is not None
    assert not action.pushing.shy
    beside, _ = step(GO_THROUGH_DOOR, at(-0.4 * side, 1.2, heading_deg=facing, gap=WIDE), room=room)
    assert isinstance(beside.drive, Head)
    assert abs(beside.drive.bearing) > math.pi / 2, "it goes around the post, from where it can line up"
    assert beside.pushing is not None
    assert beside.pushing.shy


def open_door(percepts: list[Percepts]) -> tuple[list[str], Action]:
    memory: Memory = {}
    phases = []
    for each in percepts:
        action, memory = step(OPEN_DOOR, each, memory)
        assert json.loads(json.dumps(memory)) == memory, "it can be written down"
        phases.append(memory["phase"])
    return phases, action


def test_open_door_lines_up_pushes_in_and_comes_back() -> None:
    assert goal(OPEN_DOOR, at(-1.5, gap=WIDE))
    assert not goal(OPEN_DOOR, at(-1.5))
    assert not goal(OPEN_DOOR, at(-1.5, gap=None))
    phases, back = open_door(
        [at(-2.5), at(-1.5, heading_deg=40), at(-1.5), at(-1.2), at(0.1), at(0.76), at(0.3), at(-1.01, time_s=1.0)]
    )
    assert phases == ["approach", "approach", "push", "push", "push", "back", "back", "look"]
    assert open_door([at(-1.5), at(-1.2), at(0.76), at(0.3)])[1].drive == Drive(linear=-0.2)
    assert back.paddles == "close"
    pushing = open_door([at(-1.5), at(-1.2, leaf=True)])[1]
    assert pushing.pushing is not None
    assert not pushing.pushing.shy


def test_before_it_drives_into_a_doorway_the_robot_makes_sure_that_it_is_there() -> None:
    doubtful = at(-1.5, gap=WIDE, time_s=20.0, posts_seen_s=5.0)
    action, memory = step(OPEN_DOOR, doubtful)
    assert isinstance(action.drive, Drive)
    assert action.drive.angular < 0, "towards the post beside the gap, which no leaf hides"
    assert memory["phase"] == "approach"
    assert step(GO_THROUGH_DOOR, doubtful, room="other")[0].drive == action.drive
    sure = replace(doubtful, time_s=10.0)
    assert step(OPEN_DOOR, sure)[1]["phase"] == "push"
    assert isinstance(step(GO_THROUGH_DOOR, sure, room="other")[0].drive, Head)
    # In the doorway the posts cannot be seen.
    inside = at(-0.2, gap=WIDE, time_s=20.0, posts_seen_s=5.0)
    assert isinstance(step(GO_THROUGH_DOOR, inside, room="other")[0].drive, Head)


def test_the_leaf_that_gives_way_tells_the_side_of_the_hinge() -> None:
    for side in (1.0, -1.0):
        leaf = replace(at(0.0), obstacles=np.array([[0.3 * k, side * 0.1 * (6 - k)] for k in range(4)]))
        memory = {"phase": "push", "since_s": 0.0, "from": [0.0, 0.0], "into": "far"}
        action, after = step(OPEN_DOOR, leaf, memory)
        assert after["offset"] == 0.2 * side
        assert isinstance(action.drive, Head)
        assert action.drive.bearing * side > 0


def test_a_box_is_put_aside_first() -> None:
    box_in = {"gripper": PUSHING}
    phases, action = open_door(
        [
            at(-1.5, **box_in),  # type: ignore[arg-type]
            at(-1.5, heading_deg=60, **box_in),  # type: ignore[arg-type]
            at(-1.5, heading_deg=98, **box_in),  # type: ignore[arg-type]
            at(-1.55, 0.3, heading_deg=98, **box_in),  # type: ignore[arg-type]
            at(-1.57, 0.5, heading_deg=98, **box_in),  # type: ignore[arg-type]
            at(-1.50, 0.02, heading_deg=98),
        ]
    )
    assert phases == ["turn", "turn", "shove", "shove", "leave", "approach"]
    assert action.paddles == "close"


def test_nobody_who_stands_in_the_doorway_is_pushed() -> None:
    person = Thing(id=1, color=Color.BLUE, position=Point(0.8, 0), radius=0.15, sensed=True, seen_s=0.0)
    percepts = replace(at(-0.8, gap=WIDE), teacher=person)
    assert step(GO_THROUGH_DOOR, percepts, room="other")[0].drive == Drive()
    memory = {"phase": "push", "since_s": 0.0, "from": [0.0, 0.0], "into": "far"}
    assert step(OPEN_DOOR, percepts, memory)[0].drive == Drive()


def wall(x: float) -> NDArray[np.float64]:
    return np.array([[x, y / 20] for y in range(-30, 31)])


def test_avoid_does_not_fight_an_intended_push_and_nothing_else_is_pushed() -> None:
    motion, percepts = Motion(PIONEER), Percepts(time_s=0.0, obstacles=wall(0.5))
    ahead = Action(drive=Head(bearing=0.0, speed=0.2))
    assert motion.command([ahead], percepts)[0].linear < 0.01
    strip = Strip(frame=Pose(0.5, 0.0, 0.0), half_width=2.0, reach=0.3)
    assert motion.command([replace(ahead, pushing=strip)], percepts)[0].linear == pytest.approx(0.2)
    narrow = replace(strip, half_width=0.1)
    assert motion.command([replace(ahead, pushing=narrow)], percepts)[0].linear < 0.01
    # Shy of it: gone around while there is room, and no cause to back off.
    shy = replace(strip, shy=True)
    assert motion.command([replace(ahead, pushing=shy)], percepts)[0].linear < 0.01
    straight = Action(drive=Drive(linear=0.2), pushing=shy)
    assert motion.command([straight], percepts) == (motion.command([straight], Percepts(time_s=0.0))[0], False)


def test_turning_gently() -> None:
    motion, nothing = Motion(PIONEER), Percepts(time_s=0.0)
    assert motion.command([Action(drive=Head(bearing=2.0, speed=0.2, turn=0.6))], nothing)[0].angular == 0.6
    assert motion.command([Action(drive=Head(bearing=2.0, speed=0.2))], nothing)[0].angular == 1.2


@pytest.mark.parametrize("skill", DELIVERY, ids=lambda skill: skill.name)
def test_they_say_what_they_do(skill: Skill) -> None:
    given = {"GetBox": {"color": "orange"}, "GoTo": {"place": "door"}, "GoThroughDoor": {"room": "other"}}
    words = skill.abstract.describe(skill.complete(given.get(skill.name, {})))
    assert (
        words
        == {
            "Localize": "find out in which room you are",
            "GetBox": "get the orange box, to push it",
            "GoTo": "go to the door",
            "OpenDoor": "open the door",
            "GoThroughDoor": "go through the door into the other room",
        }[skill.name]
    )
