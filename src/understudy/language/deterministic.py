"""The deterministic automaton of a task, made as far as it is asked for.

A state is the number of a set of states of :class:`~understudy.language.automaton.Automaton`: all in which the task can
be after the symbols so far, silent moves included.
"""

from collections.abc import Mapping
from functools import cached_property

from understudy.errors import LanguageError
from understudy.language.automaton import Automaton, State
from understudy.language.symbols import Spelling
from understudy.network import Component, Network

__all__ = ["MANY_STATES", "Deterministic"]

MANY_STATES = 100_000
"""More states than this are refused: they would take some ten seconds, and a few hundred megabytes."""


class Deterministic:
    """A task's automaton over symbols.

    Args:
        network: the task.
        spell: the symbol of each behavior.
        limit: refuse to make more states than this.

    Attributes:
        symbol: of every behavior by its path.
        start: the first state.
    """

    def __init__(self, network: Network, spell: Spelling, *, limit: int = MANY_STATES) -> None:
        self.symbol = {path: spell(path, part) for path, part in network.walk() if isinstance(part, Component)}
        self._automaton, self._limit = Automaton(network), limit
        self._rank = {path: index for index, path in enumerate(self.symbol)}
        self._sets: list[frozenset[State]] = []
        self._size = 0
        self._numbers: dict[frozenset[State], int] = {}  # of closed sets, and of those that were closed to them
        self._after: list[Mapping[str, int] | None] = []
        self._bounds: list[tuple[float, float]] = []
        self._hopeful: dict[int, bool] = {}
        self.start = self._number({self._automaton.start})

    def after(self, state: int) -> Mapping[str, int]:
        """Where each symbol leads that can come next, in the order of the steps.

        Raises:
            LanguageError: there are too many states.
        """
        found = self._after[state]
        if found is None:
            reached: dict[str, set[State]] = {}
            for one in self._sets[state]:
                for path, target in self._automaton.moves(one):
                    if path is not None:
                        reached.setdefault(path, set()).add(target)
            targets: dict[str, set[State]] = {}
            for path in sorted(reached, key=self._rank.__getitem__):
                targets.setdefault(self.symbol[path], set()).update(reached[path])
            found = self._after[state] = {symbol: self._number(ones) for symbol, ones in targets.items()}
        return found

    def complete(self, state: int) -> bool:
        """Whether the task is done there."""
        return any(map(self._automaton.complete, self._sets[state]))

    def bounds(self, state: int) -> tuple[float, float]:
        """Between how many and how many more symbols it takes to be done; no promise that it can be."""
        return self._bounds[state]

    def hopeful(self, state: int) -> bool:
        """Whether the task can still be done from there."""
        if self._automaton.ends:
            return True
        if state not in self._hopeful:
            found, seen = self.complete(state), {state}
            way = [(state, iter(self.after(state).values()))]
            while way and not found:
                step = next(way[-1][1], None)
                if step is None:
                    way.pop()
                elif step not in seen and self._hopeful.get(step) is not False:
                    seen.add(step)
                    way.append((step, iter(self.after(step).values())))
                    found = self.complete(step) or self._hopeful.get(step, False)
            self._hopeful |= dict.fromkeys((one for one, _ in way) if found else seen, found)
        return self._hopeful[state]

    @cached_property
    def useful(self) -> tuple[int, ...]:
        """Every state from which the task can be done.

        Raises:
            LanguageError: there are too many states.
        """
        order, found = [self.start], {self.start}
        before: dict[int, list[int]] = {self.start: []}
        for state in order:
            for target in dict.fromkeys(self.after(state).values()):
                before.setdefault(target, []).append(state)
                if target not in found:
                    found.add(target)
                    order.append(target)
        way = [state for state in order if self.complete(state)]
        useful = set(way)
        for state in way:
            new = [one for one in before[state] if one not in useful]
            useful.update(new)
            way += new
        self._hopeful = {state: state in useful for state in order}
        return tuple(state for state in order if state in useful)

    @cached_property
    def order(self) -> tuple[int, ...] | None:
        """The :attr:`useful` states, each before those that come after it; None if there are loops."""
        waiting = dict.fromkeys(self.useful, 0)
        for state in self.useful:
            for target in self.after(state).values():
                if target in waiting:
                    waiting[target] += 1
        order = [state for state, count in waiting.items() if not count]
        for state in order:
            for target in self.after(state).values():
                if target in waiting:
                    waiting[target] -= 1
                    if not waiting[target]:
                        order.append(target)
        return tuple(order) if len(order) == len(self.useful) else None

    def _number(self, states: set[State]) -> int:
        """The number of a set of states, with everything that silent moves lead to."""
        given = frozenset(states)
        number = self._numbers.get(given)
        if number is None:
            closed = self._closed(given)
            number = self._numbers.get(closed)
            if number is None:
                number = len(self._sets)
                # Where steps look alike the sets are large, and it is their size that costs.
                self._size += len(closed)
                self._refuse(self._size)
                self._sets.append(closed)
                self._after.append(None)
                low, high = zip(*map(self._automaton.bounds, closed), strict=True)
                self._bounds.append((min(low), max(high)))
            self._numbers[given] = self._numbers[closed] = number
        return number

    def _closed(self, states: frozenset[State]) -> frozenset[State]:
        closed, new = set(states), list(states)
        while new:
            for path, target in self._automaton.moves(new.pop()):
                if path is None and target not in closed:
                    closed.add(target)
                    new.append(target)
            self._refuse(len(closed))
        return frozenset(closed)

    def _refuse(self, count: int) -> None:
        if count > self._limit:
            raise LanguageError(
                f"the language has more than {self._limit} states, too many to look at all of them: many steps may "
                "come in any order; ask for single words, or put some of the steps in order"
            )
