"""Two tasks by their languages: what both can do, and what only one of them can."""

from collections import deque
from dataclasses import dataclass
from typing import Literal

from understudy.language.deterministic import Deterministic
from understudy.language.language import Language, Word

__all__ = ["Comparison", "compare"]

Relation = Literal["equal", "included", "includes", "overlapping", "disjoint"]

_Pair = tuple[int | None, int | None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """How the languages of two tasks lie to each other.

    Attributes:
        both: the shortest word of both; None if they have none in common.
        only_first: the shortest word that only the first one has; None if it has none.
        only_second: the shortest word that only the second one has.
    """

    both: Word | None
    only_first: Word | None
    only_second: Word | None

    @property
    def relation(self) -> Relation:
        """``equal``; the first is ``included`` in the second, or ``includes`` it; ``overlapping``; ``disjoint``."""
        if self.only_first is None:
            return "equal" if self.only_second is None else "included"
        if self.only_second is None:
            return "includes"
        return "disjoint" if self.both is None else "overlapping"


def compare(one: Language, other: Language) -> Comparison:
    """Compares two languages symbol by symbol, in both automata at once.

    Raises:
        LanguageError: together they have too many states.
    """
    first, second = one.states, other.states
    start: _Pair = (first.start, second.start)
    came: dict[_Pair, tuple[_Pair, str] | None] = {start: None}
    found: dict[tuple[bool, bool], _Pair] = {}
    waiting = deque([start])
    while waiting and len(found) < 3:
        pair = waiting.popleft()
        ends = pair[0] is not None and first.complete(pair[0]), pair[1] is not None and second.complete(pair[1])
        if any(ends):
            found.setdefault(ends, pair)
        after_first = first.after(pair[0]) if pair[0] is not None else {}
        after_second = second.after(pair[1]) if pair[1] is not None else {}
        for symbol in {**after_first, **after_second}:
            target = _hopeful(first, after_first.get(symbol)), _hopeful(second, after_second.get(symbol))
            if target not in came and target != (None, None):
                came[target] = pair, symbol
                waiting.append(target)

    def word(ends: tuple[bool, bool]) -> Word | None:
        if ends not in found:
            return None
        symbols: list[str] = []
        step = came[found[ends]]
        while step is not None:
            pair, symbol = step
            symbols.append(symbol)
            step = came[pair]
        return tuple(reversed(symbols))

    return Comparison(both=word((True, True)), only_first=word((True, False)), only_second=word((False, True)))


def _hopeful(states: Deterministic, state: int | None) -> int | None:
    """The state if the task can still be done from there."""
    return state if state is not None and states.hopeful(state) else None
