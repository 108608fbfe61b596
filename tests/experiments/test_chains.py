"""Chains of transmissions: what counts as the same task, how a chain ends, and what many come to."""

import pytest

from understudy.experiments import Trial, Unit, conduct, find_experiment, measured_limit, steps_in_order
from understudy.network import Component, Link, LinkType, Network


def track(color: str, angle_deg: float) -> Component:
    parameters = {"color": color, "distance_m": 0.5, "angle_deg": angle_deg}
    return Component(id=f"track-{color}-1", behavior="Track", parameters=parameters)


def network(*steps: Component, links: tuple[tuple[int, int], ...]) -> Network:
    made = (Link(source=steps[a].id, target=steps[b].id, type=LinkType.ORDERING) for a, b in links)
    return Network(components=steps, links=tuple(made))


A, B, C = track("green", 178.0), track("pink", 2.0), track("red", 90.0)


def test_the_same_task_has_the_same_steps_on_the_same_sides_in_one_order() -> None:
    assert steps_in_order(network(A, B, C, links=((0, 1), (1, 2)))) == (
        ("track-green-1", "left"),
        ("track-pink-1", "right"),
        ("track-red-1", "ahead"),
    )


def test_an_order_that_is_left_open_is_none() -> None:
    assert steps_in_order(network(A, B, C, links=((0, 1), (0, 2)))) is None
    assert steps_in_order(network(A, B, links=())) is None


def chain(row: str, seed: int, **options: object) -> Trial:
    experiment = find_experiment("relay")
    [found] = [one for one in experiment.document.rows if one.name == row]
    found = found.model_copy(update={"options": {**found.options, **options}})
    return conduct(Unit(experiment=experiment, row=found, seed=seed))


def test_a_naive_teachers_chain_ends_and_says_with_what() -> None:
    trial = chain("naive robots", 1001)
    assert not trial.success
    assert trial.details == {"transmissions": 0}
    [problem] = trial.problems
    assert problem.startswith("transmission 1: learned: track-yellow-1 left, track-light-orange-1 right")


def test_a_chain_that_is_cut_off_has_not_failed() -> None:
    trial = chain("robots", 1, most=1)
    assert trial.success
    assert trial.details == {"transmissions": 1}


def test_what_chains_measure_is_the_mean_of_the_limit() -> None:
    def made(transmissions: int, *problems: str, ending: str = "taught") -> Trial:
        details = {"transmissions": transmissions} if ending == "taught" else {}
        return Trial(experiment="relay", row="robots", seed=1, ending=ending, problems=problems, details=details)

    trials = [made(3, "transmission 4: learned: nothing"), made(10), made(0, "no room", ending="error")]
    measured = measured_limit(trials)
    assert measured.value == pytest.approx(6.5)
    assert measured.told == "mean 6.5 (13 transmissions, 2 of 3 chains failed)"
    assert measured.sure.startswith("98 %: ")
