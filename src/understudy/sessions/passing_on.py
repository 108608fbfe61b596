"""One transmission of a task: a robot that knows it teaches another, in a simulated room (§4.5.5.2)."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from understudy.behaviors import FollowTeacher, FollowTrail, Skill
from understudy.errors import WorldError
from understudy.execution import Tally, compile_network
from understudy.learning import Demonstration, LearningSettings, Observer, demonstrate
from understudy.network import Network
from understudy.perception import Percepts
from understudy.recording import Recorder
from understudy.robot import TEACHER_COLOR
from understudy.sessions.aloud import Aloud
from understudy.sessions.stage import Path as Way
from understudy.sessions.stage import Stage, Verdict
from understudy.sessions.teaching import demonstration_recorder
from understudy.sim import World
from understudy.sim.world import RobotStart
from understudy.teaching import CAREFUL, Manner, RobotTeacher, with_teacher

__all__ = ["PassedOn", "pass_on", "with_robot_teacher"]

_NAME = "teacher"


@dataclass(frozen=True, slots=True, kw_only=True)
class PassedOn:
    """A demonstration that a robot gave.

    Attributes:
        demonstration: what the learner observed.
        teacher: the robot that taught.
        teacher_path: where it truly was.
        recording: of the learner, if it was recorded.
        stage: the room as it is now; its robot is the learner.
        verdict: the referee's, of both robots.
        complaints: what the teacher did not do.
        remarks: when, and what the learner said aloud; its teacher does not listen.
    """

    demonstration: Demonstration
    teacher: RobotTeacher
    teacher_path: Way
    recording: Path | None
    stage: Stage
    verdict: Verdict
    complaints: tuple[str, ...]
    remarks: tuple[tuple[float, str], ...]

    @property
    def finished(self) -> bool:
        """DONE was said, and all of the task had been shown."""
        return self.demonstration.done and self.teacher.complete


def with_robot_teacher(world: World) -> World:
    """The room with a second robot, in the teacher's color, where its teacher stands; as it is if it has such a robot.

    Raises:
        WorldError: it has neither.
    """
    bare = world.model_copy(update={"teacher": None})
    if any(robot.marker is TEACHER_COLOR for robot in world.robots[1:]):
        return bare
    if world.teacher is None:
        raise WorldError(
            f"no robot can teach in this world: it has no teacher in whose place one could start; add `teacher:` with"
            f" `at:`, or a second robot with `marker: {TEACHER_COLOR}`",
            source=world.name,
        )
    taken = {robot.name for robot in world.robots}
    name = next(name for name in (_NAME, *(f"{_NAME} {n}" for n in range(2, len(taken) + 3))) if name not in taken)
    person = world.teacher
    start = RobotStart(name=name, at=person.at, heading_deg=person.heading_deg, marker=TEACHER_COLOR)
    data = bare.model_dump(mode="json", by_alias=True)
    data["robots"].append(start.model_dump(mode="json"))
    return World.from_data(data, source=world.name)


def pass_on(
    name: str,
    network: Network,
    world: World,
    skills: Mapping[str, Skill],
    *,
    manner: Manner = CAREFUL,
    seed: int | None = None,
    settings: LearningSettings | None = None,
    recording: Path | None = None,
    limit_s: float = 600.0,
    watch: Callable[[Percepts, Observer], None] | None = None,
) -> PassedOn:
    """A robot that knows a task leads the world's first robot through it.

    Each robot decides by its own senses. The teacher says one word for each step that it achieves, and hears one bit:
    that its follower has it near, in view.

    Args:
        name: of the demonstration.
        network: the task that the teacher knows.
        world: the room, see :func:`with_robot_teacher`.
        skills: by name, of both robots.
        manner: how the teacher teaches.
        seed: of all chance; the world's own if None.
        settings: of the learner.
        recording: the file to be written, which must not exist; None records nothing.
        limit_s: after which the demonstration is ended.
        watch: is called after every tick of the learner.

    Raises:
        WorldError: no robot can teach in this world.
        NetworkError: the network does not fit the skills.
        LearningError: START was never said.
        RecordingError: the file exists or cannot be written.
    """
    compile_network(network, skills)
    world = with_robot_teacher(world)
    stage = Stage(world, seed)
    body = stage.simulation.robot(next(robot.name for robot in world.robots[1:] if robot.marker is TEACHER_COLOR))
    teacher = RobotTeacher(network, skills, body.spec, manner=manner, seed=stage.simulation.seed)

    def look(percepts: Percepts, observer: Observer) -> None:
        """The learner has decided; it is the teacher's turn."""
        stage.look()
        command, words = teacher.step(body.sense(), with_teacher(percepts))
        for word in words:
            stage.robot.hear(word)
        body.act(command)
        if watch is not None:
            watch(percepts, observer)

    with ExitStack() as stack:
        stack.callback(body.stop)
        recorder: Recorder | None = None
        if recording is not None:
            recorder = stack.enter_context(demonstration_recorder(recording, stage, name, teacher="robot"))
        aloud = Aloud(stage.simulation, recorder)
        demonstration = demonstrate(
            stage.robot,
            skills,
            settings,
            name=name,
            limit_s=limit_s,
            following=FollowTrail() if manner.trail else FollowTeacher(),
            journal=aloud,
            watch=look,
        )
    return PassedOn(
        demonstration=demonstration,
        teacher=teacher,
        teacher_path=stage.path_of(body.name),
        recording=recording,
        stage=stage,
        verdict=stage.verdict(),
        complaints=_complaints(teacher, demonstration),
        remarks=tuple(aloud.remarks),
    )


def _complaints(teacher: RobotTeacher, demonstration: Demonstration) -> tuple[str, ...]:
    told: list[str] = []
    if not teacher.complete:
        tally = Tally(teacher.controller.program.network, teacher.events)
        told.append(f"the teacher did not come to the end of its task; missing: {', '.join(tally.missing)}")
    if not demonstration.done:
        told.append("DONE was never said")
    return tuple(told)
