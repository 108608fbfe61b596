"""The control loop: sense, decide, act, wait; and the robot stands still however it ends."""

from collections.abc import Callable
from dataclasses import replace

from understudy.errors import RobotError
from understudy.robot.command import STOP, Command
from understudy.robot.cues import Cue
from understudy.robot.journal import Journal
from understudy.robot.observation import Observation
from understudy.robot.protocol import Robot

__all__ = ["DEADMAN_S", "control"]

DEADMAN_S = 0.5
"""Without a fresh observation for this long the robot must not go on with its last command (semantics §3, step 7)."""


def control(
    robot: Robot,
    decide: Callable[[Observation], Command | None],
    journal: Journal,
    *,
    period_s: float,
) -> None:
    """Runs until ``decide`` gives None. Whatever happens, the robot is stopped first.

    Args:
        robot: to be controlled.
        decide: the command for an observation; None ends the loop.
        journal: is told every observation and command.
        period_s: of the control, for the deadman: so many periods without a fresh observation are too many.

    Raises:
        RobotError: the robot sent nothing fresh for :data:`DEADMAN_S`, or readings that cannot be used.
    """
    last_s: float | None = None
    stale = 0
    held: tuple[Cue, ...] = ()
    try:
        while True:
            observation = robot.sense()
            if last_s is not None and observation.time_s <= last_s:
                # No news: stand still rather than go on blindly. Words heard meanwhile are not lost.
                stale += 1
                held += observation.cues
                robot.act(STOP)
                journal.command(last_s, STOP)
                if stale * period_s >= DEADMAN_S:
                    raise RobotError(
                        f"the robot sent no fresh readings for {DEADMAN_S} s (the last are of t={last_s} s), so it was "
                        "stopped; check its sensors and the connection"
                    )
            else:
                observation.check()
                if held:
                    observation, held = replace(observation, cues=held + observation.cues), ()
                last_s, stale = observation.time_s, 0
                journal.observation(observation)
                command = decide(observation)
                if command is None:
                    journal.command(last_s, STOP)
                    return
                robot.act(command)
                journal.command(last_s, command)
            robot.wait()
    finally:
        robot.stop()
