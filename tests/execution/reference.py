"""The reference interpreter of behavior-network execution: slow, obvious, for tests only.

It is written from semantics §1-§3 and §3.2-§3.4 of the dissertation, in the order of the numbered steps of
semantics §3. It knows nothing of the product's interpreter but what both are told by the definition: networks, the
conditions, and how these are written. Steps 1 (percepts) and 7 (commands) need a robot: here a `World` stands for the
percepts and nothing is commanded. Components are called by their paths.

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

Networks in a component's place, and control structures:

Reading 19: a network is in use in a tick if its NAB was active at the end of the last one (a port carries its value to
    the next tick), and the NAB has chosen it. A component is enabled if the network in which it stands is in use. The
    others keep their last Effects, get no level, and are not due.
Reading 20: a NAB that ceases to be active stops its parts in the same tick: a part is active only if its NAB is, too.
Reading 21: a NAB's Effects become true when its network is complete, in the same step 3, and stay so until it is begun
    anew. The step goes on as long as anything changes: latches first, then all NABs whose networks are complete.
Reading 22: a NAB chooses its case when it becomes active for the first time since it was begun, by what holds in that
    tick; if no case fits there is nothing to do, and its goal holds from the next tick on.
Reading 23: whether a complete network is begun anew (a switch, another round) is asked each time when step 3 finds
    nothing else to do, and finally at the end of step 5; what is begun anew is so from the next tick on: latches
    inside are cleared, clocks and choices, too, and nothing inside counts as active or executing in the last tick.
Reading 24: a switch goes before a round; the first switch in document order. A round chooses the case anew.
Reading 25: a clock runs in every tick after one in which the component was active and not achieved. When its time is
    up it begins again from zero, and `then` follows at once, before step 2: a signal is an event of this tick; a
    component that is skipped is achieved, and its links are satisfied whatever their type.
Reading 26: a duty is asked for by Init with 1 from the moment when it is called (after step 2) until it is achieved, or
    its network is complete. It is due only while it is called. A condition calls when it comes true, a period so long
    after the network came into use, or after the duty was achieved. A network that is called is begun anew, also if
    `Continue` has kept it active from the call before: it does not count as active in the last tick.
Reading 27: `until` makes a goal true as long as it is so, and that of an active NAB for good.
Reading 28: locks: duties and their parts go before all others. For the order, a part is needed by all who need its
    NAB, and not by duties: these come and go.
Reading 29: whatever is followed by duties only is a final goal.
Reading 30: a NAB is as good as a behavior (§3.4): it continues while one of its parts does, so that a primitive that
    asked not to be interrupted may finish when its network is complete.

Alternatives (semantics §5; §5.2 and §5.3 of the dissertation):

Reading 31: in play are the components of the way that was taken, and the candidates. Whoever is out of play is asked
    for nothing and not due, and links from and to it do not count. Init asks for the candidates instead of the sinks.
Reading 32: a component that is achieved, or skipped, is taken at once; of several in one step, the first in document
    order, and by then the others may be out of play. A network is complete when END may come next.
Reading 33: a direct way to END leads past all else. Duties are on no way.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from understudy.network import (
    END,
    START,
    Achieved,
    After,
    AllOf,
    AnyOf,
    Complete,
    Component,
    Condition,
    Happened,
    Link,
    LinkType,
    Nab,
    Network,
    Not,
    TimedOut,
)

__all__ = ["Behaviors", "Reason", "RefContext", "RefOutcome", "World", "run", "tick"]

Behaviors = Mapping[str, tuple[frozenset[str], bool]]
"""By the name of the behavior: the actuators it controls, and whether it is maintaining."""

Reason = tuple[str, ...]
"""Why a component is not active: ("unused",), ("level",), ("ordering", predecessor), ("enabling", predecessor),
("permanent", predecessor), ("inhibited", by); why an active one does not execute: ("precondition",),
("locked", by, actuator)."""

Case = tuple[str, str]
"""A network by its place: the path of its NAB, and the name of the case; ("", "") is the whole task."""

ROOT: Case = ("", "")


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
    time_s: float | None = None
    """Of the previous tick."""
    chosen: dict[str, str | None] = field(default_factory=dict)
    """The case of every NAB that has been begun; None if none fits."""
    begun: dict[Case, float] = field(default_factory=dict)
    rounds: dict[str, int] = field(default_factory=dict)
    clocks: dict[str, float] = field(default_factory=dict)
    timed_out: set[str] = field(default_factory=set)
    skipped: set[str] = field(default_factory=set)
    called: set[str] = field(default_factory=set)
    rung: set[str] = field(default_factory=set)
    due_s: dict[str, float] = field(default_factory=dict)
    taken: dict[Case, list[str]] = field(default_factory=dict)
    """The way through every network with alternatives, as far as it has come; ids."""

    @classmethod
    def fresh(cls, network: Network) -> "RefContext":
        """Before the first tick: nothing achieved, no effect true, nothing active."""
        paths = [part.path for part in _parts(network)]
        return cls(achieved=dict.fromkeys(paths, False), effects=dict.fromkeys(paths, False))


@dataclass(frozen=True)
class World:
    """What the percepts and the primitives say in one tick. What is left out: no effect, precondition holds."""

    effects: Mapping[str, bool] = field(default_factory=dict)
    """E(c) as the percepts would give it now."""
    preconditions: Mapping[str, bool] = field(default_factory=dict)
    """The world precondition of c holds now."""
    continues: frozenset[str] = frozenset()
    """The components whose primitive, when it ran in the previous step, asserted Continue."""
    time_s: float = 0.0
    events: frozenset[str] = frozenset()
    """That arrived from outside."""
    senses: Mapping[str, bool] = field(default_factory=dict)
    """Whether a `Holds` or a `Possible` is so, by its text."""


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
    stopped: str = ""


@dataclass(frozen=True)
class Part:
    """A component with its place."""

    path: str
    component: Component | Nab
    case: Case
    network: Network

    @property
    def prefix(self) -> str:
        return self.path[: len(self.path) - len(self.component.id)]


def run(network: Network, behaviors: Behaviors, worlds: Iterable[World]) -> list[RefOutcome]:
    """One run from its beginning, one tick for each world."""
    context = RefContext.fresh(network)
    return [tick(network, behaviors, context, world) for world in worlds]


def tick(network: Network, behaviors: Behaviors, context: RefContext, world: World) -> RefOutcome:
    """One tick (semantics §3). Changes the context; the outcome shares nothing with it."""
    return _Tick(network, behaviors, context, world).outcome()


def _parts(network: Network, prefix: str = "", case: Case = ROOT) -> Iterator[Part]:
    """Every component at every depth, each NAB before what is inside, in document order."""
    for component in network.components:
        path = prefix + component.id
        yield Part(path, component, case, network)
        if isinstance(component, Nab):
            for one in component.cases:
                inside = f"{path}/{one.name}/" if one.name else f"{path}/"
                yield from _parts(one.network, inside, (path, one.name))


class _Tick:
    """One tick, step after step, everything recomputed from the definition."""

    def __init__(self, network: Network, behaviors: Behaviors, context: RefContext, world: World) -> None:
        self.network, self.behaviors, self.context, self.world = network, behaviors, context, world
        self.parts = list(_parts(network))
        self.by_path = {part.path: part for part in self.parts}
        self.events = set(world.events)
        self.levels: dict[str, int] = {}
        self.refusals: dict[str, set[Reason]] = {}
        self.stopped = ""

    def outcome(self) -> RefOutcome:
        context = self.context
        context.begun.setdefault(ROOT, self.world.time_s)
        self.step_0_clocks()
        self.step_2_effects()
        self.step_2_duties()
        self.step_3_latches()
        levels = {part.path: self.step_4_level(part) for part in self.parts}
        active = self.step_5_activation(levels)
        executing = self.step_5_execution(active)
        anew = self.begun_anew()
        self.step_6_inhibition(executing)
        became_active = active - context.active
        context.active, context.executing = set(active), set(executing)
        effects, achieved = dict(context.effects), dict(context.achieved)
        context.complete = self.is_complete(ROOT)
        for part in self.parts:
            if part.path in became_active:
                self.begin(part)
        for part, target in anew:
            self.begin_anew(part, target)
        context.time_s = self.world.time_s
        return RefOutcome(
            effects=effects,
            achieved=achieved,
            levels=levels,
            active=active,
            executing=executing,
            searching=active - executing,
            refusals=self.refusals,
            completed=context.complete,
            stopped=self.stopped,
        )

    # -- where things stand ----------------------------------------------------------------------------------

    def in_use(self, case: Case) -> bool:
        """Reading 19."""
        nab, name = case
        return case == ROOT or (nab in self.context.active and self.context.chosen.get(nab, 0) == name)

    def is_complete(self, case: Case) -> bool:
        """Semantics §3 step 8: "when every sink is achieved"; duties are no sinks."""
        network = self.network_of(case)
        if network.paths:
            return END in self.candidates(case)
        return all(self.context.achieved[part.path] for part in self.parts if part.case == case and _is_sink(part))

    def network_of(self, case: Case) -> Network:
        if case == ROOT:
            return self.network
        nab = self.by_path[case[0]].component
        assert isinstance(nab, Nab)
        return next(one.network for one in nab.cases if one.name == case[1])

    def way(self, case: Case) -> list[str]:
        return self.context.taken.setdefault(case, [])

    def candidates(self, case: Case) -> list[str]:
        """Semantics §5: "the successors of the path's last node, minus any successor from which another of those
        successors can be reached".
        """
        network = self.network_of(case)
        after = _successors(network, (self.way(case) or [START])[-1])
        return [id_ for id_ in after if not any(_reaches(network, id_, other) for other in after)]

    def in_play(self, part: Part) -> bool:
        """Reading 31."""
        if not part.network.paths or part.component.trigger is not None:
            return True
        return part.component.id in (*self.way(part.case), *self.candidates(part.case))

    def links_into(self, part: Part) -> list[tuple[str, Link]]:
        """The links that count: all, or "from every node on the taken path" to one in play."""
        links = [link for link in part.network.links if link.target == part.component.id]
        if part.network.paths:
            links = [link for link in links if link.source in self.way(part.case) and self.in_play(part)]
        return [(part.prefix + link.source, link) for link in links]

    def satisfied(self, source: str, target: str, link: Link) -> bool:
        """Semantics §2, the table; §3.3.1 of the dissertation."""
        context = self.context
        achieved, effect = context.achieved[source], context.effects[source]
        if source in context.skipped:
            return achieved  # Reading 25
        if link.type is LinkType.ORDERING:
            return achieved
        if link.type is LinkType.PERMANENT:
            return achieved and effect
        # Enabling: E(p) is "not looked at while c stays active" (Readings 1, 2, 3).
        return achieved and (effect or target in context.active)

    def so(self, condition: Condition, case: Case) -> bool:
        """A condition, asked of one network."""
        context = self.context
        nab, name = case
        prefix = "" if case == ROOT else f"{nab}/{name}/" if name else f"{nab}/"
        match condition:
            case Not():
                return not self.so(condition.of, case)
            case AllOf():
                return all(self.so(part, case) for part in condition.of)
            case AnyOf():
                return any(self.so(part, case) for part in condition.of)
            case Happened():
                return condition.event in self.events
            case Achieved():
                return context.achieved[prefix + condition.component]
            case TimedOut():
                return prefix + condition.component in context.timed_out
            case Complete():
                return self.is_complete(case)
            case After():
                return case in context.begun and self.world.time_s - context.begun[case] >= condition.seconds
            case _:
                return self.world.senses.get(str(condition), False)

    # -- the steps -------------------------------------------------------------------------------------------

    def step_0_clocks(self) -> None:
        """Reading 25."""
        context = self.context
        passed = 0.0 if context.time_s is None else self.world.time_s - context.time_s
        for part in self.parts:
            timeout = part.component.timeout
            if timeout is None or part.path not in context.active or context.achieved[part.path]:
                continue
            clock = context.clocks.get(part.path, 0.0) + passed
            context.clocks[part.path] = clock
            if clock < timeout.seconds:
                continue
            context.clocks[part.path] = 0.0
            context.timed_out.add(part.path)
            if timeout.then == "signal":
                self.events.add(timeout.event)
            elif timeout.then == "stop":
                self.stopped = self.stopped or part.path
            else:
                context.skipped.add(part.path)
                self.achieve(part)

    def step_2_effects(self) -> None:
        """Semantics §3 step 2: "Effects of every enabled, uninhibited component".

        The others keep their last value (semantics §1; §3.2.1 of the dissertation).
        """
        context = self.context
        for part in self.parts:
            if part.path in context.inhibited or not self.in_use(part.case):
                continue
            early = part.component.until is not None and self.so(part.component.until, part.case)
            if isinstance(part.component, Component):
                context.effects[part.path] = self.world.effects.get(part.path, False) or early
            elif part.path in context.active and early:
                context.effects[part.path] = True  # Reading 27

    def step_2_duties(self) -> None:
        """Reading 26."""
        context = self.context
        for part in self.parts:
            trigger = part.component.trigger
            if trigger is None or not self.in_use(part.case):
                continue
            if trigger.on is not None:
                rings = self.so(trigger.on, part.case)
                calls = rings and part.path not in context.rung
                if rings:
                    context.rung.add(part.path)
                else:
                    context.rung.discard(part.path)
            elif part.path in context.called:
                calls = False
            else:
                assert trigger.every_s is not None
                due_s = context.due_s.setdefault(part.path, self.world.time_s + trigger.every_s)
                calls = self.world.time_s >= due_s
            if calls and part.path not in context.called and not self.is_complete(part.case):
                self.call(part)

    def call(self, part: Part) -> None:
        context = self.context
        context.due_s.pop(part.path, None)
        context.skipped.discard(part.path)
        context.timed_out.discard(part.path)
        context.clocks.pop(part.path, None)
        context.achieved[part.path] = False
        if isinstance(part.component, Nab):
            context.effects[part.path] = False
            context.rounds.pop(part.path, None)
            context.chosen.pop(part.path, None)
            context.active.discard(part.path)
            self.forget(part)
        context.called.add(part.path)

    def step_3_latches(self) -> None:
        """Semantics §3 step 3: "Latches, repeated until nothing changes (several steps ... in one tick)"."""
        context = self.context
        changed = True
        while changed:
            changed = False
            # Those that are due now, and only then those that are due because of them: in document order both times.
            reached = [part for part in self.parts if not context.achieved[part.path] and context.effects[part.path]]
            for part in [part for part in reached if self.is_due(part)]:
                if self.is_due(part):  # an alternative may have been taken meanwhile
                    self.achieve(part)
                    changed = True
            if changed:
                continue
            for part in self.parts:
                if part.path in context.called and self.is_complete(part.case):
                    context.called.discard(part.path)
            done = [part.path for part in self.parts if self.is_done(part)]
            for path in done:
                context.effects[path] = True
            changed = bool(done)

    def is_due(self, part: Part) -> bool:
        """Semantics §2: "enabled, not inhibited and every sequential precondition satisfied"."""
        context = self.context
        if part.path in context.inhibited or not self.in_use(part.case) or not self.in_play(part):
            return False
        if part.component.trigger is not None and part.path not in context.called:
            return False
        return all(self.satisfied(source, part.path, link) for source, link in self.links_into(part))

    def achieve(self, part: Part) -> None:
        context = self.context
        context.achieved[part.path] = True
        context.called.discard(part.path)
        context.clocks.pop(part.path, None)
        if part.path not in context.skipped:
            context.timed_out.discard(part.path)
        if part.network.paths and part.component.trigger is None:
            self.way(part.case).append(part.component.id)  # Reading 32

    def is_done(self, part: Part) -> bool:
        """Readings 21 and 22."""
        context = self.context
        if not isinstance(part.component, Nab) or context.effects[part.path] or part.path in context.inhibited:
            return False
        if part.path not in context.chosen or not self.in_use(part.case):
            return False
        name = context.chosen[part.path]
        if name is None:
            return True
        return self.is_complete((part.path, name)) and self.next_start(part) is None

    def next_start(self, part: Part) -> tuple[str | None] | None:
        """Readings 23 and 24: the case to which a NAB switches; (None,) for another round; None for neither."""
        context, nab = self.context, part.component
        assert isinstance(nab, Nab)
        name = context.chosen.get(part.path)
        if name is None or not self.in_use((part.path, name)) or context.effects[part.path]:
            return None
        for switch in nab.switches:
            if switch.source == name and self.so(switch.when, (part.path, name)):
                return (switch.target,)
        if nab.repeat is None or not self.is_complete((part.path, name)):
            return None
        if nab.repeat.until is not None and self.so(nab.repeat.until, part.case):
            return None
        rounds = context.rounds.get(part.path, 0) + 1
        return (None,) if nab.repeat.times is None or rounds < nab.repeat.times else None

    def step_4_level(self, part: Part) -> int:
        """Semantics §3 step 4, from zero each tick; §3.3.2 of the dissertation ("continuous ... activation spreading").

        Written from the receiver's side: the level of a component is what Init sends it and what its successors send
        it. The network has no cycles, so this ends.
        """
        if part.path not in self.levels:
            level = 0
            if self.in_use(part.case):
                for link in part.network.links:
                    if link.source == part.component.id:
                        level += self.sent_over(part, link)
                if self.is_goal(part) and not self.context.achieved[part.path]:
                    level += 1  # "Init sends 1 to each sink not yet achieved"
                if part.path in self.context.called:
                    level += 1  # Reading 26
            self.levels[part.path] = level
        return self.levels[part.path]

    def is_goal(self, part: Part) -> bool:
        """Whether Init asks for it: a sink; where there are alternatives, a candidate (Reading 31)."""
        if part.network.paths:
            return part.component.id in self.candidates(part.case)
        return _is_sink(part)

    def sent_over(self, part: Part, link: Link) -> int:
        target = part.prefix + link.target
        if link not in [counting for _, counting in self.links_into(self.by_path[target])]:
            return 0  # Reading 31
        if self.step_4_level(self.by_path[target]) == 0:
            return 0
        if not self.satisfied(part.path, target, link):
            return 1  # "sends 1 to every predecessor whose link to it is not satisfied"
        if self.maintaining(part) and link.type is LinkType.PERMANENT:
            return 1  # "also gets 1 over each satisfied permanent link" (semantics §3; §4.3 of the dissertation)
        return 0

    def maintaining(self, part: Part) -> bool:
        return isinstance(part.component, Component) and self.behaviors[part.component.behavior][1]

    def step_5_activation(self, levels: Mapping[str, int]) -> set[str]:
        """Semantics §3 step 5, first half: which components are active, and every reason why the others are not."""
        context = self.context
        active: set[str] = set()
        for part in self.parts:
            path = part.path
            reasons: set[Reason] = set()
            if not self.in_play(part):
                reasons.add(("path",))
            used = self.in_use(part.case) and (part.case == ROOT or part.case[0] in active)  # Readings 19 and 20
            if not used:
                reasons.add(("unused",))
            if path in context.inhibited:
                rivals = [part.prefix + by for by, of in part.network.inhibitions if of == part.component.id]
                # A rival that was begun anew meanwhile is not known any more.
                reasons |= {("inhibited", by) for by in rivals if self.was_busy(by)} or {("inhibited", "")}
            if levels[path] == 0:
                reasons.add(("level",))
            for source, link in self.links_into(part):
                if not self.satisfied(source, path, link):
                    reasons.add((link.type.value, source))
            if (used and self.continues(part)) or not reasons:
                active.add(path)
            else:
                self.refusals[path] = reasons
        return active

    def continues(self, part: Part) -> bool:
        """Its primitive asserts Continue; of a NAB, that of one of its parts does (Reading 30)."""
        if part.path in self.context.inhibited or not self.in_use(part.case):
            return False
        if isinstance(part.component, Component):
            return part.path in self.world.continues
        return any(self.continues(inner) for inner in self.parts if inner.case[0] == part.path)

    def was_busy(self, path: str) -> bool:
        """It executed in the last tick; of a NAB, one of its parts did."""
        return any(one == path or one.startswith(path + "/") for one in self.context.executing)

    def step_5_execution(self, active: set[str]) -> set[str]:
        """Semantics §3 step 5, second half: which of the active components execute.

        "... iff its world precondition holds AND its actuators are not locked by another; else it searches. Locks are
        taken in a fixed, documented order: who executed before keeps them; then the higher level; then document order."
        Adds the reasons of those that only search to the refusals.
        """
        context, world = self.context, self.world
        order = [part.path for part in self.parts]
        contenders = [part for part in self.parts if part.path in active and isinstance(part.component, Component)]
        turns = sorted(
            contenders,
            key=lambda part: (
                not self.on_duty(part),
                self.maintaining(part) and context.achieved[part.path],
                part.path not in context.executing,
                -self.need(part),
                order.index(part.path),
            ),
        )
        executing: set[str] = set()
        locked_by: dict[str, str] = {}
        for part in turns:
            c = part.path
            assert isinstance(part.component, Component)
            actuators, _ = self.behaviors[part.component.behavior]
            reasons: set[Reason] = {("locked", locked_by[a], a) for a in actuators if a in locked_by}
            if c not in world.continues and not world.preconditions.get(c, True):
                reasons.add(("precondition",))
            if reasons:
                self.refusals[c] = reasons
                continue
            executing.add(c)
            for actuator in actuators:
                locked_by[actuator] = c
        return executing

    def need(self, part: Part) -> int:
        """The level by which locks are ordered (Reading 28)."""
        links = [link for link in part.network.links if link.source == part.component.id]
        duties = [link for link in links if part.network.by_id[link.target].trigger is not None]
        level = self.step_4_level(part) - sum(self.sent_over(part, link) for link in duties)
        return level if part.case == ROOT else level + self.need(self.by_path[part.case[0]])

    def on_duty(self, part: Part) -> bool:
        if part.component.trigger is not None:
            return True
        return part.case != ROOT and self.on_duty(self.by_path[part.case[0]])

    def step_6_inhibition(self, executing: set[str]) -> None:
        """Semantics §3 step 6: "Executing components assert inhibition on their rivals, from the next tick on"."""
        self.context.inhibited = {
            part.prefix + of
            for part in self.parts
            for by, of in part.network.inhibitions
            if by == part.component.id and any(e == part.path or e.startswith(part.path + "/") for e in executing)
        }

    # -- beginnings ------------------------------------------------------------------------------------------

    def begin(self, part: Part) -> None:
        """Reading 22."""
        if not isinstance(part.component, Nab):
            return
        context = self.context
        if part.path not in context.chosen:
            self.choose(part)
        name = context.chosen[part.path]
        if name is not None:
            context.begun.setdefault((part.path, name), self.world.time_s)

    def choose(self, part: Part) -> None:
        assert isinstance(part.component, Nab)
        fitting = [case.name for case in part.component.cases if case.when is None or self.so(case.when, part.case)]
        self.context.chosen[part.path] = fitting[0] if fitting else None

    def begun_anew(self) -> list[tuple[Part, str | None]]:
        """Reading 23; what stands inside of a NAB that is begun anew is begun with it."""
        found: list[tuple[Part, str | None]] = []
        for part in self.parts:
            inside = any(part.path.startswith(other.path + "/") for other, _ in found)
            if isinstance(part.component, Nab) and not inside:
                start = self.next_start(part)
                if start is not None:
                    found.append((part, start[0]))
        return found

    def begin_anew(self, part: Part, target: str | None) -> None:
        context = self.context
        self.forget(part)
        if target is None:
            context.rounds[part.path] = context.rounds.get(part.path, 0) + 1
            self.choose(part)
        else:
            context.chosen[part.path] = target
        name = context.chosen[part.path]
        if name is not None:
            context.begun[part.path, name] = self.world.time_s

    def forget(self, nab: Part) -> None:
        """What is inside has no past."""
        context = self.context
        for part in self.parts:
            if not part.path.startswith(nab.path + "/"):
                continue
            path = part.path
            context.achieved[path] = False
            if isinstance(part.component, Nab):
                context.effects[path] = False
            for table in (context.chosen, context.rounds, context.clocks, context.due_s):
                table.pop(path, None)
            context.taken.pop(part.case, None)
            for paths in (
                context.active, context.executing, context.timed_out, context.skipped, context.called, context.rung
            ):  # fmt: skip
                paths.discard(path)
        context.begun = {
            case: at
            for case, at in context.begun.items()
            if case[0] != nab.path and not case[0].startswith(nab.path + "/")
        }


def _successors(network: Network, id_: str) -> list[str]:
    return [edge.target for edge in network.paths if edge.source == id_]


def _reaches(network: Network, source: str, target: str) -> bool:
    return any(one == target or _reaches(network, one, target) for one in _successors(network, source))


def _is_sink(part: Part) -> bool:
    if part.component.trigger is not None:
        return False
    after = [link.target for link in part.network.links if link.source == part.component.id]
    return all(part.network.by_id[target].trigger is not None for target in after)
