"""Following the teacher during a demonstration (§4.1, A.5)."""

import math
from itertools import pairwise
from random import Random
from typing import Protocol

from understudy.behaviors.skill import Action, Drive, Head, Memory
from understudy.geometry import Point
from understudy.perception import Percepts

__all__ = ["FollowTeacher", "FollowTrail", "Following"]


class Following(Protocol):
    """How a learner keeps with its teacher."""

    def step(self, percepts: Percepts, memory: Memory, random: Random) -> tuple[Action, Memory]:
        """The action for this tick, and what to remember for the next."""
        ...


class FollowTeacher:
    """Stays half a metre behind the teacher.

    When it loses sight, it goes on to where the teacher was last, and looks around there.
    """

    distance_m = 0.60
    """To the robot's turning point; the laser, which sits 0.1 m before it, then reads the manual's 50 cm."""

    speed = 0.50

    def step(self, percepts: Percepts, memory: Memory, random: Random) -> tuple[Action, Memory]:
        """The action for this tick, and what to remember for the next."""
        teacher, pose = percepts.teacher, percepts.odometry.pose
        if teacher is not None:
            place = pose.to_parent(teacher.position)
            gap = teacher.distance_m - self.distance_m
            speed = max(0.0, min(self.speed, 1.5 * gap))
            drive: Drive | Head
            if gap < 0.05:
                drive = Drive(angular=max(-1.0, min(1.0, 1.8 * teacher.bearing)))
            else:
                drive = Head(bearing=teacher.bearing, speed=speed, way=gap)
            action = Action(drive=drive, aim=teacher.position, aim_radius=teacher.radius)
            return action, {"place": (place.x, place.y), "seen_s": percepts.time_s}
        if "place" not in memory:
            return Action(drive=Drive(angular=0.6)), memory
        last = pose.to_local(Point(*memory["place"]))
        lost_s = percepts.time_s - memory["seen_s"]
        if lost_s < 6.0 and last.distance > 0.9:
            return Action(drive=Head(bearing=last.bearing, speed=0.25)), memory
        # Turn to the side on which the teacher was last, and keep to it.
        turn = memory.get("turn", math.copysign(0.6, last.bearing))
        return Action(drive=Drive(angular=turn)), {**memory, "turn": turn}


class FollowTrail:
    """Goes where the teacher went, and not straight to where it is, so that it cuts no corner.

    Who stays straight behind a teacher passes a target on another side, or farther off, than the teacher did when the
    way turns there. When it loses sight, it goes on to the trail's end, and looks around there.
    """

    distance_m = FollowTeacher.distance_m
    speed = FollowTeacher.speed

    crumb_m = 0.10
    """How far apart the remembered places of the trail are."""

    ahead_m = 0.20
    """The place that is aimed at lies so far before the robot: shorter, and it would weave."""

    longest = 80

    def step(self, percepts: Percepts, memory: Memory, random: Random) -> tuple[Action, Memory]:
        teacher, pose = percepts.teacher, percepts.odometry.pose
        trail: list[tuple[float, float]] = memory.get("trail", [])
        if teacher is not None:
            place = pose.to_parent(teacher.position)
            if not trail or math.dist(trail[-1], place) >= self.crumb_m:
                trail = [*trail[-self.longest :], (place.x, place.y)]
        elif not trail:
            return Action(drive=Drive(angular=0.6)), memory
        trail = self._still_ahead(trail, pose.position)
        memory = {"trail": trail, "turn": memory.get("turn")}
        places = [pose.to_local(Point(*crumb)) for crumb in trail]
        left_m = places[0].distance + sum(one.distance_to(other) for one, other in pairwise(places))
        keep_m = self.distance_m if teacher is not None else 0.3
        gap = min(left_m, teacher.distance_m if teacher is not None else left_m) - keep_m
        if gap >= 0.05:
            aim = next((one for one in places if one.distance >= self.ahead_m), places[-1])
            drive: Drive | Head = Head(bearing=aim.bearing, speed=min(self.speed, 1.5 * gap))
            memory["turn"] = None
        elif teacher is not None:
            drive = Drive(angular=max(-1.0, min(1.0, 1.8 * teacher.bearing)))
        else:
            # Turn to the side on which the trail ends, and keep to it.
            memory["turn"] = memory["turn"] or math.copysign(0.6, places[-1].bearing)
            drive = Drive(angular=memory["turn"])
        if teacher is None:
            return Action(drive=drive), memory
        return Action(drive=drive, aim=teacher.position, aim_radius=teacher.radius), memory

    def _still_ahead(self, trail: list[tuple[float, float]], here: Point) -> list[tuple[float, float]]:
        """The trail without what lies behind; its end always stays."""
        beside = min(range(min(len(trail), 10)), key=lambda index: math.dist(trail[index], here))
        if math.dist(trail[beside], here) < self.ahead_m:
            return trail[min(beside + 1, len(trail) - 1) :]
        return trail[beside:]
