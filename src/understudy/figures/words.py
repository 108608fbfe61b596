"""A task in plain words, as one person tells it to another; and what was learned from a demonstration."""

from collections.abc import Iterable, Mapping, Sequence

from understudy.behaviors import Skill
from understudy.errors import SkillError
from understudy.figures.labels import clean, label_of
from understudy.learning.construction import DECIMALS
from understudy.learning.learner import Lesson
from understudy.learning.observations import Observed
from understudy.network import Component, LinkType, Nab, Network, ParameterValue

__all__ = ["describe_lesson", "describe_task", "goal_in_words"]

_EXPLAINED = "A step holds while what it achieved is still true. One that is needed and no longer holds is done again."


def describe_task(name: str, network: Network, skills: Mapping[str, Skill]) -> str:
    """Tell a task as numbered steps, with what they ask of each other.

    Steps stand in the network's topological order. Nothing is said of the order where each step simply follows the one
    before; steps without an order between them are said to be in any order.

    Args:
        name: of the task.
        network: its behavior network.
        skills: by name; they know the words. A behavior that is not among them is called by its label.

    Returns:
        Several lines without a newline at the end.
    """
    order = network.topological_order
    stages = _stages(network)
    steps = f"{len(order)} step{'' if len(order) == 1 else 's'}"
    free = len(stages) == 1 and len(order) > 1 and not network.links
    lines = [f"{clean(name)}: {steps}{', in any order' if free else ''}", ""]
    telling = _Telling(network, skills)
    marked = False
    for index, stage in enumerate(stages):
        loose = len(stage) > 1
        if loose and not free:
            inside = any(link.source in stage and link.target in stage for link in network.links)
            first = "then, " if index else ""
            lines.append(f"     {first}{'in any order, except as noted:' if inside else 'in any order:'}")
        elif marked:
            lines.append("     then:")
        marked = loose
        for id_ in stage:
            lines.append(f"{telling.number[id_]:3}. {telling.goal[id_]}")
            lines += [f"       {condition}" for condition in telling.conditions(id_, stage if loose else ())]
    if any(link.type is not LinkType.ORDERING for link in network.links):
        lines += ["", _EXPLAINED]
    return "\n".join(lines)


def describe_lesson(lesson: Lesson, skills: Mapping[str, Skill]) -> str:
    """Tell what was made of a demonstration: the observations that became steps, and those left out, with the reasons.

    Args:
        lesson: from :func:`understudy.learning.learn`.
        skills: by name, for the words.

    Returns:
        Several lines without a newline at the end.
    """
    seen = len(lesson.kept) + len(lesson.dropped)
    learned = f"{len(lesson.kept)} of {seen} observation{'' if seen == 1 else 's'} became steps"
    lines = [f"{clean(lesson.demonstration)}: {learned}", ""]
    rows = [(*_moment(observed), _goal_of(observed, skills), _cues(observed)) for observed in lesson.kept]
    lines += [f"  {time}  {words}{cues}" for time, words, cues in _aligned(rows)]
    if lesson.dropped:
        lines += ["", "Left out:"]
        rows = [
            (*_moment(item.observed), _goal_of(item.observed, skills), f" – {clean(item.reason)}")
            for item in lesson.dropped
        ]
        lines += [f"  {time}  {words}{reason}" for time, words, reason in _aligned(rows)]
    if lesson.notes:
        lines += ["", *(clean(note) for note in lesson.notes)]
    return "\n".join(lines)


class _Telling:
    """The steps of one network with their numbers and words."""

    def __init__(self, network: Network, skills: Mapping[str, Skill]) -> None:
        self.network = network
        self.number = {id_: index for index, id_ in enumerate(network.topological_order, start=1)}
        self.goal = {component.id: goal_in_words(component, skills) for component in network.components}

    def conditions(self, id_: str, stage: Sequence[str]) -> list[str]:
        """What a step asks of others; the order only within its stage, and only if nothing else says it."""
        sources = {
            kind: sorted(
                (link.source for link in self.network.incoming[id_] if link.type is kind), key=self.number.__getitem__
            )
            for kind in LinkType
        }
        told = []
        if after := [source for source in sources[LinkType.ORDERING] if source in stage]:
            told.append(f"after {self._steps(after, id_)}")
        if enabling := sources[LinkType.ENABLING]:
            told.append(f"start while {self._steps(enabling, id_)} still hold{'s' if len(enabling) == 1 else ''}")
        if permanent := sources[LinkType.PERMANENT]:
            told.append(f"{self._steps(permanent, id_)} must hold all the while")
        return told

    def _steps(self, ids: Sequence[str], seen_from: str) -> str:
        """``step 3 (pick up the orange box) and step 4``; the step just before and many need no reminder."""
        if len(ids) > 2:
            return f"steps {_listed([str(self.number[id_]) for id_ in ids])}"
        named = []
        for id_ in ids:
            before = self.number[seen_from] - self.number[id_] == 1
            short = self.goal[id_].split(",")[0]
            named.append(f"step {self.number[id_]}" + ("" if before else f" ({short})"))
        return _listed(named)


def _stages(network: Network) -> list[tuple[str, ...]]:
    """The steps, cut wherever everything before comes before everything after."""
    order = network.topological_order
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


def goal_in_words(component: Component | Nab, skills: Mapping[str, Skill]) -> str:
    """What a component is to achieve: ``pick up the orange box``; of unknown skills, and of networks, the label."""
    if isinstance(component, Component) and component.behavior in skills:
        skill = skills[component.behavior]
        try:
            # Rounded as what was learned is: what was seen then reads the same, and so does a picture of either.
            values = {
                name: value if isinstance(value, str) else round(value, DECIMALS)
                for name, value in component.parameters.items()
            }
            return clean(skill.abstract.describe(skill.complete(values)))
        except SkillError:
            pass  # a network of somebody else's skills: its labels are what is known
    named = label_of(component)
    return f"{named.title} ({named.details})" if named.details else named.title


def _goal_of(observed: Observed, skills: Mapping[str, Skill]) -> str:
    parameters: dict[str, ParameterValue] = {**dict(observed.instance.parameters), **observed.values}
    return goal_in_words(Component(id="seen", behavior=observed.instance.behavior, parameters=parameters), skills)


def _moment(observed: Observed) -> tuple[str, str]:
    return f"{observed.interval.start:.1f}", f"{observed.interval.end:.1f} s"


def _cues(observed: Observed) -> str:
    said = ", ".join(f"{cue} {time:.1f} s" for time, cue in observed.cues)
    return f" – {said}" if said else ""


def _aligned(rows: Iterable[tuple[str, str, str, str]]) -> list[tuple[str, str, str]]:
    """Moments under each other, as ``  5.1 to  20.3 s``."""
    rows = list(rows)
    first = max((len(row[0]) for row in rows), default=0)
    second = max((len(row[1]) for row in rows), default=0)
    return [(f"{start:>{first}} to {end:>{second}}", words, rest) for start, end, words, rest in rows]


def _listed(parts: Sequence[str]) -> str:
    """``a``, ``a and b``, ``a, b and c``."""
    return " and ".join(part for part in (", ".join(parts[:-1]), *parts[-1:]) if part)
