"""From what the robot senses to what it knows: blobs, cylinders, things, working memory."""

from understudy.perception.blobs import Blob, find_blobs
from understudy.perception.cylinders import Cylinder, find_cylinders
from understudy.perception.perception import Perception, PerceptionSettings
from understudy.perception.percepts import GripperState, Percepts, Thing

__all__ = [
    "Blob",
    "Cylinder",
    "GripperState",
    "Perception",
    "PerceptionSettings",
    "Percepts",
    "Thing",
    "find_blobs",
    "find_cylinders",
]
