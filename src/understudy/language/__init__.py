"""The language of a task (§3.6): which sequences of achievements it allows, compared, counted, and checked by rules."""

from understudy.language.checking import Violation, check, violations
from understudy.language.comparison import Comparison, compare
from understudy.language.deterministic import MANY_STATES
from understudy.language.grammar import DROP_BEFORE_PICK_UP, RULES, Grammar
from understudy.language.language import Language, Membership, Word
from understudy.language.symbols import by_path, parse_word, symbol_of

__all__ = [
    "DROP_BEFORE_PICK_UP",
    "MANY_STATES",
    "RULES",
    "Comparison",
    "Grammar",
    "Language",
    "Membership",
    "Violation",
    "Word",
    "by_path",
    "check",
    "compare",
    "parse_word",
    "symbol_of",
    "violations",
]
