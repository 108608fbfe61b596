"""The pictures of a demonstration, of a task, and of a run; and of what a recording shows."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from understudy.behaviors import Skill
from understudy.execution import Event
from understudy.figures import (
    Trajectory,
    draw_arena,
    draw_network,
    draw_observations,
    draw_progress,
    marks_of_cues,
    marks_of_run,
    save,
)
from understudy.geometry import Pose
from understudy.learning import Lesson
from understudy.network import Network
from understudy.recording import Recording, outcome_of
from understudy.robot import TEACHER_COLOR
from understudy.sessions.passing_on import PassedOn
from understudy.sessions.running import Performed
from understudy.sessions.stage import Stage
from understudy.sessions.teaching import Taught
from understudy.sim import World

__all__ = ["picture_demonstration", "picture_recording", "picture_run", "picture_task"]

_MOVED_M = 0.05


def picture_demonstration(taught: Taught | PassedOn, lesson: Lesson, stem: Path) -> list[Path]:
    """The room with everybody's paths, and the observations (Figures 4.6 and 4.8), whoever was the teacher."""
    stage = taught.stage
    by_robot = isinstance(taught, PassedOn)
    teacher = taught.teacher_path if isinstance(taught, PassedOn) else stage.teacher_path
    paths = [Trajectory(name="learner" if by_robot else "robot", points=stage.robot_path)]
    if teacher is not None:
        body: Literal["robot", "person"] = "robot" if by_robot else "person"
        paths.append(Trajectory(name="teacher", points=teacher, color=str(TEACHER_COLOR), dashed=True, body=body))
    paths += _box_paths(stage)
    numbers = " Numbers: where the robot was when the teacher spoke." if taught.demonstration.cues else ""
    arena = draw_arena(
        stage.world,
        paths,
        marks_of_cues(taught.demonstration.cues),
        title=f"{taught.demonstration.name}: the demonstration",
        subtitle=f"The robot follows its teacher{', a robot, too' if by_robot else ''}.{numbers}",
    )
    return [
        *save(arena, stem.with_name(f"{stem.name}-room")),
        *save(
            draw_observations(
                lesson, cues=taught.demonstration.cues, title=f"{lesson.demonstration}: what the robot observed"
            ),
            stem.with_name(f"{stem.name}-observations"),
        ),
    ]


def picture_task(
    name: str, network: Network, skills: Mapping[str, Skill], stem: Path, *, depth: int | None = None
) -> list[Path]:
    """The behavior network (Figure 4.13); down to which depth networks are shown from inside, or all of them."""
    return save(draw_network(network, skills=skills, title=name, depth=depth), stem)


def picture_run(
    performed: Performed, network: Network, stem: Path, *, others: Sequence[NDArray[np.float64]] = ()
) -> list[Path]:
    """The room with the robot's path, and its progress (Figures 4.12 and 4.14).

    Args:
        performed: the run.
        network: its task.
        stem: of the files.
        others: paths of other runs in the same room, for comparison.
    """
    stage, report = performed.stage, performed.report
    paths = [Trajectory(name="robot", points=stage.robot_path), *_box_paths(stage)]
    outcome = "Done" if report.done else "Not done"
    compared = f" Thin lines: {len(others)} other runs." if others else ""
    arena = draw_arena(
        stage.world,
        paths,
        marks_of_run(report.events, network),
        title=f"{performed.task}: the robot on its own",
        subtitle=f"{outcome} after {report.duration_s:.0f} s. Numbers: where each step was achieved.{compared}",
        doors=stage.referee.doors(),
        others=others,
    )
    progress = draw_progress(network, report.events, report.duration_s, title=f"{performed.task}: the robot's progress")
    return [
        *save(arena, stem.with_name(f"{stem.name}-room")),
        *save(progress, stem.with_name(f"{stem.name}-progress")),
    ]


def picture_recording(recording: Recording, world: World | None, network: Network | None, stem: Path) -> list[Path]:
    """What a recording shows: the way as the wheels counted it, and for a run its progress.

    Args:
        recording: of a demonstration or a run.
        world: the room, if the recording has it attached.
        network: the task, if it has that attached.
        stem: of the files.
    """
    start = Pose()
    if world is not None:
        first = world.robots[0]
        start = Pose(*first.at, math.radians(first.heading_deg))
    poses = [(o.time_s, o.odometry.pose) for o in recording.observations(images=False)]
    origin = poses[0][1]
    way = []
    for time_s, pose in poses:
        place = start.to_parent(origin.to_local(pose.position))
        way.append((time_s, place.x, place.y, start.heading + pose.heading - origin.heading))
    written: list[Path] = []
    events = [Event.from_record(record) for record in recording.events()]
    ending = _ending(recording)
    if world is not None:
        marks = marks_of_run(events, network) if network else marks_of_cues(recording.cues())
        arena = draw_arena(
            world,
            [Trajectory(name="robot", points=np.array(way))],
            marks,
            title=recording.info.name,
            subtitle=f"{ending}The robot's way as its wheels counted it.",
            note="at the start",
        )
        written += save(arena, stem.with_name(f"{stem.name}-room"))
    if network is not None:
        progress = draw_progress(
            network,
            events,
            way[-1][0] - way[0][0],
            begin=way[0][0],
            title=recording.info.name,
            subtitle=ending.rstrip(),
        )
        written += save(progress, stem.with_name(f"{stem.name}-progress"))
    return written


def _box_paths(stage: Stage) -> list[Trajectory]:
    """Where the boxes were taken; those that stayed where they stood have no path."""
    return [
        Trajectory(name=f"{box.color} box", points=points, color=str(box.color), body="box")
        for box, points in zip(stage.world.boxes, stage.box_paths, strict=True)
        if np.ptp(points[:, 1:], axis=0).max() > _MOVED_M
    ]


def _ending(recording: Recording) -> str:
    """How a run ended, and whether anything else is whole, as a sentence before another one."""
    info = recording.info
    if info.kind == "run":
        words = str(outcome_of(recording))
    elif not info.complete:
        words = f"it breaks off at {info.duration_s:.1f} s"
    else:
        return ""
    return f"{words[0].upper()}{words[1:]}. "
