"""A run under a teacher's eyes: the task is executed, and the teacher's words change it on the way (§6)."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from understudy.behaviors import Skill
from understudy.clock import CONTROL_PERIOD_S
from understudy.errors import LearningError, NetworkError
from understudy.execution import Controller, Event, History, SavedContext, State
from understudy.generalization import Symbol, symbol_of
from understudy.learning import LearningSettings
from understudy.network import END, Component, LinkType, Network
from understudy.perception import Perception, Percepts
from understudy.practice.attribution import REACTION_S, Attribution, attributions
from understudy.practice.corrections import Correction, Ending, PracticeReport
from understudy.practice.edits import inserted, without
from understudy.practice.lesson import Showing
from understudy.robot import STOP, Command, Cue, Journal, NoJournal, Observation, Robot, control

__all__ = ["LISTEN_S", "Practice"]

LISTEN_S = 2 * REACTION_S
"""For so long the robot listens when its task is done: first a word is about the last step, then about what is missing
after it."""


class Practice:
    """One practice run.

    What BAD takes out is not executed any more. What COME … GO puts in is for the next run: the robot has just been led
    through it, and goes on where it left off (§6.2). When the task is done the robot listens on: for as long as a word
    may be about the last step, and as long again for a COME that shows what is missing at the end.

    Args:
        robot: that practises.
        network: the task.
        skills: by name.
        seed: of all chance.
        settings: of the learner.
        name: of the pieces that are learned, in their evidence.

    Attributes:
        network: the task as it has been corrected until now.
        corrections: until now.
        history: the trace until now.
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
        self.robot, self.skills, self.seed, self.settings, self.name = robot, skills, seed, settings, name
        self.network = network
        self.controller = Controller(network, skills, robot.spec, seed=seed)
        self.perception = Perception(robot.spec, attention=self.controller.program.attention)
        self.history = History(network)
        self.corrections: list[Correction] = []
        self._showing: Showing | None = None
        self._done_s: float | None = None
        self._shown_s = 0.0  # how long lessons have taken since then
        self._nothing_left = False
        self._stopped_by = ""
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

        def decide(observation: Observation) -> Command | None:
            nonlocal begun_s, now_s
            now_s = observation.time_s
            begun_s = now_s if begun_s is None else begun_s
            percepts = self.perception.update(observation)
            command = self._step(percepts, observation.cues)
            if watch is not None:
                watch(percepts)
            if self._is_over(now_s):
                return None
            if now_s - begun_s >= limit_s:
                if self._done_s is None:
                    self._end(now_s, f"the time limit of {limit_s:g} s")
                return None
            return command

        control(self.robot, decide, self._journal, period_s=CONTROL_PERIOD_S)
        if self._showing is not None:
            self._correct(replace(self._showing.asked, note="GO was never said"), now_s)
        ended_s = self._done_s if self._done_s is not None else now_s
        return PracticeReport(
            done=self._done_s is not None,
            ending=self._ending(),
            duration_s=ended_s - (begun_s or 0.0),
            network=self.network,
            corrections=tuple(self.corrections),
            events=tuple(self.history.events),
            stopped_by=self._stopped_by,
        )

    def _ending(self) -> Ending:
        if self._done_s is not None:
            return "complete"
        if self._nothing_left:
            return "nothing left"
        return "timeout" if self._stopped_by else "time limit"

    def _is_over(self, now_s: float) -> bool:
        if self._showing is not None:
            return False
        heard_out = self._done_s is not None and now_s - self._done_s - self._shown_s >= LISTEN_S
        return heard_out or self._nothing_left or bool(self._stopped_by)

    def _step(self, percepts: Percepts, cues: Sequence[Cue]) -> Command:
        """One tick: hear, then act."""
        time_s = percepts.time_s
        words = [cue for cue in cues if self._hear(cue, time_s)]
        if self._showing is not None:
            return self._follow(self._showing, percepts, words)
        if self._done_s is not None or self._nothing_left:
            return STOP
        decision = self.controller.tick(percepts)
        for event in decision.events:
            self._tell(event)
        if decision.complete:
            self._done_s = time_s
        elif decision.stopped:
            self._stopped_by = decision.stopped
            self._end(time_s, f"{decision.stopped} ran out of time")
        return decision.command

    def _hear(self, cue: Cue, time_s: float) -> bool:
        """Obeys a word; and whether it belongs to what is being shown."""
        self._tell(Event(time_s=time_s, kind="heard", detail={"cue": cue.value}))
        showing = self._showing is not None
        match cue:
            case Cue.BAD if not showing:
                self._take_out(time_s)
            case Cue.COME if not showing:
                self._begin_to_show(time_s)
                return True
            case Cue.BAD | Cue.COME:
                self._in_vain(cue, time_s, "it was said while something was being shown; say GO first")
            case Cue.START | Cue.DONE:
                self._in_vain(cue, time_s, "it belongs to a demonstration, and this is practice")
            case _ if not showing:
                self._in_vain(cue, time_s, "nothing is being shown; say COME first")
            case _:
                return True
        return False

    def _take_out(self, time_s: float) -> None:
        """BAD: the step that is meant is removed, from the task and from what is being executed."""
        meant = self._meant(time_s)
        if not meant:
            self._in_vain(Cue.BAD, time_s, "no step was under way, and none had just been finished")
            return
        before, path = self.network, meant[0].component
        try:
            self.network = without(before, path)
        except NetworkError as error:
            self._correct(
                Correction(word=Cue.BAD, time_s=time_s, meant=meant, before=before, after=before, note=str(error)),
                time_s,
            )
            return
        self._correct(Correction(word=Cue.BAD, time_s=time_s, meant=meant, before=before, after=self.network), time_s)
        removed = {"state": State.UNUSED.value, "reason": "removed"}
        self._tell(Event(time_s=time_s, kind="state", component=path, detail=removed))
        try:
            running = without(self.controller.program.network, path)
        except NetworkError:
            # What is left of the task was put in by COME, and is for the next run.
            self._nothing_left = True
            self._end(time_s, "nothing of the task is left to execute")
            return
        # The name is of no account: the document is put together and taken apart again.
        saved = SavedContext.of(self.controller.context, self.controller.program, "practice")
        self.controller = Controller(running, self.skills, self.robot.spec, seed=self.seed)
        self.controller.resume(saved.carried_over(self.controller.program))

    def _begin_to_show(self, time_s: float) -> None:
        """COME: the run is suspended, and the teacher followed."""
        # Nothing can wait for a duty, and so nothing can come before it.
        meant = tuple(one for one in self._meant(time_s) if not self._on_duty(one.component))
        if self._done_s is not None:
            meant = (*meant, Attribution(component=END, how="finished", since_s=self._done_s))
        asked = Correction(word=Cue.COME, time_s=time_s, meant=meant, before=self.network, after=self.network)
        self._showing = Showing(asked, self.skills, self.robot.spec, self.settings, seed=self.seed)
        self._tell(Event(time_s=time_s, kind="suspended"))

    def _follow(self, showing: Showing, percepts: Percepts, words: Sequence[Cue]) -> Command:
        """Following the teacher from COME to GO."""
        command, news = showing.step(percepts, words)
        for record in news:
            self._tell(Event.from_record(record))
        if Cue.GO in words:
            self._take_in(showing, percepts.time_s)
        return command

    def _take_in(self, showing: Showing, time_s: float) -> None:
        """GO: what was shown goes before the step that COME was about, and the run goes on."""
        self._showing = None
        asked, piece, note = showing.asked, None, ""
        number = sum(one.word is Cue.COME for one in self.corrections) + 1
        try:
            before = asked.meant[0].component if asked.meant else ""
            piece = showing.piece(f"{self.name} {number}", self._maintained(before) if before else ())
            if not before:
                raise LearningError("no step was under way when COME was said, so nobody knows where this belongs")
            self.network = inserted(self.network, before, piece)
        except (LearningError, NetworkError) as error:
            note = str(error)
        self._correct(replace(asked, after=self.network, piece=piece, note=note), time_s)
        context = self.controller.context
        if context.time_s is not None:
            context.pass_over(time_s - context.time_s)
        if self._done_s is not None:
            self._shown_s += time_s - asked.time_s
        self._tell(Event(time_s=time_s, kind="resumed"))

    def _meant(self, time_s: float) -> tuple[Attribution, ...]:
        return attributions(self.history, self.controller.program.network, time_s)

    def _on_duty(self, path: str) -> bool:
        around = [path[:end] for end in range(len(path) + 1) if path[end : end + 1] in ("/", "")]
        parts = (self.network.by_path.get(prefix) for prefix in around)
        return any(part is not None and part.trigger is not None for part in parts)

    def _maintained(self, before: str) -> set[Symbol]:
        """What has to hold all the while the step is executed: no part of what is shown, but its condition."""
        if before not in self.network.by_path:
            return set()
        inside, home = self.network.home_of(before)
        links = home.incoming[before[len(inside) :]]
        sources = [home.by_id[link.source] for link in links if link.type is LinkType.PERMANENT]
        return {symbol_of(part) for part in sources if isinstance(part, Component)}

    def _in_vain(self, cue: Cue, time_s: float, note: str) -> None:
        """A word of which nothing can be made."""
        self._correct(
            Correction(word=cue, time_s=time_s, meant=(), before=self.network, after=self.network, note=note), time_s
        )

    def _correct(self, correction: Correction, now_s: float) -> None:
        self.corrections.append(correction)
        detail: dict[str, object] = {"word": correction.word.value, "said_s": correction.time_s}
        path = ""
        if correction.meant:
            first, *others = correction.meant
            path = first.component
            detail |= {"how": first.how, "since_s": first.since_s, "others": [one.component for one in others]}
        if correction.note:
            detail["note"] = correction.note
        self._tell(Event(time_s=now_s, kind="corrected", component=path, detail=detail))

    def _end(self, time_s: float, reason: str) -> None:
        self._tell(Event(time_s=time_s, kind="stopped", detail={"reason": reason}))

    def _tell(self, event: Event) -> None:
        self.history.add(event)
        self._journal.event(event.as_record())
