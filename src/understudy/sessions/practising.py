"""One practice run in a simulated room, under the feedback of the teacher in its document."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from understudy.behaviors import Skill
from understudy.errors import WorldError
from understudy.execution import compile_network
from understudy.learning import LearningSettings
from understudy.network import Network
from understudy.perception import Percepts
from understudy.practice import Practice, PracticeReport, minutes_of
from understudy.robot import Journal
from understudy.sessions.capability import check_capable
from understudy.sessions.running import run_recorder
from understudy.sessions.stage import Stage, Verdict
from understudy.sim import World

__all__ = ["Practised", "practise"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Practised:
    """A practice run that was made.

    Attributes:
        task: its name.
        network: the task as it was practised.
        report: the robot's own, with the corrected task.
        recording: the file, if it was recorded.
        stage: the room as it is now, with everybody's paths.
        verdict: the referee's.
        complaints: what the scripted teacher waited for in vain.
    """

    task: str
    network: Network
    report: PracticeReport
    recording: Path | None
    stage: Stage
    verdict: Verdict
    complaints: tuple[str, ...]

    def as_record(self) -> dict[str, Any]:
        """The run in plain data, for a report or another program."""
        report = self.report
        return {
            "task": self.task,
            "world": self.stage.world.name,
            "seed": self.stage.simulation.seed,
            "done": report.done,
            "ending": report.ending,
            "duration_s": round(report.duration_s, 1),
            **minutes_of(self.task, self.network, report.corrections),
            "collisions": dict(self.verdict.collisions),
            "complaints": list(self.complaints),
            "recording": str(self.recording) if self.recording else None,
        }


def practise(
    name: str,
    network: Network,
    world: World,
    skills: Mapping[str, Skill],
    *,
    seed: int | None = None,
    settings: LearningSettings | None = None,
    limit_s: float = 600.0,
    recording: Path | None = None,
    watch: Callable[[Percepts, Practice], None] | None = None,
) -> Practised:
    """Lets the robot practise a task while the teacher of the room's document watches.

    Args:
        name: of the task.
        network: the task.
        world: the room, with a teacher whose script says BAD, or COME and GO.
        skills: by name.
        seed: of all chance; the world's own if None.
        settings: of the learner.
        limit_s: the time allowed.
        recording: the file to be written, which must not exist; None records nothing.
        watch: is called after every tick.

    Raises:
        WorldError: the world has no teacher.
        NetworkError: the network does not fit the skills.
        SkillError: a skill does not bind on the robot.
        RecordingError: the file exists or cannot be written.
    """
    if world.teacher is None or not world.teacher.script:
        raise WorldError(
            "this world has no teacher with a script, so nobody watches the practice; add `teacher:` with a `script:`"
            " that says BAD, or COME and GO",
            source=world.name,
        )
    compile_network(network, skills)  # a task that does not fit is refused before anything is written
    check_capable(network, skills, world.robots[0].spec)
    stage = Stage(world, seed)
    practice = Practice(
        stage.robot, network, skills, seed=stage.simulation.seed, settings=settings, name=f"practice of {name}"
    )
    with ExitStack() as stack:
        journal: Journal | None = None
        if recording is not None:
            recorder = run_recorder(recording, stage, name, network, limit_s=limit_s, practice="yes")
            journal = stack.enter_context(recorder)

        def look(percepts: Percepts) -> None:
            stage.look()
            if watch is not None:
                watch(percepts, practice)

        report = practice.run(limit_s=limit_s, journal=journal, watch=look)
    return Practised(
        task=name,
        network=network,
        report=report,
        recording=recording,
        stage=stage,
        verdict=stage.verdict(),
        complaints=tuple(f"{text} (at {time_s:.0f} s)" for time_s, text in stage.simulation.teacher_complaints),
    )
