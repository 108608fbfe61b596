"""The language of a task (§3.6): every sequence in which it can achieve its goals, as a deterministic automaton.

The automaton is made as far as it is asked for. Whoever asks for all of it (is it finite, how many words, are two
languages equal) may meet a language with too many states: ``n`` steps in any order have ``2 ** n``. Membership and the
first words need only few of them.
"""

import math
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random

from understudy.errors import LanguageError
from understudy.language.automaton import Automaton, State
from understudy.language.symbols import Spelling, spelled
from understudy.network import Component, Network

__all__ = ["MANY_STATES", "Language", "Membership", "Word"]

Word = tuple[str, ...]
"""Symbols in the order of their achievement."""

MANY_STATES = 200_000
"""More states than this are refused: some ten seconds, and a few hundred megabytes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Membership:
    """Whether a word belongs to a language, and if not, where it leaves it.

    Attributes:
        word: that was asked for.
        begins: so many of its symbols some run of the task begins with.
        complete: the task is done after these.
        allowed: the symbols that can come next then, in a run that gets done if there is any.
    """

    word: Word
    begins: int
    complete: bool
    allowed: Word

    @property
    def member(self) -> bool:
        """Whether the word is in the language: the task can be done just so."""
        return self.begins == len(self.word) and self.complete


class Language:
    """The words of one task.

    Words are found in a fixed order: the shortest first, those of one length by the order of the steps in the task.

    Args:
        network: the task.
        spell: the symbol of each behavior; by default what it does, ``Track(orange)``.
        limit: refuse to make more states than this.
    """

    def __init__(self, network: Network, *, spell: Spelling = spelled, limit: int = MANY_STATES) -> None:
        self.automaton = Automaton(network)
        self.limit = limit
        parts = [(path, part) for path, part in network.walk() if isinstance(part, Component)]
        self.symbol = {path: spell(path, part) for path, part in parts}
        self.symbols: Word = tuple(dict.fromkeys(self.symbol.values()))
        self._rank = {path: index for index, path in enumerate(self.symbol)}
        self._sets: list[frozenset[State]] = []
        self._numbers: dict[frozenset[State], int] = {}
        self._after: list[Mapping[str, int] | None] = []
        self._bounds: list[tuple[float, float]] = []
        self._hopeful: dict[int, bool] = {}
        self.start = self._number({self.automaton.start})

    # -- the deterministic automaton --------------------------------------------------------------------------

    def after(self, state: int) -> Mapping[str, int]:
        """Where each symbol leads that can come next, in the order of the steps.

        Raises:
            LanguageError: the language has too many states.
        """
        found = self._after[state]
        if found is None:
            reached: dict[str, set[State]] = {}
            for one in self._sets[state]:
                for path, target in self.automaton.moves(one):
                    if path is not None:
                        reached.setdefault(path, set()).add(target)
            targets: dict[str, set[State]] = {}
            for path in sorted(reached, key=self._rank.__getitem__):
                targets.setdefault(self.symbol[path], set()).update(reached[path])
            found = self._after[state] = {symbol: self._number(ones) for symbol, ones in targets.items()}
        return found

    def complete(self, state: int) -> bool:
        """Whether the task is done there."""
        return any(self.automaton.complete(one) for one in self._sets[state])

    def hopeful(self, state: int) -> bool:
        """Whether the task can still be done from there."""
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

    def _number(self, states: set[State]) -> int:
        """The number of a set of states, with everything that silent moves lead to."""
        closed, new = set(states), list(states)
        while new:
            for path, target in self.automaton.moves(new.pop()):
                if path is None and target not in closed:
                    closed.add(target)
                    new.append(target)
            if len(closed) > self.limit:
                raise LanguageError(self._too_many())
        key = frozenset(closed)
        number = self._numbers.get(key)
        if number is None:
            number = len(self._sets)
            if number >= self.limit:
                raise LanguageError(self._too_many())
            self._numbers[key] = number
            self._sets.append(key)
            self._after.append(None)
            low, high = zip(*map(self.automaton.bounds, key), strict=True)
            self._bounds.append((min(low), max(high)))
        return number

    def _too_many(self) -> str:
        return (
            f"the language has more than {self.limit} states, too many to look at all of them: many steps may come in "
            "any order; ask for single words, or order some of the steps"
        )

    def _all(self) -> list[int]:
        """Every state from which the task can be done."""
        order, found = [self.start], {self.start}
        for state in order:
            new = [target for target in dict.fromkeys(self.after(state).values()) if target not in found]
            found.update(new)
            order += new
        before: dict[int, list[int]] = {state: [] for state in order}
        for state in order:
            for target in self.after(state).values():
                before[target].append(state)
        ways = [state for state in order if self.complete(state)]
        hopeful = set(ways)
        for state in ways:
            ways += (new := [one for one in dict.fromkeys(before[state]) if one not in hopeful])
            hopeful.update(new)
        self._hopeful = {state: state in hopeful for state in order}
        return [state for state in order if state in hopeful]

    # -- what can be asked ------------------------------------------------------------------------------------

    def follow(self, word: Sequence[str]) -> int | None:
        """The state after the first symbols of a run; None if no run begins with them."""
        state: int | None = self.start
        for symbol in word:
            state = self.after(state).get(symbol) if state is not None else None
        return state

    def membership(self, word: Sequence[str]) -> Membership:
        """Whether a word is in the language; if not, where it leaves it, and what would have been allowed there."""
        state, begins = self.start, 0
        for symbol in word:
            target = self.after(state).get(symbol)
            if target is None or (self.hopeful(state) and not self.hopeful(target)):
                break
            state, begins = target, begins + 1
        after = self.after(state)
        allowed = [symbol for symbol, target in after.items() if self.hopeful(target)] or list(after)
        return Membership(word=tuple(word), begins=begins, complete=self.complete(state), allowed=tuple(allowed))

    def __contains__(self, word: Sequence[str]) -> bool:
        return self.membership(word).member

    def words(self, *, longest: float = math.inf) -> Iterator[Word]:
        """The words, the shortest first, lazily.

        Args:
            longest: no longer ones.
        """
        low, high = self._bounds[self.start]
        if math.isinf(low) or not self.hopeful(self.start):
            return
        length = int(low)
        while length <= min(high, longest):
            found = False
            for word in self._of_length(length):
                found = True
                yield word
            length += 1
            if not found and math.isinf(high) and length > self.longest:
                return

    def _of_length(self, length: int) -> Iterator[Word]:
        """The words of one length; which states have no word left of which length is remembered on the way."""
        barren: set[tuple[int, int]] = set()
        word: list[str] = []
        way = [(self.start, iter(self.after(self.start).items() if length else ()))]
        fruitful = [self.complete(self.start) and not length]
        if fruitful[0]:
            yield ()
        while way:
            state, options = way[-1]
            left = length - len(word)
            step = next(options, None)
            if step is None:
                way.pop()
                if not (bears := fruitful.pop()):
                    barren.add((state, left))
                if way:
                    word.pop()
                    fruitful[-1] |= bears
                continue
            symbol, target = step
            low, high = self._bounds[target]
            if not low <= left - 1 <= high or (target, left - 1) in barren:
                continue
            word.append(symbol)
            ends = left == 1
            way.append((target, iter(() if ends else self.after(target).items())))
            fruitful.append(ends and self.complete(target))
            if fruitful[-1]:
                yield tuple(word)

    @property
    def finite(self) -> bool:
        """Whether there are only so many words.

        Raises:
            LanguageError: the language has too many states.
        """
        return math.isfinite(self.longest)

    @cached_property
    def longest(self) -> float:
        """The length of the longest word; infinity if there is none, -1 if there is no word at all."""
        states = set(self._all())
        if self.start not in states:
            return -1
        waiting = dict.fromkeys(states, 0)
        for state in states:
            for target in set(self.after(state).values()) & states:
                waiting[target] += 1
        ready = deque(state for state, count in waiting.items() if not count)
        length: dict[int, int] = {self.start: 0}
        longest = done = 0
        while ready:
            state = ready.popleft()
            done += 1
            if self.complete(state):
                longest = max(longest, length[state])
            for target in set(self.after(state).values()) & states:
                length[target] = max(length.get(target, 0), length[state] + 1)
                waiting[target] -= 1
                if not waiting[target]:
                    ready.append(target)
        return longest if done == len(states) else math.inf

    def count(self, *, longest: float = math.inf) -> int | None:
        """How many words there are; None if there is no end to them.

        Args:
            longest: only words of at most so many symbols.

        Raises:
            LanguageError: the language has too many states.
        """
        length = min(longest, self.longest)
        if math.isinf(length):
            return None
        return self._counts(int(length))(self.start, int(length)) if length >= 0 else 0

    def sample(self, random: Random, *, longest: float = math.inf) -> Word:
        """A word by chance, each of those of at most ``longest`` symbols as likely as any other.

        Raises:
            LanguageError: there is no word, no end to them, or too many states.
        """
        length = min(longest, self.longest)
        if math.isinf(length):
            raise LanguageError("there is no end to the words of this task; say how long they may be at most")
        total = self.count(longest=length)
        if not total:
            raise LanguageError("this task has no word" + (f" of at most {longest:g} symbols" if length >= 0 else ""))
        count, state, left, word = self._counts(int(length)), self.start, int(length), list[str]()
        while True:
            drawn = random.randrange(count(state, left))
            if self.complete(state):
                if not drawn:
                    return tuple(word)
                drawn -= 1
            for symbol, target in self.after(state).items():
                share = count(target, left - 1)
                if drawn < share:
                    word.append(symbol)
                    state, left = target, left - 1
                    break
                drawn -= share

    def _counts(self, longest: int) -> Callable[[int, int], int]:
        """How many words of at most so many symbols there are from a state on."""
        states = self._all()
        table = [{state: int(self.complete(state)) for state in states}]
        for _ in range(longest):
            last = table[-1]
            table.append(
                {
                    state: int(self.complete(state)) + sum(last.get(one, 0) for one in self.after(state).values())
                    for state in states
                }
            )
        return lambda state, left: table[left].get(state, 0) if left >= 0 else 0
