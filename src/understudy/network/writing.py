"""From a network to the parts of its document."""

from understudy.network.conditions import (
    Achieved,
    After,
    AllOf,
    AnyOf,
    Complete,
    Condition,
    Happened,
    Holds,
    Not,
    Possible,
    TimedOut,
)
from understudy.network.controls import Repeat, Timeout, Trigger
from understudy.network.definition import Case, Component, Link, Nab, Network
from understudy.network.parts import (
    BehaviorPart,
    CasePart,
    ComponentPart,
    ConditionPart,
    InhibitionPart,
    LinkEvidencePart,
    LinkPart,
    NetworkPart,
    OccurrencePart,
    PathPart,
    RepeatPart,
    SwitchPart,
    TimeoutPart,
    TriggerPart,
)

__all__ = ["component_part", "condition_part", "network_part"]


def network_part(network: Network) -> NetworkPart:
    """Everything that a network says, at every depth.

    Raises:
        ValidationError: an id, or another text, is none that a document can have.
    """
    return NetworkPart(
        components=tuple(map(component_part, network.components)),
        links=tuple(map(_link, network.links)),
        inhibitions=tuple(InhibitionPart(source=source, target=target) for source, target in network.inhibitions),
        paths=tuple(PathPart(source=step.source, target=step.target, shown=step.shown) for step in network.paths),
    )


def component_part(component: Component | Nab) -> ComponentPart:
    """A component, or a network in its place."""
    until = condition_part(component.until) if component.until is not None else None
    timeout, trigger = _timeout(component.timeout), _trigger(component.trigger)
    if isinstance(component, Component):
        return ComponentPart(
            id=component.id,
            behavior=component.behavior,
            parameters=dict(component.parameters),
            seen=tuple(
                OccurrencePart(
                    demonstration=seen.demonstration,
                    interval=tuple(seen.interval),
                    values=dict(seen.values),
                    cues=seen.cues,
                    closest_s=seen.closest_s,
                )
                for seen in component.occurrences
            ),
            until=until,
            timeout=timeout,
            trigger=trigger,
        )
    plain = len(component.cases) == 1 and not component.cases[0].name and component.cases[0].when is None
    return ComponentPart(
        id=component.id,
        name=component.task or None,
        network=network_part(component.network) if plain else None,
        cases=None if plain else tuple(map(_case, component.cases)),
        switches=tuple(
            SwitchPart(source=switch.source, target=switch.target, when=condition_part(switch.when))
            for switch in component.switches
        ),
        repeat=_repeat(component.repeat),
        until=until,
        timeout=timeout,
        trigger=trigger,
    )


def condition_part(condition: Condition) -> ConditionPart:
    """A condition."""
    match condition:
        case Holds():
            return ConditionPart(holds=BehaviorPart(behavior=condition.behavior, parameters=dict(condition.parameters)))
        case Possible():
            behavior = BehaviorPart(behavior=condition.behavior, parameters=dict(condition.parameters))
            return ConditionPart(possible=behavior)
        case Happened():
            return ConditionPart(event=condition.event)
        case Achieved():
            return ConditionPart(achieved=condition.component)
        case TimedOut():
            return ConditionPart(timed_out=condition.component)
        case Complete():
            return ConditionPart(complete=True)
        case After():
            return ConditionPart(after=condition.seconds)
        case Not():
            return ConditionPart(not_=condition_part(condition.of))
        case AllOf():
            return ConditionPart(all=tuple(map(condition_part, condition.of)))
        case AnyOf():
            return ConditionPart(any=tuple(map(condition_part, condition.of)))


def _case(case: Case) -> CasePart:
    when = condition_part(case.when) if case.when is not None else None
    return CasePart(name=case.name, when=when, network=network_part(case.network))


def _timeout(timeout: Timeout | None) -> TimeoutPart | None:
    return None if timeout is None else TimeoutPart(seconds=timeout.seconds, then=timeout.then, event=timeout.event)


def _trigger(trigger: Trigger | None) -> TriggerPart | None:
    if trigger is None:
        return None
    return TriggerPart(every=trigger.every_s, when=condition_part(trigger.on) if trigger.on is not None else None)


def _repeat(repeat: Repeat | None) -> RepeatPart | None:
    if repeat is None:
        return None
    return RepeatPart(times=repeat.times, until=condition_part(repeat.until) if repeat.until is not None else None)


def _link(link: Link) -> LinkPart:
    return LinkPart(
        source=link.source,
        target=link.target,
        type=link.type,
        because=tuple(
            LinkEvidencePart(
                demonstration=evidence.demonstration,
                from_interval=tuple(evidence.source),
                to_interval=tuple(evidence.target),
                relation=evidence.relation,
                note=evidence.note,
            )
            for evidence in link.evidence
        ),
    )
