"""What is written in the boxes of a network's picture, and how much room it takes."""

from collections.abc import Mapping
from dataclasses import dataclass

from understudy.behaviors import Skill
from understudy.execution.trace import State
from understudy.figures.labels import Label, clean, label_of
from understudy.figures.network_plan import BORDER, Sizes
from understudy.figures.numbering import cases_of
from understudy.figures.style import BODY, SMALL, text_width, wrap
from understudy.figures.words_controls import Note, Wording
from understudy.network import Component, Nab, Network

__all__ = ["CHIP", "LINE", "PAD", "BoxText", "Lines", "Texts", "texts_of"]

LINE = 12.5
PAD = 9.0
CHIP = 16.0
"""The width of the column in which colors and signs of controls stand."""

_TEXT = 170.0
"""The longest line in a box; longer ones are broken."""
_CASE_TEXT = 168.0
_SWITCH_TEXT = 150.0
_MANY = 8
"""Conditions are not cut short unless they are longer than so many lines."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BoxText:
    """What stands in the box of a behavior, or in the heading of a NAB's.

    Attributes:
        number: of the step.
        label: of which the color is shown.
        title, details: lines.
        notes: controls, each with its lines.
        state: what it is doing, where that is shown.
        heading: it stands above what is in the box.
    """

    number: str
    label: Label
    title: tuple[str, ...]
    details: tuple[str, ...]
    notes: tuple[tuple[Note, tuple[str, ...]], ...] = ()
    state: State | None = None
    heading: bool = False

    @property
    def bypassed(self) -> bool:
        """Whether it is never done."""
        return any(note.kind == "bypassed" for note, _ in self.notes)

    @property
    def indent(self) -> float:
        """Where the title, or its color, begins."""
        return PAD + max(text_width("88", SMALL), text_width(self.number, SMALL)) + 7.0

    @property
    def chip(self) -> float:
        """How far the title is moved by its color."""
        return CHIP if self.label.color else 0.0

    @property
    def lines(self) -> int:
        """How many lines it has."""
        noted = sum(len(lines) for _, lines in self.notes)
        return len(self.title) + len(self.details) + noted + (1 if self.state else 0)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height with the space around it."""
        widest = max(
            max((text_width(line, BODY, "bold") for line in self.title), default=0.0) + self.chip,
            max((text_width(line, SMALL) for line in self.details), default=0.0) + self.chip,
            max((text_width(line, SMALL) for _, lines in self.notes for line in lines), default=0.0) + CHIP,
            text_width(self.state.value, SMALL, "bold") + self.chip + 4.0 if self.state else 0.0,
        )
        width = self.indent + widest + 14.0 + (16.0 if self.state else 0.0)
        return width, max(1 if self.heading else 2, self.lines) * LINE + 2 * PAD - 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Lines:
    """A few lines, perhaps with a bold one above them.

    Attributes:
        title: bold; empty for none.
        text: the others.
    """

    title: str = ""
    text: tuple[str, ...] = ()

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, without any space around."""
        widest = max([text_width(self.title, SMALL, "bold"), *(text_width(line, SMALL) for line in self.text)])
        return widest, LINE * (len(self.text) + (1 if self.title else 0))


@dataclass(frozen=True, slots=True, kw_only=True)
class Texts:
    """Everything that is written in a network's picture.

    Attributes:
        boxes: by path, of behaviors and of NABs of which only the outside is drawn.
        headings: by path, of NABs that are drawn with what stands in them.
        closed: the paths of the NABs among ``boxes``.
        panels: of cases that are named or asked for, by what the paths of their components begin with.
        switches: by path of the NAB.
    """

    boxes: Mapping[str, BoxText]
    headings: Mapping[str, BoxText]
    closed: frozenset[str]
    panels: Mapping[str, Lines]
    switches: Mapping[str, tuple[Lines, ...]]

    @property
    def sizes(self) -> Sizes:
        """How much room all of it takes."""
        return Sizes(
            boxes={
                path: _around(text.size, BORDER) if path in self.closed else text.size
                for path, text in self.boxes.items()
            },
            headings={path: text.size for path, text in self.headings.items()},
            panels={inside: lines.size for inside, lines in self.panels.items()},
            switches={path: tuple(lines.size for lines in all_) for path, all_ in self.switches.items()},
        )


def texts_of(
    network: Network, states: Mapping[str, State | str], skills: Mapping[str, Skill], depth: int | None
) -> Texts:
    """What is written in a network's picture.

    Args:
        network: the task.
        states: by path.
        skills: by name, for defaults and the words of conditions.
        depth: how many networks in each other are drawn with what stands in them; None for all.
    """
    wording = Wording(network, skills)
    boxes: dict[str, BoxText] = {}
    headings: dict[str, BoxText] = {}
    closed: set[str] = set()
    panels: dict[str, Lines] = {}
    switches: dict[str, tuple[Lines, ...]] = {}

    def read(part: Network, inside: str, left: int | None) -> None:
        for component in part.components:
            path = inside + component.id
            state = State(states[path]) if path in states else None
            notes = tuple(
                (note, wrap(note.text, _TEXT, SMALL, lines=_MANY)) for note in wording.notes(component, inside, part)
            )
            label = label_of(_completed(component, skills))
            details = label.details
            opened = isinstance(component, Nab) and left != 0
            if isinstance(component, Nab) and not opened:
                closed.add(path)
                details = _contents(component)
            text = BoxText(
                number=wording.numbers[path],
                label=label,
                title=wrap(label.title, _TEXT, BODY, "bold", lines=3),
                details=wrap(details, _TEXT, SMALL, lines=2),
                notes=notes,
                state=state,
                heading=opened,
            )
            (headings if opened else boxes)[path] = text
            if isinstance(component, Nab) and opened:
                for index, (below, letter, case) in enumerate(cases_of(path, component)):
                    choice = wording.choice(component, index, inside)
                    if case.name or choice:
                        title = wrap(
                            " · ".join(filter(None, (letter, clean(case.name)))), _CASE_TEXT, SMALL, "bold", lines=1
                        )
                        asked = wrap(choice, _CASE_TEXT, SMALL, lines=_MANY)
                        panels[below] = Lines(title=title[0] if title else "", text=asked)
                    read(case.network, below, None if left is None else left - 1)
                switches[path] = tuple(
                    Lines(text=wrap(when, _SWITCH_TEXT, SMALL, lines=_MANY))
                    for _, _, when in wording.switches(path, component)
                )

    read(network, "", depth)
    return Texts(boxes=boxes, headings=headings, closed=frozenset(closed), panels=panels, switches=switches)


def _completed(component: Component | Nab, skills: Mapping[str, Skill]) -> Component | Nab:
    """The component with its skill's numbers, where the skill is known; words that it leaves out go without saying."""
    if isinstance(component, Nab) or component.behavior not in skills:
        return component
    values = skills[component.behavior].complete(component.parameters)
    numbers = {name: value for name, value in values.items() if isinstance(value, float)}
    return Component(id=component.id, behavior=component.behavior, parameters={**component.parameters, **numbers})


def _contents(nab: Nab) -> str:
    """What stands in a NAB of which only the outside is drawn."""
    steps = sum(isinstance(part, Component) for case in nab.cases for _, part in case.network.walk())
    cases = f"{len(nab.cases)} cases, " if len(nab.cases) > 1 else ""
    return f"{cases}{steps} step{'' if steps == 1 else 's'}"


def _around(size: tuple[float, float], border: float) -> tuple[float, float]:
    return size[0] + 2 * border, size[1] + 2 * border
