"""A task that is passed on from robot to robot until it is no longer the same (§4.5.5.2)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from understudy.behaviors import Skill
from understudy.errors import LearningError
from understudy.experiments.teaching import side
from understudy.learning import LearningSettings, learn
from understudy.network import Component, Network
from understudy.sessions import PassedOn, pass_on
from understudy.sim import World
from understudy.teaching import Manner

__all__ = ["Chain", "Transmission", "chain_of", "steps_in_order"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Transmission:
    """One robot has taught another.

    Attributes:
        passed: the demonstration.
        network: what was learned; None if nothing could be.
        problem: why it is not the task that was to be passed on; empty if it is.
    """

    passed: PassedOn
    network: Network | None
    problem: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Chain:
    """Transmissions, each of what the one before had taught.

    Attributes:
        transmissions: all but the last are right; the last one, too, if the chain was cut off.
    """

    transmissions: tuple[Transmission, ...]

    @property
    def failed(self) -> bool:
        """It ended with a wrong transmission, and was not cut off."""
        return bool(self.transmissions) and bool(self.transmissions[-1].problem)

    @property
    def limit(self) -> int:
        """How many were right before the first wrong one; at least so many, if the chain was cut off."""
        return len(self.transmissions) - self.failed


def steps_in_order(network: Network) -> tuple[tuple[str, ...], ...] | None:
    """The steps of a task that has but one order, with the sides on which targets are passed.

    Returns:
        Of each step its id and the side; None if the links leave an order open.
    """
    steps = [(part.id, side(part)) for part in network.components if isinstance(part, Component)]
    linked = {(link.source, link.target) for link in network.links}
    # Of two steps that follow each other, the one before is linked to the next: no other step could imply the order.
    if len(steps) < len(network.components) or any((a, b) not in linked for (a, _), (b, _) in pairwise(steps)):
        return None
    return tuple(steps)


def chain_of(
    name: str,
    network: Network,
    world: World,
    skills: Mapping[str, Skill],
    *,
    seed: int,
    manner: Manner,
    most: int = 20,
    settings: LearningSettings | None = None,
    limit_s: float = 300.0,
) -> Chain:
    """Passes a task on, from each learner to the next, until another one is learned.

    A transmission is right if the same steps are learned in the same order, and no others, each target to be passed on
    the same side.

    Args:
        name: of the task.
        network: what the first teacher knows.
        world: see :func:`understudy.sessions.with_robot_teacher`.
        skills: by name.
        seed: of the chain; each transmission has its own, drawn by it.
        manner: how the robots teach.
        most: transmissions after which a chain is cut off.
        settings: of the learners.
        limit_s: simulated seconds allowed to a demonstration.

    Raises:
        WorldError: no robot can teach in this world.
        NetworkError: the network does not fit the skills.
    """
    told = steps_in_order(network)
    transmissions: list[Transmission] = []
    for draw in np.random.SeedSequence(seed).generate_state(most).tolist():
        passed = pass_on(name, network, world, skills, manner=manner, seed=draw, settings=settings, limit_s=limit_s)
        learned, problem = None, ""
        try:
            learned = learn(passed.demonstration, settings).network
            problem = _difference(told, steps_in_order(learned))
        except LearningError as error:
            problem = str(error)
        transmissions.append(Transmission(passed=passed, network=learned, problem=problem))
        if problem or learned is None:
            break
        network = learned
    return Chain(transmissions=tuple(transmissions))


def _difference(told: Sequence[Sequence[str]] | None, learned: Sequence[Sequence[str]] | None) -> str:
    """What was learned instead, in words; empty if it is the same."""
    if learned == told:
        return ""
    if learned is None:
        return "in which order is left open"
    return f"learned: {', '.join(' '.join(filter(None, step)) for step in learned)}"
