"""``Track(color, distance, angle)``: go to a tall target until it stands at a distance and angle (§3.5.3.2)."""

import math
from collections.abc import Mapping
from random import Random

from understudy.behaviors.skill import Action, Actuator, Drive, Head, Instance, Memory, Parameter, Parameters, Skill
from understudy.behaviors.stand import Stand, choose_direction, stand_at
from understudy.behaviors.surroundings import surroundings
from understudy.behaviors.symbols import TARGET, Way
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
    ways = (Way(of={"color": TARGET}, goal="near(color)", gives="visited(color)", ends="near(*)"),)

    def goal(self, percepts: Percepts, parameters: Parameters) -> bool:
        color, distance, angle = parameters["color"], parameters["distance_m"], parameters["angle_deg"]
        for thing in percepts.targets:
            if thing.color == color and thing.sensed:
                near = abs(thing.distance_m - distance) <= DISTANCE.tolerance
                if near and abs(thing.angle_deg - angle) <= ANGLE.tolerance:
                    return True
        return False

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
            where = f"to pass it on your left at {parameters['distance_m']:.2f} m"
        elif angle <= 45:
            where = f"to pass it on your right at {parameters['distance_m']:.2f} m"
        else:
            where = f"until it is {parameters['distance_m']:.2f} m ahead"
        return f"go to the {parameters['color']} target, {where}"

    def holding(self, parameters: Parameters) -> str:
        angle = parameters["angle_deg"]
        where = "to the left" if angle >= 135 else "to the right" if angle <= 45 else "ahead"
        return f"the {parameters['color']} target is {parameters['distance_m']:.2f} m {where}"

    def possible(self, parameters: Parameters) -> str:
        return f"the {parameters['color']} target is in sight or remembered"


def _evaluable(thing: Thing) -> bool:
    """Found by the camera, sensed now, within the laser's half circle and the distances that the skill can hold."""
    return (
        thing.followed and thing.sensed and thing.distance_m <= DISTANCE.high and abs(thing.bearing) <= math.radians(95)
    )


class PrimitiveTrack:
    """Drives to a stand from which the target is at its distance and angle, and turns there until it is so.

    Any point of a circle around the target will do. The nearest one with room is chosen, less turning counting as less
    way: so a gate or a slalom pole is passed in one smooth line, and a target in a corner is approached from where
    there is room. Its memory holds the direction of the chosen stand, and those that it could not reach.
    """

    speed = 0.40
    patience_s = 6.0
    """Without coming nearer to its stand for so long, the robot gives it up for another one."""

    reconsider_s = 0.25
    """How often it looks for a better one."""

    def step(self, percepts: Percepts, parameters: Parameters, memory: Memory, random: Random) -> tuple[Action, Memory]:
        thing = self._chosen(percepts, parameters["color"], memory)
        if thing is None:
            return Action(drive=Drive()), {}
        if thing.id != memory.get("id"):
            memory = {"id": thing.id, "avoided": []}
        wanted = thing.radius + parameters["distance_m"]
        goal_bearing = angle_to_bearing(parameters["angle_deg"])
        memory = self._choose(percepts, thing, wanted, goal_bearing, memory)
        stand = stand_at(memory["direction"], thing.position, wanted, goal_bearing, percepts.odometry.pose.heading)
        memory = self._watch_progress(percepts.time_s, stand, memory)
        close = abs(thing.position.distance - wanted) <= 0.6 * DISTANCE.tolerance
        drive: Drive | Head
        if close and (stand.place.distance < 0.15 or memory["turning"]):
            # At the right distance, turning on the spot changes the angle alone.
            memory = {**memory, "turning": True}
            drive = Drive(angular=_turn(1.8 * wrap_angle(thing.bearing - goal_bearing)))
        else:
            memory = {**memory, "turning": False}
            # Slow down at the end, unless the robot only passes by.
            passing = abs(wrap_angle(stand.heading - stand.place.bearing)) < math.radians(25)
            speed = self.speed if passing else min(self.speed, 0.08 + 1.0 * stand.place.distance)
            if stand.place.distance < 0.25 and abs(stand.place.bearing) > math.pi / 2:
                # A little too far: back up rather than turn around.
                back = wrap_angle(stand.place.bearing - math.pi)
                drive = Drive(linear=-0.12, angular=_turn(0.8 * back))
            else:
                drive = Head(bearing=stand.place.bearing, speed=speed, way=stand.place.distance)
        return Action(drive=drive, aim=thing.position, aim_radius=thing.radius), memory

    def _choose(self, percepts: Percepts, thing: Thing, wanted: float, goal_bearing: float, memory: Memory) -> Memory:
        """The direction of the stand, reconsidered a few times a second."""
        previous = memory.get("direction")
        if previous is not None and percepts.time_s - memory["chosen_s"] < self.reconsider_s:
            return memory
        direction = choose_direction(
            thing.position,
            thing.radius,
            wanted,
            goal_bearing,
            percepts.odometry.pose.heading,
            obstacles=surroundings(percepts, None),
            previous=previous,
            avoided=memory["avoided"],
        )
        memory = {**memory, "direction": direction, "chosen_s": percepts.time_s}
        if direction != previous:
            memory |= {"nearest": math.inf, "since_s": percepts.time_s, "turning": False}
        return memory

    def _watch_progress(self, time_s: float, stand: Stand, memory: Memory) -> Memory:
        """Gives a stand up that the robot does not come nearer to."""
        left = stand.place.distance + 0.3 * abs(stand.heading)
        if left < memory["nearest"] - 0.05:
            return {**memory, "nearest": left, "since_s": time_s}
        if time_s - memory["since_s"] > self.patience_s:
            avoided = [*memory["avoided"][-2:], memory["direction"]]
            return {**memory, "avoided": avoided, "nearest": math.inf, "since_s": time_s}
        return memory

    @staticmethod
    def _chosen(percepts: Percepts, color: Color, memory: Memory) -> Thing | None:
        """The target that was chosen before, as long as it is there: two of one color must not pull the robot about."""
        same = [thing for thing in percepts.targets if thing.color == color]
        return next((thing for thing in same if thing.id == memory.get("id")), same[0] if same else None)


def _turn(rate: float) -> float:
    return max(-1.0, min(1.0, rate))


TRACK = Skill(AbstractTrack(), PrimitiveTrack())
