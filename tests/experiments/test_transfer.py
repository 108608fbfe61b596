"""The task transfer limit's mean and interval, against likelihoods added up, and against chains that were drawn."""

import math
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.special import comb

from understudy.experiments import transfer_limit

CHAINS = st.lists(st.tuples(st.integers(0, 12), st.booleans()), min_size=1, max_size=8)


def likelihood(chains: list[tuple[int, bool]], p: float) -> float:
    product = 1.0
    for successes, failed in chains:
        product *= p**successes * ((1 - p) if failed else 1.0)
    return product


@given(CHAINS)
def test_no_other_mean_is_likelier(chains: list[tuple[int, bool]]) -> None:
    found = transfer_limit(chains)
    best = likelihood(chains, found.mean / (1 + found.mean) if math.isfinite(found.mean) else 1.0)
    assert all(likelihood(chains, step / 200) <= best * (1 + 1e-9) for step in range(201))


@given(CHAINS)
def test_the_interval_holds_the_mean_and_grows_with_confidence(chains: list[tuple[int, bool]]) -> None:
    sure, surer = transfer_limit(chains, 0.9), transfer_limit(chains, 0.98)
    assert surer.low <= sure.low <= sure.mean <= sure.high <= surer.high
    assert sure.cut_off + sure.failures == sure.chains == len(chains)


@pytest.mark.parametrize("limits", [(2, 0, 3), (5,), (25, *[0] * 9)])
def test_at_its_ends_the_observed_sum_is_just_improbable(limits: tuple[int, ...]) -> None:
    """The negative binomial, added up term by term."""
    n, total = len(limits), sum(limits)
    found = transfer_limit([(limit, True) for limit in limits])

    def at_most(count: int, mean: float) -> float:
        p = mean / (1 + mean)
        return math.fsum(comb(k + n - 1, k) * p**k * (1 - p) ** n for k in range(count + 1))

    assert 1 - at_most(total - 1, found.low) == pytest.approx(0.01)
    assert at_most(total, found.high) == pytest.approx(0.01)


@pytest.mark.parametrize("most", [4, 1000])
@pytest.mark.parametrize("mean", [0.3, 2.5, 12.0])
def test_it_covers_the_true_mean_as_often_as_it_says(mean: float, most: int) -> None:
    """Of 1000 experiments with ten chains each, drawn at random; cut off after ``most`` transmissions."""
    random, p, covered = Random(5), mean / (1 + mean), 0
    for _ in range(1000):
        chains = []
        for _ in range(10):
            limit = 0
            while limit < most and random.random() < p:
                limit += 1
            chains.append((limit, limit < most))
        found = transfer_limit(chains, 0.9)
        covered += found.low <= mean <= found.high
    assert covered / 1000 >= 0.9 - 3 * math.sqrt(0.9 * 0.1 / 1000)


def test_without_a_failure_there_is_no_upper_bound() -> None:
    found = transfer_limit([(10, False), (10, False)])
    assert (found.mean, found.high) == (math.inf, math.inf)
    assert found.low == pytest.approx(0.01 ** (1 / 20) / (1 - 0.01 ** (1 / 20)))
    assert transfer_limit([(0, True)]).low == 0.0


@pytest.mark.parametrize(("chains", "confidence"), [([], 0.98), ([(-1, True)], 0.98), ([(1, True)], 1.0)])
def test_nonsense_is_refused(chains: list[tuple[int, bool]], confidence: float) -> None:
    with pytest.raises(ValueError, match="a transfer limit takes"):
        transfer_limit(chains, confidence)
