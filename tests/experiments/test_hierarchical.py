"""The task of §3.5.3 from end to end; how nested steps are judged; the experiments as they are called."""

from dataclasses import replace

import pytest

from understudy.behaviors import installed_skills
from understudy.execution import RunReport
from understudy.experiments import (
    EXPERIMENTS,
    Trial,
    hierarchical_tables,
    links_with_init,
    problems_of,
    visits,
)
from understudy.experiments.__main__ import main
from understudy.network import Component, Link, LinkType, Nab, Network, flattened, load_task, task_path
from understudy.sessions import Performed, Stage, Verdict, perform
from understudy.sim import World, load_world, rearranged, world_path

TRANSPORT = [
    "drop-first",
    "go-to-light-green",
    "pick-up-orange",
    "go-through-gate/pass-yellow",
    "go-through-gate/pass-light-orange",
    "go-through-gate",
    "go-to-green",
    "drop-there",
]


def test_the_hierarchical_task_is_done_in_a_changed_room() -> None:
    """Sequential execution first, opportunistic execution then (§3.5.3.4)."""
    _, network = load_task(task_path("hierarchical"))
    room = rearranged(load_world(world_path("hierarchical")), 5)
    run = perform("hierarchical", network, room, installed_skills(), seed=5)
    assert problems_of(run, network) == []
    paths = [path for path, _ in run.report.achieved]
    assert paths[:9] == [*(f"object-transport/{path}" for path in TRANSPORT), "object-transport"]
    assert {*paths[9:-1]} == {f"visit-targets/visit-{color}" for color in ("pink", "light-green", "yellow", "orange")}
    assert paths[-1] == "visit-targets"


def test_the_links_that_the_text_counts() -> None:
    _, network = load_task(task_path("hierarchical"))
    assert (links_with_init(network), links_with_init(flattened(network))) == (31, 60)


def trial(*achieved: str, room: str = "same", seed: int = 1) -> Trial:
    return Trial(
        experiment="hierarchical",
        room=room,
        seed=seed,
        time_s=9.0,
        problems=(),
        collisions=0,
        grazes=0,
        achieved=achieved,
    )


def test_the_order_of_the_visits_is_told_as_in_table_3_1() -> None:
    tried = trial("object-transport", "visit-targets/visit-light-green", "visit-targets/visit-pink", "visit-targets")
    assert visits(tried) == "Light-Green Pink"
    lines = list(hierarchical_tables([tried, trial("visit-targets/visit-pink", room="changed", seed=2)]))
    assert "| 1 | 1 | Light-Green Pink |" in lines
    assert "| changed | Pink | 1 |" in lines
    assert "| with those to Init, too | 31 | 60 |" in lines


WORLD = World.from_data(
    {
        "understudy": "world/1",
        "name": "w",
        "arena": {"size": [4.0, 4.0]},
        "targets": [{"color": "green", "at": [2.0, 1.0]}],
        "robots": [{"name": "learner", "at": [1.2, 1.0]}],
    }
)
INNER = Network(
    (
        Component(id="near", behavior="Track", parameters={"color": "green", "distance_m": 0.7}),
        Component(id="far", behavior="Track", parameters={"color": "green", "distance_m": 1.6}),
    ),
    (Link(source="near", target="far", type=LinkType.ORDERING),),
)
NESTED = Network((Nab.of("visits", INNER), Component(id="drop", behavior="Drop")))


def judged(*achieved: tuple[str, float], done: bool) -> list[str]:
    report = RunReport(
        done=done, ending="complete" if done else "time limit", duration_s=1.0, achieved=achieved, events=()
    )
    verdict = Verdict(collisions={}, grazes={}, boxes=())
    performed = Performed(task="t", report=report, recording=None, stage=Stage(WORLD), verdict=verdict)
    return problems_of(performed, NESTED)


def test_steps_inside_of_networks_are_judged_by_their_paths() -> None:
    whole = (("visits/far", 0.0), ("visits/near", 0.1), ("visits", 0.1), ("drop", 0.2))
    assert judged(*whole, done=True) == [
        "visits/far was achieved before visits/near",
        "visits/far: 0.90 m from where it should have been",
    ]
    assert judged(("visits/near", 0.0), done=False) == ["time limit; missing visits/far, drop"]


def test_the_experiments_are_called_by_name(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[list[int]] = []
    failed = replace(trial("visit-targets/visit-pink", seed=7), problems=("x",))

    def trials(seeds: object) -> object:
        asked.append(list(seeds))  # type: ignore[call-overload]
        return iter([failed])

    experiment = replace(EXPERIMENTS["hierarchical"], trials=trials)  # type: ignore[arg-type]
    monkeypatch.setattr("understudy.experiments.__main__.EXPERIMENTS", {"hierarchical": experiment})
    monkeypatch.setattr("sys.argv", ["experiments", "--trials", "2", "--seed", "7"])
    main()
    told = capsys.readouterr().out
    assert asked == [[7, 8]]
    assert "| hierarchical | same | 0 of 1 |" in told
    assert "- hierarchical, same room, seed 7: x" in told
    monkeypatch.setattr("sys.argv", ["experiments", "tea"])
    with pytest.raises(SystemExit) as caught:
        main()
    assert caught.value.code == 2
    assert "there is no experiment 'tea'; there are: hierarchical" in capsys.readouterr().err
