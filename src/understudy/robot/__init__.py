"""What a robot is: its observations, its commands, its numbers."""

from understudy.robot.colors import RGB, TEACHER_COLOR, Color, Paints
from understudy.robot.command import STOP, Command
from understudy.robot.cues import Cue
from understudy.robot.journal import Journal, NoJournal
from understudy.robot.kinds import ROBOTS
from understudy.robot.loop import DEADMAN_S, control
from understudy.robot.observation import GripperReading, Observation, Odometry, Scan
from understudy.robot.pioneer import PIONEER
from understudy.robot.protocol import Robot
from understudy.robot.spec import CameraMount, GripperGeometry, LaserMount, RobotSpec
from understudy.robot.turtlebot import TURTLEBOT

__all__ = [
    "DEADMAN_S",
    "PIONEER",
    "RGB",
    "ROBOTS",
    "STOP",
    "TEACHER_COLOR",
    "TURTLEBOT",
    "CameraMount",
    "Color",
    "Command",
    "Cue",
    "GripperGeometry",
    "GripperReading",
    "Journal",
    "LaserMount",
    "NoJournal",
    "Observation",
    "Odometry",
    "Paints",
    "Robot",
    "RobotSpec",
    "Scan",
    "control",
]
