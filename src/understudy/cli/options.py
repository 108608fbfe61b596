"""Options that several commands share."""

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["DEFAULT_WORKSPACE", "Json", "Name", "Seed", "WorkspaceFolder"]

DEFAULT_WORKSPACE = Path("understudy-out")

WorkspaceFolder = Annotated[
    Path, typer.Option("--workspace", "-o", help="The folder to write to. Nothing in it is overwritten.")
]
Seed = Annotated[int | None, typer.Option("--seed", min=0, help="Of all chance; the world's own if not given.")]
Name = Annotated[str | None, typer.Option("--name", help="Instead of the name it would get by itself.")]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object, for another program to read.")]
