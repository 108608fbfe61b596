"""The automaton of a network: in which orders the tick can achieve its behaviors' goals (§3.6).

A state says what the execution remembers of it: which components are achieved, and of every network in a component's
place that has begun the case, the round and, again, what is achieved inside. Sets of components are bits of one number,
so a flat network's states are the sets that a run can have achieved so far: there is no permutation anywhere.

A move achieves one behavior, or is silent: a network begins, ends, is switched or begun anew, a step is skipped. Of the
percepts nothing is assumed. Whatever depends on them may go either way; ``docs/language.md`` says what follows.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

from understudy.language.possibly import asked_by, asked_in, truth
from understudy.network import END, START, Achieved, Complete, Component, Condition, Nab, Network, TimedOut

__all__ = ["Automaton", "Begun", "State"]


class State(NamedTuple):
    """What has happened in a network.

    Attributes:
        achieved: the components that are achieved or passed over, by their places; of the duties, those that were
            done just when the network was.
        begun: the networks in them that are under way, or were cut short and may still finish what they were at.
    """

    achieved: int = 0
    begun: tuple["Begun", ...] = ()

    def begun_at(self, place: int) -> "Begun | None":
        """What is under way in a component's place."""
        return next((one for one in self.begun if one.place == place), None)


class Begun(NamedTuple):
    """A network in a component's place: the component, the case, the rounds that are over, and what happened inside."""

    place: int
    case: int
    rounds: int
    inside: State


Move = tuple[str | None, State]
"""The path of the behavior that is achieved, or None for a silent move; and where it leads."""

_NOTHING = State()


@dataclass(frozen=True, slots=True)
class _Part:
    """A component with its place.

    Attributes:
        bit: for its place, in sets of components.
        skippable: it may be passed over.
        after: what must be achieved before; where there are alternatives, the way that was taken says that.
        scopes: of its cases.
        asked: some condition asks whether it is achieved, so that it matters when it is.
        blind: its cases ask for nothing that is achieved, so that it does not matter when it begins.
    """

    place: int
    path: str
    of: Component | Nab
    bit: int
    skippable: bool
    after: int
    scopes: tuple["_Scope", ...]
    asked: bool
    blind: bool


class Automaton:
    """The automaton of a task.

    Args:
        network: the task.

    Attributes:
        ends: nothing in it can go on without end, so the task can be done from every state.
    """

    def __init__(self, network: Network) -> None:
        self._root = _Scope(network, "")
        self.start = _NOTHING
        self.ends = all(
            not part.switches and (part.repeat is None or part.repeat.times is not None)
            for _, part in network.walk()
            if isinstance(part, Nab)
        )
        self._moves: dict[State, tuple[Move, ...]] = {}

    def moves(self, state: State) -> tuple[Move, ...]:
        """What can happen next."""
        found = self._moves.get(state)
        if found is None:
            found = self._moves[state] = tuple(dict.fromkeys(self._root.moves(state, over=False)))
        return found

    def complete(self, state: State) -> bool:
        """Whether the task is done."""
        return self._root.complete(state)

    def bounds(self, state: State) -> tuple[float, float]:
        """Between how many and how many more achievements it takes to complete the task; no promise that it can be."""
        return self._root.bounds(state)


class _Scope:
    """A network at its place in the hierarchy, with what its states mean."""

    def __init__(self, network: Network, prefix: str, leaving: tuple[Condition, ...] = ()) -> None:
        asked = asked_in(network).union(*map(asked_by, leaving))
        place = {component.id: index for index, component in enumerate(network.components)}
        self.place = place
        self.topology = network.topology if network.paths else None
        self.parts = tuple(
            _Part(
                place=place[of.id],
                path=prefix + of.id,
                of=of,
                bit=1 << place[of.id],
                skippable=of.timeout is not None and of.timeout.then == "skip",
                after=0 if network.paths else sum(1 << place[link.source] for link in network.incoming[of.id]),
                scopes=tuple(_scopes(of, prefix)) if isinstance(of, Nab) else (),
                asked=of.id in asked,
                blind=isinstance(of, Nab) and not any(case.when and asked_by(case.when) for case in of.cases),
            )
            for of in network.components
        )
        self.sinks = sum(1 << place[id_] for id_ in network.sinks)
        self.duties = sum(part.bit for part in self.parts if part.of.trigger is not None)
        self.outset = self.bounds(_NOTHING)

    def complete(self, state: State) -> bool:
        if self.topology is not None:
            return END in self._candidates(state)
        return not self.sinks & ~state.achieved

    def _candidates(self, state: State) -> tuple[str, ...]:
        """What may come next where there are alternatives (§5.2): after the last of those achieved, all on one way."""
        assert self.topology is not None
        taken = (id_ for id_ in reversed(self.topology.ids) if state.achieved >> self.place[id_] & 1)
        return self.topology.candidates[next(taken, START)]

    def so(self, condition: Condition | None, state: State) -> bool | None:
        """Whether a condition of this network is so, as far as the state says."""

        def known(atom: Condition) -> bool | None:
            match atom:
                case Complete():
                    return self.complete(state)
                case Achieved(component=id_) | TimedOut(component=id_):
                    part = self.parts[self.place[id_]]
                    if part.of.trigger is not None:
                        return None
                    done = bool(state.achieved & part.bit)
                    if isinstance(atom, Achieved):
                        return done
                    return False if done and not part.skippable else None
                case _:
                    return None

        return True if condition is None else truth(condition, known)

    def moves(self, state: State, *, over: bool) -> Iterator[Move]:
        """What can happen next.

        Args:
            state: of this network.
            over: the component in whose place it stands is achieved, and only what was cut short goes on.
        """
        begun = {one.place: one for one in state.begun}
        complete = self.complete(state)
        candidates = self._candidates(state) if self.topology is not None else None
        for part in self.parts:
            if part.after & ~state.achieved:
                continue
            own = begun.get(part.place)
            if candidates is not None and part.of.trigger is None and part.of.id not in candidates:
                if own is not None:
                    # Another one was taken while it was under way; within that tick more may be achieved in it.
                    yield from self._inside(part, own, state)
                continue
            if part.of.trigger is not None:
                yield from self._duty(part, own, state, complete=complete, over=over)
            elif isinstance(part.of, Component):
                if not state.achieved & part.bit:
                    yield part.path, _with(state, part, done=True)
                    if part.skippable:
                        yield None, _with(state, part, done=True)
            elif own is not None:
                yield from self._inside(part, own, state)
                if not state.achieved & part.bit:
                    yield from self._ends(part, own, state)
            elif not state.achieved & part.bit:
                for _, chosen in self._begins(part, state):
                    fresh = chosen.begun_at(part.place)
                    if fresh is None or not part.blind:
                        yield None, chosen
                        continue
                    # Where it does not matter when it begins, it does so with its first achievement.
                    yield from self._inside(part, fresh, state)
                    yield from self._ends(part, fresh, state)

    def _duty(self, part: _Part, own: Begun | None, state: State, *, complete: bool, over: bool) -> Iterator[Move]:
        """Beside the sequence: as often as it is called; what it began may break off when the network is complete."""
        if isinstance(part.of, Component):
            if not complete:
                yield part.path, state
            elif not over and not state.achieved & part.bit:
                yield part.path, _with(state, part, done=True)  # called before; it is not called again
            return
        if own is None:
            if not complete:
                yield from self._begins(part, state)
            return
        yield from self._inside(part, own, state)
        if part.scopes[own.case].complete(own.inside) or self._cut_short(part, state):
            yield None, _with(state, part)
            if not complete:
                yield from self._begins(part, state)

    def _begins(self, part: _Part, state: State, *, rounds: int = 0) -> Iterator[Move]:
        """With the first case whose condition is so; without any there is nothing to do."""
        assert isinstance(part.of, Nab)
        for index, case in enumerate(part.of.cases):
            fits = self.so(case.when, state)
            if fits is not False:
                yield None, _with(state, part, Begun(part.place, index, rounds, _NOTHING))
            if fits is True:
                return
        yield None, _with(state, part, done=part.of.trigger is None)

    def _inside(self, part: _Part, own: Begun, state: State) -> Iterator[Move]:
        """What happens inside; and a switch to another case."""
        assert isinstance(part.of, Nab)
        done = bool(state.achieved & part.bit)
        scope = part.scopes[own.case]
        for path, inside in scope.moves(own.inside, over=done):
            yield path, self._settled(part, own._replace(inside=inside), state)
        if done and not part.skippable:
            return
        for switch in part.of.switches:
            if switch.source != part.of.cases[own.case].name:
                continue
            fires = scope.so(switch.when, own.inside)
            if fires is not False:
                target = next(i for i, case in enumerate(part.of.cases) if case.name == switch.target)
                yield None, _with(state, part, Begun(part.place, target, own.rounds, _NOTHING))
            if fires is True:
                return
        if scope.complete(own.inside) and self._repeats(part, own, state) is not False:
            rounds = own.rounds + 1 if part.of.repeat is not None and part.of.repeat.times is not None else 0
            yield from self._begins(part, state, rounds=rounds)

    def _settled(self, part: _Part, own: Begun, state: State) -> State:
        """The state with what happened inside; where nothing else can follow its completion, that follows at once."""
        scope = part.scopes[own.case]
        assert isinstance(part.of, Nab)
        plain = part.of.trigger is None and not (part.asked or part.of.switches or part.of.repeat or scope.duties)
        if plain and scope.complete(own.inside) and next(scope.moves(own.inside, over=True), None) is None:
            return _with(state, part, done=True)
        return _with(state, part, own)

    def _repeats(self, part: _Part, own: Begun, state: State) -> bool | None:
        """Whether another round follows one that is complete."""
        assert isinstance(part.of, Nab)
        repeat = part.of.repeat
        if repeat is None or (repeat.times is not None and own.rounds + 1 >= repeat.times):
            return False
        over = False if repeat.until is None else self.so(repeat.until, state)
        return None if over is None else not over

    def _ends(self, part: _Part, own: Begun, state: State) -> Iterator[Move]:
        """It is complete, and nothing begins anew; or it is cut short."""
        assert isinstance(part.of, Nab)
        scope = part.scopes[own.case]
        name = part.of.cases[own.case].name
        goes_on = any(one.source == name and scope.so(one.when, own.inside) is True for one in part.of.switches)
        finished = scope.complete(own.inside) and not goes_on and self._repeats(part, own, state) is not True
        if finished or self._cut_short(part, state):
            ended = _with(state, part, own, done=True)
            left = next(self._inside(part, own, ended), None)
            yield None, ended if left is not None else _with(state, part, done=True)

    def _cut_short(self, part: _Part, state: State) -> bool:
        """Whether something may end it before it is complete."""
        return part.skippable or (part.of.until is not None and self.so(part.of.until, state) is not False)

    def bounds(self, state: State) -> tuple[float, float]:
        """At least and at most so many achievements until it is complete."""
        if self.topology is not None:
            return self._bounds_of_ways(state)
        least = most = 0.0
        begun = {one.place: one for one in state.begun}
        for part in self.parts:
            own = begun.get(part.place)
            if part.of.trigger is not None:
                most = math.inf
            elif own is not None:
                low, high = self._bounds_of(part, own)
                least += 0 if state.achieved & part.bit else low
                most += high
            elif not state.achieved & part.bit:
                low, high = self._bounds_of(part, None)
                least, most = least + low, most + high
        return least, most

    def _bounds_of_ways(self, state: State) -> tuple[float, float]:
        """The same over the shortest and the longest way that is left."""
        assert self.topology is not None
        begun = {one.place: one for one in state.begun}
        bounds: dict[str, tuple[float, float]] = {END: (0.0, 0.0)}

        def along(candidates: tuple[str, ...]) -> tuple[float, float]:
            both = []
            for id_ in candidates:
                own = (0.0, 0.0)
                if id_ != END:
                    part = self.parts[self.place[id_]]
                    own = self._bounds_of(part, begun.get(part.place))
                both.append((own[0] + bounds[id_][0], own[1] + bounds[id_][1]))
            return min(low for low, _ in both), max(high for _, high in both)

        for id_ in reversed(self.topology.ids):
            bounds[id_] = along(self.topology.candidates[id_])
        candidates = self._candidates(state)
        low, high = along(candidates)
        # What was under way when another one was taken may be at its end, too.
        for one in state.begun:
            part = self.parts[one.place]
            if part.of.id not in candidates:
                high += self._bounds_of(part, one)[1]
        return low, math.inf if self.duties else high

    def _bounds_of(self, part: _Part, own: Begun | None) -> tuple[float, float]:
        if isinstance(part.of, Component):
            return (0.0 if part.skippable else 1.0), 1.0
        if part.of.switches:
            return 0.0, math.inf
        lows, highs = zip(*(scope.outset for scope in part.scopes), strict=True)
        low = 0.0 if all(case.when is not None for case in part.of.cases) else min(lows)
        high, fewest, rounds = max(highs), 1.0, 1.0
        if part.of.repeat is not None:
            rounds = part.of.repeat.times or math.inf
            fewest = rounds if part.of.repeat.until is None else 1.0
        if own is None:
            low, high = _times(low, fewest), _times(high, rounds)
        else:
            now, over = part.scopes[own.case].bounds(own.inside), own.rounds + 1
            low, high = now[0] + _times(low, max(0.0, fewest - over)), now[1] + _times(high, rounds - over)
        return (0.0 if part.skippable or part.of.until is not None else low), high


def _scopes(nab: Nab, prefix: str) -> Iterator[_Scope]:
    for case in nab.cases:
        leaving = tuple(switch.when for switch in nab.switches if switch.source == case.name)
        yield _Scope(case.network, f"{'/'.join(filter(None, (prefix + nab.id, case.name)))}/", leaving)


def _times(count: float, rounds: float) -> float:
    """So many achievements in each of so many rounds; none is none, even without end."""
    return count * rounds if count and rounds else 0.0


def _with(state: State, part: _Part, own: Begun | None = None, *, done: bool = False) -> State:
    """The state after something happened in the place of a component.

    Args:
        state: before.
        part: the component.
        own: what is under way there now.
        done: it is achieved, too.
    """
    achieved = state.achieved | part.bit if done else state.achieved
    if not part.scopes:
        return State(achieved, state.begun)
    others = [one for one in state.begun if one.place != part.place]
    return State(achieved, tuple(sorted((*others, own))) if own is not None else tuple(others))
