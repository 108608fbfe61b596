"""``understudy generalize``"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from understudy.cli.keeping import Edit, Shown, keeping
from understudy.cli.merging import learned_from, merge
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
    """Adds demonstrations to a task: what all have in common is done, the rest becomes alternatives (§5).

    With --order free it stays a task without alternatives, in which only the needed order is kept.
    """
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.figures import describe_task  # noqa: PLC0415
    from understudy.learning import LearningSettings  # noqa: PLC0415
    from understudy.network import Task, save_task  # noqa: PLC0415
    from understudy.sessions import Workspace  # noqa: PLC0415
    from understudy.sessions.pictures import picture_task  # noqa: PLC0415

    settings = LearningSettings(
        order="onset" if order == "free" else order,
        max_distance_m=max_distance,
        min_duration_s=min_duration,
        heed_cues=not everything,
    )
    skills = installed_skills()
    named = named_task(task, library, workspace)
    keep = keeping(named, save, library, workspace)
    known = named.task
    shown = [learned_from(source, skills, settings) for source in sources]
    merged = merge([(known.name, named.network), *shown], skills, free=order == "free")
    network = merged.network
    demonstrations = [
        Shown(task=Task.of(called, one), file=source) for source, (called, one) in zip(sources, shown, strict=True)
    ]
    name = name or known.name
    path = Workspace(workspace).free(name, ".yaml", ".png", ".svg")
    document = path.with_name(f"{path.name}.yaml")
    added = f"generalised with {', '.join(source.name for source in sources)}"
    generalized = Task.of(name, network, note="; ".join(filter(None, (known.note, added))))
    save_task(document, generalized)
    pictures = picture_task(name, network, skills, path)
    broken = broken_rules(network)
    if not as_json:
        typer.echo(merged.told + "\n")
        typer.echo(describe_task(name, network, skills))
        typer.echo(f"\nThe task is in {document}, and drawn in {pictures[0]}")
    evidence = {"demonstrations": [one.task.name for one in demonstrations]}
    edit = Edit(task=generalized, cause="generalised", evidence=evidence)
    kept = keep.edit([*keep.outset(named), edit], demonstrations, misfits=misfits, quiet=as_json)
    if as_json:
        record = _record(name, document, network)
        typer.echo(json.dumps({**record, **merged.record, "broken_rules": broken, **kept.as_record()}))
        return
    kept.say()
    for problem in broken:
        typer.echo(f"It cannot be run as it is: {problem}. Mend the document, or demonstrate it again", err=True)
    if not broken:
        typer.echo(f"Next: understudy run {kept.called or document} --world WORLD")


def _record(name: str, document: Path, network: "Network") -> dict[str, Any]:
    topology = network.topology
    return {
        "task": str(document),
        "name": name,
        "demonstrations": list(topology.demonstrations),
        "paths": [[edge.source, edge.target, list(edge.shown)] for edge in topology.edges],
        "bypassed": list(topology.bypassed),
        "links": [[link.source, link.target, link.type.value] for link in network.links],
    }
