"""The robot that teaches: it executes its task, and tells its follower when something is achieved (semantics §7)."""

import math
from collections import deque
from collections.abc import Mapping
from dataclasses import replace
from typing import Literal

from understudy.behaviors import Action, Drive, Head, Motion, Skill
from understudy.clock import CONTROL_PERIOD_S
from understudy.execution import Controller, Event
from understudy.geometry import Pose, wrap_angle
from understudy.network import Component, Network
from understudy.perception import Perception, Percepts
from understudy.robot import STOP, Command, Cue, Observation, RobotSpec
from understudy.teaching.manner import CAREFUL, Manner

__all__ = ["RobotTeacher"]

_TURN_RATE = 0.8
_LOOK_S = 1.5 * math.tau / _TURN_RATE
"""Where there is no room to turn, half a look must do."""

_LOST_S = 0.5
"""A follower that looks aside for a moment is not waited for."""

_PATIENCE_S = 20.0
"""One that has not come after so long has lost its teacher, and finds it rather when it moves."""

_LEAD_OUT = 1.6
"""At the end it goes on by so many times what the follower is behind: a target is passed when it is well behind."""

_LEAD_OUT_M_S = 0.25
_LEAD_OUT_S = 12.0
"""Where there is no room to lead the follower past the last place, the words are said all the same."""

_WORDS = {"PickUp": Cue.TAKE, "GetBox": Cue.TAKE, "Drop": Cue.DROP}


class RobotTeacher:
    """Executes a task before a follower, by its own senses and the one bit that the follower tells.

    Args:
        network: the task.
        skills: by name.
        spec: the robot.
        manner: how it teaches.
        seed: of the search.

    Raises:
        NetworkError: the network does not fit the skills.
    """

    def __init__(
        self,
        network: Network,
        skills: Mapping[str, Skill],
        spec: RobotSpec,
        *,
        manner: Manner = CAREFUL,
        seed: int = 0,
    ) -> None:
        self.manner = manner
        self.controller = Controller(network, skills, spec, seed=seed)
        self.perception = Perception(spec, attention=self.controller.program.attention)
        self.phase: Literal["looking", "beginning", "doing", "leading out", "over"] = (
            "looking" if manner.looks_around else "beginning"
        )
        self.events: list[Event] = []
        """What the trace of the execution has told so far."""
        self.complete = False
        """The task was executed to its end."""
        self._motion = Motion(spec)
        self._unsaid: deque[tuple[float, Cue]] = deque()
        self._pose: Pose | None = None
        self._way_m = self._turned = 0.0
        self._alone_s = 0.0
        self._look_until_s: float | None = None
        self._end_m = self._end_s = math.inf

    def step(self, observation: Observation, followed: bool) -> tuple[Command, tuple[Cue, ...]]:
        """One control period: the command, and the words that the follower hears.

        Args:
            observation: of this robot's own senses.
            followed: what the follower tells: it has its teacher near, before it.

        Raises:
            RobotError: the readings cannot be used.
        """
        percepts = self.perception.update(observation)
        self._count_the_way(percepts.odometry.pose)
        self._alone_s = 0.0 if followed else self._alone_s + CONTROL_PERIOD_S
        if self.phase == "looking":
            return self._look(percepts), ()
        if self.phase == "beginning":
            if self._standing:
                return STOP, ()
            self.phase = "doing"
            return self._do(percepts), (Cue.START, *self._say())
        if self.phase == "over":
            return STOP, ()
        command = self._do(percepts) if self.phase == "doing" else self._lead_out(percepts)
        words = self._say()
        if self.phase == "leading out" and self._led_out(percepts.time_s):
            self.phase = "over"
            words += (*(word for _, word in self._unsaid), Cue.DONE)
            command = STOP
        return command, words

    @property
    def _standing(self) -> bool:
        """It waits for its follower."""
        busy = bool(self.controller.context.keep_on)  # what the gripper has begun is not broken off
        return self.manner.waits and not busy and _LOST_S <= self._alone_s < _PATIENCE_S

    def _count_the_way(self, pose: Pose) -> None:
        if self._pose is not None:
            self._way_m += pose.position.distance_to(self._pose.position)
            self._turned += abs(wrap_angle(pose.heading - self._pose.heading))
        self._pose = pose

    def _look(self, percepts: Percepts) -> Command:
        """Once around: what was seen is remembered."""
        if self._look_until_s is None:
            self._look_until_s = percepts.time_s + _LOOK_S
        if self._turned >= math.tau or percepts.time_s >= self._look_until_s:
            self.phase = "beginning"
            return STOP
        command, _ = self._motion.command([Action(drive=Drive(angular=_TURN_RATE))], percepts)
        return command

    def _do(self, percepts: Percepts) -> Command:
        """The task itself."""
        if self._standing:
            return STOP
        context = self.controller.context
        if context.time_s is not None and (stood_s := percepts.time_s - context.time_s - CONTROL_PERIOD_S) > 0.01:
            context.pass_over(stood_s)
        decision = self.controller.tick(percepts)
        self.events += decision.events
        for event in decision.events:
            if event.kind == "achieved" and (word := self._word(event)) is not None:
                self._unsaid.append((self._way_m + self.manner.shows_m, word))
        if decision.complete or decision.stopped:
            self.complete = decision.complete
            self.phase = "leading out"
            self._end_m = self._way_m + _LEAD_OUT * self.manner.shows_m
            self._end_s = percepts.time_s + _LEAD_OUT_S * (self.manner.shows_m > 0)
            return STOP
        return self._at_pace(decision.command)

    def _word(self, event: Event) -> Cue | None:
        """What is said of an achievement; nothing of a network, whose steps were told, and of an empty gripper."""
        part = self.controller.program.network.by_path.get(event.component)
        if not isinstance(part, Component):
            return None
        if part.behavior in _WORDS:
            return _WORDS[part.behavior] if event.detail["on_purpose"] else None
        return Cue.HERE

    def _say(self) -> tuple[Cue, ...]:
        """The words whose time has come: the follower stands where the teacher stood."""
        said: list[Cue] = []
        while self._unsaid and self._way_m >= self._unsaid[0][0] and not self._standing:
            said.append(self._unsaid.popleft()[1])
        return tuple(said)

    def _lead_out(self, percepts: Percepts) -> Command:
        """Straight on, so that the follower comes past the last place, too."""
        if self._standing:
            return STOP
        command, _ = self._motion.command([Action(drive=Head(bearing=0.0, speed=_LEAD_OUT_M_S))], percepts)
        return command

    def _led_out(self, time_s: float) -> bool:
        return self._way_m >= self._end_m or time_s >= self._end_s

    def _at_pace(self, command: Command) -> Command:
        pace = self.manner.pace
        return replace(command, linear=pace * command.linear, angular=pace * command.angular)
