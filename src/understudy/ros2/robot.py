"""A robot that speaks ROS 2, behind the same protocol as the simulated one."""

import logging
from dataclasses import replace
from types import TracebackType
from typing import Final, Self

from understudy.clock import CONTROL_PERIOD_S, Clock, WallClock
from understudy.errors import RobotError
from understudy.robot import STOP, Command, Cue, Observation, RobotSpec
from understudy.ros2.deadman import Deadman
from understudy.ros2.document import RobotDocument
from understudy.ros2.inputs import Inputs
from understudy.ros2.outputs import Outputs, eased
from understudy.ros2.transport import Transport, open_transport

__all__ = ["Ros2Robot"]

_log = logging.getLogger(__name__)

_LOOK_S: Final = 0.05
"""While connecting, what others publish is looked at so often."""

_DEADMAN_SHARE: Final = 0.8
"""Of the deadman's time, to leave some for the stop to arrive."""


class Ros2Robot:
    """A real robot, or a simulated one of another process.

    It moves only while somebody calls :meth:`act`. Whatever ends the ``with`` block, the robot is stopped first.

    Args:
        document: what it is, and which topics it has.
        transport: the network; joined by the document if left out.
        clock: ours, by which the age of readings is told.
    """

    def __init__(self, document: RobotDocument, transport: Transport | None = None, clock: Clock | None = None) -> None:
        self.document = document
        self._spec = document.spec
        self._clock = clock or WallClock()
        self._transport = transport or open_transport(document.transport, domain=document.domain)
        self.inputs = Inputs(document, self._transport, self._clock)
        self.outputs = Outputs(document, self._transport)
        self._deadman = Deadman(_DEADMAN_SHARE * document.deadman_s, self._clock, self._undecided)
        self._observation: Observation | None = None
        self._news_s = 0.0
        self._fresh = False
        self._acted_s: float | None = None
        self._halted = ""
        self._open = True

    @property
    def spec(self) -> RobotSpec:
        """What the robot is made of."""
        return self._spec

    def connect(self, timeout_s: float = 10.0) -> None:
        """Waits until everything that is needed has been heard, and the robot listens. Nothing moves.

        Raises:
            RobotError: something is missing after the timeout; the first fault, and how to mend it.
        """
        until_s = self._clock.now() + timeout_s
        while True:
            self.inputs.listen()
            self.outputs.connect()
            unusable: list[str] = []
            try:
                fresh = self._take_in()
            except RobotError as error:
                fresh = False
                unusable.append(str(error))  # as long as nothing moves, it may yet settle
            if fresh and not self.outputs.faults:
                break
            if self._clock.now() >= until_s:
                faults = [self.inputs.why_silent(role) for role in self.inputs.missing]
                faults += [*self.outputs.faults, *unusable]
                more = f" (and {len(faults) - 1} more: understudy doctor --robot)" if len(faults) > 1 else ""
                raise RobotError((faults or ["no whole observation came; try again"])[0] + more)
            self._transport.wait(_LOOK_S)
        if self.outputs.others:
            _log.warning(
                "%d other programs publish %s; what they send, the robot does, too",
                self.outputs.others,
                self.document.drive.topic,
            )

    def sense(self) -> Observation:
        """The newest readings; cues that arrived since the last call are handed over once.

        Raises:
            RobotError: nothing fresh came for too long, or somebody pressed the emergency stop.
        """
        if self._halted:
            raise RobotError(self._halted)
        if self._observation is None:
            self.connect()
        if self._stale:
            self._take_in()  # it may be us who were slow
        if self._stale:
            self._brake()
            scan = self.inputs.listening["scan"]
            raise RobotError(f"the robot was stopped: {self.inputs.why_silent(scan.role)}")
        observation = self._observation
        assert observation is not None
        self._observation = replace(observation, cues=()) if observation.cues else observation
        return observation

    def act(self, command: Command) -> None:
        """Takes the command for the period that begins, within the limits of speed and acceleration."""
        if self._halted or not self._fresh:
            self.stop()
            return
        observation = self._observation
        assert observation is not None
        self._deadman.alive()
        passed_s = CONTROL_PERIOD_S if self._acted_s is None else observation.time_s - self._acted_s
        speeds = eased(self.outputs.speeds, command, self._spec, min(max(passed_s, 0.0), self.document.deadman_s))
        self._acted_s = observation.time_s
        self.outputs.move_gripper(command)
        self.outputs.drive(*speeds, self.inputs.stamp_ns)

    def wait(self) -> None:
        """Until the next readings come, or it is time to stop for want of them."""
        # Half of the deadman's time without news, the robot stands still; a laser at 5 Hz is no reason for it yet.
        patience_s = max(self.document.deadman_s / 2 - (self._clock.now() - self._news_s), CONTROL_PERIOD_S)
        until_s = self._clock.now() + patience_s
        self._fresh = False
        while not self._take_in():
            left_s = until_s - self._clock.now()
            if left_s <= 0.0 or self._halted:
                return
            self._transport.wait(left_s)

    def stop(self) -> None:
        """Stands still at once."""
        self._deadman.rest()
        self._brake()

    def hear(self, cue: Cue) -> None:
        """A word from elsewhere, such as the keyboard; comes with the next observation."""
        self.inputs.hear(cue)

    def emergency_stop(self, reason: str) -> None:
        """Stops the robot for good: the next :meth:`sense` tells the reason. May be called from any thread."""
        self._halted = f"emergency stop: {reason}"
        self.outputs.halt(self.inputs.stamp_ns)

    def close(self) -> None:
        """Stops the robot and leaves the network."""
        if not self._open:
            return
        self._open = False
        try:
            self.stop()
        finally:
            self._deadman.close()
            self._transport.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @property
    def _stale(self) -> bool:
        return self._clock.now() - self._news_s > self.document.deadman_s

    def _take_in(self) -> bool:
        """Whether an observation came."""
        observation = self.inputs.update()
        if self.inputs.emergency and not self._halted:
            self.emergency_stop(f"{self.document.emergency_stop} is true; make it false, and start again")
        if observation is None:
            return False
        unheard = self._observation.cues if self._observation is not None else ()
        if unheard:
            observation = replace(observation, cues=unheard + observation.cues)
        self._observation, self._news_s, self._fresh = observation, self._clock.now(), True
        return True

    def _brake(self) -> None:
        self._acted_s = None
        self.outputs.drive(STOP.linear, STOP.angular, self.inputs.stamp_ns)

    def _undecided(self) -> None:
        self._brake()
        _log.warning("the program decided nothing for too long, so the robot was stopped; it goes on with the next")
