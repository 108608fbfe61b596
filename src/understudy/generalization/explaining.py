"""Which order of steps explains demonstrations best (beyond §5, which never frees an order that it has seen).

Eight people who keep one order may do so by need or by habit. What tells the two apart is how often they could have
done otherwise. So a partial order is judged by how well it foretells the demonstrations:

*Likelihood.* Whoever demonstrates does one of the steps that are ready, each as likely as any other; and once in a
while, by ``SLIP``, any step that is left. An order that leaves fewer choices foretells more, as long as it is kept
(the size principle): that u was waited for though v could have been done, again and again, is evidence for u before v.

*Cost.* Each order that no other implies costs ``COST`` for every step from the one end to the other, on the average.
A step is done for the sake of another one soon before it; two that merely happen to come in one order lie far apart.

The search begins with all orders that no demonstration contradicts, and takes out or adds one pair at a time, always
the one that helps most, until none does. With n steps and d demonstrations a look at one pair costs d × n, and there
are up to n² pairs; it is a matter of milliseconds for twenty steps.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["COST", "covers", "explaining_order"]

Order = NDArray[np.bool_]
"""Shape ``(steps, steps)``: the row comes before the column. Transitive, and without circles."""

SLIP = 0.03
"""How likely a step is out of turn. A tenth of that, or three times as much, gives nearly the same orders."""

COST = 0.15
"""In natural units of the log likelihood, for each step from one end to the other. Chosen by cross-validation on twelve
recipes (docs/generalization.md); from 0.05 to 0.4 the score hardly changes."""

WORTH_IT = 1e-9
"""Less is rounding."""


def explaining_order(
    words: Sequence[Sequence[int]], count: int, kept: Order | None = None, *, cost: float = COST
) -> Order:
    """The order of steps that explains the words best.

    Args:
        words: the steps of each demonstration by number, each at most once.
        count: how many steps there are.
        kept: pairs that are never freed; those that some word contradicts are not kept.
        cost: of an order, for each step from one end to the other.
    """
    likelihood = _Likelihood(words, count, cost)
    order = likelihood.never_contradicted()
    kept = order & kept if kept is not None else np.zeros_like(order)
    ready = np.stack([likelihood.ready(order[:, step]) for step in range(count)], axis=1)
    value = likelihood(ready) - likelihood.cost(order)
    while True:
        best, change = value + WORTH_IT, None
        for u, v in _changes(order, kept):
            order[u, v] ^= True
            changed = ready.copy()
            changed[:, v] = likelihood.ready(order[:, v])
            now = likelihood(changed) - likelihood.cost(order)
            order[u, v] ^= True
            if now > best:
                best, change = now + WORTH_IT, (u, v, changed, now)
        if change is None:
            return order
        u, v, ready, value = change
        order[u, v] ^= True


def covers(order: Order) -> Order:
    """The pairs that no others imply."""
    found: Order = order & ~(order @ order)
    return found


def _changes(order: Order, kept: Order) -> Iterator[tuple[int, int]]:
    """Every pair that alone can be taken out of an order, or put in, so that it stays one."""
    free = covers(order) & ~kept
    # Put in: all that come before u come before v, and all that come after v after u.
    before_u_only = order.T @ ~order
    after_v_only = ~order @ order.T
    free |= ~(order | order.T | before_u_only | after_v_only | np.eye(len(order), dtype=bool))
    yield from zip(*(column.tolist() for column in np.nonzero(free)), strict=True)


class _Likelihood:
    """How likely the words are, by when each step is ready. All arrays have a row for each word."""

    def __init__(self, words: Sequence[Sequence[int]], count: int, cost: float) -> None:
        length = max(map(len, words), default=0)
        self.place = np.full((len(words), count), -1)
        for row, word in zip(self.place, words, strict=True):
            row[list(word)] = np.arange(len(word))
        self.shown = self.place >= 0
        left = self.shown.sum(axis=1)[:, None] - np.arange(length)
        self.in_word = left > 0
        self.any_left = SLIP / np.maximum(left, 1)
        self.row, self.step = np.nonzero(self.shown)
        both = self.shown[:, :, None] & self.shown[:, None, :]
        apart = self.place[:, None, :] - self.place[:, :, None]
        self.never = ~(both & (apart < 0)).any(axis=0) & both.any(axis=0) & ~np.eye(count, dtype=bool)
        self.price = cost * np.where(both, abs(apart), 0).sum(axis=0) / np.maximum(both.sum(axis=0), 1)

    def never_contradicted(self) -> Order:
        """The orders that all words keep which have both ends; where these run in a circle, none of the circle's."""
        order: Order = self.never.copy()
        for middle in range(len(order)):
            order |= np.outer(order[:, middle], order[middle])
        return order & ~order.T

    def cost(self, order: Order) -> float:
        return float(self.price[covers(order)].sum())

    def ready(self, before: NDArray[np.bool_]) -> NDArray[np.int_]:
        """At which place the last of some steps was done; what a word leaves out is not waited for."""
        found: NDArray[np.int_] = self.place[:, before].max(axis=1, initial=-1)
        return found

    def __call__(self, ready: NDArray[np.int_]) -> float:
        place, since = self.place[self.row, self.step], ready[self.row, self.step]
        in_turn = since < place
        width = self.in_word.shape[1] + 1
        changes = np.zeros((len(self.place), width), np.int_)
        np.add.at(changes, (self.row[in_turn], since[in_turn] + 1), 1)
        np.add.at(changes, (self.row[in_turn], place[in_turn] + 1), -1)
        choices = changes.cumsum(axis=1)[:, :-1]
        turn = np.zeros(self.in_word.shape)
        turn[self.row, place] = in_turn
        chance = (1 - SLIP) * turn / np.maximum(choices, 1) + self.any_left
        return float(np.log(chance[self.in_word]).sum())
