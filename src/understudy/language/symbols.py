"""The alphabet: one symbol for each behavior with its words, as steps are told apart when tasks are (semantics §5)."""

from collections.abc import Callable

from understudy.errors import NetworkError
from understudy.network import Component, Network

__all__ = ["Spelling", "behavior_of", "by_path", "parse_word", "spelled", "symbol_of"]

Spelling = Callable[[str, Component], str]
"""From a component and its path to the symbol for which it stands."""


def symbol_of(component: Component) -> str:
    """``Track(orange)``, ``Drop``: the behavior and its discrete parameters. Numbers do not tell symbols apart."""
    words = ", ".join(value for value in component.parameters.values() if isinstance(value, str))
    return f"{component.behavior}({words})" if words else component.behavior


def behavior_of(symbol: str) -> str:
    """``Track`` of ``Track(orange)``."""
    return symbol.partition("(")[0]


def spelled(path: str, component: Component) -> str:
    """By what it does: :func:`symbol_of`."""
    return symbol_of(component)


def by_path(path: str, component: Component) -> str:
    """Every component a symbol of its own."""
    return path


def parse_word(text: str, network: Network) -> tuple[str, ...]:
    """A word as a person writes it: ``Track(orange), PickUp(orange)``.

    Args:
        text: symbols with commas between them; case and spaces do not matter.
        network: the task, whose symbols may have commas and brackets of their own.

    Raises:
        NetworkError: a bracket is not closed.
    """
    known = {_folded(symbol): symbol for symbol in _symbols(network)}
    if text.count("(") != text.count(")"):
        raise NetworkError(f"a bracket is missing in {text!r:.80}; a word is written as Track(orange), PickUp(orange)")
    parts = [part.strip() for part in text.split(",")]
    word: list[str] = []
    while parts:
        # The longest run of parts that is a symbol; else up to where the brackets are closed.
        for count in range(len(parts), 0, -1):
            joined = ", ".join(parts[:count])
            if _folded(joined) in known:
                word.append(known[_folded(joined)])
                break
        else:
            count = next(n for n in range(1, len(parts) + 1) if _closed(", ".join(parts[:n])))
            word.append(", ".join(parts[:count]))
        parts = parts[count:]
    return tuple(symbol for symbol in word if symbol)


def _symbols(network: Network) -> tuple[str, ...]:
    return tuple(dict.fromkeys(symbol_of(part) for _, part in network.walk() if isinstance(part, Component)))


def _folded(text: str) -> str:
    return "".join(text.split()).lower()


def _closed(text: str) -> bool:
    return text.count("(") == text.count(")")
