"""What a teacher's words made of a task in practice, one after the other."""

from dataclasses import dataclass
from typing import Literal

from understudy.execution import Event
from understudy.network import Network
from understudy.practice.attribution import Attribution
from understudy.robot import Cue

__all__ = ["Correction", "Ending", "PracticeReport"]

Ending = Literal["complete", "time limit", "timeout", "nothing left"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Correction:
    """What one word, or one COME … GO, made of the task.

    Attributes:
        word: BAD, or COME; or another one of which nothing could be made.
        time_s: when it was said.
        meant: the steps that it may have been about; the first was taken.
        before: the task until then.
        after: the task from then on; the same where nothing came of it.
        piece: of a COME, what was learned until GO, also if it could not be put in; None if nothing was.
        note: why nothing came of it.
    """

    word: Cue
    time_s: float
    meant: tuple[Attribution, ...]
    before: Network
    after: Network
    piece: Network | None = None
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class PracticeReport:
    """How a practice run went.

    Attributes:
        done: what was executed was completed.
        ending: why the run ended: ``complete``, ``time limit``, ``timeout`` of a component that stops the run then, or
            ``nothing left`` to execute.
        stopped_by: the path of that component; empty if there is none.
        duration_s: on the robot's clock; until it was done, if it was.
        network: the task as the teacher corrected it; for the next run.
        corrections: one for each word, in their order.
        events: the whole trace.
    """

    done: bool
    ending: Ending
    duration_s: float
    network: Network
    corrections: tuple[Correction, ...]
    events: tuple[Event, ...]
    stopped_by: str = ""
