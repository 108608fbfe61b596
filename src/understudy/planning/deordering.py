"""A plan with as much freedom as its reasons allow: causal links and threats (§3.3.1).

A planner puts steps one after the other, also those between which nothing demands an order. What does is found so:

1. **Causal links.** Each step needs some facts, and so does the goal. Of the steps before it that give such a fact,
   the first after which nothing ends it again is its producer. If it has been so from the start, the start is.
2. **Threats.** A step that ends the fact of a causal link must not come between the two: it comes before the producer
   if it does so in the plan, else after the consumer.

The steps are ordered by their causal links and threats, and by nothing else. Since no causal link can be broken in any
order that keeps these, every such order is a plan, too. Steps that nobody needs are left out. It is a deordering in the
sense of Bäckström: orders are only taken away; another order of the steps may leave more freedom.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from understudy.behaviors import Fact
from understudy.planning.domain import Facts, Operator

__all__ = ["GOAL", "START", "CausalLink", "PartialOrder", "Threat", "deordered"]

START, GOAL = -1, -2
"""Instead of a step: what is so at the start, and what shall be so at the end."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CausalLink:
    """``producer`` gives ``fact``, which ``consumer`` needs; numbers of steps, :data:`START` or :data:`GOAL`."""

    producer: int
    fact: Fact
    consumer: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Threat:
    """``first`` comes before ``second``, since one of them ends ``fact``, which the other gives or needs."""

    first: int
    fact: Fact
    second: int


@dataclass(frozen=True, slots=True, kw_only=True)
class PartialOrder:
    """Steps, and why which come before which.

    Attributes:
        steps: in the order of the plan that it was made from.
        links: why a step is there.
        threats: what else orders steps.
    """

    steps: tuple[Operator, ...]
    links: tuple[CausalLink, ...]
    threats: tuple[Threat, ...]

    def before(self) -> tuple[frozenset[int], ...]:
        """For each step all that come before it, directly or not."""
        found: list[frozenset[int]] = []
        for number in range(len(self.steps)):
            direct = {link.producer for link in self.links if link.consumer == number} - {START}
            direct |= {threat.first for threat in self.threats if threat.second == number}
            found.append(frozenset(direct).union(*(found[one] for one in direct)))
        return tuple(found)


def deordered(plan: Sequence[Operator], start: Facts, goal: Facts) -> PartialOrder:
    """The partial order of a plan.

    Args:
        plan: steps that lead from the start to the goal.
        start: what is so at first.
        goal: what shall be so at the end.

    Raises:
        ValueError: they do not lead there.
    """
    steps = list(plan)
    while True:
        links = _links(steps, start, goal)
        needed = {link.producer for link in links} - {START}
        if len(needed) == len(steps):
            return PartialOrder(steps=tuple(steps), links=links, threats=_threats(steps, links))
        steps = [step for number, step in enumerate(steps) if number in needed]


def _links(steps: Sequence[Operator], start: Facts, goal: Facts) -> tuple[CausalLink, ...]:
    links: list[CausalLink] = []
    producer = dict.fromkeys(start, START)
    for number, step in enumerate(steps):
        for fact in sorted(step.needs):
            if fact not in producer:
                raise ValueError(f"{step.name} needs {fact}, which is not so then")
            links.append(CausalLink(producer=producer[fact], fact=fact, consumer=number))
        for fact in step.ends:
            producer.pop(fact, None)
        for fact in step.gives:
            producer.setdefault(fact, number)
    for fact in sorted(goal):
        if fact not in producer:
            raise ValueError(f"{fact} is not so at the end")
        links.append(CausalLink(producer=producer[fact], fact=fact, consumer=GOAL))
    return tuple(links)


def _threats(steps: Sequence[Operator], links: Sequence[CausalLink]) -> tuple[Threat, ...]:
    found: dict[Threat, None] = {}
    for link in links:
        for number, step in enumerate(steps):
            if number in (link.producer, link.consumer) or link.fact not in step.ends:
                continue
            if number < link.producer:
                found[Threat(first=number, fact=link.fact, second=link.producer)] = None
            else:
                found[Threat(first=link.consumer, fact=link.fact, second=number)] = None
    return tuple(found)
