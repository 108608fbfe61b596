"""One demonstration in a simulated room: taught, recorded, learned."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from understudy.behaviors import Skill
from understudy.errors import WorldError
from understudy.learning import Demonstration, LearningSettings, Observer, demonstrate, observe
from understudy.perception import Percepts
from understudy.recording import Recorder, read_recording
from understudy.ros2 import Fitting, RobotDocument
from understudy.sessions.aloud import Aloud
from understudy.sessions.recorded import spec_of
from understudy.sessions.stage import Stage, Verdict
from understudy.sim import Slip, World

__all__ = ["Taught", "demonstration_recorder", "recorded_demonstration", "teach"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Taught:
    """A demonstration that was given.

    Attributes:
        demonstration: what the robot observed.
        recording: the file, if it was recorded.
        stage: the room as it is now, with everybody's paths.
        verdict: the referee's.
        finished: DONE was said; otherwise the time was over.
        complaints: what the teacher waited for in vain, and where a demonstration without DONE got stuck.
        remarks: what the robot said aloud, and when.
        slips: where the teacher departed from the script; the truth, of which the robot knows nothing.
    """

    demonstration: Demonstration
    recording: Path | None
    stage: Stage
    verdict: Verdict
    finished: bool
    complaints: tuple[str, ...]
    remarks: tuple[tuple[float, str], ...]
    slips: tuple[Slip, ...]


def teach(
    world: World,
    skills: Mapping[str, Skill],
    *,
    seed: int | None = None,
    name: str | None = None,
    settings: LearningSettings | None = None,
    recording: Path | None = None,
    limit_s: float = 600.0,
    watch: Callable[[Percepts, Observer], None] | None = None,
) -> Taught:
    """The world's scripted teacher leads its robot through the task.

    Args:
        world: with a teacher.
        skills: by name.
        seed: of all chance; the world's own if None.
        name: of the demonstration; the world's if None.
        settings: of the learner.
        recording: the file to be written, which must not exist; None records nothing.
        limit_s: after which the demonstration is ended.
        watch: is called after every tick.

    Raises:
        WorldError: the world has no teacher.
        LearningError: the teacher never said START.
        RecordingError: the file exists or cannot be written.
    """
    if world.teacher is None or not world.teacher.script:
        raise WorldError(
            "this world has no teacher with a script, so nobody can show a task in it; add `teacher:` with a `script:`",
            source=world.name,
        )
    name = name or world.name
    stage = Stage(world, seed)
    with ExitStack() as stack:
        recorder: Recorder | None = None
        if recording is not None:
            recorder = stack.enter_context(demonstration_recorder(recording, stage, name))
        aloud = Aloud(stage.simulation, recorder)

        def look(percepts: Percepts, observer: Observer) -> None:
            stage.look()
            if watch is not None:
                watch(percepts, observer)

        demonstration = demonstrate(
            stage.robot, skills, settings, name=name, limit_s=limit_s, journal=aloud, watch=look
        )
    complaints = [f"{sentence} (at {time_s:.0f} s)" for time_s, sentence in stage.simulation.teacher_complaints]
    if not demonstration.done:
        where = stage.simulation.teacher_at
        complaints.append("DONE was never said" + (f"; the teacher got stuck at {where}" if where else ""))
    return Taught(
        demonstration=demonstration,
        recording=recording,
        stage=stage,
        verdict=stage.verdict(),
        finished=demonstration.done,
        complaints=tuple(complaints),
        remarks=tuple(aloud.remarks),
        slips=stage.simulation.teacher_slips,
    )


def demonstration_recorder(path: Path, stage: Stage, name: str, **more: str) -> Recorder:
    """A recording of a demonstration, with the room that it was given in.

    Args:
        path: the file, which must not exist.
        stage: where it is given.
        name: of the demonstration.
        more: what else is to be known of it.
    """
    return Recorder(
        path,
        kind="demonstration",
        name=name,
        spec=stage.robot.spec,
        metadata={"seed": str(stage.simulation.seed), "world": stage.world.name, **more},
        attachments={"world.yaml": stage.world.to_yaml().encode()},
    )


def recorded_demonstration(
    path: str | Path,
    skills: Mapping[str, Skill],
    settings: LearningSettings | None = None,
    *,
    robot: RobotDocument | None = None,
) -> Demonstration:
    """What a recording shows: the same that a live learner saw.

    Args:
        path: a recording, or a bag of a ROS 2 robot.
        skills: by name.
        settings: of the learner.
        robot: of a bag, which does not say: its topics, and where its sensors sit.

    Raises:
        RecordingError: the file cannot be read.
        LearningError: START was never said.
        RobotError: the recorded readings cannot be used.
    """
    if robot is None:
        recording = read_recording(path)
        observations, spec = recording.observations(), spec_of(recording)
    else:
        recording = read_recording(path, topics=robot.topics)
        # Understudy's own recordings hold what has been fitted already.
        given = recording.observations()
        observations = given if recording.info.exact else map(Fitting(robot).observation, given)
        spec = robot.spec
    return observe(observations, spec, skills, settings, name=recording.info.name)
