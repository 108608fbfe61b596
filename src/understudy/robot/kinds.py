"""The robots that are known by name: those that can be simulated."""

from collections.abc import Mapping
from types import MappingProxyType

from understudy.robot.pioneer import PIONEER
from understudy.robot.spec import RobotSpec
from understudy.robot.turtlebot import TURTLEBOT

__all__ = ["ROBOTS"]

ROBOTS: Mapping[str, RobotSpec] = MappingProxyType({spec.name: spec for spec in (PIONEER, TURTLEBOT)})
