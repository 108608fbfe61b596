"""A task in plain words, as one person tells it to another."""

from collections.abc import Mapping, Sequence

from understudy.behaviors import Skill
from understudy.figures.labels import clean
from understudy.figures.numbering import bypassed_of, cases_of, duties_of, letters_of, sequence_of
from understudy.figures.ways import always_before, is_bypassed, shown_in_words
from understudy.figures.words_controls import Wording, in_the_end
from understudy.figures.words_goals import goal_in_words, listed
from understudy.network import END, START, Component, LinkType, Nab, Network

__all__ = ["describe_task"]

_EXPLAINED = "A step holds while what it achieved is still true. One that is needed and no longer holds is done again."
_INDENT = "     "


def describe_task(name: str, network: Network, skills: Mapping[str, Skill]) -> str:
    """Tell a task as numbered steps, with what they ask of each other, and what comes next if that is not the next one.

    Steps stand in the network's topological order, those of a network in a step's place below it, and duties after the
    sequence. Nothing is said of the order where each step simply follows the one before; steps without an order between
    them are said to be in any order.

    Args:
        name: of the task.
        network: its behavior network.
        skills: by name; they know the words. A behavior that is not among them is called by its label.

    Returns:
        Several lines without a newline at the end.
    """
    count = len(network.components) - len(bypassed_of(network))
    steps = f"{count} step{'' if count == 1 else 's'}"
    if any(len(next_) > 1 for next_ in network.topology.candidates.values()):
        steps += ", some of them alternatives"
    if not network.flat:
        steps += f", of {sum(isinstance(part, Component) for _, part in network.walk())} in all"
    telling = _Telling(network, skills)
    free = telling.free(network)
    lines = [f"{clean(name)}: {steps}{', in any order' if free else ''}", "", *telling.network(network, "", "")]
    if _asks_for_holding(network):
        lines += ["", _EXPLAINED]
    return "\n".join(lines)


class _Telling:
    """The steps of one task with their numbers and words."""

    def __init__(self, network: Network, skills: Mapping[str, Skill]) -> None:
        self.wording = Wording(network, skills)
        self.number = self.wording.numbers
        self.goal = {path: goal_in_words(component, skills) for path, component in network.walk()}

    def free(self, network: Network) -> bool:
        """Whether its steps are in any order, all of them."""
        return len(sequence_of(network)) > 1 and not (network.links or network.paths) and len(_stages(network)) == 1

    def network(self, network: Network, inside: str, margin: str) -> list[str]:
        """The lines of a network.

        Args:
            network: the task, or what stands in a component's place.
            inside: what the paths of its components begin with.
            margin: before every line.
        """
        lines = self._ways(network, inside, margin) if network.paths else self._stages(network, inside, margin)
        if duties := duties_of(network):
            lines.append(f"{margin}{_INDENT}beside that:")
            for id_ in duties:
                lines += self._step(network, id_, network.topological_order, inside, margin)
        return lines

    def _stages(self, network: Network, inside: str, margin: str) -> list[str]:
        lines: list[str] = []
        marked = False
        for index, stage in enumerate(_stages(network)):
            loose = len(stage) > 1
            if loose and not self.free(network):
                inner = any(link.source in stage and link.target in stage for link in network.links)
                first = "then, " if index else ""
                lines.append(f"{margin}{_INDENT}{first}in any order{', except as noted' if inner else ''}:")
            elif marked:
                lines.append(f"{margin}{_INDENT}then:")
            marked = loose
            for id_ in stage:
                lines += self._step(network, id_, stage if loose else (), inside, margin)
        return lines

    def _ways(self, network: Network, inside: str, margin: str) -> list[str]:
        """The steps where there are alternatives, with what comes next where that is not the next line."""
        steps = sequence_of(network)
        begin = self._next(network, START, steps[0], inside)
        lines = [f"{margin}{_INDENT}begin with {begin}:"] if begin else []
        for id_, following in zip(steps, (*steps[1:], END), strict=True):
            lines += self._step(network, id_, (), inside, margin)
            if then := self._next(network, id_, following, inside):
                lines.append(f"{margin}{_INDENT}  then {then}")
        if bypassed := bypassed_of(network):
            lines.append(f"{margin}{_INDENT}shown, but never done, since a direct way leads past:")
            for id_ in bypassed:
                lines += self._step(network, id_, (), inside, margin)
        return lines

    def _next(self, network: Network, id_: str, following: str, inside: str) -> str:
        """What may come after a step, unless it is just the following one."""
        candidates = network.topology.candidates[id_]
        if candidates == (following,):
            return ""
        if candidates == (END,):
            return "all is done"
        numbers = [self.number[inside + one] for one in candidates]
        first = ", whichever comes first" if len(numbers) > 1 else ""
        return f"step {listed(numbers, 'or')}{first}"

    def _step(self, network: Network, id_: str, stage: Sequence[str], inside: str, margin: str) -> list[str]:
        path, component = inside + id_, network.by_id[id_]
        called = f"{self.wording.calls(component, inside)}: " if component.trigger is not None else ""
        goal, below = self.goal[path], ""
        lines = []
        if isinstance(component, Nab):
            if component.repeat is not None:
                below = f", {self.wording.rounds(component.repeat, inside)}"
            (first, *others) = component.cases
            free = not others and first.when is None and self.free(first.network)
            below += ", in any order:" if free else ":"
            lines = self._inside(path, component, inside, margin + _INDENT)
        number = f"{margin}{self.number[path]:>3}. "
        return [
            f"{number}{called}{goal}{below}",
            *(f"{' ' * len(number)}  {line}" for line in self._asked(network, id_, stage, inside)),
            *lines,
        ]

    def _inside(self, path: str, nab: Nab, outside: str, margin: str) -> list[str]:
        """What stands in a step's place."""
        lines: list[str] = []
        for index, (inside, letter, case) in enumerate(cases_of(path, nab)):
            choice = self.wording.choice(nab, index, outside)
            if choice or case.name:
                which = f"case {letter} ({clean(case.name)})" if letter else clean(case.name)
                free = ", in any order" if self.free(case.network) else ""
                lines.append(f"{margin}{', '.join(filter(None, (which, choice)))}{free}:")
            lines += self.network(case.network, inside, margin)
        if all(case.when is not None for case in nab.cases):
            lines.append(f"{margin}otherwise there is nothing to do")
        letters = letters_of(nab)
        for source, target, when in self.wording.switches(path, nab):
            again = "begin it anew" if source == target else f"go over to case {letters[target]}"
            where = f"in case {letters[source]}, " if letters[source] else ""
            lines.append(f"{margin}{where}{when}: {again}")
        return lines

    def _asked(self, network: Network, id_: str, stage: Sequence[str], inside: str) -> list[str]:
        """What a step asks of others; the order only within its stage, and only if nothing else says it."""
        component = network.by_id[id_]
        sources = {kind: [link.source for link in network.incoming[id_] if link.type is kind] for kind in LinkType}
        told = []
        if after := [source for source in sources[LinkType.ORDERING] if source in stage]:
            told.append(f"after {self._steps(after, id_, inside)}")
        if network.paths and component.trigger is None:
            told += filter(None, [shown_in_words(network, id_, names=is_bypassed(network, id_))])
        for certain, condition in ((True, ""), (False, ", if it was done")):
            if enabling := _these(network, sources[LinkType.ENABLING], id_, certain=certain):
                holds = "holds" if len(enabling) == 1 else "hold"
                told.append(f"start while {self._steps(enabling, id_, inside)} still {holds}{condition}")
            if permanent := _these(network, sources[LinkType.PERMANENT], id_, certain=certain):
                told.append(f"{self._steps(permanent, id_, inside)} must hold all the while{condition}")
        if rivals := [rival for rival, held in network.inhibitions if held == id_]:
            told.append(f"keep still while {self._steps(rivals, id_, inside, last='or')} is under way")
        if component.until is not None:
            told.append(f"done, too, as soon as {self.wording.condition(component.until, inside)}")
        if component.timeout is not None:
            told.append(f"after {component.timeout.seconds:g} s without success: {in_the_end(component.timeout)}")
        return told

    def _steps(self, ids: Sequence[str], seen_from: str, inside: str, *, last: str = "and") -> str:
        """``step 3 (pick up the orange box) and step 4``; the step just before and many need no reminder."""
        ids = sorted(ids, key=lambda id_: self._index(inside + id_))
        if len(ids) > 2:
            return f"steps {listed([self.number[inside + id_] for id_ in ids], last)}"
        named = []
        for id_ in ids:
            before = self._index(inside + seen_from) - self._index(inside + id_) == 1
            short = self.goal[inside + id_].split(",")[0]
            named.append(f"step {self.number[inside + id_]}" + ("" if before else f" ({short})"))
        return listed(named, last)

    def _index(self, path: str) -> int:
        """Which step of its own network it is."""
        return int(self.number[path].rpartition(".")[2])


def _these(network: Network, sources: Sequence[str], target: str, *, certain: bool) -> list[str]:
    """Those of the sources that are done before the target in any case, or those that may be."""
    if not network.paths:
        return list(sources) if certain else []
    if is_bypassed(network, target):
        return []  # nobody ever asks
    return [
        source
        for source in sources
        if not is_bypassed(network, source) and always_before(network, source, target) is certain
    ]


def _asks_for_holding(network: Network) -> bool:
    return any(link.type is not LinkType.ORDERING for link in network.links) or any(
        _asks_for_holding(case.network)
        for component in network.components
        if isinstance(component, Nab)
        for case in component.cases
    )


def _stages(network: Network) -> list[tuple[str, ...]]:
    """The steps of the sequence, cut wherever everything before comes before everything after."""
    order = sequence_of(network)
    before: dict[str, set[str]] = {}
    for id_ in order:
        before[id_] = {link.source for link in network.incoming[id_]}
        for link in network.incoming[id_]:
            before[id_] |= before[link.source]
    # A cut before step i holds if every later step has all the i steps among its predecessors.
    stages: list[tuple[str, ...]] = []
    begin = 0
    for cut in range(1, len(order) + 1):
        done = set(order[:cut])
        if all(done <= before[id_] for id_ in order[cut:]):
            stages.append(order[begin:cut])
            begin = cut
    return stages
