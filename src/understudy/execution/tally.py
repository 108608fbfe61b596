"""How far a run has come: which steps the task takes, and which of them have been achieved."""

from collections.abc import Iterable, Iterator

from understudy.execution.trace import Event
from understudy.network import END, START, Nab, Network

__all__ = ["Tally"]


class Tally:
    """Counts the steps of a run: the behaviors of the sequence, at any depth, in the cases that are in use.

    A network that has not begun counts with its first case, and where there are alternatives, the first ones that may
    still come. Duties are no steps: a task is complete without them.

    Args:
        network: the task.
        events: told so far; more can be :meth:`added <add>` as they come.
    """

    def __init__(self, network: Network, events: Iterable[Event] = ()) -> None:
        self._network = network
        self._achieved: set[str] = set()
        self._case: dict[str, str | None] = {}
        self._taken: set[str] = set()
        for event in events:
            self.add(event)

    def add(self, event: Event) -> None:
        """The next event of the trace."""
        match event.kind:
            case "achieved":
                self._achieved.add(event.component)
            case "taken":
                self._taken.add(event.component)
            case "case":
                self._case[event.component] = event.detail.get("case")
            case "switch":
                self._case[event.component] = event.detail.get("to")
                self._forget(event.component)
            case "round":
                self._forget(event.component)
            case _:
                pass

    @property
    def steps(self) -> tuple[str, ...]:
        """The paths of all steps, in topological order."""
        return tuple(path for path, _ in self._walk(self._network, "", False))

    @property
    def missing(self) -> tuple[str, ...]:
        """The paths of those that are not achieved, and do not stand in something that is."""
        return tuple(path for path, reached in self._walk(self._network, "", False) if not reached)

    def __str__(self) -> str:
        """``3 of 7 steps``."""
        count = len(self.steps)
        return f"{count - len(self.missing)} of {count} step{'' if count == 1 else 's'}"

    def _walk(self, network: Network, inside: str, reached: bool) -> Iterator[tuple[str, bool]]:
        for id_ in self._way(network, inside) if network.paths else network.topological_order:
            component, path = network.by_id[id_], inside + id_
            if component.trigger is not None:
                continue
            done = reached or path in self._achieved
            if not isinstance(component, Nab):
                yield path, done
                continue
            name = self._case.get(path, component.cases[0].name)
            for case in component.cases:
                if case.name == name:
                    yield from self._walk(case.network, "/".join(filter(None, (path, name))) + "/", done)

    def _way(self, network: Network, inside: str) -> Iterator[str]:
        """The way that was taken, and on from there."""
        candidates = network.topology.candidates[START]
        while candidates != (END,):
            been = (id_ for id_ in candidates if inside + id_ in self._achieved | self._taken)
            id_ = next(been, candidates[0])
            yield id_
            candidates = network.topology.candidates[id_]

    def _forget(self, nab: str) -> None:
        """A network is begun anew: nothing in it has been achieved."""
        self._achieved = {path for path in self._achieved if not path.startswith(f"{nab}/")}
        self._taken = {path for path in self._taken if not path.startswith(f"{nab}/")}
        self._case = {path: name for path, name in self._case.items() if not path.startswith(f"{nab}/")}
