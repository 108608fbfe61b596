"""From what the robot senses to what it knows: blobs, cylinders, things, working memory."""

from understudy.perception.blobs import Blob, find_blobs
from understudy.perception.cylinders import Cylinder, find_cylinders
from understudy.perception.perception import Perception, PerceptionSettings
from understudy.perception.percepts import Attention, Doorway, GripperState, Percepts, Room, Thing

__all__ = [
    "Attention",
    "Blob",
    "Cylinder",
    "Doorway",
    "GripperState",
    "Perception",
    "PerceptionSettings",
    "Percepts",
    "Room",
    "Thing",
    "find_blobs",
    "find_cylinders",
]
