"""The control loop: the robot stands still however it ends."""

from collections.abc import Iterator

import numpy as np
import pytest

from understudy.errors import RobotError
from understudy.robot import PIONEER, STOP, Command, NoJournal, Observation, RobotSpec, Scan, control

GO = Command(linear=0.3)


class Fake:
    """A robot that tells the given times, one a period."""

    spec: RobotSpec = PIONEER

    def __init__(self, times: Iterator[float]) -> None:
        self.times = times
        self.now = next(times)
        self.commands: list[Command] = []
        self.stops = 0

    def sense(self) -> Observation:
        return Observation(time_s=self.now, scan=Scan(ranges=np.ones(181, np.float32)))

    def act(self, command: Command) -> None:
        self.commands.append(command)

    def wait(self) -> None:
        self.now = next(self.times)

    def stop(self) -> None:
        self.stops += 1


def test_it_runs_until_there_is_no_command() -> None:
    robot = Fake(iter([0.0, 0.1, 0.2]))
    control(robot, lambda seen: GO if seen.time_s < 0.2 else None, NoJournal(), period_s=0.1)
    assert robot.commands == [GO, GO]
    assert robot.stops == 1


@pytest.mark.parametrize("error", [KeyboardInterrupt, ZeroDivisionError])
def test_it_stops_the_robot_on_any_exception(error: type[BaseException]) -> None:
    robot = Fake(iter([0.0]))

    def decide(seen: Observation) -> Command:
        raise error

    with pytest.raises(error):
        control(robot, decide, NoJournal(), period_s=0.1)
    assert robot.stops == 1


def test_the_deadman() -> None:
    """Frozen readings: it stands still at once, and gives up after half a second."""
    robot = Fake(iter([0.0, 0.1, *[0.1] * 20]))
    with pytest.raises(RobotError, match=r"no fresh readings for 0\.5 s.*check its sensors"):
        control(robot, lambda seen: GO, NoJournal(), period_s=0.1)
    assert robot.commands == [GO, GO, *[STOP] * 5]
    assert robot.stops == 1


def test_a_short_gap_is_bridged() -> None:
    robot = Fake(iter([0.0, 0.0, 0.0, 0.3, 0.4]))
    control(robot, lambda seen: GO if seen.time_s < 0.4 else None, NoJournal(), period_s=0.1)
    assert robot.commands == [GO, STOP, STOP, GO]
