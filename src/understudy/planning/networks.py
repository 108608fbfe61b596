"""From a partial order to a behavior network: which link says what the plan needs.

A running task senses the goals of its skills, and nothing else of what the planner knows. So only a fact that is the
goal of the step which gives it can be asked for again. That the box was ``carried(orange, pink)`` is known from the
steps having been done, in order.

| reason | link |
| --- | --- |
| a step needs what an earlier one has as its goal | enabling |
| … all the while (:attr:`Way.keeps <understudy.behaviors.Way.keeps>`) | permanent |
| a step comes between two of which the later needs what the earlier has as its goal | permanent, from the earlier |
| a step needs what an earlier one gives besides its goal | ordering |
| a threat | ordering |

An enabling link asks for the goal of the earlier step at the moment when the later one begins, and it is so then: what
ends it has been put before the earlier step or after the later one. The third row is the box that is held on the way:
it must be so until ``Drop``, and what comes in between must not be done without it.

What the plan leaves unordered stays so, and the robot takes it as it comes.
"""

from dataclasses import dataclass

from understudy.behaviors import Instance
from understudy.network import Component, Link, LinkType, Network, component_ids, reduce_links
from understudy.planning.deordering import GOAL, START, PartialOrder

__all__ = ["Reason", "network_of", "reasons_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Reason:
    """Why one step is linked to another.

    Attributes:
        source, target: numbers of steps.
        type: of the link that it asks for.
        words: ``it gives holding(orange)``.
    """

    source: int
    target: int
    type: LinkType
    words: str


def reasons_of(plan: PartialOrder) -> tuple[Reason, ...]:
    """Every reason for a link, of which two steps may have several."""
    before, found = plan.before(), []
    for link in plan.links:
        one, other, fact = link.producer, link.consumer, link.fact
        if one == START:
            continue
        sensed = fact == plan.steps[one].goal
        if other != GOAL:
            kept = fact in plan.steps[other].keeps
            type_ = LinkType.ORDERING if not sensed else LinkType.PERMANENT if kept else LinkType.ENABLING
            when = " all the while" if kept else ""
            found.append(Reason(source=one, target=other, type=type_, words=f"{fact} is needed{when}"))
        until = "the end" if other == GOAL else plan.steps[other].name
        for between in range(len(plan.steps)):
            if sensed and one in before[between] and (other == GOAL or between in before[other]):
                words = f"{fact} is needed until {until}"
                found.append(Reason(source=one, target=between, type=LinkType.PERMANENT, words=words))
    for threat in plan.threats:
        which = "earlier" if threat.fact in plan.steps[threat.first].ends else "later"
        words = f"the {which} ends {threat.fact}"
        found.append(Reason(source=threat.first, target=threat.second, type=LinkType.ORDERING, words=words))
    return tuple(dict.fromkeys(found))


def network_of(plan: PartialOrder) -> Network:
    """The behavior network that does what a plan says: one component a step, between two the strongest link."""
    ids = component_ids(Instance(step.skill, tuple(step.parameters.items())) for step in plan.steps)
    strongest: dict[tuple[int, int], LinkType] = {}
    for reason in reasons_of(plan):
        pair = reason.source, reason.target
        strongest[pair] = max(reason.type, strongest.get(pair, reason.type), key=lambda type_: type_.strength)
    return reduce_links(
        Network(
            components=tuple(
                Component(id=id_, behavior=step.skill, parameters=step.parameters)
                for id_, step in zip(ids, plan.steps, strict=True)
            ),
            links=tuple(
                Link(source=ids[source], target=ids[target], type=type_)
                for (source, target), type_ in sorted(strongest.items())
            ),
        )
    )
