"""A loop that is taught (§4.6): shown once, and done until the world says that it is enough."""

from functools import cache

import pytest

from understudy.behaviors import installed_skills
from understudy.execution import Decision
from understudy.learning import learn
from understudy.network import Nab, Network, Possible, Repeat
from understudy.perception import Percepts
from understudy.robot import Color
from understudy.sessions import Stage, perform, teach
from understudy.sim import load_world, world_path

SKILLS = installed_skills()
WORLD = load_world(world_path("patrol"))
THERE, PUT_AWAY = (5.3, 2.0), (5.5, 0.5)


@cache
def taught() -> Network:
    return learn(teach(WORLD, SKILLS).demonstration).network


def test_a_loop_is_learned_from_one_round() -> None:
    assert list(taught().by_path) == ["repeat-1", "repeat-1/track-green-1", "repeat-1/track-pink-1", "track-yellow-1"]
    loop = taught().by_path["repeat-1"]
    assert isinstance(loop, Nab)
    assert loop.repeat == Repeat(until=Possible(behavior="Track", parameters={"color": "red"}))


@pytest.mark.parametrize("rounds", [1, 3])
def test_it_is_repeated_until_the_world_ends_it(rounds: int) -> None:
    """Red is away until the last round begins."""
    stages: list[Stage] = []
    been: list[str] = []

    def prepare(stage: Stage) -> None:
        stages.append(stage)
        if rounds > 1:
            stage.simulation.move_target(Color.RED, PUT_AWAY)

    def watch(percepts: Percepts, decision: Decision) -> None:
        for event in decision.events:
            if event.kind == "achieved":
                been.append(event.component)
                if event.component == "repeat-1/track-pink-1" and been.count(event.component) == rounds - 1:
                    stages[0].simulation.move_target(Color.RED, THERE)

    run = perform("patrol", taught(), WORLD, SKILLS, seed=7, prepare=prepare, watch=watch)
    assert run.report.done
    assert been == [
        *(["repeat-1/track-green-1", "repeat-1/track-pink-1"] * rounds),
        "repeat-1",
        "track-yellow-1",
    ]
    assert run.verdict.clean
