"""``Wander``: search the room when no skill of the task is in execution (A.4, semantics §1)."""

import math
from dataclasses import replace
from random import Random

import numpy as np
from numpy.typing import NDArray

from understudy.behaviors.rooms import near_leaf
from understudy.behaviors.skill import Action, Drive, Head, Memory
from understudy.geometry import Pose, wrap_angle
from understudy.perception import Doorway, Percepts

__all__ = ["Wander"]

_BEFORE_DOOR_M = 1.0
"""A search ends so far before the line of a door: still well inside the room that is searched."""


class Wander:
    """Looks around once, then goes some way in a random free direction, and again.

    The camera sees 48.8°, so looking around shows more than driving on. Directions with much room are likelier.
    """

    turn_rate = 0.8
    speed = 0.40
    longest_leg = 2.5

    def step(self, percepts: Percepts, memory: Memory, random: Random) -> tuple[Action, Memory]:
        """The action for this tick, and what to remember for the next."""
        pose = percepts.odometry.pose
        if not memory:
            memory = {
                "phase": "look",
                "turned": 0.0,
                "heading": pose.heading,
                "side": random.choice((-1.0, 1.0)),
                # Where there is no room to turn, half a look must do.
                "until": percepts.time_s + 1.5 * math.tau / self.turn_rate,
            }
        if memory["phase"] == "look":
            action, memory = self._look(percepts, memory, random)
        else:
            action, memory = self._go(percepts, memory)
        return (replace(action, pushing=near_leaf(percepts)) if percepts.doorways else action), memory

    def _look(self, percepts: Percepts, memory: Memory, random: Random) -> tuple[Action, Memory]:
        heading = percepts.odometry.pose.heading
        turned = memory["turned"] + abs(wrap_angle(heading - memory["heading"]))
        if turned < math.tau and percepts.time_s < memory["until"]:
            action = Action(drive=Drive(angular=memory["side"] * self.turn_rate))
            return action, {**memory, "turned": turned, "heading": heading}
        return self._go(percepts, self._new_leg(percepts, random))

    def _new_leg(self, percepts: Percepts, random: Random) -> Memory:
        bearings = np.radians(np.arange(-85, 86, 10))
        room = np.array([_room(percepts, bearing) for bearing in bearings])
        lengths = np.clip(room - 0.5, 0.0, self.longest_leg)
        for doorway in percepts.doorways:
            lengths = np.minimum(lengths, _way_to(doorway, bearings))
        weights = lengths**2 + 1e-6
        index = random.choices(range(len(bearings)), weights=weights.tolist())[0]
        pose = percepts.odometry.pose
        return {
            "phase": "go",
            "heading": wrap_angle(pose.heading + float(bearings[index])),
            "from": (pose.x, pose.y),
            "length": float(lengths[index]),
            "until": percepts.time_s + 2.0 + float(lengths[index]) / self.speed * 1.5,
        }

    def _go(self, percepts: Percepts, memory: Memory) -> tuple[Action, Memory]:
        pose = percepts.odometry.pose
        gone = Pose(*memory["from"]).position.distance_to(pose.position)
        if gone >= memory["length"] or percepts.time_s > memory["until"]:
            return Action(drive=Drive()), {}
        return Action(drive=Head(bearing=wrap_angle(memory["heading"] - pose.heading), speed=self.speed)), memory


def _way_to(doorway: Doorway, bearings: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far the robot goes in each direction: one room is searched before the next."""
    here = doorway.here
    closing = -np.sign(here.x) * np.cos(here.heading + bearings)
    return np.where(closing > 1e-3, max(0.0, abs(here.x) - _BEFORE_DOOR_M) / np.maximum(closing, 1e-3), np.inf)


def _room(percepts: Percepts, bearing: float) -> float:
    """How far the robot could go in a direction before it meets something, at most 8 m."""
    points = percepts.obstacles
    along = points[:, 0] * math.cos(bearing) + points[:, 1] * math.sin(bearing)
    across = points[:, 1] * math.cos(bearing) - points[:, 0] * math.sin(bearing)
    ahead = along[(along > 0) & (np.abs(across) < 0.3)]
    return float(ahead.min()) if len(ahead) else 8.0
