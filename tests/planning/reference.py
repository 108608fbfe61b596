"""Planning as its definition says, slowly: every order is tried, and every state is looked at."""

from collections import deque
from collections.abc import Collection, Iterable, Iterator, Sequence

from understudy.behaviors import Fact
from understudy.network import Link, Network
from understudy.planning import Operator

Facts = frozenset[Fact]


def carried_out(steps: Iterable[Operator], start: Facts) -> Facts:
    """What is so after these steps; each must find what it needs."""
    facts = set(start)
    for step in steps:
        assert step.needs <= facts, f"{step.name} lacks {set(map(str, step.needs - facts))}"
        for fact in step.ends:
            facts.discard(fact)
        for fact in step.gives:
            facts.add(fact)
    return frozenset(facts)


def fewest_steps(operators: Collection[Operator], start: Facts, goal: Facts) -> int | None:
    """The length of a shortest plan, by looking at every state; None if there is none."""
    seen, open_ = {start}, deque([(start, 0)])
    while open_:
        facts, steps = open_.popleft()
        if goal <= facts:
            return steps
        for one in operators:
            if one.needs <= facts:
                after = frozenset((facts - one.ends) | one.gives)
                if after not in seen:
                    seen.add(after)
                    open_.append((after, steps + 1))
    return None


def orders(network: Network) -> Iterator[tuple[int, ...]]:
    """Every order of the components that the links allow, as numbers of components."""
    number = {component.id: index for index, component in enumerate(network.components)}
    before: list[set[int]] = [set() for _ in network.components]
    for link in network.links:
        before[number[link.target]].add(number[link.source])

    def further(done: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
        if len(done) == len(before):
            yield done
        for index, needed in enumerate(before):
            if index not in done and needed <= set(done):
                yield from further((*done, index))

    return further(())


def check_links(network: Network, steps: Sequence[Operator], order: Sequence[int], start: Facts) -> None:
    """In one order, what a robot would sense: what enabling and permanent links ask for holds (semantics §2)."""
    number = {component.id: index for index, component in enumerate(network.components)}
    facts = start
    for index in order:
        after = carried_out([steps[index]], facts)
        for link in network.links:
            if number[link.target] == index:
                sensed = steps[number[link.source]].goal
                assert link.type == "ordering" or sensed in facts, _told(link)
                # Until its own goal is reached; what a skill keeps it may end when it is done.
                kept = sensed in steps[index].keeps
                assert link.type != "permanent" or kept or sensed in after, _told(link)
        facts = after


def _told(link: Link) -> str:
    return f"{link.source} to {link.target}, {link.type}"
