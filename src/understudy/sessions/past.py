"""A recorded run, taken up at one of its moments: the robot's mind as it was then, and the room."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from understudy.behaviors import Skill
from understudy.errors import ContextError, RecordingError
from understudy.execution import Context, Controller, Event, compile_network, load_context
from understudy.network import Network, differences
from understudy.perception import Perception
from understudy.recording import Recording, read_recording
from understudy.robot import Command, Journal, NoJournal, Observation
from understudy.sessions.recorded import seed_of, spec_of, task_of, world_of
from understudy.sessions.stage import Stage
from understudy.sim import World

__all__ = ["Past", "past_at", "take_up"]

_SLACK_S = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class Past:
    """What a run had behind it at one of its moments.

    Attributes:
        recording: of the run.
        context: as it was after the last tick.
        events: what the trace had told.
    """

    recording: Recording
    context: Context
    events: tuple[Event, ...]

    @classmethod
    def of(cls, recording: Recording, context: Context) -> "Past":
        """The past of a context that was saved."""
        last_s = context.time_s if context.time_s is not None else -1.0
        events = map(Event.from_record, recording.events())
        return cls(
            recording=recording,
            context=context,
            events=tuple(event for event in events if event.time_s <= last_s + _SLACK_S and event.kind != "stopped"),
        )

    @property
    def world(self) -> World:
        """The simulated room that the run was in.

        Raises:
            RecordingError: it was in none.
        """
        world = world_of(self.recording)
        if world is None:
            raise RecordingError(f"{self.recording.info.path} holds no simulated room, so the run cannot go on in it")
        return world

    @property
    def seed(self) -> int:
        """Of all chance."""
        return seed_of(self.recording)

    def relive(self, stage: Stage, perception: Perception, journal: Journal | None = None) -> None:
        """Brings a fresh room, and what the robot has in mind of it, to the moment; what was recorded is told again.

        Args:
            stage: of the recorded world and seed, at its beginning.
            perception: fresh.
            journal: is told everything, as it was told then.

        Raises:
            RecordingError: the room does not answer as it did.
        """
        journal = journal or NoJournal()
        by_time: dict[float, list[Event]] = {}
        for event in self.events:
            by_time.setdefault(event.time_s, []).append(event)
        last_s, count = None, 0
        for recorded, command in islice(_steps(self.recording, images=False), self.context.tick):
            last_s, count = recorded.time_s, count + 1
            observation = stage.robot.sense()
            if not _same(observation, recorded):
                raise RecordingError(
                    f"{self.recording.info.path} cannot be gone on with: at {recorded.time_s:.1f} s the simulated room"
                    " does not answer as it did, so another version of the program has made it; start anew"
                )
            journal.observation(observation)
            perception.update(observation)
            for event in by_time.get(observation.time_s, ()):
                journal.event(event.as_record())
            stage.look()
            stage.robot.act(command)
            journal.command(observation.time_s, command)
            stage.robot.wait()
        if (count, last_s) != (self.context.tick, self.context.time_s):
            ended_s, aside_s = last_s or 0.0, self.context.time_s or 0.0
            raise RecordingError(
                f"{self.recording.info.path} is not the recording of this run: it ends at {ended_s:g} s, and the run"
                f" was put aside after {aside_s:g} s; put the right one beside the context document"
            )


def take_up(file: Path, network: Network, skills: Mapping[str, Skill]) -> Past:
    """The past of a run that was put aside, or that broke off.

    Args:
        file: the context document, whose recording lies beside it; or the recording alone.
        network: the task.
        skills: by name.

    Raises:
        ContextError: the document is none, or of another task.
        RecordingError: the recording is missing, or cannot be gone on with.
        NetworkError: the network does not fit the skills.
    """
    if file.suffix.lower() == ".mcap":
        return past_at(read_recording(file), network, skills)
    saved = load_context(file)
    if not saved.recording:
        raise ContextError("the run was not recorded, so nothing is known of its room; start anew", source=str(file))
    context = saved.restored(compile_network(network, skills), source=str(file))
    past = Past.of(read_recording(file.with_name(saved.recording)), context)
    if saved.seed is not None and saved.seed != past.seed:
        raise ContextError(
            f"{saved.recording} is the recording of another run: its seed is {past.seed}, and this one's was"
            f" {saved.seed}; put the right one beside the context document",
            source=str(file),
        )
    return past


def past_at(recording: Recording, network: Network, skills: Mapping[str, Skill], at_s: float | None = None) -> Past:
    """The past of a recorded run at a moment: what was sensed then is thought through again.

    Args:
        recording: of the run.
        network: its task.
        skills: by name.
        at_s: before the tick of this moment; as far as the recording goes if None.

    Raises:
        RecordingError: the recording is of another task; the task was done by then; or what the robot does now is not
            what it did.
        NetworkError: the network does not fit the skills.
    """
    path = recording.info.path
    attached = task_of(recording)
    if attached is None:
        raise RecordingError(f"{path} is the recording of a {recording.info.kind}, and no run can go on from it")
    if "practice" in recording.info.metadata:
        raise RecordingError(
            f"{path} is a practice run, and a teacher's words changed the task on the way; no run can go on from it"
        )
    if told := differences(attached[1], network):
        raise RecordingError(f"{path} is the run of another task: {told[0]}")
    seed = seed_of(recording)
    spec = spec_of(recording)
    controller = Controller(network, skills, spec, seed=seed)
    perception = Perception(spec, attention=controller.program.attention)
    stopped_s = next((float(event["time_s"]) for event in recording.events() if event["kind"] == "stopped"), None)
    events: list[Event] = []
    for observation, command in _steps(recording, images=True):
        time_s = observation.time_s
        if (at_s is not None and time_s >= at_s - _SLACK_S) or time_s == stopped_s:
            break
        decision = controller.tick(perception.update(observation))
        events += decision.events
        if decision.complete:
            raise RecordingError(f"{path}: the task was done at {time_s:.1f} s; there is nothing to go on with")
        if decision.command != command:
            raise RecordingError(
                f"{path} cannot be gone on with: at {time_s:.1f} s the robot would not do what it did, so another"
                " version of the program, or of a skill, has made it; start anew"
            )
    return Past(recording=recording, context=controller.context, events=tuple(events))


def _steps(recording: Recording, *, images: bool) -> Iterator[tuple[Observation, Command]]:
    """What was sensed, with what was done then; a last step that was not completed is left out."""
    for observation, (_, command) in zip(recording.observations(images=images), recording.commands(), strict=False):
        yield observation, command


def _same(one: Observation, other: Observation) -> bool:
    """Whether two observations are of one moment, the image aside."""
    return (
        one.time_s == other.time_s
        and one.odometry == other.odometry
        and one.gripper == other.gripper
        and one.scan.ranges.tobytes() == other.scan.ranges.tobytes()
    )
