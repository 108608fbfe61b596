"""Options that several commands share."""

from pathlib import Path
from typing import Annotated, Literal

import typer

__all__ = [
    "DEFAULT_WORKSPACE",
    "Everything",
    "Json",
    "LibraryPlace",
    "MaxDistance",
    "MinDuration",
    "Misfits",
    "Name",
    "Order",
    "Save",
    "Seed",
    "WorkspaceFolder",
]

DEFAULT_WORKSPACE = Path("understudy-out")

WorkspaceFolder = Annotated[
    Path, typer.Option("--workspace", "-o", help="The folder to write to. Nothing in it is overwritten.")
]
Seed = Annotated[int | None, typer.Option("--seed", min=0, help="Of all chance; the world's own if not given.")]
Name = Annotated[str | None, typer.Option("--name", help="Instead of the name it would get by itself.")]
Order = Annotated[
    Literal["onset", "closest", "free"],
    typer.Option(
        help="Order the steps by when each was first observed, or by when the robot was closest; or, of several"
        " demonstrations, only as far as they show that it is needed."
    ),
]
MaxDistance = Annotated[float, typer.Option(min=0.0, help="Metres; what was last seen farther away was not visited.")]
MinDuration = Annotated[float, typer.Option(min=0.0, help="Seconds; shorter observations are taken for noise.")]
Everything = Annotated[
    bool, typer.Option("--everything", help="Learn all that was observed, also where no word of the teacher's fell.")
]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object, for another program to read.")]
LibraryPlace = Annotated[
    str | None,
    typer.Option(
        "--library",
        envvar="UNDERSTUDY_LIBRARY",
        show_default="library.db in the workspace",
        help="The library of tasks: a file, or the URL of a database.",
    ),
]
Save = Annotated[
    str | None,
    typer.Option(
        "--save", metavar="TASK", help="Keep it in the library, as the next revision of this task, or its first."
    ),
]
Misfits = Annotated[
    bool | None,
    typer.Option(
        "--yes/--refuse-misfits",
        show_default=False,
        help="If something no longer fits the edited task, take the edit, or keep it as a proposal only. Left out, you"
        " are asked; where nobody can be, it is a proposal.",
    ),
]
