"""The control loop: the robot stands still however it ends."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from understudy.errors import RobotError
from understudy.robot import PIONEER, STOP, Command, Cue, NoJournal, Observation, RobotSpec, Scan, control

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


def test_many_short_gaps_are_no_long_one() -> None:
    robot = Fake(iter([0.0, 0.0, 0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.4, 0.4, 0.5, 0.5, 0.6]))
    control(robot, lambda seen: GO if seen.time_s < 0.6 else None, NoJournal(), period_s=0.1)
    assert robot.commands.count(STOP) == 6


def test_words_heard_in_a_gap_are_not_lost() -> None:
    robot = Fake(iter([0.0, 0.0, 0.0, 0.1]))
    spoken = iter([(), (Cue.HERE,), (Cue.TAKE,), (Cue.DONE,)])
    sense = robot.sense
    robot.sense = lambda: replace(sense(), cues=next(spoken))  # type: ignore[method-assign]
    heard: list[tuple[Cue, ...]] = []

    def decide(seen: Observation) -> Command | None:
        heard.append(seen.cues)
        return GO if seen.time_s < 0.1 else None

    control(robot, decide, NoJournal(), period_s=0.1)
    assert heard == [(), (Cue.HERE, Cue.TAKE, Cue.DONE)]


class Listener(NoJournal):
    """Keeps the commands."""

    def __init__(self) -> None:
        self.told: list[tuple[float, Command]] = []

    def command(self, time_s: float, command: Command) -> None:
        self.told.append((time_s, command))


def test_the_journal_is_told_of_every_stop() -> None:
    robot, journal = Fake(iter([0.0, 0.0, 0.1, 0.2])), Listener()
    control(robot, lambda seen: GO if seen.time_s < 0.2 else None, journal, period_s=0.1)
    assert journal.told == [(0.0, GO), (0.0, STOP), (0.1, GO), (0.2, STOP)]


def test_readings_that_cannot_be_used_stop_the_robot_before_anything_is_told() -> None:
    robot, journal = Fake(iter([float("nan")])), Listener()
    with pytest.raises(RobotError, match="not a number"):
        control(robot, lambda seen: GO, journal, period_s=0.1)
    assert robot.stops == 1
    assert journal.told == []
