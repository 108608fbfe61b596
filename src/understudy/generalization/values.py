"""What becomes of numbers that several demonstrations show (semantics §5).

Of all shown values those are kept that lie nearest to the others: the medoid. They were shown, together, by one
demonstration; a mean need not be anything that anybody did. The mean of passing a pole on the right and on the left
would be to drive at it.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from understudy.network import Component, Occurrence, ParameterValue

__all__ = ["merged_parameters", "parameters_after", "typical"]

_DECIMALS = 3
"""As the learner rounds; occurrences keep the exact values."""

Values = Mapping[str, float]


def typical(shown: Sequence[Values]) -> Values:
    """The shown values with the least sum of distances to all others; of equals the last, as in one demonstration.

    Each number is measured by the range over which it was shown, so that metres and degrees weigh alike. One that is
    missing is as far away as can be.
    """
    away = np.zeros(len(shown))
    for name in {name for values in shown for name in values}:
        numbers = np.array([values.get(name, math.nan) for values in shown])
        missing = np.isnan(numbers)
        span = np.ptp(numbers[~missing])
        # Of two that both miss it, neither is away; of one and another that has it, as far as can be.
        apart = abs(numbers[:, None] - numbers) / span if span else np.zeros((len(shown), len(shown)))
        away += np.where(missing[:, None] | missing, missing[:, None] ^ missing, apart).sum(axis=1)
    least, best = math.inf, 0
    for index, distance in enumerate(away.tolist()):
        if distance <= least + 1e-9:
            least, best = min(distance, least), index
    return shown[best] if shown else {}


def merged_parameters(component: Component, added: Sequence[Occurrence]) -> Mapping[str, ParameterValue]:
    """The parameters of a step after more occurrences of it.

    Numbers that are not those of its occurrences were written by somebody, who knows better: they stay.

    Args:
        component: as it was.
        added: from the new demonstration.
    """
    numbers = {name: value for name, value in component.parameters.items() if not isinstance(value, str)}
    learned = _rounded(typical([one.values for one in component.occurrences]))
    if numbers.keys() != learned.keys() or any(abs(numbers[name] - learned[name]) > 1e-3 for name in numbers):
        return component.parameters
    now = typical([one.values for one in (*component.occurrences, *added)])
    return {**component.parameters, **_rounded(now)}


def parameters_after(component: Component, added: Sequence[Occurrence]) -> Mapping[str, ParameterValue]:
    """:func:`merged_parameters` of one occurrence after the other.

    At once it is the same, unless some of them lack a number that others have: then what was learned may come to differ
    from the parameters, which are taken for written ones from then on.
    """
    if len({frozenset(one.values) for one in (*component.occurrences, *added)}) <= 1:
        return merged_parameters(component, added)
    for one in added:
        component = replace(
            component,
            parameters=merged_parameters(component, (one,)),
            occurrences=(*component.occurrences, one),
        )
    return component.parameters


def _rounded(values: Values) -> dict[str, float]:
    return {name: round(value, _DECIMALS) for name, value in values.items()}
