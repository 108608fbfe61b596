"""Whether a task keeps a rule, whatever happens; if not, the shortest way to break it, and which steps do (§3.6)."""

from collections import deque
from collections.abc import Iterable
from dataclasses import dataclass, replace
from itertools import pairwise

from understudy.language.deterministic import MANY_STATES, Deterministic
from understudy.language.grammar import RULES, Grammar
from understudy.language.language import Word
from understudy.language.possibly import asked_by, asked_in
from understudy.language.symbols import by_path, symbol_of
from understudy.network import Component, Link, LinkType, Nab, Network

__all__ = ["Violation", "check", "violations"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Violation:
    """The shortest way in which a task breaks a rule.

    Attributes:
        rule: that is broken.
        paths: the components in the order of their achievement, up to the one that breaks it.
        word: the same in symbols.
        offender: the path of the component that breaks it; empty if the task ends too early instead.
        since: the path of the component after which it could not come any more; empty if it never could.
    """

    rule: Grammar
    paths: Word
    word: Word
    offender: str
    since: str

    def __str__(self) -> str:
        word = ", ".join(self.word) or "nothing at all"
        if not self.offender:
            return f"{self.rule.says}; but the task can end after {word}"
        how = f"follow {self.since!r}" if self.since else "come"
        return f"{self.rule.says}; but {self.offender!r} can {how} without it: {word}"


def violations(network: Network, rules: Iterable[Grammar] = RULES, *, limit: int = MANY_STATES) -> list[Violation]:
    """Everything that is wrong with a task: one violation for each rule that it breaks.

    Raises:
        LanguageError: the language has too many states.
    """
    found = (check(network, rule, limit=limit) for rule in rules)
    return [violation for violation in found if violation is not None]


def check(network: Network, rule: Grammar, *, limit: int = MANY_STATES) -> Violation | None:
    """The shortest way in which a run of the task breaks a rule; None if none does.

    A run that is never done counts, too: the rule must hold of all that the robot can do. The search goes through the
    task's automaton and the grammar's at once.

    Args:
        network: the task.
        rule: to be kept.
        limit: refuse to look at more states than this.

    Raises:
        LanguageError: the language has too many states.
    """
    symbol = {path: symbol_of(part) for path, part in network.walk() if isinstance(part, Component)}
    if rule.open_ended:
        if all(map(rule.neutral, symbol.values())):
            return None
        network = _without_idle_orders(network, rule)
    states = Deterministic(network, by_path, limit=limit)
    start = (states.start, rule.start)
    came: dict[tuple[int, frozenset[str]], tuple[tuple[int, frozenset[str]], str] | None] = {start: None}
    waiting = deque([start])
    while waiting:
        at = waiting.popleft()
        state, open_ = at
        if states.complete(state) and not rule.ends(open_):
            return _violation(rule, _way(came, at), symbol, offending=False)
        for path, target in states.after(state).items():
            after = rule.after(open_, symbol[path])
            if not after:
                return _violation(rule, (*_way(came, at), path), symbol, offending=True)
            if (target, after) not in came:
                came[target, after] = at, path
                waiting.append((target, after))
    return None


def _way(
    came: dict[tuple[int, frozenset[str]], tuple[tuple[int, frozenset[str]], str] | None],
    at: tuple[int, frozenset[str]],
) -> Word:
    paths: list[str] = []
    step = came[at]
    while step is not None:
        before, path = step
        paths.append(path)
        step = came[before]
    return tuple(reversed(paths))


def _violation(rule: Grammar, paths: Word, symbol: dict[str, str], *, offending: bool) -> Violation:
    since = ""
    if offending:
        # The last step before which the offender could have come, and after which it could not.
        allowed, open_ = [], rule.start
        for path in paths:
            allowed.append(bool(rule.after(open_, symbol[paths[-1]])))
            open_ = rule.after(open_, symbol[path])
        since = next((paths[i] for i in reversed(range(len(paths) - 1)) if allowed[i] and not allowed[i + 1]), "")
    return Violation(
        rule=rule,
        paths=paths,
        word=tuple(symbol[path] for path in paths),
        offender=paths[-1] if offending else "",
        since=since,
    )


def _without_idle_orders(network: Network, rule: Grammar, *, whole: bool = True) -> Network:
    """The network without the freedom that the rule does not see, which would only make more states.

    A component is idle if every symbol in it is neutral, no condition asks for it, and nothing waits for it. The
    shortest way to break a rule needs an idle one only where a part is completed on the way, and then it needs all of
    the part's. So in a part they are put in order; in the whole task they are taken out, unless there are duties, which
    are not called any more once the task is complete.
    """
    asked = asked_in(network)
    parts = tuple(part if isinstance(part, Component) else _inside(part, rule) for part in network.components)
    if network.paths:
        return replace(network, components=parts)  # one after the other as it is
    neutral = {part.id for part in parts if part.id not in asked and part.trigger is None and _is_neutral(part, rule)}
    links = network.links

    def idle() -> list[str]:
        waited_for = {link.source for link in links}
        return [part.id for part in parts if part.id in neutral and part.id not in waited_for]

    if not whole or any(part.trigger is not None for part in parts):
        order = (Link(source=a, target=b, type=LinkType.ORDERING) for a, b in pairwise(idle()))
        return Network(parts, (*links, *order))
    while (last := idle()) and len(last) < len(parts):
        parts = tuple(part for part in parts if part.id not in last)
        links = tuple(link for link in links if link.target not in last)
    return Network(parts, links)


def _inside(nab: Nab, rule: Grammar) -> Nab:
    if any(asked_by(switch.when) for switch in nab.switches):
        return nab  # for steps of the case that the switch leaves
    cases = tuple(replace(case, network=_without_idle_orders(case.network, rule, whole=False)) for case in nab.cases)
    return replace(nab, cases=cases)


def _is_neutral(part: Component | Nab, rule: Grammar) -> bool:
    if isinstance(part, Component):
        return rule.neutral(symbol_of(part))
    inner = (of for case in part.cases for of in case.network.components)
    return all(_is_neutral(of, rule) for of in inner)
