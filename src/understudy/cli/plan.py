"""``understudy plan``"""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from understudy.cli.keeping import Edit, keeping
from understudy.cli.options import DEFAULT_WORKSPACE, Json, LibraryPlace, Misfits, Name, Save, WorkspaceFolder
from understudy.cli.rules import broken_rules
from understudy.cli.worlds import find_world

if TYPE_CHECKING:
    from understudy.planning import Things

__all__ = ["command"]


def command(
    goal: Annotated[
        str, typer.Argument(help='What shall be so, for example "carried(orange, pink) and visited(red)".')
    ],
    world: Annotated[
        str | None,
        typer.Option(
            "--world", "-w", help="Plan with the boxes and targets of this world; with all colors if left out."
        ),
    ] = None,
    given: Annotated[
        str, typer.Option(help="What is so at the start; if left out, the task works whatever is so.")
    ] = "",
    planner: Annotated[
        Literal["pyperplan", "fast-downward"], typer.Option(help="Who looks for the plan; fast-downward is an extra.")
    ] = "pyperplan",
    pddl: Annotated[
        Path | None, typer.Option(help="A folder for domain.pddl and problem.pddl. Nothing is overwritten.")
    ] = None,
    workspace: WorkspaceFolder = DEFAULT_WORKSPACE,
    name: Name = None,
    save: Save = None,
    misfits: Misfits = None,
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """Plans a task from what the skills need and give (§3.3.1). Exit code 1 if there is no plan."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.errors import NoPlanError  # noqa: PLC0415
    from understudy.figures import describe_task  # noqa: PLC0415
    from understudy.network import Task, save_task  # noqa: PLC0415
    from understudy.planning import EVERYTHING, plan_task, planning_problem, reasons_of, write_pddl  # noqa: PLC0415
    from understudy.sessions import Workspace  # noqa: PLC0415
    from understudy.sessions.pictures import picture_task  # noqa: PLC0415

    skills = installed_skills()
    problem = planning_problem(goal, skills, EVERYTHING if world is None else _things(world), given=given)
    keep = keeping(None, save, library, workspace)
    name = name or save or problem.name
    written: list[Path] = []
    if pddl is not None:
        written += write_pddl(pddl, problem.operators(problem.goal), problem.start, problem.goal, name=name)
    try:
        plan = plan_task(problem, planner=planner)
    except NoPlanError as error:
        if as_json:
            typer.echo(json.dumps({"goal": str(problem), "task": None, "missing": list(error.missing)}))
        else:
            _say_written(written)
        typer.echo(f"understudy: {error}", err=True)
        raise typer.Exit(1) from None
    network = plan.network
    stem = Workspace(workspace).free(name, ".yaml", ".png", ".svg")
    path = stem.with_name(f"{stem.name}.yaml")
    task = Task.of(name, network, note=f"planned for {problem}")
    save_task(path, task)
    written += [path, *picture_task(name, network, skills, stem)]
    if not as_json:
        typer.echo(describe_task(name, network, skills))
        typer.echo()
        _say_written(written)
    edit = Edit(task=task, cause="planned", evidence={"goal": str(problem)})
    kept = keep.edit([edit], misfits=misfits, quiet=as_json)
    if as_json:
        ids = [component.id for component in network.components]
        record = {
            "goal": str(problem),
            "task": str(path),
            "name": name,
            "components": ids,
            "links": [[link.source, link.target, link.type.value] for link in network.links],
            "reasons": [
                [ids[one.source], ids[one.target], one.type.value, one.words] for one in reasons_of(plan.steps)
            ],
            "written": list(map(str, written)),
        }
        typer.echo(json.dumps(record | kept.as_record()))
        return
    kept.say()
    # What is given at the start, as an empty gripper is, no rule knows of.
    unchecked = " --unchecked" if broken_rules(network) else ""
    typer.echo(f"Next: understudy run {kept.called or path} --world {world or 'WORLD'}{unchecked}")


def _say_written(files: list[Path]) -> None:
    for file in files:
        typer.echo(f"Wrote {file}")


def _things(world: str) -> "Things":
    """The boxes and targets of a room."""
    from understudy.behaviors import BOX, TARGET  # noqa: PLC0415

    room = find_world(world)
    return {
        BOX: tuple(dict.fromkeys(str(box.color) for box in room.boxes)),
        TARGET: tuple(dict.fromkeys(str(target.color) for target in room.targets)),
    }
