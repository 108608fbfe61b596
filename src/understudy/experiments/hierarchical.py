"""Two subtasks one after the other (§3.5.3): a box carried through a gate, then four targets in any order.

The task comes with the program and is not taught. As in Table 3.1 the order of the visits is told, which is the robot's
own: it takes what it knows of first, and finds the rest.
"""

from collections import Counter
from collections.abc import Iterator, Sequence

from understudy.experiments.trials import Trial, run_trials
from understudy.network import Network, expand_links, flattened, load_task, task_path
from understudy.sim import load_world, world_path

__all__ = ["hierarchical_tables", "hierarchical_trials", "links_with_init", "visits"]

_NAME = "hierarchical"
_VISITS = "visit-targets/visit-"


def hierarchical_trials(seeds: Sequence[int]) -> Iterator[Trial]:
    """The task in its room, and in that room with everything elsewhere; one trial a seed in each."""
    _, network = load_task(task_path(_NAME))
    world = load_world(world_path(_NAME))
    for room in ("same", "changed"):
        yield from run_trials(_NAME, world, network, room, seeds)


def visits(trial: Trial) -> str:
    """The targets of the second subtask in the order in which they were visited, as in Table 3.1."""
    colors = [path.removeprefix(_VISITS) for path in trial.achieved if path.startswith(_VISITS)]
    return " ".join(color.title() for color in colors)


def links_with_init(network: Network) -> int:
    """All links of a network, as §3.7 seems to count them: also those that a path implies, and ``Init``'s.

    ``Init`` asks for the goals of a network (§3.3.2). Here it needs no links; with one from every component of every
    network the hierarchical task has 31, and its flat equivalent 60, which are the dissertation's numbers.
    """
    return expand_links(network).link_count + sum(1 for _ in network.walk())


def hierarchical_tables(trials: Sequence[Trial]) -> Iterator[str]:
    """Table 3.1, the orders of all trials, and the links of §3.7, as lines of Markdown."""
    yield "| trial | seed | order of target visits |"
    yield "| --- | --- | --- |"
    for number, trial in enumerate([trial for trial in trials if trial.room == "same"][:5], start=1):
        yield f"| {number} | {trial.seed} | {visits(trial)} |"
    yield ""
    yield "| room | order of target visits | trials |"
    yield "| --- | --- | --- |"
    for (room, order), count in Counter((trial.room, visits(trial)) for trial in trials).most_common():
        yield f"| {room} | {order} | {count} |"
    _, hierarchy = load_task(task_path(_NAME))
    yield ""
    yield "| links | hierarchical | flat |"
    yield "| --- | --- | --- |"
    both = hierarchy, flattened(hierarchy)
    for name, counts in (
        ("stored", [network.link_count for network in both]),
        ("with those that a path implies", [expand_links(network).link_count for network in both]),
        ("with those to Init, too", [links_with_init(network) for network in both]),
    ):
        yield f"| {name} | {counts[0]} | {counts[1]} |"
