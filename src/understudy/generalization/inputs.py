"""What can be generalised: steps that are behaviors, and links between them."""

from collections.abc import Mapping

from understudy.errors import LearningError
from understudy.network import Component, Network

__all__ = ["behaviors_of", "check_demonstration", "check_shown"]


def behaviors_of(network: Network, name: str) -> Mapping[str, Component]:
    """The components of a network that can be generalised, by their ids, in topological order.

    Raises:
        LearningError: one of them is something else.
    """
    components: dict[str, Component] = {}
    for part in (network.by_id[id_] for id_ in network.topological_order):
        if not isinstance(part, Component):
            raise LearningError(
                f"{name}: {part.id!r} is a network of its own; only steps that are behaviors are aligned"
            )
        if part.trigger is not None:
            raise LearningError(f"{name}: {part.id!r} is a duty beside the sequence, and has no place in an alignment")
        components[part.id] = part
    return components


def check_shown(network: Network, name: str) -> None:
    """Refuses what no demonstration shows.

    Raises:
        LearningError: the network has ends, timeouts or rivals, which somebody wrote.
    """
    parts = behaviors_of(network, name).values()
    extra = {key for part in parts for key in ("until", "timeout") if getattr(part, key) is not None}
    if network.inhibitions:
        extra.add("inhibitions")
    if extra:
        raise LearningError(f"{name} has {' and '.join(sorted(extra))}, which no demonstration shows; take it out")


def check_demonstration(network: Network, name: str) -> None:
    """Refuses what is not one demonstration.

    Raises:
        LearningError: it has alternatives, or what no demonstration shows.
    """
    behaviors_of(network, name)
    if network.paths:
        raise LearningError(
            f"{name} has alternatives, so it is not one demonstration; add those that it was made of one by one"
        )
    check_shown(network, name)
