"""Readable, unique ids of components: ``track-light-green-1``, ``pick-up-orange-1``, ``drop-2``."""

import re
from collections import Counter
from collections.abc import Collection, Iterable

from understudy.behaviors import Instance

__all__ = ["component_ids"]

HUMP = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")
OTHER = re.compile(r"[\W_]+")


def component_ids(instances: Iterable[Instance], *, taken: Collection[str] = ()) -> tuple[str, ...]:
    """One id for each, in the same order.

    The behavior and the discrete parameters in lower case, joined by hyphens, and a running number among those that
    read alike. Since the number follows the last hyphen, no two ids can be the same.

    Args:
        instances: of the components.
        taken: ids that others have already.
    """
    used: Counter[str] = Counter()
    ids = []
    for instance in instances:
        stem = _stem(instance)
        used[stem] += 1
        while f"{stem}-{used[stem]}" in taken:
            used[stem] += 1
        ids.append(f"{stem}-{used[stem]}")
    return tuple(ids)


def _stem(instance: Instance) -> str:
    words = (instance.behavior, *(str(value) for _, value in instance.parameters))
    split = (OTHER.sub("-", HUMP.sub("-", word)).strip("-").lower() for word in words)
    return "-".join(word for word in split if word) or "step"
