"""Regression by replay: which demonstrations and successful runs still speak for a task after an edit.

A demonstration fits if its steps, in the order in which they were first seen, are one way to do the task, and if every
condition that the task keeps between two of them was kept when they were shown. It was kept if the same learner makes
of that demonstration alone a link between the two that is as strict (Figure 5.6), which it reads off the recorded
intervals by Table 4.1. A successful run fits if its achievements, in their order, are one of the task's.

That is what can be said without doing it again. Whether the robot would succeed is another question, and only a run
answers it.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice

from understudy.errors import LanguageError
from understudy.language import symbol_of
from understudy.library.records import Sitting, shown_in
from understudy.library.replay import Replay, replays
from understudy.network import Component, LinkType, Nab, Network

__all__ = ["Misfit", "Regression", "Unheld", "regression"]

_READINGS = 100
"""So many of the best ways to read a demonstration are looked at; only steps that come several times make them many."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Unheld:
    """A condition that the task keeps and a demonstration did not: ``source`` has to hold for ``target``."""

    source: Component
    target: Component
    asked: LinkType


@dataclass(frozen=True, slots=True, kw_only=True)
class Misfit:
    """A demonstration or a run that is none of the task's.

    Attributes:
        sitting: which.
        extra: its steps that the task does not have.
        missing: the task's steps that it does not have.
        moved: the steps that both have, at places that do not go together.
        unheld: the conditions that did not hold in it.
    """

    sitting: Sitting
    extra: tuple[Component, ...] = ()
    missing: tuple[Component, ...] = ()
    moved: tuple[Component, ...] = ()
    unheld: tuple[Unheld, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class Regression:
    """What became of all that spoke for a task.

    Attributes:
        fits: what fits.
        broken: what fitted before the edit, and no longer does.
        before: what does not fit, and did not before either.
        unread: why nothing could be replayed; empty if it was.
    """

    fits: tuple[Sitting, ...] = ()
    broken: tuple[Misfit, ...] = ()
    before: tuple[Misfit, ...] = ()
    unread: str = ""


def regression(
    network: Network, sittings: Sequence[Sitting], executed: Mapping[int, Network], before: Network | None = None
) -> Regression:
    """Replays demonstrations and successful runs against a task.

    Args:
        network: the task as it shall be.
        sittings: of the task. Runs that failed are passed over; so are practice runs, in which the task changed on
            the way.
        executed: for every revision of which there is a run, its network.
        before: the task as it is; None if there is none yet.
    """
    seen = [(one, _steps(one, executed)) for one in sittings if one.kind == "demonstration" or _succeeded(one)]
    read: dict[tuple[object, ...], tuple[Misfit | None, bool]] = {}
    fits: list[Sitting] = []
    broken: list[Misfit] = []
    still: list[Misfit] = []
    try:
        for sitting, steps in seen:
            # Of a thousand runs most came in the same order.
            key = (sitting.kind, sitting.shown, steps.word)
            if key not in read:
                misfit = _misfit(sitting, steps, network)
                read[key] = misfit, misfit is None or _fitted(sitting, steps, before)
            misfit, fitted = read[key]
            if misfit is None:
                fits.append(sitting)
            else:
                (broken if fitted else still).append(replace(misfit, sitting=sitting))
    except LanguageError as error:
        return Regression(unread=str(error))
    return Regression(fits=tuple(fits), broken=tuple(broken), before=tuple(still))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Steps:
    """What happened: the steps in their order, and how strictly one was kept for another in a demonstration."""

    components: tuple[Component, ...]
    kept: Mapping[tuple[str, str], LinkType]

    @property
    def word(self) -> tuple[str, ...]:
        return tuple(map(symbol_of, self.components))


def _succeeded(sitting: Sitting) -> bool:
    return sitting.kind == "run" and sitting.done


def _steps(sitting: Sitting, executed: Mapping[int, Network]) -> _Steps:
    if sitting.kind == "run":
        by_path = executed[sitting.revision].by_path
        parts = [by_path[path] for path in sitting.achieved]
        return _Steps(components=tuple(part for part in parts if isinstance(part, Component)), kept={})
    shown = shown_in(sitting)
    steps = [shown.by_id[id_] for id_ in shown.topological_order]
    return _Steps(
        components=tuple(part for part in steps if isinstance(part, Component)),
        kept={(link.source, link.target): link.type for link in shown.links},
    )


def _fitted(sitting: Sitting, steps: _Steps, before: Network | None) -> bool:
    """Whether it fitted before the edit; also where that cannot be found out, so that somebody is asked."""
    try:
        return before is None or _misfit(sitting, steps, before) is None
    except LanguageError:
        return True


def _misfit(sitting: Sitting, steps: _Steps, network: Network) -> Misfit | None:
    """What keeps something from fitting; None if nothing does.

    Raises:
        LanguageError: the task can be done in too many orders to be looked at, or in none.
    """
    shown = sitting.kind == "demonstration"
    # One step may be either of two that do the same; the task gets the benefit of the doubt.
    readings = islice(replays(steps.word, network, shown=shown), _READINGS if shown else 1)
    told = [(tuple(_unheld(steps, found, network, "")) if shown else (), found) for found in readings]
    if not told:
        raise LanguageError("the task is never done, so that nothing can be an example of it")
    unheld, found = min(told, key=lambda one: len(one[0]))
    if found.fits and not unheld:
        return None
    extra = [steps.components[place] for place in found.extra]
    missing = [part for path in found.missing if isinstance(part := network.by_path[path], Component)]
    moved = []
    for part in list(extra):
        twin = next((one for one in missing if symbol_of(one) == symbol_of(part)), None)
        if twin is not None:
            moved.append(twin)
            extra.remove(part)
            missing.remove(twin)
    return Misfit(sitting=sitting, extra=tuple(extra), missing=tuple(missing), moved=tuple(moved), unheld=unheld)


def _unheld(steps: _Steps, found: Replay, network: Network, inside: str) -> Iterator[Unheld]:
    """The conditions between behaviors of a network, and of those in it, that were not kept."""
    for link in network.links:
        if link.type is LinkType.ORDERING:
            continue
        source: Component | None = None
        for place, path in found.matched:
            if path == inside + link.source:
                source = steps.components[place]
            elif path == inside + link.target and source is not None:
                target = steps.components[place]
                kept = steps.kept.get((source.id, target.id), LinkType.ORDERING)
                if kept.strength < link.type.strength:
                    yield Unheld(source=source, target=target, asked=link.type)
    for part in network.components:
        if isinstance(part, Nab):
            for case in part.cases:
                name = "/".join(filter(None, (part.id, case.name)))
                yield from _unheld(steps, found, case.network, f"{inside}{name}/")
