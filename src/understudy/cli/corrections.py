"""What a teacher's words made of a task, as the commands tell it and keep it."""

from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from collections.abc import Mapping

    from understudy.behaviors import Skill
    from understudy.network import Network, Task
    from understudy.practice import Correction

__all__ = ["say_correction", "write_corrected"]


def write_corrected(corrected: "Network", network: "Network", document: "Task", stem: Path) -> Path | None:
    """Writes the corrected task, if there is anything to be written."""
    from understudy.network import Task, save_task  # noqa: PLC0415 - help must come at once

    if corrected == network:
        return None
    path = stem.with_suffix(".yaml")
    save_task(path, Task.of(document.name, corrected, note=document.note))
    return path


def say_correction(correction: "Correction", skills: "Mapping[str, Skill]") -> None:
    """One correction in words, with the step that it was taken for."""
    from understudy.figures import WhyWords  # noqa: PLC0415

    before, after = WhyWords(correction.before, skills), WhyWords(correction.after, skills)
    head = f"  {correction.word} at {correction.time_s:.1f} s"
    if correction.meant:
        first = correction.meant[0]
        if first.component in before.network.by_path:
            where = "before " if correction.word == "COME" else ""
            head += f" → {where}{before.step(first.component)}, {first.told(correction.time_s)}"
        else:
            head += f" → after everything else, {first.told(correction.time_s)}"
    typer.echo(head)
    if correction.note:
        typer.echo(f"      nothing came of it: {correction.note}")
    elif correction.piece is None:
        typer.echo("      taken out")
    else:
        new = [path for path in after.network.by_path if path not in before.network.by_path]
        if new:
            typer.echo(f"      new: {', '.join(after.step(path) for path in new)}")
        else:
            done = _bypassed(after.network)
            kept = [after.step(path) for path in _bypassed(before.network) if path not in done]
            typer.echo(f"      passed by no more: {', '.join(kept)}")


def _bypassed(network: "Network") -> list[str]:
    """The steps that a direct way leads past."""
    homes = ((path, *network.home_of(path)) for path in network.by_path)
    return [path for path, inside, home in homes if path[len(inside) :] in home.topology.bypassed]
