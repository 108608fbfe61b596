"""One more demonstration of a known task (§5.1): what is common to both becomes one, the rest becomes alternatives."""

from dataclasses import dataclass

from understudy.generalization.difference import Difference, difference_of
from understudy.generalization.merger import Merger, ways_of
from understudy.network import Network

__all__ = ["Generalized", "generalize"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Generalized:
    """A task after one more demonstration, and what that changed."""

    network: Network
    difference: Difference


def generalize(
    task: Network, demonstration: Network, *, names: tuple[str, str] = ("the task", "the demonstration")
) -> Generalized:
    """Adds a demonstration to a task.

    Every demonstration given so far is a way from START to END of the result. Where all show the same steps, it is a
    plain network again. Steps are the same if they lie on the longest common subsequence (:mod:`.alignment`). To add
    many, and to know what the task has become only at the end, use a :class:`~.merger.Merger`; the result is the same.

    Args:
        task: learned from one demonstration, or generalised over several.
        demonstration: the network that was learned from one more.
        names: of both, for the evidence; used for what has no evidence of its own, such as a task that was written.

    Raises:
        LearningError: one of them holds more than steps and links, or the demonstration has alternatives itself.
    """
    merger = Merger(task, name=names[0])
    added = merger.add(demonstration, name=names[1])
    result = merger.network()
    before = ways_of(task, names[0])
    difference = difference_of(task, added.network, result, before, added.demonstrations)
    return Generalized(network=result, difference=difference)
