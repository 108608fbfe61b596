"""``Track(color, distance, angle)``: go to a tall target until it stands at a distance and angle (§3.5.3.2)."""

import math
from collections.abc import Mapping
from random import Random

from understudy.behaviors.skill import Action, Actuator, Drive, Head, Instance, Memory, Parameter, Parameters, Skill
from understudy.geometry import angle_to_bearing, wrap_angle
from understudy.perception import Percepts, Thing
from understudy.robot import TEACHER_COLOR, Color

__all__ = ["TRACK", "AbstractTrack", "PrimitiveTrack"]

COLOR = Parameter(name="color", kind="color")
DISTANCE = Parameter(name="distance_m", kind="number", low=0.30, high=2.00, default=0.60, tolerance=0.10)
ANGLE = Parameter(name="angle_deg", kind="number", low=0.0, high=180.0, default=90.0, tolerance=10.0)


class AbstractTrack:
    """Goal: ``DistToTarget = distance AND AngleToTarget = angle``, within 0.10 m and 10°."""

    name = "Track"
    parameters = (COLOR, DISTANCE, ANGLE)
    actuators = frozenset({Actuator.WHEELS})
    maintaining = False

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        return any(
            thing.sensed
            and abs(thing.distance_m - parameters["distance_m"]) <= DISTANCE.tolerance
            and abs(thing.angle_deg - parameters["angle_deg"]) <= ANGLE.tolerance
            for thing in percepts.targets
            if thing.color == parameters["color"]
        )

    def precondition(self, percepts: Percepts, parameters: Parameters) -> bool:
        return percepts.nearest_target(parameters["color"]) is not None

    def observe(self, percepts: Percepts) -> Mapping[Instance, Mapping[str, float]]:
        seen: dict[Instance, Mapping[str, float]] = {}
        for thing in percepts.targets:  # nearest first: of two targets of one color, the nearer one is meant
            instance = Instance(self.name, (("color", str(thing.color)),))
            if thing.color is TEACHER_COLOR or instance in seen or not _evaluable(thing):
                continue
            distance = min(max(thing.distance_m, DISTANCE.low), DISTANCE.high)
            angle = min(max(thing.angle_deg, ANGLE.low), ANGLE.high)
            seen[instance] = {"distance_m": distance, "angle_deg": angle}
        return seen

    def describe(self, parameters: Parameters) -> str:
        angle = parameters["angle_deg"]
        if angle >= 135:
            where = f"to pass it on your left at {parameters['distance_m']:.1f} m"
        elif angle <= 45:
            where = f"to pass it on your right at {parameters['distance_m']:.1f} m"
        else:
            where = f"until it is {parameters['distance_m']:.1f} m ahead"
        return f"go to the {parameters['color']} target, {where}"


def _evaluable(thing: Thing) -> bool:
    """Sensed now, within the laser's half circle and the distances that the skill can hold."""
    return thing.sensed and thing.distance_m <= DISTANCE.high and abs(thing.bearing) <= math.radians(95)


class PrimitiveTrack:
    """Drives along the straight line that brings the target to its distance and angle at once.

    On a line that passes the target's middle at the lateral offset ``h``, the target stands at bearing ``asin(h / R)`` when
    it is ``R`` away. Choosing ``h = D sin(goal bearing)`` makes both right at the distance ``D``, so that a gate or a slalom pole
    is passed smoothly. At the right distance but a wrong angle the robot turns on the spot, which changes the angle alone.
    """

    speed = 0.40

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        thing = self._chosen(percepts, parameters["color"], memory)
        if thing is None:
            return Action(drive=Drive()), {}
        wanted = thing.radius + parameters["distance_m"]
        goal_bearing = angle_to_bearing(parameters["angle_deg"])
        away, bearing = thing.position.distance, thing.bearing
        drive: Drive | Head
        if away > wanted + 0.6 * DISTANCE.tolerance:
            offset = wanted * math.sin(goal_bearing)
            line = math.asin(max(-1.0, min(1.0, offset / away)))
            # Slow down towards the end, but not on a line that passes by.
            speed = min(self.speed, 0.10 + 0.8 * (away - wanted) + 0.3 * abs(math.sin(goal_bearing)))
            drive = Head(bearing=wrap_angle(bearing - line), speed=speed)
        elif away < wanted - 0.6 * DISTANCE.tolerance:
            # Too near: leave along the line through the target, forwards or backwards, whichever is the smaller turn.
            ahead = abs(bearing) < math.pi / 2
            turn = bearing if ahead else wrap_angle(bearing - math.pi)
            drive = Drive(linear=-0.12 if ahead else 0.15, angular=_turn(0.5 * turn))
        else:
            drive = Drive(angular=_turn(1.8 * wrap_angle(bearing - goal_bearing)))
        return Action(drive=drive, aim=thing.position, aim_radius=thing.radius), {"id": thing.id}

    @staticmethod
    def _chosen(percepts: Percepts, color: Color, memory: Memory) -> Thing | None:
        """The target that was chosen before, as long as it is there: two of one color must not pull the robot about."""
        same = [thing for thing in percepts.targets if thing.color == color]
        return next((thing for thing in same if thing.id == memory.get("id")), same[0] if same else None)


def _turn(rate: float) -> float:
    return max(-1.0, min(1.0, rate))


TRACK = Skill(AbstractTrack(), PrimitiveTrack())
