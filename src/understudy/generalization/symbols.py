"""When two components of two demonstrations are the same step (semantics §5)."""

from typing import NamedTuple

from understudy.network import Component

__all__ = ["Symbol", "symbol_of"]


class Symbol(NamedTuple):
    """The letter that a step is in the word of a demonstration.

    Attributes:
        behavior: its name.
        parameters: the discrete ones, by name: a target of another color is another step, a distance is none.
    """

    behavior: str
    parameters: tuple[tuple[str, str], ...] = ()


def symbol_of(component: Component) -> Symbol:
    """The symbol of a component: behavior and discrete parameters. Numbers are merged, and tell nothing apart."""
    discrete = sorted((name, value) for name, value in component.parameters.items() if isinstance(value, str))
    return Symbol(component.behavior, tuple(discrete))
