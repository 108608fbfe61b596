"""What becomes of numbers that several demonstrations show (semantics §5).

Of all shown values those are kept that lie nearest to the others: the medoid. They were shown, together, by one
demonstration; a mean need not be anything that anybody did. The mean of passing a pole on the right and on the left
would be to drive at it.
"""

import math
from collections.abc import Mapping, Sequence

from understudy.network import Component, Occurrence, ParameterValue

__all__ = ["merged_parameters", "typical"]

_DECIMALS = 3
"""As the learner rounds; occurrences keep the exact values."""

Values = Mapping[str, float]


def typical(shown: Sequence[Values]) -> Values:
    """The shown values with the least sum of distances to all others; of equals the last, as in one demonstration.

    Each number is measured by the range over which it was shown, so that metres and degrees weigh alike. One that is
    missing is as far away as can be.
    """
    names = {name for values in shown for name in values}
    span = {}
    for name in names:
        numbers = [values[name] for values in shown if name in values]
        span[name] = max(numbers) - min(numbers)

    def apart(a: Values, b: Values, name: str) -> float:
        if name not in a or name not in b:
            return float(name in a or name in b)
        return abs(a[name] - b[name]) / span[name] if span[name] else 0.0

    best: Values = {}
    least = math.inf
    for values in shown:
        away = sum(apart(values, other, name) for other in shown for name in names)
        if away <= least + 1e-9:
            best, least = values, min(away, least)
    return best


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


def _rounded(values: Values) -> dict[str, float]:
    return {name: round(value, _DECIMALS) for name, value in values.items()}
