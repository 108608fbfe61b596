"""Why there is no plan: what cannot come about, or what cannot be so together."""

from collections.abc import Callable, Iterator, Sequence
from itertools import combinations

from understudy.behaviors import Fact
from understudy.planning.domain import Domain, Facts, Operator

__all__ = ["conflicts", "reachable", "unreachable"]


def reachable(domain: Domain, start: Facts) -> Facts:
    """Everything that could come about if nothing ever ended (delete relaxation). No plan reaches anything else."""
    facts = set(start)
    while new := {fact for one in domain.operators if one.needs <= facts for fact in one.gives} - facts:
        facts |= new
    return frozenset(facts)


def unreachable(domain: Domain, start: Facts, goal: Sequence[Fact]) -> tuple[str, ...]:
    """In words, what of a goal cannot come about, down to what no skill gives; nothing if all of it can."""
    facts, told = reachable(domain, start), set(start)
    lines = [line for fact in goal if fact not in facts for line in _because(domain, facts, fact, told)]
    return (*lines, *domain.silence) if lines else ()


def conflicts(domain: Domain, goal: Sequence[Fact], possible: Callable[[Sequence[Fact]], bool]) -> tuple[str, ...]:
    """In words, which smallest parts of a goal no plan reaches, though all could come about if nothing ever ended.

    Args:
        domain: what can be done.
        goal: no plan reaches all of it.
        possible: whether a plan reaches a part of it.
    """
    for size in range(1, len(goal)):
        if found := [part for part in combinations(goal, size) if not possible(part)]:
            return tuple(_never(domain, part) for part in found)
    return (_never(domain, goal),)


def _never(domain: Domain, part: Sequence[Fact]) -> str:
    if len(part) > 1:
        fewer = "each of them" if len(part) == 2 else f"any {len(part) - 1} of them"
        return f"{' and '.join(map(str, part))} cannot be so together, though {fewer} can"
    giver = next(one for one in domain.operators if part[0] in one.gives)
    needed = " and ".join(map(str, sorted(giver.needs)))
    return f"{part[0]} is given by {giver.skill}, and what it needs cannot be so together: {needed}"


def _because(domain: Domain, facts: Facts, fact: Fact, told: set[Fact]) -> Iterator[str]:
    """The chain from a fact down to what no skill gives; of several ways of a skill, the one that lacks least."""
    if fact in told:
        return
    told.add(fact)
    ways: dict[str, list[Operator]] = {}
    for operator in domain.operators:
        if fact in operator.gives:
            ways.setdefault(operator.skill, []).append(operator)
    if not ways:
        yield f"no skill gives {fact}"
    for skill, operators in ways.items():
        missing = min((sorted(one.needs - facts) for one in operators), key=len)
        yield f"{fact} is given by {skill}, which needs {' and '.join(map(str, missing))}"
        for further in missing:
            yield from _because(domain, facts, further, told)
