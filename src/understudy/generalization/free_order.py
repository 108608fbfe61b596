"""Several demonstrations of one task whose steps need not come in one order: what is left is the order that is needed.

The alternatives of §5.2 keep every order that was shown: a step that came at two places is two steps there, of which
one is bypassed. Here it is one step, and the task stays a plain network, which the robot executes as it comes across
things.

1. A step is the n-th time that a symbol comes in a demonstration. It belongs to the task if more than half of the
   demonstrations show it.
2. What every demonstration that shows both asks for by an enabling or a permanent link stays: something depends on it.
3. Of all the rest the order that explains the demonstrations best is kept (:mod:`.explaining`).
4. What a demonstration did otherwise is told as a deviation: every demonstration without one is a word of the task.

Which demonstration is given first matters for the ids of the steps alone, and for which of two equally typical numbers
is taken.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from understudy.errors import LearningError
from understudy.generalization.demonstrations import Demonstrated, Step, demonstrated
from understudy.generalization.explaining import COST, covers, explaining_order
from understudy.generalization.links import least_restrictive
from understudy.generalization.renaming import free_id
from understudy.generalization.values import merged_parameters
from understudy.network import Component, Link, LinkType, Network, reduce_links

__all__ = ["Deviation", "FreeOrder", "free_order"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Deviation:
    """Why one demonstration is no word of the task.

    Attributes:
        demonstration: its name.
        left_out: the steps that most others show, and it does not.
        extra: the steps that most others do not show, as it did them; they are not in the task.
        inverted: pairs of steps that it did in the other order, each written as the task has it.
    """

    demonstration: str
    left_out: tuple[str, ...]
    extra: tuple[Component, ...]
    inverted: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class FreeOrder:
    """A task that is ordered only where it is needed, and the demonstrations that are no words of it."""

    network: Network
    demonstrations: tuple[str, ...]
    deviations: tuple[Deviation, ...]


def free_order(tasks: Sequence[Network], *, names: Sequence[str] = (), cost: float = COST) -> FreeOrder:
    """The task of several demonstrations, with an order only where one is needed.

    Args:
        tasks: each learned from one demonstration, or from several; those of the latter are taken one by one, in the
            order of their intervals.
        names: of all of them, for what has no evidence of its own.
        cost: of an order, for each step from one end to the other; the more, the fewer orders are learned.

    Raises:
        LearningError: a task has more than steps and links, or no step is shown by more than half.
    """
    shown = demonstrated(tasks, names or [f"demonstration {number}" for number in range(1, len(tasks) + 1)])
    counted = Counter(step for one in shown for step in one.steps)
    common = {step for step, times in counted.items() if 2 * times > len(shown)}
    if not common:
        raise LearningError(
            f"no step is shown by more than half of the {len(shown)} demonstrations, so there is no task that "
            "they have in common; leave out --order free to learn them as alternatives"
        )
    parts = _components(shown, common)
    steps = sorted(common, key=lambda step: (_mean_place(step, shown), step))
    number = {step: index for index, step in enumerate(steps)}
    words = [[number[step] for step in one.steps if step in common] for one in shown]
    order = explaining_order(words, len(steps), _kept(steps, shown), cost=cost)
    pairs = [(steps[u], steps[v]) for u, v in zip(*np.nonzero(order), strict=True)]
    # Document order settles ties among steps that are free: the mean place, as the demonstrations had it.
    components = tuple(parts[step] for step in steps)
    ids = {step: part.id for step, part in parts.items()}
    links = tuple(_link(pair, ids, shown) for pair in pairs)
    needed = [(steps[u], steps[v]) for u, v in zip(*np.nonzero(covers(order)), strict=True)]
    deviations = tuple(filter(None, (_deviation(one, steps, pairs, needed, ids) for one in shown)))
    return FreeOrder(
        network=reduce_links(Network(components, links)),
        demonstrations=tuple(one.name for one in shown),
        deviations=deviations,
    )


def _components(shown: Sequence[Demonstrated], common: set[Step]) -> dict[Step, Component]:
    """The steps of the task, with all that was seen of each."""
    found: dict[Step, Component] = {}
    taken: set[str] = set()
    for one in shown:
        for step, part in one.steps.items():
            if step not in common:
                continue
            if step not in found:
                found[step] = replace(part, id=free_id(part.id, taken))
                taken.add(found[step].id)
                continue
            known = found[step]
            found[step] = replace(
                known,
                parameters=merged_parameters(known, part.occurrences),
                occurrences=(*known.occurrences, *part.occurrences),
            )
    return found


def _mean_place(step: Step, shown: Sequence[Demonstrated]) -> float:
    """From 0 to 1."""
    places = [one.place[step] / len(one.place) for one in shown if step in one.place]
    return sum(sorted(places)) / len(places)


def _kept(steps: Sequence[Step], shown: Sequence[Demonstrated]) -> NDArray[np.bool_]:
    """The pairs of which all that show both ask for more than an order, and two times of one symbol."""
    kept = np.zeros((len(steps), len(steps)), bool)
    for u, first in enumerate(steps):
        for v, last in enumerate(steps):
            same = first.symbol == last.symbol and first.time < last.time
            kept[u, v] = same or _type((first, last), shown) not in (None, LinkType.ORDERING)
    return kept


def _type(pair: tuple[Step, Step], shown: Sequence[Demonstrated]) -> LinkType | None:
    """The least restrictive link of all demonstrations that show both (Figure 5.6)."""
    types = [one.type_of(*pair) for one in shown if all(step in one.steps for step in pair)]
    if not types:
        return None
    least = types[0]
    for type_ in types[1:]:
        least = least_restrictive(least, type_)
    return least


def _link(pair: tuple[Step, Step], ids: dict[Step, str], shown: Sequence[Demonstrated]) -> Link:
    evidence = [found for one in shown if (found := one.evidence_of(*pair)) is not None]
    type_ = _type(pair, shown) or LinkType.ORDERING
    return Link(source=ids[pair[0]], target=ids[pair[1]], type=type_, evidence=tuple(evidence))


def _deviation(
    one: Demonstrated,
    steps: Sequence[Step],
    pairs: Sequence[tuple[Step, Step]],
    needed: Sequence[tuple[Step, Step]],
    ids: dict[Step, str],
) -> Deviation | None:
    place = one.place
    left_out = tuple(ids[step] for step in steps if step not in place)
    extra = tuple(part for step, part in one.steps.items() if step not in ids)
    # A step that was left out may stand between the two: then no direct pair tells of the inversion.
    looked_at = pairs if left_out else needed
    inverted = tuple((ids[u], ids[v]) for u, v in looked_at if u in place and v in place and place[v] < place[u])
    if not (left_out or extra or inverted):
        return None
    return Deviation(demonstration=one.name, left_out=left_out, extra=extra, inverted=inverted)
