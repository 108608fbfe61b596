"""A sitting with a robot of another process, or a real one: taught, run, practised, recorded; nobody else judges it."""

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from understudy.behaviors import Skill
from understudy.execution import Controller, Decision, RunReport, compile_network, go_on
from understudy.learning import Demonstration, LearningSettings, Observer, demonstrate
from understudy.network import Network, Task, task_text
from understudy.perception import Perception, Percepts
from understudy.practice import Practice, PracticeReport
from understudy.recording import Recorder, RecordingKind
from understudy.robot import STOP, Cue, Journal, Robot
from understudy.ros2 import RobotDocument
from understudy.sessions.capability import check_capable

__all__ = ["await_start", "perform_with", "practise_with", "teach_with"]


def await_start(robot: Robot, started: Callable[[], bool]) -> None:
    """Nothing moves before somebody says START, or ``started`` tells so.

    Raises:
        RobotError: the robot's readings stop coming meanwhile.
    """
    while not started():
        if Cue.START in robot.sense().cues:
            return
        robot.act(STOP)
        robot.wait()


def teach_with(
    robot: Robot,
    document: RobotDocument,
    skills: Mapping[str, Skill],
    *,
    name: str,
    settings: LearningSettings | None = None,
    recording: Path | None = None,
    limit_s: float = 600.0,
    watch: Callable[[Percepts, Observer], None] | None = None,
) -> Demonstration:
    """A person leads the robot through a task; it begins with START.

    Args:
        robot: is connected.
        document: what it is.
        skills: by name.
        name: of the demonstration.
        settings: of the learner.
        recording: the file to be written, which must not exist; None records nothing.
        limit_s: after which the demonstration is ended.
        watch: is called after every tick.

    Raises:
        RobotError: the robot's readings cannot be used, or stop coming.
        LearningError: START was never said.
        RecordingError: the file exists or cannot be written.
    """
    with _journal(recording, "demonstration", name, document) as journal:
        return demonstrate(robot, skills, settings, name=name, limit_s=limit_s, journal=journal, watch=watch)


def perform_with(
    robot: Robot,
    document: RobotDocument,
    name: str,
    network: Network,
    skills: Mapping[str, Skill],
    *,
    seed: int = 0,
    limit_s: float = 300.0,
    recording: Path | None = None,
    watch: Callable[[Percepts, Decision], None] | None = None,
) -> RunReport:
    """The robot executes a task.

    Args:
        robot: is connected, and somebody said that it may start.
        document: what it is.
        name: of the task.
        network: the task.
        skills: by name.
        seed: of the search.
        limit_s: the time allowed.
        recording: the file to be written, which must not exist; None records nothing.
        watch: is called after every tick.

    Raises:
        NetworkError: the network does not fit the skills.
        SkillError: a skill does not bind on this robot.
        RobotError: the robot's readings cannot be used, or stop coming.
        RecordingError: the file exists or cannot be written.
    """
    compile_network(network, skills)  # a task that does not fit is refused before anything is written
    check_capable(network, skills, robot.spec)
    controller = Controller(network, skills, robot.spec, seed=seed)
    perception = Perception(robot.spec, attention=controller.program.attention)
    with _journal(recording, "run", name, document, network, seed, limit_s) as journal:
        return go_on(robot, controller, perception, limit_s=limit_s, journal=journal, watch=watch)


def practise_with(
    robot: Robot,
    document: RobotDocument,
    name: str,
    network: Network,
    skills: Mapping[str, Skill],
    *,
    seed: int = 0,
    settings: LearningSettings | None = None,
    limit_s: float = 600.0,
    recording: Path | None = None,
    watch: Callable[[Percepts, Practice], None] | None = None,
) -> PracticeReport:
    """The robot practises a task while a person says BAD, or COME and GO.

    Args:
        robot: is connected, and somebody said that it may start.
        document: what it is.
        name: of the task.
        network: the task.
        skills: by name.
        seed: of the search.
        settings: of the learner.
        limit_s: the time allowed.
        recording: the file to be written, which must not exist; None records nothing.
        watch: is called after every tick.

    Raises:
        NetworkError: the network does not fit the skills.
        SkillError: a skill does not bind on this robot.
        RobotError: the robot's readings cannot be used, or stop coming.
        RecordingError: the file exists or cannot be written.
    """
    compile_network(network, skills)
    check_capable(network, skills, robot.spec)
    practice = Practice(robot, network, skills, seed=seed, settings=settings, name=f"practice of {name}")
    with _journal(recording, "run", name, document, network, seed, limit_s, practice="yes") as journal:
        look = None if watch is None else lambda percepts: watch(percepts, practice)
        return practice.run(limit_s=limit_s, journal=journal, watch=look)


def _journal(
    path: Path | None,
    kind: RecordingKind,
    name: str,
    document: RobotDocument,
    network: Network | None = None,
    seed: int = 0,
    limit_s: float = 0.0,
    **more: str,
) -> AbstractContextManager[Journal | None]:
    """A recording that says of which robot it is, so that it can be learned from without its document."""
    if path is None:
        return nullcontext()
    attachments = {"robot.yaml": document.to_yaml().encode()}
    if network is not None:
        attachments["task.yaml"] = task_text(Task.of(name, network)).encode()
        more = {"seed": str(seed), "limit_s": f"{limit_s:g}", **more}
    return Recorder(path, kind=kind, name=name, spec=document.spec, metadata=more, attachments=attachments)
