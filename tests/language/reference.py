"""What a network's words are, written from the definition: every choice made, every interleaving spelled out."""

from collections.abc import Iterator
from itertools import permutations, product

from understudy.network import Case, Component, Nab, Network

__all__ = ["linear_extensions", "words"]

Word = tuple[str, ...]


def linear_extensions(network: Network) -> set[Word]:
    """Of a flat network: all permutations that keep every link."""
    ids = [component.id for component in network.components]
    return {
        order
        for order in permutations(ids)
        if all(order.index(link.source) < order.index(link.target) for link in network.links)
    }


def words(network: Network, prefix: str = "") -> set[Word]:
    """The words of a network with networks in it, by paths.

    It may have cases with conditions of the world, loops with a number of rounds, and steps that are skipped; no
    duties, no switches, no network that is cut short.
    """
    each = [_own(part, prefix) for part in network.components]
    before = {part.id: {link.source for link in network.incoming[part.id]} for part in network.components}
    ids = [part.id for part in network.components]
    found: set[Word] = set()
    for chosen in product(*each):
        found |= set(_merged(dict(zip(ids, chosen, strict=True)), before))
    return found


def _own(part: Component | Nab, prefix: str) -> set[Word]:
    path = prefix + part.id
    if isinstance(part, Component):
        skipped = part.timeout is not None and part.timeout.then == "skip"
        return {(path,), ()} if skipped else {(path,)}
    once = {word for case in part.cases for word in words(case.network, _inside(path, case))}
    if all(case.when is not None for case in part.cases):
        once.add(())
    rounds = 1
    over = part.repeat is None or part.repeat.until is not None
    if part.repeat is not None:
        assert part.repeat.times is not None
        rounds = part.repeat.times
    found: set[Word] = set()
    so_far: set[Word] = {()}
    for number in range(1, rounds + 1):
        so_far = {first + then for first in so_far for then in once}
        if over or number == rounds:
            found |= so_far
        if all(case.when is not None for case in part.cases):
            found |= so_far  # a round with nothing to do is the last one
    return found


def _inside(path: str, case: Case) -> str:
    return f"{path}/{case.name}/" if case.name else f"{path}/"


def _merged(left: dict[str, Word], before: dict[str, set[str]]) -> Iterator[Word]:
    """Every order in which the words of all components can be interleaved, each after its predecessors' words."""
    done = {id_ for id_, word in left.items() if not word and all(not left[one] for one in before[id_])}
    if all(not word for word in left.values()):
        yield ()
        return
    for id_, word in left.items():
        if word and all(one in done or not left[one] for one in before[id_]) and _reached(id_, left, before):
            for rest in _merged({**left, id_: word[1:]}, before):
                yield (word[0], *rest)


def _reached(id_: str, left: dict[str, Word], before: dict[str, set[str]]) -> bool:
    """Whether everything that it waits for, and what that waits for, is over."""
    return all(not left[one] and _reached(one, left, before) for one in before[id_])
