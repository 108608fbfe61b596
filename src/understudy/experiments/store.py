"""The trials of a campaign on disk, each from the moment on at which it was made (SQLite through SQLAlchemy).

A trial follows from experiment, row and seed, so the file is a memory of what need not be made again. It remembers of
which experiment, and of which state of the program, and is one campaign's alone as long as that one has it open.
"""

import json
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from sqlalchemy import JSON, Column, Float, Integer, MetaData, String, Table, create_engine, insert, select
from sqlalchemy.exc import DatabaseError
from sqlalchemy.pool import StaticPool

from understudy.errors import CampaignError
from understudy.experiments.experiment import Experiment
from understudy.experiments.fingerprint import fingerprint
from understudy.experiments.trial import Trial

__all__ = ["Store"]

_TABLES = MetaData()

_BASIS = Table("basis", _TABLES, Column("key", String, primary_key=True), Column("value", JSON, nullable=False))
"""What all trials of the file have in common."""

_TRIALS = Table(
    "trials",
    _TABLES,
    Column("row", String, primary_key=True),
    Column("seed", Integer, primary_key=True),
    Column("took_s", Float, nullable=False),
    Column("record", JSON, nullable=False),
)

_TOLD_ONLY = ("title", "source", "note", "trials", "seed", "tables", "rows")
_TOLD_ONLY_OF_A_ROW = ("dissertation", "goal")
"""Keys of a document, and of a row, on which no trial depends; the rows are looked at one by one."""


class Store:
    """The file of one campaign, made if it is not there.

    Args:
        path: of the file.
        experiment: whose trials they are.

    Raises:
        CampaignError: the file cannot be used, belongs to another experiment or to another state of the program, or
            another campaign has it open; here and in every method.
    """

    def __init__(self, path: Path, experiment: Experiment) -> None:
        self.path = path
        with self._said(), ExitStack() as stack:
            engine = create_engine(
                f"sqlite:///{path}", poolclass=StaticPool, connect_args={"timeout": 0.0, "check_same_thread": False}
            )
            stack.callback(engine.dispose)
            self._connection = stack.enter_context(engine.connect())
            # The lock is the operating system's, and ends with the process, however that ends.
            self._connection.exec_driver_sql("PRAGMA locking_mode=EXCLUSIVE")
            self._connection.exec_driver_sql("BEGIN EXCLUSIVE")
            self._settle(_basis(experiment))
            self._connection.commit()
            self._stack = stack.pop_all()

    def _settle(self, basis: Mapping[str, Any]) -> None:
        """Adds to what the file knows of its trials' basis what is new, and refuses what is different."""
        _TABLES.create_all(self._connection)
        known = {row.key: row.value for row in self._connection.execute(select(_BASIS))}
        for key in sorted(basis.keys() & known.keys()):
            if told := _difference(known[key], basis[key], key):
                raise CampaignError(
                    f"{self.path} holds trials of another experiment or program: {told}. Begin anew with --fresh, which"
                    " puts them aside, or make it what it was"
                )
        if new := [{"key": key, "value": value} for key, value in basis.items() if key not in known]:
            self._connection.execute(insert(_BASIS), new)

    def add(self, trial: Trial, took_s: float) -> None:
        """Keeps a trial; when this returns, it is on the disk.

        Args:
            trial: not known so far.
            took_s: the time that it took, for estimates.
        """
        values = {"row": trial.row, "seed": trial.seed, "took_s": took_s, "record": trial.as_record()}
        with self._said():
            self._connection.execute(insert(_TRIALS), values)
            self._connection.commit()

    def trials(self) -> dict[tuple[str, int], Trial]:
        """All trials, by row and seed."""
        with self._said():
            records = self._connection.execute(select(_TRIALS.c.record)).scalars().all()
        trials = map(Trial.from_record, records)
        return {(trial.row, trial.seed): trial for trial in trials}

    def took_s(self) -> dict[str, list[float]]:
        """How long the trials took, by row."""
        with self._said():
            known = self._connection.execute(select(_TRIALS.c.row, _TRIALS.c.took_s)).all()
        found: dict[str, list[float]] = {}
        for row, took_s in known:
            found.setdefault(row, []).append(took_s)
        return found

    def close(self) -> None:
        """Gives the file free."""
        self._stack.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    @contextmanager
    def _said(self) -> Iterator[None]:
        """What goes wrong with the file, in one line."""
        try:
            yield
        except DatabaseError as error:
            reason = str(error.orig)
            mend = next((mend for words, mend in _MENDS.items() if words in reason), "name another with --workspace")
            raise CampaignError(f"{self.path} cannot be used: {reason}; {mend}") from None


_MENDS = {
    "locked": "another campaign has it open: wait for it, or name another folder with --workspace",
    "full": "what was stored until now is kept; make room, and give the same command again to go on",
    "not a database": "it is none of ours; begin anew with --fresh, which puts it aside",
}


def _basis(experiment: Experiment) -> dict[str, Any]:
    """All that the trials depend on, beside row and seed; a row, a world, a task for itself, so that some can be added.

    As JSON gives it back.
    """
    data = experiment.as_data()
    document = data["document"]
    basis = {"program": fingerprint()}
    basis |= {"experiment": {key: value for key, value in document.items() if key not in _TOLD_ONLY}}
    for row in document["rows"]:
        basis[f"row {row['name']}"] = {key: value for key, value in row.items() if key not in _TOLD_ONLY_OF_A_ROW}
    for kind in ("world", "task"):
        basis |= {f"{kind} {name}": value for name, value in data[f"{kind}s"].items()}
    plain: dict[str, Any] = json.loads(json.dumps(basis))
    return plain


def _difference(was: Any, now: Any, path: str) -> str:
    """The first place at which plain data differ, in words; empty if they do not."""
    if isinstance(was, Mapping) and isinstance(now, Mapping):
        for key in sorted({*was, *now}):
            if told := _difference(was.get(key), now.get(key), f"{path}: {key}"):
                return told
        return ""
    if isinstance(was, list) and isinstance(now, list) and len(was) == len(now):
        pairs = enumerate(zip(was, now, strict=True))
        return next(filter(None, (_difference(*pair, f"{path}[{index}]") for index, pair in pairs)), "")
    return "" if was == now else f"{path} was {_told(was)}, and is {_told(now)}"


def _told(value: Any) -> str:
    return "not given" if value is None else f"{value!r:.60}"
