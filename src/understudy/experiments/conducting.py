"""Making one trial; and, for one that fails, a recording of it."""

import gc
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from understudy.clock import WallClock
from understudy.errors import MissingExtraError, UnderstudyError
from understudy.experiments.kinds import KINDS
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit

__all__ = ["Made", "conduct", "make"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Made:
    """A trial that was made.

    Attributes:
        trial: what came out.
        took_s: the time that it took.
        recordings: of a failed one, files by their names; they may have been made on another machine.
        note: what is to be known of the recordings.
    """

    trial: Trial
    took_s: float
    recordings: tuple[tuple[str, bytes], ...] = ()
    note: str = ""


def conduct(unit: Unit) -> Trial:
    """Makes a trial. An error that a user can meet makes a failed one.

    Raises:
        MissingExtraError: an optional package is not installed; that says nothing of the robot.
    """
    try:
        return KINDS[unit.row.kind].trial(unit)
    except MissingExtraError:
        raise
    except UnderstudyError as error:
        return unit.trial(ending="error", problems=(str(error),))


def make(unit: Unit) -> Made:
    """Makes a trial, and if it fails, makes it again with a recording.

    The same comes out again, and few trials fail: so the others need not be recorded, which takes as long as they do.
    """
    clock = WallClock()
    trial = conduct(unit)
    recordings, note = _recorded(unit, trial) if trial.problems else ((), "")
    gc.collect()  # a room and its robot refer to each other; many at once would tear the memory to pieces
    return Made(trial=trial, took_s=clock.now(), recordings=recordings, note=note)


def _recorded(unit: Unit, trial: Trial) -> tuple[tuple[tuple[str, bytes], ...], str]:
    try:
        with tempfile.TemporaryDirectory(prefix="understudy-") as folder:
            again = conduct(replace(unit, folder=Path(folder)))
            files = tuple((file.name, file.read_bytes()) for file in sorted(Path(folder).glob("*.mcap")))
    except OSError as error:
        return (), f"{trial}: it could not be recorded: {error.strerror or error}"
    if again != trial:
        return files, f"{trial}: made again for the recording, it came out differently: {'; '.join(again.problems)}"
    return files, ""
