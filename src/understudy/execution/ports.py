"""The ports of an abstract behavior, as §3.2.1 names them: what goes in, and what comes out."""

from dataclasses import dataclass

__all__ = ["Ports"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Ports:
    """One component's ports after a tick.

    Attributes:
        use_behavior: it is used in the current controller.
        activ_level: how many activation messages reached it.
        inhibit: a rival executes.
        preconditions: for every predecessor, whether the link from it is satisfied.
        continue_: its primitive asked not to be interrupted.
        active: it may execute, or search.
        effects: its goal holds.
    """

    use_behavior: bool
    activ_level: int
    inhibit: bool
    preconditions: dict[str, bool]
    continue_: bool
    active: bool
    effects: bool
