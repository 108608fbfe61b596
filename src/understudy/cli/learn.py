"""``understudy learn``"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from understudy.cli.keeping import Edit, Shown, keeping
from understudy.cli.merging import merge
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

if TYPE_CHECKING:
    from collections.abc import Mapping

    from understudy.behaviors import Skill
    from understudy.learning import Demonstration, LearningSettings, Lesson

__all__ = ["command"]


def command(
    sources: Annotated[
        list[Path],
        typer.Argument(
            help="A recording (.mcap) or a rosbag2 folder, or a document of observed intervals (.yaml, .json); several"
            " of one task are generalised."
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
    """Builds the behavior network of one demonstration (§4.4), or of several (§5).

    Of several, what all have in common is done, and the rest becomes alternatives; with --order free there are
    none, and only the needed order is kept.
    """
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.figures import describe_lesson, describe_task  # noqa: PLC0415
    from understudy.learning import LearningSettings, learn  # noqa: PLC0415
    from understudy.network import Task, save_task  # noqa: PLC0415
    from understudy.sessions import Workspace  # noqa: PLC0415

    settings = LearningSettings(
        order="onset" if order == "free" else order,
        max_distance_m=max_distance,
        min_duration_s=min_duration,
        heed_cues=not everything,
    )
    skills = installed_skills()
    keep = keeping(None, save, library, workspace)
    demonstrations = [_demonstration(source, robot, skills, settings) for source in sources]
    lessons = [learn(one, settings) for one in demonstrations]
    network, told, record = lessons[0].network, describe_lesson(lessons[0], skills), _record(lessons[0])
    if len(lessons) > 1:
        merged = merge([(lesson.demonstration, lesson.network) for lesson in lessons], skills, free=order == "free")
        network, told, record = merged.network, f"\n{merged.told}", merged.record
    name = name or save or lessons[0].demonstration
    place = Workspace(workspace)
    path = place.free(name, ".yaml").with_suffix(".yaml")
    task = Task.of(name, network, note=f"learned from {', '.join(source.name for source in sources)}")
    save_task(path, task)
    broken = broken_rules(network)
    if not as_json:
        typer.echo(describe_task(name, network, skills))
        typer.echo(told)
        typer.echo(f"\nThe task is in {path}")
    evidence = {"demonstrations": [lesson.demonstration for lesson in lessons]}
    edit = Edit(task=task, cause="learned", evidence=evidence)
    shown = [
        Shown(task=Task.of(lesson.demonstration, lesson.network), file=source, done=demonstration.done)
        for source, demonstration, lesson in zip(sources, demonstrations, lessons, strict=True)
    ]
    kept = keep.edit([edit], shown, misfits=misfits, quiet=as_json)
    if as_json:
        common = {
            "task": str(path),
            "name": name,
            "components": [component.id for component in network.components],
            "links": [[link.source, link.target, link.type.value] for link in network.links],
        }
        typer.echo(json.dumps({**common, **record, "broken_rules": broken, **kept.as_record()}))
        return
    kept.say()
    for problem in broken:
        typer.echo(f"It cannot be run as it is: {problem}. Mend the document, or demonstrate it again", err=True)
    if not broken:
        typer.echo(f"Next: understudy run {kept.called or path} --world WORLD")


def _demonstration(
    source: Path, robot: str | None, skills: "Mapping[str, Skill]", settings: "LearningSettings"
) -> "Demonstration":
    from understudy.learning import load_intervals  # noqa: PLC0415
    from understudy.ros2 import find_robot  # noqa: PLC0415
    from understudy.sessions import recorded_demonstration  # noqa: PLC0415

    if source.suffix.lower() in (".yaml", ".yml", ".json"):
        return load_intervals(source)
    document = find_robot(robot) if robot is not None else None
    return recorded_demonstration(source, skills, settings, robot=document)


def _record(lesson: "Lesson") -> dict[str, Any]:
    return {
        "dropped": [[str(item.observed.instance), item.reason] for item in lesson.dropped],
        "notes": list(lesson.notes),
    }
