"""The task transfer limit: how often a task is passed on before it is first passed on wrongly (§4.5.5.2).

If every transmission succeeds with the same probability p, whatever came before, the number K of successes before the
first failure is geometric, with P(K = k) = p^k (1 - p) and mean p / (1 - p). Chains that were cut off before they
failed tell of successes alone (censoring). All of them together have the likelihood p^S (1 - p)^F, with S successes and
F failures, which is greatest at p = S / (S + F): the mean is estimated by S / F.

Where every chain runs to its failure, S is the sum of F geometric variables, which is negative binomial, and P(S >= s)
is the regularised incomplete beta function I_p(s, F). The least and the greatest p with which the observed S is not yet
improbable, by half of what confidence leaves on each side, are therefore quantiles of beta distributions:

* low: I_p(S, F) = (1 - confidence) / 2
* high: I_p(S + 1, F) = (1 + confidence) / 2

and the mean rises with p. This interval is exact: it covers the true mean at least as often as it says. With chains
that were cut off, the number of failures is not settled beforehand; low then counts one failure more, as if the next
transmission of all would have failed. These are the binomial (Clopper-Pearson) bounds.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from scipy.stats import beta

__all__ = ["TransferLimit", "transfer_limit"]


@dataclass(frozen=True, slots=True, kw_only=True)
class TransferLimit:
    """What chains of transmissions tell of the task transfer limit.

    Attributes:
        chains: how many.
        successes: transmissions that were right, in all of them.
        failures: chains that ended with a wrong one; all others were cut off.
        mean: of the limit, by greatest likelihood; infinite if no chain failed.
        low, high: bounds of the mean with the given confidence; high is infinite if no chain failed.
        confidence: of the interval.
    """

    chains: int
    successes: int
    failures: int
    mean: float
    low: float
    high: float
    confidence: float

    @property
    def cut_off(self) -> int:
        """Chains that did not fail as long as they were watched."""
        return self.chains - self.failures


def transfer_limit(chains: Sequence[tuple[int, bool]], confidence: float = 0.98) -> TransferLimit:
    """The mean of the task transfer limit, and how sure one can be of it.

    Args:
        chains: of each, how many transmissions were right, and whether it ended with a wrong one; at least one chain.
        confidence: of the interval; the dissertation has 98 %.

    Raises:
        ValueError: there is no chain, a number is negative, or the confidence is none.
    """
    if not chains or min(count for count, _ in chains) < 0 or not 0.0 < confidence < 1.0:
        raise ValueError("a transfer limit takes chains of 0 and more transmissions, and a confidence between 0 and 1")
    successes, failures = sum(count for count, _ in chains), sum(failed for _, failed in chains)
    tail = (1.0 - confidence) / 2
    one_more = failures < len(chains)
    low = float(beta.ppf(tail, successes, failures + one_more)) if successes else 0.0
    high = float(beta.ppf(1.0 - tail, successes + 1, failures)) if failures else 1.0
    return TransferLimit(
        chains=len(chains),
        successes=successes,
        failures=failures,
        mean=successes / failures if failures else math.inf,
        low=_mean(low),
        high=_mean(high),
        confidence=confidence,
    )


def _mean(p: float) -> float:
    """Of the geometric variable, whose transmissions succeed with probability p."""
    return p / (1.0 - p) if p < 1.0 else math.inf
