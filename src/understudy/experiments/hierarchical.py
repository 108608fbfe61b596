"""What there is to tell of two subtasks one after the other (§3.5.3): the orders of the visits, and the links.

The task comes with the program and is not taught. As in Table 3.1 the order of the visits is the robot's own: it takes
what it knows of first, and finds the rest.
"""

from collections.abc import Sequence

from understudy.experiments.experiment import Experiment
from understudy.experiments.summary import Table
from understudy.experiments.trial import Trial
from understudy.network import Network, expand_links, flattened

__all__ = ["links_table", "links_with_init", "visits", "visits_table"]

_VISITS = "visit-targets/visit-"


def visits(trial: Trial) -> str:
    """The targets of the second subtask in the order in which they were visited, as in Table 3.1."""
    colors = [path.removeprefix(_VISITS) for path in trial.order if path.startswith(_VISITS)]
    return " ".join(color.title() for color in colors)


def links_with_init(network: Network) -> int:
    """All links of a network, as §3.7 seems to count them: also those that a path implies, and ``Init``'s.

    ``Init`` asks for the goals of a network (§3.3.2). Here it needs no links; with one from every component of every
    network the hierarchical task has 31, and its flat equivalent 60, which are the dissertation's numbers.
    """
    return expand_links(network).link_count + sum(1 for _ in network.walk())


def visits_table(experiment: Experiment, trials: Sequence[Trial]) -> Table:
    """Table 3.1, of its length: the first five trials of the first row."""
    first = [trial for trial in trials if trial.row == experiment.document.rows[0].name][:5]
    return Table(
        title="Order of target visits (Table 3.1)",
        head=("trial", "seed", "order of target visits"),
        rows=tuple((str(number), str(trial.seed), visits(trial)) for number, trial in enumerate(first, start=1)),
    )


def links_table(experiment: Experiment, trials: Sequence[Trial]) -> Table:
    """How many links the experiment's task has, and its flat equivalent (§3.7)."""
    task = experiment.task(experiment.document.rows[0])
    assert task is not None, "the table of links is for an experiment with a task"
    both = task, flattened(task)
    counts = (
        ("stored", [network.link_count for network in both]),
        ("with those that a path implies", [expand_links(network).link_count for network in both]),
        ("with those to Init, too", [links_with_init(network) for network in both]),
    )
    rows = tuple((name, *map(str, of_both)) for name, of_both in counts)
    return Table(title="Links (§3.7)", head=("links", "hierarchical", "flat"), rows=rows)
