"""The reference interpreter of behavior-network execution: slow, obvious, for tests only.

It is written from semantics §1-§3 and §3.2-§3.4 of the dissertation, in the order of the numbered steps of
semantics §3, and without sight of the product's interpreter. Flat networks only: no network abstract behaviors,
no loops, no conditions. Steps 1 (percepts) and 7 (commands) need a robot: here a `World` stands for the percepts
and nothing is commanded.

Where the text leaves freedom, this is how it is read:

Reading 1: "was active in the previous step" means active, executing or searching alike, at the end of step 5 of the
    last tick. Steps 3, 4 and 5 of a tick all look at that one value; before the first tick nothing was active.
Reading 2: the exemption of enabling links covers E(p) only. achieved(p) is required all the same (§2 asks for it
    everywhere). No run can show the difference: a component that was active has had achieved(p) before, and a
    latch is never taken back.
Reading 3: the exemption goes with the previous step alone, not with what becomes of the component in this one. A
    component that was active and is stopped in this tick (inhibited, or a permanent link broke) still counts its
    enabling links as satisfied in this tick; in the next one it does not, and its predecessors may be asked again.
Reading 4: in step 3 a permanent link asks for achieved(p) and E(p) now; so a goal that comes true in the very tick in
    which a permanent condition breaks is not achieved.
Reading 5: an inhibited component keeps its last Effects, and other components read that last value. It is not due,
    so it achieves nothing while inhibited; a latch that is set stays set.
Reading 6: an inhibited component still receives a level and passes it on to its predecessors: step 4 makes no
    exception, and otherwise inhibiting c would stop the work of others that prepares c.
Reading 7: a latch does not excuse from work: an achieved component with level > 0 (a successor needs its effects
    again) becomes active again like any other, sinks included, except that Init asks for no achieved sink.
Reading 8: over one link at most 1 is sent: because the link is not satisfied, or because the predecessor is
    maintaining, the link is permanent and it is satisfied. The level of a maintaining component therefore counts
    all its permanent successors with level > 0.
Reading 9: Continue is taken from the World as given, and makes a component active whatever its level and its links.
    Only "used" (always, in a flat network) and "not inhibited" stand above it. It gives no level.
Reading 10: Continue extends the execution, not the activity alone (§3.2.2: "to extend the execution of the behavior
    until its completion", against "transience of sensory data"): the world precondition is not asked for; the locks
    are. In practice the component executed in the previous step and so keeps its locks.
Reading 11: a component whose world precondition does not hold does not contend: it locks nothing, even if it executed
    before. "Who executed before" means executed at the end of the last tick.
Reading 12: locks are all or nothing: a component takes all its actuators or none. A component without actuators is
    never locked out.
Reading 13: "on actuators that Y leaves free" decides the order of locks: a maintaining behavior that has been achieved,
    and so is kept going for its successors only, takes its turn after all others, even if it executed before.
Reading 14: "else it searches" holds for both causes: searching is active and not executing, for want of the world
    precondition or of the actuators.
Reading 15: refusals are complete, not the first reason only. A lock is reported as it stood at the component's turn
    in the order of locks, also when the world precondition fails too. Executing components have no entry.
Reading 16: inhibition is asserted by execution, not by being active; it lasts for the one tick after each tick of
    execution. Two that inhibit each other and start in one tick stop each other in the next, and so on.
Reading 17: completion only means that Init asks for nothing more. Every level is 0 from then on, and only Continue can
    keep a component active: a primitive that asked not to be interrupted (a gripper still closing) may finish.
Reading 18: an empty network is complete at its first tick.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from understudy.network.definition import Link, LinkType, Network

__all__ = ["Behaviors", "Reason", "RefContext", "RefOutcome", "World", "run", "tick"]

Behaviors = Mapping[str, tuple[frozenset[str], bool]]
"""By the name of the behavior: the actuators it controls, and whether it is maintaining."""

Reason = tuple[str, ...]
"""Why a component is not active: ("level",), ("ordering", predecessor), ("enabling", predecessor),
("permanent", predecessor), ("inhibited", by); why an active one does not execute: ("precondition",),
("locked", by, actuator)."""


@dataclass
class RefContext:
    """All that a run remembers from tick to tick. `tick` changes it in place."""

    achieved: dict[str, bool] = field(default_factory=dict)
    """The latches."""
    effects: dict[str, bool] = field(default_factory=dict)
    """The last values; an inhibited component keeps its own."""
    active: set[str] = field(default_factory=set)
    """In the previous step."""
    executing: set[str] = field(default_factory=set)
    """In the previous step."""
    inhibited: set[str] = field(default_factory=set)
    """By rivals that executed in the previous step."""
    complete: bool = False

    @classmethod
    def fresh(cls, network: Network) -> "RefContext":
        """Before the first tick: nothing achieved, no effect true, nothing active."""
        ids = [component.id for component in network.components]
        return cls(achieved=dict.fromkeys(ids, False), effects=dict.fromkeys(ids, False))


@dataclass(frozen=True)
class World:
    """What the percepts and the primitives say in one tick. What is left out: no effect, precondition holds."""

    effects: Mapping[str, bool] = field(default_factory=dict)
    """E(c) as the percepts would give it now."""
    preconditions: Mapping[str, bool] = field(default_factory=dict)
    """The world precondition of c holds now."""
    continues: frozenset[str] = frozenset()
    """The components whose primitive, when it ran in the previous step, asserted Continue."""


@dataclass(frozen=True)
class RefOutcome:
    """What one tick decided."""

    effects: dict[str, bool]
    achieved: dict[str, bool]
    levels: dict[str, int]
    active: set[str]
    executing: set[str]
    searching: set[str]
    refusals: dict[str, set[Reason]]
    completed: bool


def run(network: Network, behaviors: Behaviors, worlds: Iterable[World]) -> list[RefOutcome]:
    """One run from its beginning, one tick for each world."""
    context = RefContext.fresh(network)
    return [tick(network, behaviors, context, world) for world in worlds]


def tick(network: Network, behaviors: Behaviors, context: RefContext, world: World) -> RefOutcome:
    """One tick (semantics §3). Changes the context; the outcome shares nothing with it."""
    _step_2_effects(network, context, world)
    _step_3_latches(network, context)
    levels = _step_4_levels(network, behaviors, context)
    active, refusals = _step_5_activation(network, context, world, levels)
    executing = _step_5_execution(network, behaviors, context, world, levels, active, refusals)
    _step_6_inhibition(network, context, executing)
    _step_8_completion(network, context)
    context.active = set(active)
    context.executing = set(executing)
    return RefOutcome(
        effects=dict(context.effects),
        achieved=dict(context.achieved),
        levels=levels,
        active=active,
        executing=executing,
        searching=active - executing,
        refusals=refusals,
        completed=context.complete,
    )


def _satisfied(link: Link, context: RefContext) -> bool:
    """Semantics §2, the table; §3.3.1 of the dissertation."""
    achieved = context.achieved[link.source]
    effect = context.effects[link.source]
    if link.type is LinkType.ORDERING:
        return achieved
    if link.type is LinkType.PERMANENT:
        return achieved and effect
    # Enabling: E(p) is "not looked at while c stays active" (Readings 1, 2, 3).
    return achieved and (effect or link.target in context.active)


def _step_2_effects(network: Network, context: RefContext, world: World) -> None:
    """Semantics §3 step 2: "Effects of every enabled, uninhibited component". In a flat network all are enabled.

    The others keep their last value (semantics §1; §3.2.1 of the dissertation).
    """
    for component in network.components:
        if component.id not in context.inhibited:
            context.effects[component.id] = world.effects.get(component.id, False)


def _step_3_latches(network: Network, context: RefContext) -> None:
    """Semantics §3 step 3: "Latches, repeated until nothing changes (several steps ... in one tick)"."""
    changed = True
    while changed:
        changed = False
        for component in network.components:
            c = component.id
            if not context.achieved[c] and context.effects[c] and _due(network, context, c):
                context.achieved[c] = True
                changed = True


def _due(network: Network, context: RefContext, c: str) -> bool:
    """Semantics §2: "enabled, not inhibited and every sequential precondition satisfied"."""
    if c in context.inhibited:
        return False
    return all(_satisfied(link, context) for link in network.links if link.target == c)


def _step_4_levels(network: Network, behaviors: Behaviors, context: RefContext) -> dict[str, int]:
    """Semantics §3 step 4, from zero each tick; §3.3.2 of the dissertation ("continuous ... activation spreading").

    Written from the receiver's side: the level of a component is what Init sends it and what its successors send it.
    The network has no cycles, so this ends.
    """
    levels: dict[str, int] = {}

    def level_of(c: str) -> int:
        if c not in levels:
            levels[c] = sum(sent_over(link, level_of(link.target)) for link in network.links if link.source == c)
            if _is_sink(network, c) and not context.achieved[c]:
                levels[c] += 1  # "Init sends 1 to each sink not yet achieved"
        return levels[c]

    def sent_over(link: Link, level_of_successor: int) -> int:
        if level_of_successor == 0:
            return 0
        if not _satisfied(link, context):
            return 1  # "sends 1 to every predecessor whose link to it is not satisfied"
        _, maintaining = behaviors[network.by_id[link.source].behavior]
        if maintaining and link.type is LinkType.PERMANENT:
            return 1  # "also gets 1 over each satisfied permanent link" (semantics §3; §4.3 of the dissertation)
        return 0

    return {component.id: level_of(component.id) for component in network.components}


def _is_sink(network: Network, c: str) -> bool:
    return all(link.source != c for link in network.links)


def _step_5_activation(
    network: Network, context: RefContext, world: World, levels: Mapping[str, int]
) -> tuple[set[str], dict[str, set[Reason]]]:
    """Semantics §3 step 5, first half: which components are active, and every reason why the others are not."""
    active: set[str] = set()
    refusals: dict[str, set[Reason]] = {}
    for component in network.components:
        c = component.id
        reasons: set[Reason] = set()
        if c in context.inhibited:
            reasons |= {("inhibited", by) for by, of in network.inhibitions if of == c and by in context.executing}
        if levels[c] == 0:
            reasons.add(("level",))
        for link in network.links:
            if link.target == c and not _satisfied(link, context):
                reasons.add((link.type.value, link.source))
        continues = c in world.continues and c not in context.inhibited
        if continues or not reasons:
            active.add(c)
        else:
            refusals[c] = reasons
    return active, refusals


def _step_5_execution(
    network: Network,
    behaviors: Behaviors,
    context: RefContext,
    world: World,
    levels: Mapping[str, int],
    active: set[str],
    refusals: dict[str, set[Reason]],
) -> set[str]:
    """Semantics §3 step 5, second half: which of the active components execute.

    "... iff its world precondition holds AND its actuators are not locked by another; else it searches. Locks are taken
    in a fixed, documented order: who executed before keeps them; then the higher level; then document order."
    Adds the reasons of those that only search to the refusals.
    """
    document_order = [component.id for component in network.components]

    def yields(c: str) -> bool:
        return behaviors[network.by_id[c].behavior][1] and context.achieved[c]

    turns = sorted(active, key=lambda c: (yields(c), c not in context.executing, -levels[c], document_order.index(c)))
    executing: set[str] = set()
    locked_by: dict[str, str] = {}
    for c in turns:
        actuators, _ = behaviors[network.by_id[c].behavior]
        reasons: set[Reason] = {("locked", locked_by[a], a) for a in actuators if a in locked_by}
        if c not in world.continues and not world.preconditions.get(c, True):
            reasons.add(("precondition",))
        if reasons:
            refusals[c] = reasons
            continue
        executing.add(c)
        for actuator in actuators:
            locked_by[actuator] = c
    return executing


def _step_6_inhibition(network: Network, context: RefContext, executing: set[str]) -> None:
    """Semantics §3 step 6: "Executing components assert inhibition on their rivals, from the next tick on"."""
    context.inhibited = {of for by, of in network.inhibitions if by in executing}


def _step_8_completion(network: Network, context: RefContext) -> None:
    """Semantics §3 step 8: "Init reports completion when every sink is achieved"."""
    sinks = [component.id for component in network.components if _is_sink(network, component.id)]
    context.complete = all(context.achieved[sink] for sink in sinks)
