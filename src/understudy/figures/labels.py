"""How a behavior with its parameters is called in pictures: a title, a color to show, the numbers with their units."""

from collections.abc import Mapping
from dataclasses import dataclass

from understudy.learning.construction import DECIMALS
from understudy.network import Component, Nab, ParameterValue
from understudy.robot import Color

__all__ = ["Label", "clean", "label", "label_of", "number"]

_UNITS = {"_m": (" m", 2), "_deg": ("°", 0), "_s": (" s", 1)}


@dataclass(frozen=True, slots=True, kw_only=True)
class Label:
    """What is written in a box, at a row, in a legend.

    Attributes:
        title: the behavior with its words: ``Track green``.
        color: the trained color among the parameters; empty for none.
        details: the numbers: ``0.52 m, 178°``.
    """

    title: str
    color: str = ""
    details: str = ""


def label_of(component: Component | Nab) -> Label:
    """The label of a component; a network in its place is called by its task's name, or its id."""
    if isinstance(component, Nab):
        return Label(title=clean(component.task or component.id))
    return label(component.behavior, component.parameters)


def label(behavior: str, parameters: Mapping[str, ParameterValue]) -> Label:
    """The label of a behavior with parameters; words go to the title, numbers to the details."""
    color = ""
    words = [behavior]
    numbers = []
    for name, value in parameters.items():
        if isinstance(value, str):
            if not color and name.endswith("color") and value in tuple(Color):
                color = value
            words.append(value)
        else:
            numbers.append(number(name, value))
    return Label(title=clean(" ".join(words)), color=color, details=clean(", ".join(numbers)))


def number(name: str, value: float) -> str:
    """A number with the unit that its name ends in; without one, with its name: ``count 3``.

    It is rounded as in a component first: what was observed and what was learned from it then read the same.
    """
    value = round(value, DECIMALS)
    for ending, (unit, digits) in _UNITS.items():
        if name.endswith(ending):
            return f"{value:.{digits}f}{unit}"
    return f"{name} {value:g}"


def clean(text: str) -> str:
    """In one line, without anything that cannot be printed."""
    return " ".join("".join(letter if letter.isprintable() else " " for letter in text).split())
