"""The task of §3.5.3 from end to end; how nested steps are judged; what is told of its trials."""

from understudy.behaviors import installed_skills
from understudy.execution import RunReport
from understudy.experiments import TABLES, Trial, find_experiment, links_with_init, problems_of, visits
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


def trial(*order: str, row: str = "same", seed: int = 1) -> Trial:
    achieved = tuple((path, 1.0) for path in order)
    return Trial(experiment="hierarchical", row=row, seed=seed, ending="complete", time_s=9.0, achieved=achieved)


def test_the_order_of_the_visits_is_told_as_in_table_3_1() -> None:
    tried = trial("object-transport", "visit-targets/visit-light-green", "visit-targets/visit-pink", "visit-targets")
    assert visits(tried) == "Light-Green Pink"
    trials = [tried, trial("visit-targets/visit-pink", row="changed", seed=2)]
    experiment = find_experiment("hierarchical")
    told = {name: TABLES[name](experiment, trials).rows for name in experiment.document.tables}
    assert told["visits"] == (("1", "1", "Light-Green Pink"),)
    assert ("changed", "visit-targets/visit-pink", "1") in told["orders"]
    assert ("same", "object-transport, visit-targets/visit-light-green, visit-targets/visit-pink", "1") in told[
        "orders"
    ]
    assert ("with those to Init, too", "31", "60") in told["links"]


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
