"""The language of a task (§3.6): every sequence in which it can achieve its goals.

Whoever asks for all of it (is it finite, how many words, are two languages equal) may meet one with too many states:
``n`` steps in any order have ``2 ** n``. Membership and the first words need only few of them.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random

from understudy.errors import LanguageError
from understudy.language.deterministic import MANY_STATES, Deterministic
from understudy.language.symbols import Spelling, spelled
from understudy.network import Network

__all__ = ["Language", "Membership", "Word"]

Word = tuple[str, ...]
"""Symbols in the order of their achievement."""

_Count = Callable[[int, float], int]
"""How many words of at most so many symbols there are from a state on."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Membership:
    """Whether a word belongs to a language, and if not, where it leaves it.

    Attributes:
        word: that was asked for.
        begins: so many of its symbols some run of the task begins with.
        complete: the task can be done after these.
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

    Attributes:
        states: the automaton.
        symbols: the alphabet, in the order of the steps.
    """

    def __init__(self, network: Network, *, spell: Spelling = spelled, limit: int = MANY_STATES) -> None:
        self.states = Deterministic(network, spell, limit=limit)
        self.symbols: Word = tuple(dict.fromkeys(self.states.symbol.values()))
        self._counted: dict[float, _Count] = {}

    def membership(self, word: Sequence[str]) -> Membership:
        """Whether a word is in the language; if not, where it leaves it, and what would have been allowed there."""
        states = self.states
        state, begins = states.start, 0
        for symbol in word:
            target = states.after(state).get(symbol)
            if target is None or (states.hopeful(state) and not states.hopeful(target)):
                break
            state, begins = target, begins + 1
        after = states.after(state)
        allowed = [symbol for symbol, target in after.items() if states.hopeful(target)] or list(after)
        return Membership(word=tuple(word), begins=begins, complete=states.complete(state), allowed=tuple(allowed))

    def __contains__(self, word: Sequence[str]) -> bool:
        return self.membership(word).member

    def words(self, *, longest: float = math.inf) -> Iterator[Word]:
        """The words, the shortest first, lazily.

        Args:
            longest: no longer ones.
        """
        low, high = self.states.bounds(self.states.start)
        if math.isinf(low) or not self.states.hopeful(self.states.start):
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
        """The words of one length; from which states none of the rest's length is left is remembered on the way."""
        states = self.states
        barren: set[tuple[int, int]] = set()
        word: list[str] = []
        fruitful = [not length and states.complete(states.start)]
        way = [(states.start, iter(states.after(states.start).items() if length else ()))]
        if fruitful[0]:
            yield ()
        while way:
            left = length - len(word)
            step = next(way[-1][1], None)
            if step is None:
                state, _ = way.pop()
                bears = fruitful.pop()
                if not bears:
                    barren.add((state, left))
                if way:
                    word.pop()
                    fruitful[-1] |= bears
                continue
            symbol, target = step
            low, high = states.bounds(target)
            if not low <= left - 1 <= high or (target, left - 1) in barren:
                continue
            word.append(symbol)
            fruitful.append(left == 1 and states.complete(target))
            way.append((target, iter(() if left == 1 else states.after(target).items())))
            if fruitful[-1]:
                yield tuple(word)

    @cached_property
    def longest(self) -> float:
        """The length of the longest word; infinity if there is none, -1 if there is no word at all.

        Raises:
            LanguageError: the language has too many states.
        """
        states = self.states
        if states.order is None:
            return math.inf
        left: dict[int, int] = {}
        for state in reversed(states.order):
            left[state] = max((left[one] + 1 for one in states.after(state).values() if one in left), default=0)
        return left.get(states.start, -1)

    @property
    def finite(self) -> bool:
        """Whether there are only so many words.

        Raises:
            LanguageError: the language has too many states.
        """
        return math.isfinite(self.longest)

    def count(self, *, longest: float = math.inf) -> int | None:
        """How many words there are; None if there is no end to them.

        Args:
            longest: only words of at most so many symbols.

        Raises:
            LanguageError: the language has too many states.
        """
        if math.isinf(longest) and not self.finite:
            return None
        return self._counts(longest)(self.states.start, longest)

    def sample(self, random: Random, *, longest: float = math.inf) -> Word:
        """A word by chance, each of those of at most ``longest`` symbols as likely as any other.

        Raises:
            LanguageError: there is no word, no end to them, or too many states.
        """
        total = self.count(longest=longest)
        if total is None:
            raise LanguageError("there is no end to the words of this task; say how long they may be at most")
        if not total:
            raise LanguageError(
                "this task has no word" + ("" if math.isinf(longest) else f" of at most {longest:g} steps")
            )
        # The drawn one of all words, in the order in which they branch.
        states, count, word = self.states, self._counts(longest), list[str]()
        number, state, left = random.randrange(total), states.start, longest
        while not (states.complete(state) and number == 0):
            number -= states.complete(state)
            left -= 1
            for symbol, target in states.after(state).items():
                share = count(target, left)
                if number < share:
                    word.append(symbol)
                    state = target
                    break
                number -= share
        return tuple(word)

    def _counts(self, longest: float) -> _Count:
        if longest not in self._counted:
            finite = self.states.order is not None and longest >= self.longest
            self._counted[longest] = self._counts_of_all() if finite else self._counts_up_to(int(longest))
        return self._counted[longest]

    def _counts_of_all(self) -> _Count:
        states = self.states
        words: dict[int, int] = {}
        for state in reversed(states.order or ()):
            words[state] = states.complete(state) + sum(words.get(one, 0) for one in states.after(state).values())
        return lambda state, left: words.get(state, 0)

    def _counts_up_to(self, longest: int) -> _Count:
        states = self.states
        table = [{state: int(states.complete(state)) for state in states.useful}]
        for _ in range(longest):
            last = table[-1]
            table.append(
                {
                    state: states.complete(state) + sum(last.get(one, 0) for one in states.after(state).values())
                    for state in states.useful
                }
            )
        return lambda state, left: table[int(left)].get(state, 0) if left >= 0 else 0
