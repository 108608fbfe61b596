"""``understudy generalize``"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

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
from understudy.cli.tasks import named_task

if TYPE_CHECKING:
    from collections.abc import Mapping

    from understudy.behaviors import Skill
    from understudy.generalization import Difference
    from understudy.learning import LearningSettings
    from understudy.network import Network

__all__ = ["command"]


def command(
    task: Annotated[Path, typer.Argument(help="A task that was learned, or generalised before.")],
    sources: Annotated[
        list[Path],
        typer.Argument(
            help="One demonstration or several, in the order in which they are added: recordings (.mcap), documents of"
            " observed intervals, or tasks that were learned from one."
        ),
    ],
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
    """Adds demonstrations to a task: what all have in common is done, the rest becomes alternatives (§5)."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.figures import describe_difference, describe_task  # noqa: PLC0415
    from understudy.generalization import generalize  # noqa: PLC0415
    from understudy.learning import LearningSettings  # noqa: PLC0415
    from understudy.network import Task, save_task  # noqa: PLC0415
    from understudy.sessions import Workspace  # noqa: PLC0415
    from understudy.sessions.pictures import picture_task  # noqa: PLC0415

    settings = LearningSettings(
        order=order, max_distance_m=max_distance, min_duration_s=min_duration, heed_cues=not everything
    )
    skills = installed_skills()
    named = named_task(task, library, workspace)
    keep = keeping(named, save, library, workspace)
    known, network = named.task, named.network
    differences, demonstrations = [], []
    for source in sources:
        called, shown = _learned(source, skills, settings)
        found = generalize(network, shown, names=(known.name, called))
        network = found.network
        demonstrations.append(Shown(task=Task.of(called, shown), file=source))
        differences.append(found.difference)
    name = name or known.name
    path = Workspace(workspace).free(name, ".yaml", ".png", ".svg")
    document = path.with_name(f"{path.name}.yaml")
    added = f"generalised with {', '.join(source.name for source in sources)}"
    generalized = Task.of(name, network, note="; ".join(filter(None, (known.note, added))))
    save_task(document, generalized)
    pictures = picture_task(name, network, skills, path)
    broken = broken_rules(network)
    if not as_json:
        for difference in differences:
            typer.echo(describe_difference(difference, network, skills) + "\n")
        typer.echo(describe_task(name, network, skills))
        typer.echo(f"\nThe task is in {document}, and drawn in {pictures[0]}")
    evidence = {"demonstrations": [one.task.name for one in demonstrations]}
    edit = Edit(task=generalized, cause="generalised", evidence=evidence)
    kept = keep.edit([*keep.outset(named), edit], demonstrations, misfits=misfits, quiet=as_json)
    if as_json:
        record = _record(name, document, network, differences)
        typer.echo(json.dumps({**record, "broken_rules": broken, **kept.as_record()}))
        return
    kept.say()
    for problem in broken:
        typer.echo(f"It cannot be run as it is: {problem}. Mend the document, or demonstrate it again", err=True)
    if not broken:
        typer.echo(f"Next: understudy run {kept.called or document} --world WORLD")


def _learned(source: Path, skills: "Mapping[str, Skill]", settings: "LearningSettings") -> "tuple[str, Network]":
    """The name and the network of one demonstration, from whatever holds it."""
    from understudy.documents import read_data  # noqa: PLC0415
    from understudy.learning import learn, parse_intervals  # noqa: PLC0415
    from understudy.network import parse_task  # noqa: PLC0415
    from understudy.sessions import recorded_demonstration  # noqa: PLC0415

    if source.suffix.lower() not in (".yaml", ".yml", ".json"):
        lesson = learn(recorded_demonstration(source, skills, settings), settings)
        return lesson.demonstration, lesson.network
    data = read_data(source)
    if isinstance(data, dict) and str(data.get("understudy")).startswith("task/"):
        task, network = parse_task(data, source=str(source))
        return task.name, network
    lesson = learn(parse_intervals(data, source=str(source)), settings)
    return lesson.demonstration, lesson.network


def _record(name: str, document: Path, network: "Network", differences: "list[Difference]") -> dict[str, Any]:
    topology = network.topology
    return {
        "task": str(document),
        "name": name,
        "demonstrations": list(topology.demonstrations),
        "paths": [[edge.source, edge.target, list(edge.shown)] for edge in topology.edges],
        "bypassed": list(topology.bypassed),
        "links": [[link.source, link.target, link.type.value] for link in network.links],
        "added": [
            {
                "demonstrations": list(one.demonstrations),
                "merged": list(one.merged),
                "new": list(one.added),
                "branches": [
                    {"after": b.after, "before": b.before, "steps": list(b.steps), "instead": list(b.instead)}
                    for b in one.branches
                ],
                "bypassed": list(one.bypassed),
                "relaxed": [[r.source, r.target, r.was.value, r.now.value if r.now else None] for r in one.relaxed],
            }
            for one in differences
        ],
    }
