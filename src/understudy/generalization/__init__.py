"""A task from several demonstrations (§5): each new one is aligned with what is known, and merged into it.

What all show alike is done once; the rest becomes alternatives, of which some are bypassed for good. The task may be
used after any demonstration, and another one may always be added.

Where the demonstrations differ in their order alone, :func:`free_order` keeps of it only what is needed.
"""

from understudy.generalization.alignment import Match, align
from understudy.generalization.difference import Branch, Difference, Relaxed
from understudy.generalization.free_order import Deviation, FreeOrder, free_order
from understudy.generalization.merger import Added, Merger
from understudy.generalization.merging import Generalized, generalize
from understudy.generalization.symbols import Symbol, symbol_of

__all__ = [
    "Added",
    "Branch",
    "Deviation",
    "Difference",
    "FreeOrder",
    "Generalized",
    "Match",
    "Merger",
    "Relaxed",
    "Symbol",
    "align",
    "free_order",
    "generalize",
    "symbol_of",
]
