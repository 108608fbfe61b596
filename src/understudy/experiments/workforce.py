"""Who makes the trials: this process, or the workers of a Dask scheduler."""

import importlib
import logging
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack
from types import TracebackType
from typing import Any, Protocol, Self

from understudy.errors import CampaignError, MissingExtraError
from understudy.experiments.conducting import Made, make
from understudy.experiments.fingerprint import fingerprint
from understudy.experiments.unit import Unit

__all__ = ["Alone", "DaskWorkers", "Workforce"]

_ANSWER_S = 15.0
"""A scheduler that does not answer by then is taken to be none."""

_DEATHS = 3
"""A trial during which more workers than this are lost is given up: it is likely what kills them."""

_ONE_THREAD = dict.fromkeys(("OPENCV_FOR_THREADS_NUM", "OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"), "1")
"""There are as many workers as cores; and pictures so small are not worth a thread's waking."""


class Workforce(Protocol):
    """Makes trials; to be entered before, and left when nothing more is to be made."""

    @property
    def size(self) -> int:
        """How many are made at a time."""
        ...

    def made(self, units: Sequence[Unit]) -> Iterator[Made]:
        """Makes all units, in any order; each is handed over as soon as it is made.

        Raises:
            CampaignError: some could not be made.
        """
        ...

    def __enter__(self) -> Self: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...


class Alone:
    """Makes one trial after the other in this process."""

    size = 1

    def made(self, units: Sequence[Unit]) -> Iterator[Made]:
        yield from map(make, units)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """There is nothing to be left."""


class DaskWorkers:
    """The workers of a Dask scheduler.

    A worker that is lost is replaced if it was local, and its trial is given to another one.

    Args:
        count: of local processes, one trial each at a time; not looked at if there is a scheduler.
        scheduler: the address of one that runs already, ``tcp://host:8786``; with local workers if None.

    Raises:
        MissingExtraError: on entering: Dask is not installed.
        CampaignError: on entering: nobody answers at the address, or has workers there.
    """

    def __init__(self, count: int, scheduler: str | None = None) -> None:
        self._count, self._scheduler = count, scheduler
        self._stack = ExitStack()
        self._client: Any = None

    def __enter__(self) -> Self:
        try:
            dask, distributed = importlib.import_module("dask"), importlib.import_module("distributed")
        except ModuleNotFoundError as error:
            raise MissingExtraError(
                f"several workers need {error.name}, which is not installed; pip install 'understudy[campaign]', or"
                " make the trials in this process with --workers 0"
            ) from None
        with ExitStack() as stack:
            stack.enter_context(dask.config.set(_CONFIG))
            if self._scheduler is None:
                cluster = distributed.LocalCluster(
                    n_workers=self._count,
                    threads_per_worker=1,
                    processes=True,
                    host="127.0.0.1",
                    dashboard_address="127.0.0.1:0",  # any free port: there may be several campaigns
                    memory_limit=0,  # nothing is kept by workers, so there is nothing that Dask could put aside
                    silence_logs=logging.CRITICAL,
                )
                stack.enter_context(cluster)
                self._client = stack.enter_context(distributed.Client(cluster))
            else:
                self._client = stack.enter_context(self._connected(distributed))
            self._stack = stack.pop_all()
        return self

    def _connected(self, distributed: Any) -> Any:
        logging.getLogger("distributed").setLevel(logging.CRITICAL)  # what goes wrong is said below, in one line
        try:
            client = distributed.Client(self._scheduler, timeout=_ANSWER_S)
        except (OSError, ValueError) as error:  # ValueError: it is no address
            raise CampaignError(
                f"no Dask scheduler answers at {self._scheduler} ({error}); start one with `dask scheduler`, or leave"
                " out --scheduler"
            ) from None
        try:
            client.wait_for_workers(1, timeout=_ANSWER_S)
        except TimeoutError:
            client.close()
            raise CampaignError(
                f"the Dask scheduler at {self._scheduler} has no workers; start some with"
                f" `dask worker {self._scheduler} --nthreads 1`"
            ) from None
        return client

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stack.close()

    @property
    def size(self) -> int:
        return sum(self._client.nthreads().values()) or 1

    def made(self, units: Sequence[Unit]) -> Iterator[Made]:
        distributed = importlib.import_module("distributed")
        program = fingerprint()
        # Trials of one unit are the same, but each is to be made: without keys of its own, Dask would know it again.
        waiting = {self._client.submit(_make, unit, program, pure=False): unit for unit in units}
        lost: list[Unit] = []
        for future in distributed.as_completed(list(waiting)):
            unit = waiting.pop(future)
            if future.status == "finished":
                yield future.result()
            elif future.cancelled():
                raise CampaignError("the Dask scheduler is gone; give the same command again to go on")
            elif isinstance(error := future.exception(), distributed.KilledWorker):
                lost.append(unit)
            else:
                raise error
            future.release()
        if lost:
            named = ", ".join(f"{unit.row.name} with seed {unit.seed}" for unit in lost)
            raise CampaignError(
                f"{len(lost)} of the trials could not be made, because {_DEATHS + 1} workers one after the other were"
                f" lost in each ({named}); look at one alone with --workers 0"
            )


_CONFIG: Mapping[str, Any] = {
    "distributed.scheduler.allowed-failures": _DEATHS,
    "distributed.nanny.environ": _ONE_THREAD,
    "distributed.worker.preload": ["understudy.experiments.worker"],
}


def _make(unit: Unit, program: Mapping[str, str]) -> Made:
    """In the worker: refuses to mix results of different programs."""
    if (mine := fingerprint()) != program:
        told = ", ".join(
            f"{key} {mine.get(key)} instead of {value}" for key, value in program.items() if mine.get(key) != value
        )
        raise CampaignError(f"a worker has another state of the program: {told}; install the same there")
    return make(unit)
