"""What a tick costs, by the shape and size of the network, beside py_trees in the same run.

Each task is half done when it is measured: the chain stands at its middle step, half of the parallel steps are
achieved. Nothing changes from tick to tick, or (``1%``) one component in a hundred, at least one, changes its goal each
tick. ``whole`` reads every component's goal by a call, as the controller does; ``links`` is given the values, and so is
the links, levels and locks alone. py_trees ticks a Sequence with memory, and a Parallel.
"""

import statistics
import time
from collections.abc import Callable
from random import Random

import py_trees
from tests.execution.support import compiled

from understudy.execution import Activation, Context
from understudy.network import Component, Link, LinkType, Network

__all__ = ["main"]

SIZES = (10, 100, 1_000, 10_000)
SHAPES = ("chain", "parallel", "layered")
LAYER = 10
BEHAVIORS = {"Go": (frozenset({"wheels"}), False)}


def network(shape: str, size: int) -> Network:
    """A chain, steps without any order, or layers of ten that all wait for the whole layer before."""
    components = tuple(Component(id=f"c{i}", behavior="Go") for i in range(size))
    pairs: list[tuple[int, int]] = []
    if shape == "chain":
        pairs = [(i, i + 1) for i in range(size - 1)]
    elif shape == "layered":
        pairs = [(i, j) for j in range(LAYER, size) for i in range(j // LAYER * LAYER - LAYER, j // LAYER * LAYER)]
    return Network(components, tuple(Link(source=f"c{i}", target=f"c{j}", type=LinkType.ORDERING) for i, j in pairs))


def half_done(shape: str, size: int) -> tuple[Activation, list[bool]]:
    """A run in which the first half is achieved."""
    program = compiled(network(shape, size), BEHAVIORS)
    activation = Activation(program, Context.start(program))
    effects = [row < size // 2 for row in range(size)]
    for _ in range(3):
        activation.commit(activation.decide(effects, lambda row: True))
    return activation, effects


def microseconds(work: Callable[[], object], at_least_s: float = 0.15) -> float:
    """Of one call: the median of five rounds."""
    begun, count = time.perf_counter(), 0
    while time.perf_counter() - begun < at_least_s / 5 or count < 3:
        work()
        count += 1
    rounds = []
    for _ in range(5):
        begun = time.perf_counter()
        for _ in range(count):
            work()
        rounds.append((time.perf_counter() - begun) / count)
    return 1e6 * statistics.median(rounds)


def ours(shape: str, size: int, changing: float) -> tuple[float, float]:
    """Microseconds of a tick: with reading the goals, and the links alone."""
    activation, values = half_done(shape, size)
    chance = Random(0)
    goals: list[Callable[[], bool]] = [lambda row=row: values[row] for row in range(size)]  # type: ignore[misc]
    # Achieved ones: an achievement would change the task, and the next round would measure another one.
    movers = range(size // 2)
    count = max(1, round(size * changing)) if changing else 0

    def change() -> None:
        for row in chance.sample(movers, count):
            values[row] = not values[row]

    def tick(effects: list[bool]) -> None:
        activation.commit(activation.decide(effects, lambda row: True))

    def whole() -> None:
        change()
        tick([goal() for goal in goals])

    def links() -> None:
        change()
        tick(values[:])

    cost_of_changing = microseconds(change) if count else 0.0
    return microseconds(whole) - cost_of_changing, microseconds(links) - cost_of_changing


class Leaf(py_trees.behaviour.Behaviour):
    """A behavior that succeeds at once, or never."""

    def __init__(self, name: str, succeeds: bool) -> None:
        super().__init__(name)
        self.status_to_give = py_trees.common.Status.SUCCESS if succeeds else py_trees.common.Status.RUNNING

    def update(self) -> py_trees.common.Status:
        return self.status_to_give


def theirs(shape: str, size: int) -> float | None:
    """Microseconds of a tick of py_trees, where it has a counterpart of the shape."""
    leaves = [Leaf(str(row), row < size // 2) for row in range(size)]
    root: py_trees.composites.Composite
    if shape == "chain":
        root = py_trees.composites.Sequence("root", memory=True, children=leaves)
    elif shape == "parallel":
        root = py_trees.composites.Parallel("root", py_trees.common.ParallelPolicy.SuccessOnAll(), children=leaves)
    else:
        return None
    root.tick_once()
    return microseconds(root.tick_once)


def main() -> None:
    names = " ".join(f"{name:>10}" for name in ("components", "whole", "links", "whole 1%", "links 1%", "py_trees"))
    print(f"{'µs a tick':<10} {names}")
    for shape in SHAPES:
        for size in SIZES:
            still, moving, peer = ours(shape, size, 0.0), ours(shape, size, 0.01), theirs(shape, size)
            figures = " ".join(f"{figure:>10.1f}" for figure in (*still, *moving))
            print(f"{shape:<10} {size:>10,} {figures} {'–' if peer is None else f'{peer:.1f}':>10}")


if __name__ == "__main__":
    main()
