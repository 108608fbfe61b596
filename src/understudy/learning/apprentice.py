"""The robot in its learning mode: it follows the teacher, obeys TAKE and DROP, and watches its goals (§4.1, §4.2)."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from random import Random
from typing import Any, Literal

from understudy.behaviors import Action, Drive, FollowTeacher, Instance, Memory, Motion, Parameters, Skill
from understudy.clock import CONTROL_PERIOD_S
from understudy.learning.observations import Demonstration
from understudy.learning.observer import Observer
from understudy.learning.settings import LearningSettings
from understudy.perception import Perception, Percepts
from understudy.robot import Command, Cue, Journal, NoJournal, Observation, Robot, RobotSpec, control

__all__ = ["Apprentice", "demonstrate", "evaluate", "observe"]


def evaluate(percepts: Percepts, skills: Mapping[str, Skill]) -> dict[Instance, Mapping[str, float]]:
    """Which goals of which skills hold, or could hold, now, and with which values (§4.3)."""
    evaluated: dict[Instance, Mapping[str, float]] = {}
    for skill in skills.values():
        evaluated.update(skill.abstract.observe(percepts))
    return evaluated


def observe(
    observations: Iterable[Observation],
    spec: RobotSpec,
    skills: Mapping[str, Skill],
    settings: LearningSettings | None = None,
    *,
    name: str,
) -> Demonstration:
    """What a demonstration showed, from the observations alone: the way to learn from a recording.

    A live demonstration goes the same way, one observation at a time, so that both learn the same.

    Raises:
        LearningError: START was never said.
        RobotError: the readings cannot be used.
    """
    perception, observer = Perception(spec), Observer(settings)
    for observation in observations:
        percepts = perception.update(observation)
        observer.step(observation.time_s, evaluate(percepts, skills), observation.cues)
    return observer.finish(name=name)


@dataclass(slots=True)
class Errand:
    """TAKE or DROP in execution."""

    skill: Skill
    parameters: Parameters
    until_s: float
    memory: Memory


class Apprentice:
    """Decides what the robot does during a demonstration. All skills watch, none acts but on TAKE and DROP.

    Args:
        skills: by name; TAKE needs ``PickUp``, DROP needs ``Drop``.
        spec: the robot.
        seed: of the primitives, should they throw dice.
    """

    look_s = 15.0
    """How long after TAKE the robot waits for a box to come into view."""

    shown_s = 5.0
    """A box seen this short a time ago still counts as shown: the robot turns with the teacher."""

    errand_s = 45.0
    """How long it tries to pick up or to drop."""

    def __init__(self, skills: Mapping[str, Skill], spec: RobotSpec, *, seed: int = 0) -> None:
        self.skills = skills
        self.mode: Literal["idle", "following", "looking", "busy", "done"] = "idle"
        self._motion = Motion(spec)
        self._follow = FollowTeacher()
        self._memory: Memory = {}
        self._errand: Errand | None = None
        self._look_until_s = 0.0
        self._random = Random(seed)
        self._news: list[dict[str, Any]] = []

    def step(self, percepts: Percepts, cues: Iterable[Cue]) -> tuple[Command, list[dict[str, Any]]]:
        """The command for this tick, and the events to be recorded."""
        self._news = [{"time_s": percepts.time_s, "kind": "heard", "cue": cue.value} for cue in cues]
        for cue in cues:
            self._hear(cue, percepts)
        action = self._act(percepts)
        command, _ = self._motion.command([action], percepts)
        return command, self._news

    def _hear(self, cue: Cue, percepts: Percepts) -> None:
        if cue is Cue.START and self.mode == "idle":
            self.mode = "following"
        elif cue is Cue.DONE:
            self.mode = "done"
        elif self.mode in ("following", "looking") and cue is Cue.TAKE and "PickUp" in self.skills:
            self.mode, self._look_until_s = "looking", percepts.time_s + self.look_s
        elif self.mode in ("following", "looking") and cue is Cue.DROP and "Drop" in self.skills:
            self._begin(self.skills["Drop"], {}, percepts)

    def _begin(self, skill: Skill, given: Mapping[str, object], percepts: Percepts) -> None:
        self.mode = "busy"
        self._errand = Errand(skill, skill.complete(given), percepts.time_s + self.errand_s, {})
        words = skill.abstract.describe(self._errand.parameters)
        self._news.append({"time_s": percepts.time_s, "kind": "errand", "skill": skill.name, "what": words})

    def _act(self, percepts: Percepts) -> Action:
        if self.mode == "looking":
            # The box that is meant is the nearest one that was just shown (A.5: no more than a metre away).
            fresh = percepts.time_s - self.shown_s
            box = next((box for box in percepts.boxes if box.seen_s >= fresh and box.distance_m < 2.0), None)
            if box is not None:
                self._begin(self.skills["PickUp"], {"color": box.color}, percepts)
            elif percepts.time_s > self._look_until_s:
                self._news.append({"time_s": percepts.time_s, "kind": "missed", "what": "no box in view after TAKE"})
                self.mode = "following"
            else:
                return Action(drive=Drive())
        if self.mode == "busy" and self._errand is not None:
            return self._run(self._errand, percepts)
        if self.mode == "following":
            action, self._memory = self._follow.step(percepts, self._memory, self._random)
            return action
        return Action(drive=Drive())

    def _run(self, errand: Errand, percepts: Percepts) -> Action:
        action, errand.memory = errand.skill.primitive.step(percepts, errand.parameters, errand.memory, self._random)
        reached = errand.skill.abstract.goal(percepts, errand.parameters) and not action.keep_on
        if reached or percepts.time_s > errand.until_s:
            kind = "errand-done" if reached else "errand-failed"
            self._news.append({"time_s": percepts.time_s, "kind": kind, "skill": errand.skill.name})
            self.mode, self._errand = "following", None
        return action


def demonstrate(
    robot: Robot,
    skills: Mapping[str, Skill],
    settings: LearningSettings | None = None,
    *,
    name: str = "demonstration",
    limit_s: float = 600.0,
    journal: Journal | None = None,
    watch: Callable[[Percepts, Observer], None] | None = None,
) -> Demonstration:
    """A live demonstration: the robot follows its teacher from START to DONE, and watches.

    Args:
        robot: is stopped at the end, however it comes.
        skills: by name.
        settings: of the learner.
        name: of the demonstration.
        limit_s: after which a demonstration without DONE is ended; it counts up to then.
        journal: is told everything, for a recording.
        watch: is called after every tick, for a display.

    Raises:
        LearningError: START was never said.
        RobotError: the readings cannot be used.
    """
    journal = journal or NoJournal()
    perception, observer = Perception(robot.spec), Observer(settings)
    apprentice = Apprentice(skills, robot.spec)

    def decide(observation: Observation) -> Command | None:
        percepts = perception.update(observation)
        observer.step(observation.time_s, evaluate(percepts, skills), observation.cues)
        command, news = apprentice.step(percepts, observation.cues)
        for event in news:
            journal.event(event)
        if watch is not None:
            watch(percepts, observer)
        over = apprentice.mode == "done" or observation.time_s >= limit_s
        return None if over else command

    control(robot, decide, journal, period_s=CONTROL_PERIOD_S)
    return observer.finish(name=name)
