"""The robot in its learning mode: it follows the teacher, obeys TAKE and DROP, and watches its goals (§4.1, §4.2)."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any, Literal

from understudy.behaviors import Action, Drive, Following, FollowTeacher, Instance, Memory, Motion, Parameters, Skill
from understudy.clock import CONTROL_PERIOD_S
from understudy.learning.observations import Demonstration
from understudy.learning.observer import Observer
from understudy.learning.remarks import Remarks
from understudy.learning.settings import LearningSettings
from understudy.perception import Attention, Perception, Percepts
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
    attention: Attention | None = None,
) -> Demonstration:
    """What a demonstration showed, from the observations alone: the way to learn from a recording.

    A live demonstration goes the same way, one observation at a time, so that both learn the same.

    Args:
        observations: in order.
        spec: the robot.
        skills: by name.
        settings: of the learner.
        name: of the demonstration.
        attention: the landmarks to be watched. Where none are, skills that rest on them have nothing to observe.

    Raises:
        LearningError: START was never said.
        RobotError: the readings cannot be used.
    """
    perception, observer = Perception(spec, attention=attention), Observer(settings)
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
        following: how it keeps with its teacher; half a metre behind if left out.
    """

    look_s = 15.0
    """How long after TAKE the robot waits for a box to come into view."""

    shown_s = 5.0
    """A box seen this short a time ago still counts as shown: the robot turns with the teacher."""

    errand_s = 45.0
    """How long it tries to pick up or to drop."""

    def __init__(
        self,
        skills: Mapping[str, Skill],
        spec: RobotSpec,
        *,
        seed: int = 0,
        following: Following | None = None,
    ) -> None:
        self.skills = skills
        self.mode: Literal["idle", "following", "looking", "busy", "done"] = "idle"
        self._motion = Motion(spec)
        self._follow = following or FollowTeacher()
        self._memory: Memory = {}
        self._errand: Errand | None = None
        self._look_until_s = 0.0
        self._random = Random(seed)
        self._news: list[dict[str, Any]] = []

    def step(self, percepts: Percepts, cues: Sequence[Cue]) -> tuple[Command, list[dict[str, Any]]]:
        """The command for this tick, and the events to be recorded."""
        self._news = []
        for cue in cues:
            self._tell(percepts, "heard", cue=cue.value)
            refusal = self._hear(cue, percepts)
            if refusal:
                self._tell(percepts, "ignored", cue=cue.value, what=refusal)
        action = self._act(percepts)
        command, _ = self._motion.command([action], percepts)
        return command, self._news

    def _hear(self, cue: Cue, percepts: Percepts) -> str:
        """Obeys a word, or says why not."""
        match cue, self.mode:
            case Cue.START, "idle":
                self.mode = "following"
            case Cue.DONE, mode if mode != "idle":
                self.mode, self._errand = "done", None
            case Cue.TAKE | Cue.DROP, "idle" | "done":
                return "no demonstration is going on"
            case Cue.TAKE, _:
                return self._take(percepts)
            case Cue.DROP, _:
                return self._drop(percepts)
            case Cue.START | Cue.DONE, _:
                return f"a demonstration {'is going on' if cue is Cue.START else 'has not begun'}"
        return ""

    def _take(self, percepts: Percepts) -> str:
        if "PickUp" not in self.skills or percepts.gripper is None:
            return "this robot cannot pick things up"
        if percepts.gripper.blocked:
            return "there is something in the gripper already"
        if self.mode == "busy":
            return "the robot is busy"
        self.mode, self._look_until_s = "looking", percepts.time_s + self.look_s
        return ""

    def _drop(self, percepts: Percepts) -> str:
        """DROP also ends an attempt to pick something up."""
        if "Drop" not in self.skills or percepts.gripper is None:
            return "this robot has no gripper"
        if percepts.gripper.empty:
            return "there is nothing in the gripper"
        if self._errand is not None and self._errand.skill.name == "Drop":
            return "the robot is dropping it already"
        self._begin(self.skills["Drop"], {}, percepts)
        return ""

    def _tell(self, percepts: Percepts, kind: str, **detail: Any) -> None:
        self._news.append({"time_s": percepts.time_s, "kind": kind, **detail})

    def _begin(self, skill: Skill, given: Mapping[str, object], percepts: Percepts) -> None:
        self.mode = "busy"
        self._errand = Errand(skill, skill.complete(given), percepts.time_s + self.errand_s, {})
        self._tell(percepts, "errand", skill=skill.name, what=skill.abstract.describe(self._errand.parameters))

    def _act(self, percepts: Percepts) -> Action:
        if self.mode == "looking":
            # The box that is meant is the nearest one that was just shown (A.5: no more than a metre away).
            fresh = percepts.time_s - self.shown_s
            box = next((box for box in percepts.boxes if box.seen_s >= fresh and box.distance_m < 2.0), None)
            if box is not None:
                self._begin(self.skills["PickUp"], {"color": box.color}, percepts)
            elif percepts.time_s > self._look_until_s:
                self._tell(percepts, "missed", what="no box in view after TAKE")
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
            self._tell(percepts, kind, skill=errand.skill.name)
            self.mode, self._errand = "following", None
        return action


def demonstrate(
    robot: Robot,
    skills: Mapping[str, Skill],
    settings: LearningSettings | None = None,
    *,
    name: str = "demonstration",
    limit_s: float = 600.0,
    attention: Attention | None = None,
    following: Following | None = None,
    journal: Journal | None = None,
    watch: Callable[[Percepts, Observer], None] | None = None,
) -> Demonstration:
    """A live demonstration: the robot follows its teacher from START to DONE, and watches.

    Args:
        robot: is stopped at the end, however it comes.
        skills: by name.
        settings: of the learner.
        name: of the demonstration.
        limit_s: seconds after which a demonstration without DONE is ended; it counts up to then.
        attention: as for :func:`observe`.
        following: as for :class:`Apprentice`.
        journal: is told everything, for a recording.
        watch: is called after every tick, for a display.

    Raises:
        LearningError: START was never said.
        RobotError: the readings cannot be used.
    """
    journal = journal or NoJournal()
    perception, observer = Perception(robot.spec, attention=attention), Observer(settings)
    apprentice, remarks = Apprentice(skills, robot.spec, following=following), Remarks(settings)

    begun_s: float | None = None

    def decide(observation: Observation) -> Command | None:
        nonlocal begun_s
        begun_s = observation.time_s if begun_s is None else begun_s
        percepts = perception.update(observation)
        evaluated = evaluate(percepts, skills)
        observer.step(observation.time_s, evaluated, observation.cues)
        command, news = apprentice.step(percepts, observation.cues)
        said = remarks.step(
            observation.time_s,
            observer,
            evaluated,
            observation.cues,
            looking=apprentice.mode == "following",
            in_view=percepts.teacher is not None,
            news=news,
        )
        for event in (*news, *said):
            journal.event(event)
        if watch is not None:
            watch(percepts, observer)
        over = apprentice.mode == "done" or observation.time_s - begun_s >= limit_s
        return None if over else command

    control(robot, decide, journal, period_s=CONTROL_PERIOD_S)
    return observer.finish(name=name)
