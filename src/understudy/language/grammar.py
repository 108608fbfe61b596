"""Rules for the order of steps as regular grammars, and the one of §3.6: nothing is picked up with a full gripper."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from understudy.errors import LanguageError
from understudy.language.symbols import behavior_of

__all__ = ["DROP_BEFORE_PICK_UP", "RULES", "Grammar"]

_PRODUCTION = re.compile(r"(\w+)\s*(?:→|->)\s*(.+)")


@dataclass(frozen=True)
class Grammar:
    """A right-linear grammar, whose every production is ``S → ε`` or ``S → t S``.

    Its letters stand for the symbols of a task: for a behavior with any words, ``PickUp``, or with these,
    ``PickUp(orange)``, which goes before. Symbols for which no letter stands may come anywhere.

    Attributes:
        name: of the rule.
        says: what it asks for, as a sentence without a full stop.
        productions: one for each line or semicolon, alternatives with ``|``; the first one's left side is the start.
        letters: behaviors or symbols by the letters of the productions.

    Raises:
        LanguageError: this is no right-linear grammar.
    """

    name: str
    says: str
    productions: str
    letters: Mapping[str, str]

    def __post_init__(self) -> None:
        _ = self._rules
        for left, letter, right in self._rules:
            if letter and letter not in self.letters:
                raise LanguageError(f"{self.name}: no behavior is given for the letter {letter!r} of {left} → …")
            if right and right not in self._left:
                raise LanguageError(f"{self.name}: nothing says what becomes of {right!r}")

    @cached_property
    def _rules(self) -> tuple[tuple[str, str, str], ...]:
        """Left side, letter, right side; the latter two empty for ε."""
        rules: list[tuple[str, str, str]] = []
        for line in re.split(r"[;\n]", self.productions):
            if not line.strip():
                continue
            match = _PRODUCTION.fullmatch(line.strip())
            for alternative in match[2].split("|") if match else ("?",):
                words = alternative.split()
                if match is None or not (words in (["ε"], ["eps"]) or len(words) == 2):
                    raise LanguageError(
                        f"{self.name}: a production is written as S → t S or S → ε, given {line.strip()!r}"
                    )
                rules.append((match[1], *(("", "") if len(words) == 1 else (words[0], words[1]))))
        if not rules:
            raise LanguageError(f"{self.name}: a grammar has at least one production")
        return tuple(rules)

    @cached_property
    def _left(self) -> frozenset[str]:
        return frozenset(left for left, _, _ in self._rules)

    @property
    def start(self) -> frozenset[str]:
        """What a word is derived from, before its first symbol."""
        return frozenset((self._rules[0][0],))

    def letter_of(self, symbol: str) -> str | None:
        """The letter that stands for a symbol; None if none does."""
        by_meaning = {meaning: letter for letter, meaning in self.letters.items()}
        return by_meaning.get(symbol, by_meaning.get(behavior_of(symbol)))

    def after(self, open_: frozenset[str], symbol: str) -> frozenset[str]:
        """What can still be derived after another symbol; nothing if the rule is broken by it."""
        letter = self.letter_of(symbol)
        if letter is None:
            return open_
        return frozenset(right for left, one, right in self._rules if left in open_ and one == letter)

    @cached_property
    def reachable(self) -> frozenset[frozenset[str]]:
        """Everything from which the rest of a word may have to be derived, the rule being kept so far."""
        found, new = {self.start}, [self.start]
        while new:
            open_ = new.pop()
            for meaning in self.letters.values():
                after = self.after(open_, meaning)
                if after and after not in found:
                    found.add(after)
                    new.append(after)
        return frozenset(found)

    def neutral(self, symbol: str) -> bool:
        """Whether a symbol changes nothing, wherever it comes."""
        return all(self.after(open_, symbol) == open_ for open_ in self.reachable)

    @property
    def open_ended(self) -> bool:
        """Whether the rule says nothing of how a word ends: it can only be broken by a symbol."""
        return all(map(self.ends, self.reachable))

    def ends(self, open_: frozenset[str]) -> bool:
        """Whether a word may end here."""
        return any(left in open_ and not letter for left, letter, _ in self._rules)


DROP_BEFORE_PICK_UP = Grammar(
    name="drop before picking up",
    says="before every PickUp there is a Drop, after the PickUp before it or the beginning",
    # §3.6 as its text has it: a Drop "somewhere in the sequence preceding". Its grammar lacks A → t A, and would so ask
    # for the Drop directly before; no transport task of the dissertation is so.
    productions="S → ε | t S | d S | d A; A → t A | p S",
    letters={"t": "Track", "d": "Drop", "p": "PickUp"},
)

RULES = (DROP_BEFORE_PICK_UP,)
"""What every task is checked for."""
