"""What can be said of a condition when only the achievements so far are known: so, not so, or either."""

from collections.abc import Callable

from understudy.network import Achieved, AllOf, AnyOf, Complete, Condition, Nab, Network, Not, TimedOut, atoms

__all__ = ["Known", "asked_by", "asked_in", "truth"]

Known = Callable[[Condition], bool | None]
"""Whether an atom of conditions is so; None if the achievements so far do not say it."""


def truth(condition: Condition, known: Known) -> bool | None:
    """Whether a condition is so; None if it depends on what the world, the clock, or somebody outside says.

    What it depends on is taken to be independent: nothing is concluded from the same thing being asked twice.
    """
    match condition:
        case Not():
            of = truth(condition.of, known)
            return None if of is None else not of
        case AllOf() | AnyOf():
            settles = isinstance(condition, AnyOf)
            parts = [truth(part, known) for part in condition.of]
            return settles if settles in parts else None if None in parts else not settles
        case Achieved() | TimedOut() | Complete():
            return known(condition)
        case _:
            return None


def asked_by(condition: Condition) -> set[str]:
    """The components of which a condition asks whether they are achieved, or out of time."""
    return {atom.component for atom in atoms(condition) if isinstance(atom, Achieved | TimedOut)}


def asked_in(network: Network) -> set[str]:
    """The components of a network for which others in it ask; switches that leave it apart."""
    found: set[str] = set()
    for part in network.components:
        conditions = [part.until, part.trigger.on if part.trigger is not None else None]
        if isinstance(part, Nab):
            conditions += [case.when for case in part.cases]
            conditions.append(part.repeat.until if part.repeat is not None else None)
        found = found.union(*(asked_by(condition) for condition in conditions if condition is not None))
    return found
