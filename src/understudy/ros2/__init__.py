"""Robots that speak ROS 2, with or without ROS installed (``docs/ros2.md``)."""

from understudy.ros2.calibrating import alike, keep_colors, paint_of, picture_from
from understudy.ros2.checks import TopicFinding, examine
from understudy.ros2.document import RobotDocument, find_robot, load_robot, parse_robot, robot_names, robot_schema
from understudy.ros2.fitting import Fitting
from understudy.ros2.robot import Ros2Robot
from understudy.ros2.serving import Served, TimeKeeping
from understudy.ros2.transport import Transport, open_transport

__all__ = [
    "Fitting",
    "RobotDocument",
    "Ros2Robot",
    "Served",
    "TimeKeeping",
    "TopicFinding",
    "Transport",
    "alike",
    "examine",
    "find_robot",
    "keep_colors",
    "load_robot",
    "open_transport",
    "paint_of",
    "parse_robot",
    "picture_from",
    "robot_names",
    "robot_schema",
]
