"""Following the teacher during a demonstration (§4.1, A.5)."""

import math
from random import Random

from understudy.behaviors.skill import Action, Drive, Head, Memory
from understudy.geometry import Point
from understudy.perception import Percepts

__all__ = ["FollowTeacher"]


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
