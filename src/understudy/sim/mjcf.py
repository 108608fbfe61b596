"""A world in MuJoCo's own language (MJCF): the arena, the things in it, and the robots' bodies.

A robot's base slides along x and y and turns about z, so that its joint positions *are* its pose. Its wheels are
three velocity servos in the body's frame: forward, turning, and one that holds it against sliding sideways.
Their forces are limited: pushed against a wall, the robot stalls. Boxes that nobody touches sleep: a resting box
would cost as much as the robot.
"""

import math

from understudy.robot import RobotSpec
from understudy.sim.layout import DOOR_HALF_THICKNESS_M, WALL_HALF_THICKNESS_M
from understudy.sim.world import DOOR_RANGE_DEG, Box, Door, RobotStart, Target, Teacher, Wall, World

__all__ = [
    "BOX_HEIGHT_M",
    "GRIPPER_HEIGHT_M",
    "GROUP_BOXES",
    "GROUP_SOLID",
    "PHYSICS_STEP_S",
    "WALL_HEIGHT_M",
    "arena_walls",
    "mjcf",
]

PHYSICS_STEP_S = 0.01
"""The longest step at which grasping is stable: a carried box slips by less than 2 cm in a minute of hard driving."""

WALL_HEIGHT_M = 0.60
BOX_HEIGHT_M = 0.10
_BOX_MASS_KG = 0.1
_GRIPPER_MASS_KG = 0.3

_DOOR_MASS_KG = 3.0
_DOOR_FRICTION_NM, _DOOR_DAMPING = 1.5, 1.0
"""Stiff enough to stop within a hand's breadth when nobody pushes it; a quarter of what the robot can push with."""
_DOOR_GAP_M = 0.02
"""Between leaf and floor."""

GRIPPER_HEIGHT_M = 0.055
"""Middle of the paddles when they are down."""

GROUP_FLOOR, GROUP_SOLID, GROUP_BOXES, GROUP_GRIPPER = 0, 1, 2, 3
"""Geom groups, by which rays choose what they meet."""

# Contact masks (contype of one against conaffinity of the other): boxes meet everything, robots all but the floor.
_FLOOR, _STILL, _ROBOT, _BOX = 1, 2, 4, 8

_TRACTION_N = 40.0  # 0.45 g for 9 kg: rubber on a hard floor
_TURNING_NM = 8.0
_GRIP_N = 12.0
_PADDLE_TRAVEL_TIME_S = 0.8


MARKER_X_M, MARKER_RADIUS_M, MARKER_TOP_M = -0.12, 0.10, 0.72
"""The tall cylinder on the back of a robot that can be followed; X in the robot's frame."""


def mjcf(world: World) -> str:
    """The whole model as XML text; names are ``wall0``, ``door0``, ``target0``, ``box0``, ``robot0``, ``teacher``."""
    width, depth = world.arena.size
    parts = [
        f"""<mujoco model="world">
<compiler angle="radian" autolimits="true"/>
<option timestep="{PHYSICS_STEP_S}" integrator="implicitfast" cone="elliptic" impratio="50" iterations="20">
  <flag sleep="enable"/>
</option>
<default>
  <default class="still"><geom group="{GROUP_SOLID}" contype="{_STILL}" conaffinity="0" friction="0.3"/></default>
  <default class="robot"><geom group="{GROUP_SOLID}" contype="{_ROBOT}" conaffinity="{_STILL | _ROBOT}"
    friction="0.3" mass="0"/></default>
  <default class="paddle"><geom group="{GROUP_GRIPPER}" contype="{_ROBOT}" conaffinity="{_STILL | _ROBOT}"
    friction="1.5 0.02 0.001" condim="4" mass="0.1"/></default>
  <default class="box"><geom group="{GROUP_BOXES}" contype="{_BOX}"
    conaffinity="{_FLOOR | _STILL | _ROBOT | _BOX}" friction="0.5" mass="{_BOX_MASS_KG}"/></default>
</default>
<worldbody>
<geom name="floor" type="plane" size="{width} {depth} 1" group="{GROUP_FLOOR}" contype="{_FLOOR}" conaffinity="0"/>"""
    ]
    parts += [_wall(i, wall) for i, wall in enumerate(world.walls)]
    parts += [_wall(len(world.walls) + i, wall) for i, wall in enumerate(arena_walls(width, depth))]
    parts += [_door(i, door) for i, door in enumerate(world.doors)]
    parts += [_target(i, target) for i, target in enumerate(world.targets)]
    parts += [_box(i, box) for i, box in enumerate(world.boxes)]
    parts += [_robot(i, robot) for i, robot in enumerate(world.robots)]
    if world.teacher is not None:
        parts.append(_teacher(world.teacher))
    parts.append("</worldbody>")
    parts += [_machinery(i, robot.spec) for i, robot in enumerate(world.robots)]
    parts.append("</mujoco>")
    return "\n".join(parts)


def arena_walls(width: float, depth: float) -> list[Wall]:
    """The four walls around the arena."""
    # Their inner faces lie on the arena's edge.
    t = WALL_HALF_THICKNESS_M
    corners = [(-t, -t), (width + t, -t), (width + t, depth + t), (-t, depth + t)]
    return [Wall(start=a, end=b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]


def _wall(index: int, wall: Wall) -> str:
    (ax, ay), (bx, by) = wall.start, wall.end
    length, angle = math.hypot(bx - ax, by - ay), math.atan2(by - ay, bx - ax)
    half = WALL_HALF_THICKNESS_M
    return (
        f'<geom name="wall{index}" class="still" type="box" pos="{(ax + bx) / 2} {(ay + by) / 2} {WALL_HEIGHT_M / 2}"'
        f' euler="0 0 {angle}" size="{length / 2 + half} {half} {WALL_HEIGHT_M / 2}"/>'
    )


def _door(index: int, door: Door) -> str:
    """A leaf on a hinge, in two halves, since the camera's painter goes by the distances of middles."""
    (x, y), limit = door.hinge, math.radians(DOOR_RANGE_DEG)
    angle = math.atan2(door.to[1] - y, door.to[0] - x)
    half = door.length / 4
    middle, half_height = (_DOOR_GAP_M + WALL_HEIGHT_M) / 2, (WALL_HEIGHT_M - _DOOR_GAP_M) / 2
    halves = "\n".join(
        f'<geom name="door{index} {part}" class="still" type="box" pos="{(2 * i + 1) * half} 0 {middle}"'
        f' size="{half} {DOOR_HALF_THICKNESS_M} {half_height}" mass="{_DOOR_MASS_KG / 2}"/>'
        for i, part in enumerate(("inner", "outer"))
    )
    return f"""<body name="door{index}" pos="{x} {y} 0" euler="0 0 {angle}">
  <joint name="door{index}" type="hinge" axis="0 0 1" range="-{limit} {limit}" damping="{_DOOR_DAMPING}"
    frictionloss="{_DOOR_FRICTION_NM}"/>
  {halves}
</body>"""


def _target(index: int, target: Target) -> str:
    # A mocap body: nothing can push it, and yet an experiment can move it in mid-run.
    x, y = target.at
    return (
        f'<body name="target{index}" mocap="true" pos="{x} {y} {target.height / 2}">'
        f'<geom name="target{index}" class="still" type="cylinder" size="{target.radius} {target.height / 2}"/></body>'
    )


def _teacher(teacher: Teacher) -> str:
    x, y = teacher.at
    half = teacher.height / 2
    return (
        f'<body name="teacher" mocap="true" pos="{x} {y} {half}">'
        f'<geom name="teacher" class="still" type="cylinder" size="{teacher.radius} {half}"/></body>'
    )


def _box(index: int, box: Box) -> str:
    x, y = box.at
    half, half_height = box.size / 2, BOX_HEIGHT_M / 2
    return (
        f'<body name="box{index}" pos="{x} {y} {half_height}" euler="0 0 {math.radians(box.heading_deg)}">'
        f'<freejoint name="box{index}"/>'
        f'<geom name="box{index}" class="box" type="box" size="{half} {half} {half_height}"/></body>'
    )


def _robot(index: int, robot: RobotStart) -> str:
    name, spec = f"robot{index}", robot.spec
    clearance, top = 0.03, spec.height
    half_height = (top - clearance) / 2
    if spec.round:
        shape = f'type="cylinder" size="{spec.width / 2} {half_height}"'
    else:
        shape = f'type="box" size="{spec.length / 2} {spec.width / 2} {half_height}"'
    inertia = spec.mass * (spec.length**2 + spec.width**2) / 12
    # The laser and the camera sit in a housing that other robots' lasers meet at 0.30 m.
    housing_half = (spec.camera.height + 0.04 - top) / 2
    marker = ""
    if robot.marker is not None:
        half = (MARKER_TOP_M - top) / 2
        marker = (
            f'<geom name="{name} marker" class="robot" type="cylinder" pos="{MARKER_X_M} 0 {top + half}"'
            f' size="{MARKER_RADIUS_M} {half}"/>'
        )
    return f"""<body name="{name}" sleep="never">
  <joint name="{name} x" type="slide" axis="1 0 0"/>
  <joint name="{name} y" type="slide" axis="0 1 0"/>
  <joint name="{name} heading" type="hinge" axis="0 0 1"/>
  <inertial pos="0 0 {top / 2}" mass="{spec.mass}" diaginertia="{inertia} {inertia} {inertia}"/>
  <site name="{name}"/>
  <geom name="{name} body" class="robot" pos="0 0 {(clearance + top) / 2}" {shape}/>
  <geom name="{name} housing" class="robot" type="box" pos="{spec.laser.x - 0.02} 0 {top + housing_half}"
    size="0.08 0.08 {housing_half}"/>
  {marker}
  {_gripper(name, spec)}
</body>"""


def _gripper(name: str, spec: RobotSpec) -> str:
    geometry = spec.gripper
    if geometry is None:
        return ""
    middle, half_length = (geometry.x_back + geometry.x_front) / 2, (geometry.x_front - geometry.x_back) / 2
    half_opening, half_thickness, half_height = geometry.opening / 2, 0.008, 0.025
    # Raised, the paddles' lower edge (0.03 m above the floor when down) clears a box on the floor.
    z = GRIPPER_HEIGHT_M
    paddles = "\n".join(
        f"""<body name="{name} {side}" gravcomp="1" pos="{middle} {sign * half_thickness} {z}">
      <joint name="{name} {side}" type="slide" axis="0 {sign} 0" range="0 {half_opening}" damping="4" armature="0.4"/>
      <geom name="{name} {side}" class="paddle" type="box" size="{half_length} {half_thickness} {half_height}"/>
    </body>"""
        for side, sign in (("left", 1), ("right", -1))
    )
    return f"""<body name="{name} lift" gravcomp="1">
    <joint name="{name} lift" type="slide" axis="0 0 1" range="0 {geometry.lift_height}" damping="10"/>
    <inertial pos="{geometry.x_back} 0 {z}" mass="{_GRIPPER_MASS_KG}" diaginertia="0.001 0.001 0.001"/>
    {paddles}
  </body>"""


def _machinery(index: int, spec: RobotSpec) -> str:
    """Servos, and what couples the paddles; in the order that :mod:`understudy.sim.model` relies on."""
    name = f"robot{index}"
    wheels = f"""<actuator>
  <velocity name="{name} forward" site="{name}" gear="1 0 0 0 0 0" kv="400" forcerange="-{_TRACTION_N} {_TRACTION_N}"/>
  <velocity name="{name} turn" site="{name}" gear="0 0 0 0 0 1" kv="20" forcerange="-{_TURNING_NM} {_TURNING_NM}"/>
  <velocity name="{name} sideways" site="{name}" gear="0 1 0 0 0 0" kv="8000"
    forcerange="-{2 * _TRACTION_N} {2 * _TRACTION_N}"/>
</actuator>"""
    if spec.gripper is None:
        return wheels
    return f"""{wheels}
<actuator>
  <position name="{name} paddles" joint="{name} left" kp="1500" kv="60" forcerange="-{2 * _GRIP_N} {2 * _GRIP_N}"/>
  <position name="{name} lift" joint="{name} lift" kp="4000" kv="120" forcerange="-60 60"/>
</actuator>
<tendon><fixed name="{name} coupling" stiffness="4000" damping="60" springlength="0">
  <joint joint="{name} left" coef="1"/><joint joint="{name} right" coef="-1"/>
</fixed></tendon>
<contact>
  <exclude body1="{name} left" body2="{name} right"/>
  <exclude body1="{name}" body2="{name} left"/>
  <exclude body1="{name}" body2="{name} right"/>
</contact>"""
