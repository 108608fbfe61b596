"""Loops, ends, timeouts, duties, cases and switches in a few words: what a component says besides its goal."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from understudy.behaviors import Skill
from understudy.figures.numbering import cases_of, numbers_of
from understudy.figures.ways import is_bypassed, shown_in_words
from understudy.figures.words_conditions import condition_in_words
from understudy.network import Component, Condition, Nab, Network, Repeat, Timeout

__all__ = ["Note", "Wording", "in_the_end"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Note:
    """One control of a component.

    Attributes:
        kind: which: ``duty``, ``loop``, ``until``, ``timeout``; where there are alternatives, ``shown``, by whom, and
            ``bypassed``, what is never done.
        text: ``every 30 s``, ``3 times``, ``or until …``, ``60 s, then skip``.
    """

    kind: Literal["duty", "loop", "until", "timeout", "shown", "bypassed"]
    text: str


class Wording:
    """The words for the controls of one task.

    Args:
        network: the whole task.
        skills: by name, for the words of conditions.

    Attributes:
        numbers: of all components, by path.
    """

    def __init__(self, network: Network, skills: Mapping[str, Skill]) -> None:
        self.skills = skills
        self.numbers = numbers_of(network)

    def condition(self, condition: Condition, inside: str) -> str:
        """A condition in words.

        Args:
            condition: to be told.
            inside: what the paths of the components begin with of which it may speak.
        """
        return condition_in_words(condition, self.skills, lambda id_: f"step {self.numbers[inside + id_]}")

    def notes(self, component: Component | Nab, inside: str, network: Network | None = None) -> tuple[Note, ...]:
        """All controls of a component, briefly, in the order in which they matter.

        Args:
            component: whose.
            inside: what its path begins with.
            network: in which it stands, for what is to be told of alternatives.
        """
        notes = []
        if component.trigger is not None:
            notes.append(Note(kind="duty", text=self.calls(component, inside)))
        if isinstance(component, Nab) and component.repeat is not None:
            notes.append(Note(kind="loop", text=self.rounds(component.repeat, inside)))
        if component.until is not None:
            notes.append(Note(kind="until", text=f"or until {self.condition(component.until, inside)}"))
        if component.timeout is not None:
            notes.append(Note(kind="timeout", text=_short(component.timeout)))
        if network is not None and network.paths and component.trigger is None:
            shown = shown_in_words(network, component.id)
            if is_bypassed(network, component.id):
                notes.append(Note(kind="bypassed", text=f"never done{f'; {shown}' if shown else ''}"))
            elif shown:
                notes.append(Note(kind="shown", text=shown))
        return tuple(notes)

    def calls(self, component: Component | Nab, inside: str) -> str:
        """When a duty is called: ``every 30 s``."""
        trigger = component.trigger
        assert trigger is not None
        if trigger.on is None:
            return f"every {trigger.every_s:g} s"
        return f"whenever {self.condition(trigger.on, inside)}"

    def rounds(self, repeat: Repeat, inside: str) -> str:
        """How often: ``3 times``, ``again until …, at most 3 times``."""
        if repeat.until is None:
            return "again and again" if repeat.times is None else _times(repeat.times)
        most = "" if repeat.times is None else f", at most {_times(repeat.times)}"
        return f"again until {self.condition(repeat.until, inside)}{most}"

    def choice(self, nab: Nab, index: int, inside: str) -> str:
        """When a case is the one with which its NAB begins: ``if …``, ``otherwise``, ``only by a switch``."""
        case = nab.cases[index]
        earlier = [other.when for other in nab.cases[:index]]
        if None in earlier or (case.when is not None and case.when in earlier):
            return "only by a switch"
        if case.when is not None:
            return f"if {self.condition(case.when, inside)}"
        return "otherwise" if earlier else "at first" if len(nab.cases) > 1 else ""

    def switches(self, path: str, nab: Nab) -> tuple[tuple[str, str, str], ...]:
        """All switches of the NAB at a path: from and to which case, by name, and when: ``when it is done``."""
        below = {case.name: inside for inside, _, case in cases_of(path, nab)}
        return tuple(
            (switch.source, switch.target, f"when {self.condition(switch.when, below[switch.source])}")
            for switch in nab.switches
        )


def in_the_end(timeout: Timeout) -> str:
    """What follows a timeout: ``go on without it``."""
    match timeout.then:
        case "skip":
            return "go on without it"
        case "stop":
            return "give the task up"
        case "signal":
            return f"signal “{timeout.event}”, and try on"


def _short(timeout: Timeout) -> str:
    event = f" “{timeout.event}”" if timeout.event else ""
    return f"{timeout.seconds:g} s, then {timeout.then}{event}"


def _times(count: int) -> str:
    return {1: "once", 2: "twice"}.get(count, f"{count} times")
