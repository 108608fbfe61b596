"""How steps are numbered, in words and in pictures alike: 3.2 is the second step of what step 3 consists of.

Where a network in a component's place has several cases, they are lettered: 3b.1 is the first step of its second case.
"""

from collections.abc import Iterator

from understudy.figures.ways import is_bypassed
from understudy.network import Case, Nab, Network

__all__ = ["bypassed_of", "cases_of", "duties_of", "letters_of", "numbers_of", "sequence_of", "told_order"]


def sequence_of(network: Network) -> tuple[str, ...]:
    """The components that the task is done with, in topological order; where there are alternatives, any of them."""
    steps = (id_ for id_ in network.topological_order if network.by_id[id_].trigger is None)
    return tuple(id_ for id_ in steps if not is_bypassed(network, id_))


def duties_of(network: Network) -> tuple[str, ...]:
    """The components beside the sequence, in topological order."""
    return tuple(id_ for id_ in network.topological_order if network.by_id[id_].trigger is not None)


def told_order(network: Network) -> tuple[str, ...]:
    """All components in the order of their numbers: the sequence, what direct ways lead past, then duties."""
    return (*sequence_of(network), *bypassed_of(network), *duties_of(network))


def bypassed_of(network: Network) -> tuple[str, ...]:
    """The components that are never done, in topological order."""
    return network.topology.bypassed if network.paths else ()


def cases_of(path: str, nab: Nab) -> Iterator[tuple[str, str, Case]]:
    """The cases of the NAB at a path, with what the paths inside begin with, and its letter if there are several."""
    for index, case in enumerate(nab.cases):
        inside = "/".join(filter(None, (path, case.name)))
        yield f"{inside}/", _letter(index) if len(nab.cases) > 1 else "", case


def letters_of(nab: Nab) -> dict[str, str]:
    """The letters of a NAB's cases by their names; empty for its only one."""
    return {case.name: lettered for _, lettered, case in cases_of("", nab)}


def _letter(index: int) -> str:
    """``a`` to ``z``, then ``aa``."""
    first, last = divmod(index, 26)
    return (_letter(first - 1) if first else "") + "abcdefghijklmnopqrstuvwxyz"[last]


def numbers_of(network: Network, *, inside: str = "", before: str = "") -> dict[str, str]:
    """The number of every component at every depth, by its path.

    Args:
        network: the task, or a part of it.
        inside: what the paths begin with.
        before: what the numbers begin with.
    """
    numbers: dict[str, str] = {}
    for index, id_ in enumerate(told_order(network), start=1):
        path, number = f"{inside}{id_}", f"{before}{index}"
        numbers[path] = number
        component = network.by_id[id_]
        if isinstance(component, Nab):
            for below, lettered, case in cases_of(path, component):
                numbers |= numbers_of(case.network, inside=below, before=f"{number}{lettered}.")
    return numbers
