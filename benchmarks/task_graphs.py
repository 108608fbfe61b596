"""How well a free order is learned: ``python -m benchmarks.task_graphs FILE [--intervals FOLDER]``.

The file holds tasks with their true graphs and demonstrations, as in the CaptainCook4D key-steps::

    {task: {"steps": {id: text, …}, "edges": [[u, v], …], "demonstrations": {name: [[step id, start s, end s], …], …}}}

Ids are numbers; the least is START, the greatest END. Scored is the learned graph's transitive reduction, START and END
included, against the edges: precision, recall and F1 for each task, then the mean over the tasks. The cross-validated
figure takes for each task the cost per step that is best on all the others.

With ``--intervals`` every demonstration is written as a document of observed intervals, for ``understudy learn``.
"""

import argparse
import json
import statistics
import time
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from understudy.generalization import free_order
from understudy.generalization.explaining import COST, covers
from understudy.learning import Demonstration, learn, parse_intervals
from understudy.network import Network

__all__ = ["main"]

COSTS = (0.05, 0.1, 0.15, 0.2, 0.3, 0.4)

Score = tuple[float, float, float]


def documents(task: dict[str, Any]) -> list[dict[str, Any]]:
    """Of each demonstration the document of its intervals, with step ids in front of what the labels say."""
    return [
        {
            "understudy": "intervals/1",
            "name": name,
            "intervals": [
                {"label": f"{step} {task['steps'][str(step)]}"[:80].strip(), "start": start, "end": end}
                for step, start, end in shown
            ],
        }
        for name, shown in task["demonstrations"].items()
    ]


def demonstrations(task: dict[str, Any]) -> list[Demonstration]:
    return [parse_intervals(document) for document in documents(task)]


def graph(network: Network, count: int) -> NDArray[np.bool_]:
    """The transitive reduction by step id; of a step that comes twice the first time counts."""
    before = np.zeros((count, count), bool)
    first: dict[str, int] = {}
    for id_, part in network.by_id.items():
        step = int(part.behavior.split()[0])  # type: ignore[union-attr]  # behaviors alone
        if step not in first.values():
            first[id_] = step
    reached: dict[str, set[str]] = {}
    for id_ in reversed(network.topological_order):
        after = [link.target for link in network.outgoing[id_]]
        reached[id_] = set(after).union(*(reached[one] for one in after))
        if id_ in first:
            before[first[id_], [first[one] for one in reached[id_] if one in first]] = True
    before[0, 1:] = before[:-1, -1] = True
    return covers(before)


def score(found: NDArray[np.bool_], edges: list[list[int]]) -> Score:
    true = np.zeros_like(found)
    true[tuple(np.array(edges).T)] = True
    right = (found & true).sum()
    return right / found.sum(), right / true.sum(), 2 * right / (found.sum() + true.sum())


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.task_graphs", description=__doc__)
    parser.add_argument("file", type=Path)
    parser.add_argument("--intervals", type=Path, metavar="FOLDER")
    arguments = parser.parse_args()
    tasks = json.loads(arguments.file.read_text(encoding="utf-8"))
    if arguments.intervals:
        for name, task in tasks.items():
            folder = arguments.intervals / name
            folder.mkdir(parents=True, exist_ok=True)
            for document in documents(task):
                (folder / f"{document['name']}.json").write_text(json.dumps(document, indent=1), encoding="utf-8")
    learned = {name: [learn(one).network for one in demonstrations(task)] for name, task in tasks.items()}
    by_cost: dict[float, list[Score]] = {}
    times: dict[str, float] = {}
    for cost in sorted({*COSTS, COST}):
        by_cost[cost] = []
        for name, task in tasks.items():
            begun = time.process_time()
            network = free_order(learned[name], cost=cost).network
            if cost == COST:
                times[name] = 1000 * (time.process_time() - begun)
            by_cost[cost].append(score(graph(network, len(task["steps"])), task["edges"]))
    print(f"{'task':<32} {'precision':>9} {'recall':>7} {'F1':>7} {'ms':>6}")
    for (name, spent), row in zip(times.items(), by_cost[COST], strict=True):
        print(f"{name[:32]:<32} {row[0]:>9.3f} {row[1]:>7.3f} {row[2]:>7.3f} {spent:>6.0f}")
    means = [statistics.mean(column) for column in zip(*by_cost[COST], strict=True)]
    print(f"{'mean':<32} {means[0]:>9.3f} {means[1]:>7.3f} {means[2]:>7.3f} {statistics.mean(times.values()):>6.0f}")
    f1 = {cost: [row[2] for row in rows] for cost, rows in by_cost.items()}
    print("F1 by cost: " + ", ".join(f"{cost:g}: {statistics.mean(row):.3f}" for cost, row in f1.items()))
    if len(tasks) > 1:
        held_out = []
        for index in range(len(tasks)):
            best = max(f1, key=lambda cost: statistics.mean(one for at, one in enumerate(f1[cost]) if at != index))
            held_out.append(f1[best][index])
        print(
            f"cross-validated, one task left out: {statistics.mean(held_out):.3f}, "
            f"standard deviation over the tasks {statistics.stdev(held_out):.3f}"
        )


if __name__ == "__main__":
    main()
