"""``--robot``: what the commands have in common when the robot is a real one."""

import json
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from understudy.cli.progress import progress

if TYPE_CHECKING:
    from understudy.network import Network, Task
    from understudy.practice import Practice
    from understudy.robot import Cue
    from understudy.ros2 import RobotDocument, Ros2Robot

__all__ = ["AtOnce", "Robot", "perform", "practise", "stopped_by_signals", "teach"]

Robot = Annotated[
    str | None,
    typer.Option("--robot", help="Instead of a world: the document of a ROS 2 robot, or a bundled one: pioneer."),
]

AtOnce = Annotated[
    bool, typer.Option("--at-once", help="With --robot: begin without waiting for START; nobody may be in the way.")
]

_ENDING_SIGNALS = ("SIGTERM", "SIGHUP")
"""Somebody ends the program, or the connection to its terminal is lost."""


@contextmanager
def stopped_by_signals() -> Iterator[None]:
    """Signals that would end the program at once become an exit that stops the robot first."""

    def leave(number: int, frame: FrameType | None) -> None:
        raise SystemExit(128 + number)

    numbers = [getattr(signal, name) for name in _ENDING_SIGNALS if hasattr(signal, name)]
    before = {number: signal.signal(number, leave) for number in numbers}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextmanager
def _connected(name: str) -> "Iterator[tuple[RobotDocument, Ros2Robot, list[Cue]]]":
    """The robot, connected and standing; and the words that came from the keyboard."""
    from understudy.cli.keyboard import Keyboard  # noqa: PLC0415 - help must come at once
    from understudy.ros2 import Ros2Robot, find_robot  # noqa: PLC0415

    document = find_robot(name)
    words: list[Cue] = []

    def say(word: "Cue") -> None:
        words.append(word)
        robot.hear(word)

    with (
        stopped_by_signals(),
        Ros2Robot(document) as robot,
        Keyboard(say, lambda: robot.emergency_stop("a key was pressed")),
    ):
        print(f"Connecting to {document.name} …", file=sys.stderr)
        robot.connect()
        yield document, robot, words


def teach(robot: str, *, workspace: Path, name: str | None, as_json: bool) -> NoReturn:
    """A person leads a robot; exits with 1 if DONE was never said."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.sessions import Workspace, teach_with  # noqa: PLC0415

    name = name or "demonstration"
    path = Workspace(workspace).free(name, ".mcap").with_suffix(".mcap")
    with _connected(robot) as (document, connected, _):
        print(f"Say START on {document.cues or 'the keyboard'}, or press s, and lead the robot.", file=sys.stderr)
        with progress(f"teaching {name}") as say:
            demonstration = teach_with(
                connected,
                document,
                installed_skills(),
                name=name,
                recording=path,
                watch=lambda percepts, observer: say(percepts.time_s, f"{len(observer.observations)} goals observed"),
            )
    if as_json:
        record = {
            "recording": str(path),
            "name": demonstration.name,
            "robot": document.name,
            "duration_s": round(demonstration.span.duration, 1),
            "observations": len(demonstration.observations),
            "finished": demonstration.done,
        }
        typer.echo(json.dumps(record))
    else:
        count = len(demonstration.observations)
        goals = "1 goal" if count == 1 else f"{count} goals"
        seconds = demonstration.span.duration
        typer.echo(f"A demonstration of {seconds:.0f} s, in which the robot saw {goals} come true.")
        for note in demonstration.notes:
            typer.echo(f"  note: {note}")
        if not demonstration.done:
            typer.echo("  note: DONE was never said")
        typer.echo(f"Recorded in {path}")
        typer.echo(f"Next: understudy learn {path}")
    raise typer.Exit(0 if demonstration.done else 1)


def perform(
    robot: str,
    name: str,
    network: "Network",
    *,
    workspace: Path,
    seed: int | None,
    limit_s: float,
    at_once: bool,
    as_json: bool,
) -> NoReturn:
    """A robot executes a task; exits with 0 if it was done, 1 if not."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.documents import write_new  # noqa: PLC0415
    from understudy.execution import Tally  # noqa: PLC0415
    from understudy.figures import goal_in_words  # noqa: PLC0415
    from understudy.ros2 import find_robot  # noqa: PLC0415
    from understudy.sessions import Workspace, check_capable, perform_with, unbound  # noqa: PLC0415

    skills, spec = installed_skills(), find_robot(robot).spec
    check_capable(network, skills, spec)  # before anybody switches the robot on
    if lacking := unbound(skills, spec):
        print(f"Not every skill binds on {spec.name} ({lacking}); this task asks for none of them.", file=sys.stderr)
    stem = Workspace(workspace).free(f"{name} run", ".mcap", ".json")
    tally = Tally(network, ())
    with _connected(robot) as (document, connected, words):
        _await(connected, document, words, at_once)
        with progress(f"running {name}", limit_s) as say:

            def watch(percepts: Any, decision: Any) -> None:
                for event in decision.events:
                    tally.add(event)
                say(percepts.time_s, str(tally))

            report = perform_with(
                connected,
                document,
                name,
                network,
                skills,
                seed=seed or 0,
                limit_s=limit_s,
                recording=stem.with_suffix(".mcap"),
                watch=watch,
            )
    record = {
        "task": name,
        "robot": document.name,
        "done": report.done,
        "ending": report.ending,
        "duration_s": round(report.duration_s, 1),
        "achieved": [{"component": id_, "time_s": time_s} for id_, time_s in report.achieved],
        "recording": str(stem.with_suffix(".mcap")),
    }
    write_new(stem.with_suffix(".json"), json.dumps(record, indent=2) + "\n")
    if as_json:
        typer.echo(json.dumps(record))
    else:
        for path, time_s in report.achieved:
            typer.echo(f"  achieved at {time_s:6.1f} s: {goal_in_words(network.by_path[path], skills)}")
        missing = f"; missing: {', '.join(tally.missing)}" if tally.missing else ""
        ended = "Done" if report.done else f"Not done ({report.ending})"
        typer.echo(f"{ended} after {report.duration_s:.1f} s{missing}.")
        typer.echo(f"Recorded in {record['recording']}, report in {stem.with_suffix('.json')}")
    raise typer.Exit(0 if report.done else 1)


def practise(
    robot: str,
    document: "Task",
    network: "Network",
    *,
    workspace: Path,
    seed: int | None,
    limit_s: float,
    at_once: bool,
    as_json: bool,
) -> NoReturn:
    """A robot practises a task while a person says BAD, or COME and GO; exits with 0 if it was done, 1 if not."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.cli.corrections import say_correction, write_corrected  # noqa: PLC0415
    from understudy.ros2 import find_robot  # noqa: PLC0415
    from understudy.sessions import Workspace, check_capable, practise_with  # noqa: PLC0415

    skills = installed_skills()
    check_capable(network, skills, find_robot(robot).spec)
    stem = Workspace(workspace).free(f"{document.name} practice", ".mcap", ".yaml")
    latest: list[Practice] = []
    with _connected(robot) as (described, connected, words):
        _await(connected, described, words, at_once)
        with progress(f"practising {document.name}", limit_s) as say:

            def watch(percepts: Any, practice: "Practice") -> None:
                latest[:] = [practice]
                say(percepts.time_s, f"{len(practice.corrections)} corrections")

            try:
                report = practise_with(
                    connected,
                    described,
                    document.name,
                    network,
                    skills,
                    seed=seed or 0,
                    limit_s=limit_s,
                    recording=stem.with_suffix(".mcap"),
                    watch=watch,
                )
            except BaseException:
                # What the teacher has said until now must not be lost, whatever stopped the robot.
                if latest and (saved := write_corrected(latest[0].network, network, document, stem)) is not None:
                    typer.echo(f"Corrected task so far in {saved}", err=True)
                raise
    corrected = write_corrected(report.network, network, document, stem)
    if as_json:
        record = {
            "task": document.name,
            "robot": described.name,
            "done": report.done,
            "ending": report.ending,
            "duration_s": round(report.duration_s, 1),
            "corrections": [{"word": one.word.value, "time_s": one.time_s} for one in report.corrections],
            "corrected": str(corrected) if corrected is not None else None,
            "recording": str(stem.with_suffix(".mcap")),
        }
        typer.echo(json.dumps(record))
    else:
        for correction in report.corrections:
            say_correction(correction, skills)
        ended = "Done" if report.done else f"Not done ({report.ending})"
        typer.echo(f"{ended} after {report.duration_s:.1f} s.")
        typer.echo(f"Recorded in {stem.with_suffix('.mcap')}")
        typer.echo(f"Corrected task in {corrected}" if corrected is not None else "The task is as it was.")
    raise typer.Exit(0 if report.done else 1)


def _await(robot: "Ros2Robot", document: "RobotDocument", words: "list[Cue]", at_once: bool) -> None:
    """Nothing moves before somebody says so."""
    from understudy.robot import Cue  # noqa: PLC0415
    from understudy.sessions import await_start  # noqa: PLC0415

    if at_once:
        return
    where = f"say START on {document.cues}, or " if document.cues else ""
    print(f"The robot stands ready: {where}press Enter here, and it starts.", file=sys.stderr)
    await_start(robot, lambda: Cue.START in words)
