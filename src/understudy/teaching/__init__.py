"""A robot that knows a task shows it to another one that follows it (§4.1, §4.5.5.2; semantics §7)."""

from understudy.teaching.follower import with_teacher
from understudy.teaching.manner import CAREFUL, NAIVE, Manner
from understudy.teaching.robot_teacher import RobotTeacher

__all__ = ["CAREFUL", "NAIVE", "Manner", "RobotTeacher", "with_teacher"]
