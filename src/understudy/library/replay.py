"""What happened once, read against a task: with as few steps too many or too few as can be.

The task's language is an automaton; so is the graph of its ways. The steps of a word are read along it. Where the task
cannot follow, a step of the word is left out (it is *extra*), or a step of the task is done that the word has not (it
is *missing*). Of all readings the one with the fewest such places is taken, found by breadth-first search over pairs of
a state and a place in the word. A word that is read without any belongs to the language. There may be several best
readings, where two steps do the same.
"""

from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

from understudy.language import Language, by_path, symbol_of
from understudy.network import END, START, Component, Network, Topology

__all__ = ["Replay", "replays"]

_STATES = 20_000
"""A second's work at most, as for the rules."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Replay:
    """A word read against a task.

    Attributes:
        matched: places in the word, with the paths of the steps of the task that they are.
        extra: places of the steps that the task does not have there.
        missing: the paths of the steps of the task that the word does not have there.
    """

    matched: tuple[tuple[int, str], ...]
    extra: tuple[int, ...]
    missing: tuple[str, ...]

    @property
    def fits(self) -> bool:
        """Whether the word is one of the task's."""
        return not self.extra and not self.missing


def replays(word: Sequence[str], network: Network, *, shown: bool) -> Iterator[Replay]:
    """Reads a word against a task.

    Args:
        word: symbols (:func:`understudy.language.symbol_of`) in the order in which they happened.
        network: the task.
        shown: it was demonstrated. Then the steps that a direct way leads past belong to the task, too: somebody showed
            them, and that they are not done is what was learned of it (§5.2). A run never does them.

    Yields:
        All best readings, lazily, always in one order; none if the task has no word at all. The same one comes more
        than once where what is missing or extra can be passed over in several orders.

    Raises:
        LanguageError: the task can be done in too many orders to be looked at.
    """
    ways: _Ways = _Shown(network.topology) if shown and network.paths else _Done(network)
    symbols = {path: symbol_of(part) for path, part in network.walk() if isinstance(part, Component)}
    outset: _At = ways.start, 0
    places: dict[_At, int] = {outset: 0}  # how many places it takes to get there that do not go together
    came: dict[_At, list[tuple[_At, str]]] = {outset: []}
    waiting = deque([outset])
    over: set[_At] = set()
    ends: list[_At] = []
    while waiting:
        at = waiting.popleft()
        if at in over:
            continue
        over.add(at)
        state, place = at
        cost = places[at]
        if ends and cost > places[ends[0]]:
            break
        if place == len(word) and ways.complete(state):
            ends.append(at)
        after = ways.after(state)
        steps = [((target, place), path, 1) for path, target in after.items()]
        if place < len(word):
            steps += [((target, place + 1), path, 0) for path, target in after.items() if symbols[path] == word[place]]
            steps.append(((state, place + 1), "", 1))
        for target, path, more in steps:
            known = places.get(target)
            if known is None or cost + more < known:
                places[target], came[target] = cost + more, []
                (waiting.append if more else waiting.appendleft)(target)
            if cost + more == places[target]:
                came[target].append((at, path))
    for end in ends:
        yield from _readings(came, end)


def _readings(came: "Mapping[_At, Sequence[tuple[_At, str]]]", end: "_At") -> Iterator[Replay]:
    """All readings that lead to a state, from their ends."""
    way: list[tuple[_At, Iterator[tuple[_At, str]]]] = [(end, iter(came[end]))]
    read: list[tuple[int, int, str]] = []  # up to which place before and after it, and which step
    while way:
        at, before = way[-1]
        if not came[at]:
            yield _replay(read[::-1])
        step = next(before, None)
        if step is None:
            way.pop()
            del read[-1:]
            continue
        source, path = step
        read.append((source[1], at[1], path))
        way.append((source, iter(came[source])))


def _replay(read: Sequence[tuple[int, int, str]]) -> Replay:
    return Replay(
        matched=tuple((first, path) for first, last, path in read if path and first != last),
        extra=tuple(first for first, _, path in read if not path),
        missing=tuple(path for first, last, path in read if path and first == last),
    )


_State = int | str
_At = tuple[_State, int]
"""A state of the task, and the place in the word up to which was read."""


class _Ways(Protocol):
    """What may come after what."""

    start: _State

    def after(self, state: _State) -> Mapping[str, _State]: ...

    def complete(self, state: _State) -> bool: ...


class _Done:
    """The orders in which the task can be done."""

    def __init__(self, network: Network) -> None:
        self._states = Language(network, spell=by_path, limit=_STATES).states
        self.start: _State = self._states.start

    def after(self, state: _State) -> Mapping[str, _State]:
        assert isinstance(state, int)
        return dict(self._states.after(state))

    def complete(self, state: _State) -> bool:
        assert isinstance(state, int)
        return self._states.complete(state)


class _Shown:
    """The ways through a task with alternatives, those included that are never taken."""

    def __init__(self, topology: Topology) -> None:
        self._successors = topology.successors
        self.start: _State = START

    def after(self, state: _State) -> Mapping[str, _State]:
        assert isinstance(state, str)
        return {id_: id_ for id_ in self._successors[state] if id_ != END}

    def complete(self, state: _State) -> bool:
        assert isinstance(state, str)
        return END in self._successors[state]
