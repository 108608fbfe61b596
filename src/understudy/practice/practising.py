"""A run under a teacher's eyes: the task is executed, and the teacher's words change it on the way (§6)."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from understudy.behaviors import Skill
from understudy.clock import CONTROL_PERIOD_S
from understudy.errors import LearningError, NetworkError
from understudy.execution import Controller, Event, History, SavedContext, State
from understudy.learning import Apprentice, Instance, LearningSettings, Observer, evaluate, learn
from understudy.network import Component, LinkType, Network
from understudy.perception import Perception, Percepts
from understudy.practice.attribution import Attribution, attributions
from understudy.practice.edits import inserted, without
from understudy.robot import Command, Cue, Journal, NoJournal, Observation, Robot, control

__all__ = ["Correction", "Practice", "PracticeReport"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Correction:
    """What one word of the teacher's, or one COME … GO, made of the task.

    Attributes:
        word: BAD, or COME.
        time_s: when it was said.
        meant: the steps that it may have been about; the first was taken.
        before: the task until then.
        after: the task from then on; the same where nothing came of it.
        piece: of a COME, what was learned until GO; None if nothing was.
        note: why nothing came of it.
    """

    word: Literal[Cue.BAD, Cue.COME]
    time_s: float
    meant: tuple[Attribution, ...]
    before: Network
    after: Network
    piece: Network | None = None
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PracticeReport:
    """How a practice run went.

    Attributes:
        done: what was executed was completed.
        duration_s: on the robot's clock.
        network: the task as the teacher corrected it; for the next run.
        corrections: one for each word, in their order.
        events: the whole trace.
    """

    done: bool
    duration_s: float
    network: Network
    corrections: tuple[Correction, ...]
    events: tuple[Event, ...]


class Practice:
    """One practice run.

    What BAD takes out is not executed any more. What COME … GO puts in is for the next run: the robot has just been led
    through it, and goes on where it left off (§6.2).

    Args:
        robot: that practises.
        network: the task.
        skills: by name.
        seed: of all chance.
        settings: of the learner.
        name: of the pieces that are learned, in their evidence.
    """

    def __init__(
        self,
        robot: Robot,
        network: Network,
        skills: Mapping[str, Skill],
        *,
        seed: int = 0,
        settings: LearningSettings | None = None,
        name: str = "practice",
    ) -> None:
        self.robot, self.skills, self.seed, self.name = robot, skills, seed, name
        self.settings = replace(settings or LearningSettings(), begin=Cue.COME, end=Cue.GO)
        self.network = network
        self.controller = Controller(network, skills, robot.spec, seed=seed)
        self.perception = Perception(robot.spec, attention=self.controller.program.attention)
        self.history = History(network)
        self.corrections: list[Correction] = []
        self._lesson: tuple[Correction, Apprentice, Observer] | None = None
        self._journal: Journal = NoJournal()

    def run(
        self,
        *,
        limit_s: float = 600.0,
        journal: Journal | None = None,
        watch: Callable[[Percepts], None] | None = None,
    ) -> PracticeReport:
        """Executes the task until it is complete, and listens.

        Args:
            limit_s: the time allowed, lessons included.
            journal: is told everything, for a recording.
            watch: is called after every tick.

        Raises:
            RobotError: the robot's readings could not be used.
        """
        self._journal = journal or self._journal
        begun_s: float | None = None
        now_s = 0.0
        done = False

        def decide(observation: Observation) -> Command | None:
            nonlocal begun_s, now_s, done
            now_s = observation.time_s
            begun_s = now_s if begun_s is None else begun_s
            percepts = self.perception.update(observation)
            command, done = self._step(percepts, observation.cues)
            if watch is not None:
                watch(percepts)
            if now_s - begun_s >= limit_s and not done:
                self._tell(Event(time_s=now_s, kind="stopped", detail={"reason": f"the time limit of {limit_s:g} s"}))
                return None
            return None if done else command

        control(self.robot, decide, self._journal, period_s=CONTROL_PERIOD_S)
        return PracticeReport(
            done=done,
            duration_s=now_s - (begun_s or 0.0),
            network=self.network,
            corrections=tuple(self.corrections),
            events=tuple(self.history.events),
        )

    def _step(self, percepts: Percepts, cues: Sequence[Cue]) -> tuple[Command, bool]:
        """One tick: hear, then act; and whether the task is complete."""
        for cue in cues:
            self._tell(Event(time_s=percepts.time_s, kind="heard", detail={"cue": cue.value}))
            if self._lesson is None and cue is Cue.BAD:
                self._take_out(percepts.time_s)
            elif self._lesson is None and cue is Cue.COME:
                self._begin_lesson(percepts.time_s)
        if self._lesson is not None:
            return self._learn(percepts, cues), False
        decision = self.controller.tick(percepts)
        for event in decision.events:
            self._tell(event)
        return decision.command, decision.complete

    def _take_out(self, time_s: float) -> None:
        """BAD: the step that is meant is removed, from the task and from what is being executed."""
        meant = attributions(self.history, self.controller.program.network, time_s)
        before, note = self.network, ""
        if not meant:
            note = "no step was under way, and none had just been finished"
        else:
            path = meant[0].component
            try:
                self.network = without(self.network, path)
                running = without(self.controller.program.network, path)
            except NetworkError as error:
                self.network, note = before, str(error)
            else:
                context = self.controller.context
                saved = SavedContext.of(context, self.controller.program, self.name)
                self.controller = Controller(running, self.skills, self.robot.spec, seed=self.seed)
                self.controller.resume(saved.carried_over(self.controller.program))
                self._tell(Event(time_s=time_s, kind="state", component=path, detail={"state": State.UNUSED.value}))
        correction = Correction(word=Cue.BAD, time_s=time_s, meant=meant, before=before, after=self.network, note=note)
        self._correct(correction, time_s)

    def _begin_lesson(self, time_s: float) -> None:
        """COME: the run is suspended, and the teacher followed."""
        meant = attributions(self.history, self.controller.program.network, time_s)
        asked = Correction(word=Cue.COME, time_s=time_s, meant=meant, before=self.network, after=self.network)
        apprentice = Apprentice(self.skills, self.robot.spec, seed=self.seed)
        self._lesson = asked, apprentice, Observer(self.settings)
        self._tell(Event(time_s=time_s, kind="suspended"))

    def _learn(self, percepts: Percepts, cues: Sequence[Cue]) -> Command:
        """Following the teacher from COME to GO."""
        assert self._lesson is not None
        asked, apprentice, observer = self._lesson
        observer.step(percepts.time_s, evaluate(percepts, self.skills), cues)
        # To the apprentice it is a demonstration like any other.
        words = {Cue.COME: Cue.START, Cue.GO: Cue.DONE}
        command, news = apprentice.step(percepts, [words.get(cue, cue) for cue in cues if cue is not Cue.BAD])
        for record in news:
            self._journal.event(record)
        if Cue.GO in cues:
            self._end_lesson(asked, observer, percepts.time_s)
        return command

    def _end_lesson(self, asked: Correction, observer: Observer, time_s: float) -> None:
        """GO: what was shown goes before the step that COME was about, and the run goes on."""
        self._lesson = None
        number = sum(one.word is Cue.COME for one in self.corrections) + 1
        try:
            if not asked.meant:
                raise LearningError("no step was under way when COME was said, so nobody knows where this belongs")
            before = asked.meant[0].component
            demonstration = observer.finish(name=f"{self.name} {number}")
            held = self._maintained(before)
            seen = tuple(
                one
                for one in demonstration.observations
                if one.instance not in held or one.interval.start > demonstration.span.start
            )
            piece = learn(replace(demonstration, observations=seen), self.settings).network
            self.network = inserted(self.network, before, piece)
            correction = replace(asked, before=asked.before, after=self.network, piece=piece)
        except (LearningError, NetworkError) as error:
            correction = replace(asked, after=self.network, note=str(error))
        self._correct(correction, time_s)
        # The lesson does not count as time in which a step was tried.
        if self.controller.context.time_s is not None:
            self.controller.context.time_s = time_s
        self._tell(Event(time_s=time_s, kind="resumed"))

    def _maintained(self, before: str) -> set[Instance]:
        """What has to hold all the while the step is executed: no part of the lesson, but its condition."""
        inside, home = self.network.home_of(before)
        links = home.incoming[before[len(inside) :]]
        sources = [home.by_id[link.source] for link in links if link.type is LinkType.PERMANENT]
        return {self._instance(part) for part in sources if isinstance(part, Component)}

    def _instance(self, step: Component) -> Instance:
        """A step as the observer calls what it sees of it: the behavior, and the parameters that tell uses apart."""
        parameters = self.skills[step.behavior].abstract.parameters
        named = [one.name for one in parameters if one.kind != "number" and one.name in step.parameters]
        return Instance(step.behavior, tuple((name, str(step.parameters[name])) for name in named))

    def _correct(self, correction: Correction, now_s: float) -> None:
        self.corrections.append(correction)
        detail: dict[str, object] = {"word": correction.word.value, "said_s": correction.time_s}
        if correction.meant:
            first = correction.meant[0]
            detail |= {
                "how": first.how,
                "since_s": first.since_s,
                "others": [o.component for o in correction.meant[1:]],
            }
        if correction.note:
            detail["note"] = correction.note
        path = correction.meant[0].component if correction.meant else ""
        self._tell(Event(time_s=now_s, kind="corrected", component=path, detail=detail))

    def _tell(self, event: Event) -> None:
        self.history.add(event)
        self._journal.event(event.as_record())
