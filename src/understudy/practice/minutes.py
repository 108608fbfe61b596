"""What the report of a practice run keeps of its corrections, so that they can be made again otherwise (§6.1)."""

from collections.abc import Sequence
from typing import Any, Literal

from pydantic import BaseModel, ValidationError

from understudy.documents import first_fault
from understudy.errors import DocumentError
from understudy.network import Network, Task, differences, parse_task, task_data
from understudy.practice.attribution import Attribution
from understudy.practice.corrections import Correction
from understudy.practice.reassigning import made
from understudy.robot import Cue

__all__ = ["minutes_of", "read_minutes"]


class MeantEntry(BaseModel):
    component: str
    how: Literal["finished", "executing", "searching", "said"]
    since_s: float


class CorrectionEntry(BaseModel):
    word: Cue
    time_s: float
    meant: list[MeantEntry]
    piece: Any
    note: str


class Minutes(BaseModel):
    """The keys of a report that matter here; it has others."""

    task: str
    before: Any
    corrections: list[CorrectionEntry]


def minutes_of(name: str, network: Network, corrections: Sequence[Correction]) -> dict[str, Any]:
    """What a report tells of corrections, in plain data: enough to make them again.

    Args:
        name: of the task.
        network: the task as it was before the first of them.
        corrections: in their order.
    """
    return {
        "before": task_data(Task.of(name, network)),
        "corrections": [
            {
                "word": one.word.value,
                "time_s": one.time_s,
                "component": one.meant[0].component if one.meant else None,
                "how": one.meant[0].told(one.time_s) if one.meant else None,
                "others": [other.component for other in one.meant[1:]],
                "changes": list(differences(one.before, one.after)),
                "note": one.note,
                "meant": [
                    {"component": step.component, "how": step.how, "since_s": step.since_s} for step in one.meant
                ],
                "piece": task_data(Task.of(name, one.piece)) if one.piece is not None else None,
            }
            for one in corrections
        ],
    }


def read_minutes(data: Any, *, source: str) -> tuple[str, Network, tuple[Correction, ...]]:
    """The task of a report, as it was before practice, its name before it, and the corrections.

    Args:
        data: the report in plain data.
        source: its file, for messages.

    Raises:
        DocumentError: it is no report of practice.
    """
    if not (isinstance(data, dict) and "corrections" in data and "before" in data):
        raise DocumentError(
            "this is no report of a practice run; name the .json that `understudy practice` wrote", source=source
        )
    try:
        minutes = Minutes.model_validate(data)
    except ValidationError as error:
        raise first_fault(error, source) from None
    _, network = parse_task(minutes.before, source=f"{source}: before")
    corrections: list[Correction] = []
    task = network
    for index, entry in enumerate(minutes.corrections):
        piece = None
        if entry.piece is not None:
            _, piece = parse_task(entry.piece, source=f"{source}: corrections[{index}].piece")
        meant = tuple(Attribution(component=one.component, how=one.how, since_s=one.since_s) for one in entry.meant)
        given = Correction(
            word=entry.word, time_s=entry.time_s, meant=meant, before=task, after=task, piece=piece, note=entry.note
        )
        corrections.append(made(given))
        task = corrections[-1].after
    return minutes.task, network, tuple(corrections)
