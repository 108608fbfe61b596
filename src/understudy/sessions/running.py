"""One run of a task in a simulated room: executed, recorded, judged."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from understudy.behaviors import Skill
from understudy.execution import Controller, Decision, RunReport, SavedContext, compile_network, go_on
from understudy.network import Network, Task, task_text
from understudy.perception import Perception, Percepts
from understudy.recording import Recorder
from understudy.robot import Journal
from understudy.sessions.capability import check_capable
from understudy.sessions.past import Past
from understudy.sessions.stage import Stage, Verdict
from understudy.sim import World

__all__ = ["Performed", "perform", "run_recorder"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Performed:
    """A run that was made.

    Attributes:
        task: its name.
        report: the robot's own.
        recording: the file, if it was recorded.
        stage: the room as it is now, with everybody's paths.
        verdict: the referee's.
        paused: what a run that was paused needs to go on; None for every other.
    """

    task: str
    report: RunReport
    recording: Path | None
    stage: Stage
    verdict: Verdict
    paused: SavedContext | None = None

    def as_record(self) -> dict[str, Any]:
        """The run in plain data, for a report or another program."""
        return {
            "task": self.task,
            "world": self.stage.world.name,
            "seed": self.stage.simulation.seed,
            "done": self.report.done,
            "ending": self.report.ending,
            "duration_s": round(self.report.duration_s, 1),
            "achieved": [{"component": id_, "time_s": time_s} for id_, time_s in self.report.achieved],
            "collisions": dict(self.verdict.collisions),
            "grazes": dict(self.verdict.grazes),
            "boxes": [[round(box.x, 3), round(box.y, 3)] for box in self.verdict.boxes],
            "recording": str(self.recording) if self.recording else None,
        }


def perform(
    name: str,
    network: Network,
    world: World,
    skills: Mapping[str, Skill],
    *,
    seed: int | None = None,
    limit_s: float = 300.0,
    recording: Path | None = None,
    pause_at_s: float | None = None,
    past: Past | None = None,
    watch: Callable[[Percepts, Decision], None] | None = None,
    prepare: Callable[[Stage], None] | None = None,
) -> Performed:
    """Lets the robot of a simulated room execute a task.

    Args:
        name: of the task.
        network: the task.
        world: the room; its teacher, if it has one, stays out.
        skills: by name.
        seed: of all chance; the world's own if None.
        limit_s: the time allowed (§4.5.4.1: 5 minutes).
        recording: the file to be written, which must not exist; None records nothing.
        pause_at_s: when the run is put aside, seconds.
        past: goes on from there, in the same world with the same seed.
        watch: is called after every tick.
        prepare: is given the room before the run, for example to move things in mid-run from ``watch``.

    Raises:
        NetworkError: the network does not fit the skills.
        SkillError: a skill does not bind on the robot.
        RecordingError: the file exists or cannot be written, or the past cannot be gone on with.
    """
    compile_network(network, skills)  # a task that does not fit is refused before anything is written
    check_capable(network, skills, world.robots[0].spec)
    stage = Stage(world.model_copy(update={"teacher": None}), seed)
    if prepare is not None:
        prepare(stage)
    controller = Controller(network, skills, stage.robot.spec, seed=stage.simulation.seed)
    perception = Perception(stage.robot.spec, attention=controller.program.attention)
    with ExitStack() as stack:
        journal: Journal | None = None
        if recording is not None:
            journal = stack.enter_context(run_recorder(recording, stage, name, network, limit_s=limit_s))
        if past is not None:
            try:
                past.relive(stage, perception, journal)
            except BaseException:
                # Nothing was begun: what was recorded so far is in the past's own recording.
                stack.close()
                if recording is not None:
                    recording.unlink(missing_ok=True)
                raise
            controller.resume(past.context)

        def look(percepts: Percepts, decision: Decision) -> None:
            stage.look()
            if watch is not None:
                watch(percepts, decision)

        report = go_on(
            stage.robot,
            controller,
            perception,
            limit_s=limit_s,
            pause_at_s=pause_at_s,
            past=past.events if past is not None else (),
            journal=journal,
            watch=look,
        )
    paused = None
    if report.ending == "paused":
        file = recording.name if recording is not None else ""
        seed = stage.simulation.seed
        paused = SavedContext.of(controller.context, controller.program, name, recording=file, seed=seed)
    return Performed(task=name, report=report, recording=recording, stage=stage, verdict=stage.verdict(), paused=paused)


def run_recorder(path: Path, stage: Stage, name: str, network: Network, *, limit_s: float, **more: str) -> Recorder:
    """A recording of a run, with all that is needed to repeat it.

    Args:
        path: the file, which must not exist.
        stage: where the run takes place.
        name: of the task.
        network: the task.
        limit_s: the time allowed.
        more: what else is to be known of it.
    """
    return Recorder(
        path,
        kind="run",
        name=name,
        spec=stage.robot.spec,
        metadata={"seed": str(stage.simulation.seed), "world": stage.world.name, "limit_s": f"{limit_s:g}", **more},
        attachments={
            "world.yaml": stage.world.to_yaml().encode(),
            "task.yaml": task_text(Task.of(name, network)).encode(),
        },
    )
