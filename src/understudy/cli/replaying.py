"""Before an edit is taken, all that speaks for the task is replayed against it; the teacher decides.

Whatever the answer is, the edit is kept: at least as a proposal, which changes nothing.
"""

import sys
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from understudy.library import Library, Regression, Revision
    from understudy.network import Network

__all__ = ["decide", "replayed", "say_replayed"]


def replayed(library: "Library", task: str, network: "Network", base: "Revision | None") -> "Regression":
    """All that speaks for a task, replayed against what it shall be."""
    from understudy.library import network_of, regression  # noqa: PLC0415

    if base is None:
        return regression(network, (), {})
    sittings = library.sittings(task)
    executed = {one.revision for one in sittings if one.kind == "run"}
    networks = {number: network_of(library.revision(task, number))[1] for number in executed}
    return regression(network, sittings, networks, network_of(base)[1])


def say_replayed(regression: "Regression", *, err: bool = False) -> None:
    """Tells what became of what speaks for a task, if there is anything to be told."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.figures import describe_regression  # noqa: PLC0415

    if words := describe_regression(regression, installed_skills()):
        typer.echo(words, err=err)


def decide(regression: "Regression", task: str, misfits: bool | None) -> bool:
    """Whether an edit is taken."""
    if not regression.broken:
        return True
    if misfits is not None:
        return misfits
    if not _attended():
        return False
    try:
        return typer.confirm(f"Shall {task} be so all the same?", err=True)
    except typer.Abort:  # Ctrl-C at the question: no, but nothing is lost
        return False


def _attended() -> bool:
    """Whether somebody can be asked."""
    return sys.stdin.isatty() and sys.stderr.isatty()
