"""Why a component is active or not, in plain words: what decides it, since when, and what would have to change."""

from collections.abc import Iterator, Mapping, Sequence

from understudy.behaviors import Skill
from understudy.execution import Cause, Explanation, Missing, State
from understudy.figures.labels import clean
from understudy.figures.words_conditions import condition_in_words
from understudy.figures.words_controls import Wording, in_the_end
from understudy.figures.words_goals import goal_in_words, listed
from understudy.network import Component, Condition, LinkType, Nab, Network, Not, Possible

__all__ = ["WhyWords"]

_STATES = {
    State.EXECUTING: "is active, and acts",
    State.SEARCHING: "is active, but does not act",
    State.WAITING: "is not active; it waits",
    State.INHIBITED: "is not active; it is held back",
    State.ACHIEVED: "is not active; it is done",
    State.SKIPPED: "is not active; it is passed over",
    State.RESTING: "is not active; it rests",
    State.BYPASSED: "is not active; it does not lie on the way",
    State.UNUSED: "is not active; it is not in use",
}


class WhyWords:
    """Explanations of one task in words.

    Args:
        network: the task.
        skills: by name; they know the words. A behavior that is not among them is called by its label.
    """

    def __init__(self, network: Network, skills: Mapping[str, Skill]) -> None:
        self.network = network
        self.skills = skills
        self.wording = Wording(network, skills)

    def step(self, path: str) -> str:
        """``step 3 (go to the green target)``; how near, and from which side, is left out."""
        return f"step {self.wording.numbers[path]} ({self._goal(path).split(',')[0]})"

    def path_of(self, named: str) -> str:
        """The path of a component that somebody calls by its path or by its number; otherwise what was given."""
        numbers = {number: path for path, number in self.wording.numbers.items()}
        return numbers.get(named, named)

    def overview(self, found: Sequence[Explanation]) -> str:
        """One line for each component, and one more for the first thing in its way if that is not plain."""
        numbers = [f"{self.wording.numbers[one.component]}." for one in found]
        width = max(map(len, numbers), default=0)
        lines = []
        for number, one in zip(numbers, found, strict=True):
            head = f"{number:<{width}}  {one.state.value:<9}  since {one.since_s:6.1f} s  "
            lines.append(f"{head}{self._goal(one.component)}")
            if one.missing and one.state not in (State.ACHIEVED, State.UNUSED):
                lines.append(f"{' ' * len(head)}{self._is_missing(one, one.missing[0])}")
        return "\n".join(lines)

    def story(self, found: Explanation) -> str:
        """The whole answer: several lines without a newline at the end."""
        lines = [
            f"At {found.time_s:.1f} s step {self.wording.numbers[found.component]}, {self._goal(found.component)},"
            f" {_STATES[found.state]}.",
            f"  Why:   {_sentence(self._why(found))}",
            f"  Since: {found.since_s:.1f} s, when {self._cause(found, found.cause)}.",
        ]
        if found.state is State.EXECUTING:
            lines.append(f"  Ends:  {_sentence('; '.join(self._ends(found.component)))}")
        else:
            lines.append(f"  Acts:  {self._would_act(found)}")
        chain = list(found.chain())[1:]
        if chain:
            lines.append("  And there:")
            for one in chain:
                first = next((f": {self._is_missing(one, missing)}" for missing in one.missing), "")
                when = f"since {one.since_s:.1f} s, when {self._cause(one, one.cause)}"
                lines.append(f"    {self.step(one.component)} {_STATES[one.state]}, {when}{first}.")
        return "\n".join(lines)

    def parting(self, states: Mapping[str, tuple[State, State]]) -> str:
        """Where two runs part: one line for each component, what it would have done and what it did."""
        return "\n".join(
            f"    {self.step(path)} would have been {would.value}, and was {was.value}"
            for path, (was, would) in states.items()
        )

    def _goal(self, path: str) -> str:
        return goal_in_words(self.network.by_path[path], self.skills)

    def _why(self, found: Explanation) -> str:
        if found.missing:
            return listed([self._is_missing(found, one) for one in found.missing])
        if isinstance(self.network.by_path[found.component], Nab):
            return "all that it asks for is so, and one of its own steps acts"
        actuators = self._actuators(found.component)
        has = f", and it has the {listed(actuators)}" if actuators else ""
        return f"all that it asks for is so{has}"

    def _is_missing(self, found: Explanation, missing: Missing) -> str:
        """A condition that is not so, as a clause."""
        other = self.step(missing.component) if missing.component else ""
        match missing.kind:
            case "ordering" | "enabling" | "permanent" if missing.lacks == "achieved":
                return f"{other} is not done"
            case "enabling":
                return f"{other} was done, but does not hold any more, as it must when this one begins"
            case "permanent":
                return f"{other} was done, but does not hold any more, as it must all the while"
            case "inhibited":
                return f"{other} is under way, and holds it back"
            case "locked":
                return f"{other} has the {self._contested(found.component, missing.component)}"
            case "world":
                return self._possible(found.component, so=False)
            case "parts":
                return f"none of its own steps acts; the next is {other}" if other else "nothing in it acts"
            case "unused":
                return f"{other}, of which it is a part, does not use it now" if other else "it is not in use"
            case "path":
                return f"{other} comes first on the way, and is not done"
            case "bypassed":
                return f"{other} was taken, from which no way leads to it" if other else "a direct way leads past it"
            case "removed":
                return "the teacher has taken it out of the task"
            case "resting":
                return f"it is called {self._calls(found.component)}, and is not called now"
            case _ if found.state is State.SKIPPED:
                return "it ran out of time, and the task went on without it"
            case _:
                return "it is done, and nothing that is to come needs it again"

    def _would_act(self, found: Explanation) -> str:
        """What would have to change, as a sentence."""
        if found.state is State.BYPASSED:
            other = found.missing[0].component
            return "Not in this run." if other else "Never, as long as the direct way is there."
        if any(one.kind == "removed" for one in found.missing):
            return "Not again in this run."
        if found.state is State.SKIPPED:
            return "Not again, unless a network around it is begun anew."
        if found.state is State.ACHIEVED:
            prefix, network = self.network.home_of(found.component)
            links = network.outgoing[found.component[len(prefix) :]]
            needed_by = [self.step(prefix + link.target) for link in links if link.type is not LinkType.ORDERING]
            if not needed_by:
                return "Not again: no step asks that it still holds."
            needing = listed(needed_by, "or")
            return f"If it ceased to hold while {needing} needs it."
        return f"If {listed([self._requirement(found, one) for one in found.missing])}."

    def _requirement(self, found: Explanation, missing: Missing) -> str:
        """The same condition, as it would have to be."""
        other = self.step(missing.component) if missing.component else ""
        match missing.kind:
            case "ordering" | "enabling" | "permanent" | "path":
                return f"{other} were done" if missing.lacks == "achieved" else f"{other} held again"
            case "inhibited":
                return f"{other} ended"
            case "locked":
                return f"{other} let go of the {self._contested(found.component, missing.component)}"
            case "world":
                return f"it were so that {self._possible(found.component, so=True)}"
            case "parts":
                return f"{other} could act" if other else "one of its own steps could act"
            case "unused":
                return f"{other} came to use it" if other else "it came into use"
            case _:
                return "it were called"

    def _ends(self, path: str) -> Iterator[str]:
        """What would end an executing component."""
        component = self.network.by_path[path]
        inside, network = self.network.home_of(path)
        id_ = component.id
        yield "when it is done"
        if component.until is not None:
            yield f"or as soon as {self.wording.condition(component.until, inside)}"
        held = [link.source for link in network.incoming[id_] if link.type is LinkType.PERMANENT]
        if held:
            yield f"or if {listed([self.step(inside + one) for one in held], 'or')} ceases to hold"
        rivals = [by for by, of in network.inhibitions if of == id_]
        if rivals:
            yield f"or if {listed([self.step(inside + one) for one in rivals], 'or')} begins, which holds it back"
        if isinstance(component, Component):
            yield f"or if {self._possible(path, so=False)}"
        if component.timeout is not None:
            yield f"or after {component.timeout.seconds:g} s without success ({in_the_end(component.timeout)})"

    def _cause(self, found: Explanation, cause: Cause) -> str:
        """What happened, as a clause in the past."""
        own = cause.component == found.component
        other = "it" if own else self.step(cause.component) if cause.component else "it"
        first = next(iter(found.missing), None)
        contested = self._contested(found.component, cause.component) if cause.kind in ("took", "freed") else ""
        match cause.kind:
            case "began":
                return "the run began"
            case "begun":
                return f"{other} began to use it"
            case "ended":
                return f"{other} ceased to use it"
            case "achieved":
                return f"{other} was done"
            case "skipped":
                return "it ran out of time"
            case "called":
                return "it was called"
            case "reached":
                return f"what {other} achieves came to be so"
            case "lost":
                return f"what {other} achieves ceased to be so"
            case "came" if isinstance(self.network.by_path[found.component], Nab):
                return "one of its own steps began to act"
            case "went" if isinstance(self.network.by_path[found.component], Nab):
                return "none of its own steps acted any longer"
            case "came":
                return "what it needs to act came to be there"
            case "went":
                return "what it needs to act was there no longer"
            case "finished":
                return "it had nothing more to do"
            case "removed":
                return "the teacher said BAD"
            case "taken":
                return f"{other} was taken"
            case "took":
                return f"{other} took the {contested}"
            case "freed":
                return f"{other} let go of the {contested}"
            case "inhibited":
                return f"{other} began, and holds it back"
            case "released":
                return f"{other} ended, which had held it back"
            case _:
                return "something else changed" if first is None else "that came to be the first thing in its way"

    def _actuators(self, path: str) -> Sequence[str]:
        component = self.network.by_path[path]
        if not isinstance(component, Component) or component.behavior not in self.skills:
            return ()
        return sorted(self.skills[component.behavior].abstract.actuators)

    def _contested(self, path: str, other: str) -> str:
        """What two components both need."""
        both = [one for one in self._actuators(path) if not other or one in self._actuators(other)]
        return listed(both or self._actuators(path)) or "what it needs"

    def _possible(self, path: str, *, so: bool) -> str:
        """The world precondition of a component."""
        component = self.network.by_path[path]
        assert isinstance(component, Component)
        condition: Condition = Possible(behavior=component.behavior, parameters=component.parameters)
        return condition_in_words(condition if so else Not(of=condition), self.skills, clean)

    def _calls(self, path: str) -> str:
        return self.wording.calls(self.network.by_path[path], self.network.home_of(path)[0])


def _sentence(clause: str) -> str:
    return f"{clause[:1].upper()}{clause[1:]}."
