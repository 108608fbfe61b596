"""``understudy learn``"""

import json
from pathlib import Path
from typing import Annotated

import typer

from understudy.cli.keeping import Edit, Shown, keeping
from understudy.cli.options import (
    DEFAULT_WORKSPACE,
    Everything,
    Json,
    LibraryPlace,
    MaxDistance,
    MinDuration,
    Misfits,
    Name,
    Order,
    Save,
    WorkspaceFolder,
)
from understudy.cli.rules import broken_rules

__all__ = ["command"]


def command(
    source: Annotated[
        Path,
        typer.Argument(
            help="A recording (.mcap) or a rosbag2 folder, or a document of observed intervals (.yaml, .json)."
        ),
    ],
    robot: Annotated[
        str | None, typer.Option("--robot", help="Of a bag: the document of the robot that it was recorded on.")
    ] = None,
    workspace: WorkspaceFolder = DEFAULT_WORKSPACE,
    name: Name = None,
    order: Order = "onset",
    max_distance: MaxDistance = 2.0,
    min_duration: MinDuration = 2.0,
    everything: Everything = False,
    save: Save = None,
    misfits: Misfits = None,
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """Builds the behavior network of one demonstration (§4.4)."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.figures import describe_lesson, describe_task  # noqa: PLC0415
    from understudy.learning import LearningSettings, learn, load_intervals  # noqa: PLC0415
    from understudy.network import Task, save_task  # noqa: PLC0415
    from understudy.ros2 import find_robot  # noqa: PLC0415
    from understudy.sessions import Workspace, recorded_demonstration  # noqa: PLC0415

    settings = LearningSettings(
        order=order, max_distance_m=max_distance, min_duration_s=min_duration, heed_cues=not everything
    )
    skills = installed_skills()
    keep = keeping(None, save, library, workspace)
    if source.suffix.lower() in (".yaml", ".yml", ".json"):
        demonstration = load_intervals(source)
    else:
        document = find_robot(robot) if robot is not None else None
        demonstration = recorded_demonstration(source, skills, settings, robot=document)
    lesson = learn(demonstration, settings)
    name = name or save or lesson.demonstration
    place = Workspace(workspace)
    path = place.free(name, ".yaml").with_suffix(".yaml")
    task = Task.of(name, lesson.network, note=f"learned from {source.name}")
    save_task(path, task)
    broken = broken_rules(lesson.network)
    if not as_json:
        typer.echo(describe_task(name, lesson.network, skills))
        typer.echo(describe_lesson(lesson, skills))
        typer.echo(f"\nThe task is in {path}")
    edit = Edit(task=task, cause="learned", evidence={"demonstrations": [lesson.demonstration]})
    shown = Shown(task=Task.of(lesson.demonstration, lesson.network), file=source, done=demonstration.done)
    kept = keep.edit([edit], [shown], misfits=misfits, quiet=as_json)
    if as_json:
        record = {
            "task": str(path),
            "name": name,
            "components": [component.id for component in lesson.network.components],
            "links": [[link.source, link.target, link.type.value] for link in lesson.network.links],
            "dropped": [[str(item.observed.instance), item.reason] for item in lesson.dropped],
            "notes": list(lesson.notes),
            "broken_rules": broken,
        }
        typer.echo(json.dumps(record | kept.as_record()))
        return
    kept.say()
    for problem in broken:
        typer.echo(f"It cannot be run as it is: {problem}. Mend the document, or demonstrate it again", err=True)
    if not broken:
        typer.echo(f"Next: understudy run {kept.called or path} --world WORLD")
