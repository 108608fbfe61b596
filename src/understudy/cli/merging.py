"""Several demonstrations made one task, for ``understudy learn`` and ``understudy generalize``."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from understudy.behaviors import Skill
    from understudy.generalization import Difference, FreeOrder
    from understudy.learning import LearningSettings
    from understudy.network import Network

__all__ = ["Merged", "learned_from", "merge"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Merged:
    """A task of several demonstrations; what they differ in, in words and for another program."""

    network: "Network"
    told: str
    record: dict[str, Any]


def learned_from(source: Path, skills: "Mapping[str, Skill]", settings: "LearningSettings") -> "tuple[str, Network]":
    """The name and the network of one demonstration, from whatever holds it."""
    from understudy.documents import read_data  # noqa: PLC0415
    from understudy.learning import learn, parse_intervals  # noqa: PLC0415
    from understudy.network import parse_task  # noqa: PLC0415
    from understudy.sessions import recorded_demonstration  # noqa: PLC0415

    if source.suffix.lower() not in (".yaml", ".yml", ".json"):
        lesson = learn(recorded_demonstration(source, skills, settings), settings)
        return lesson.demonstration, lesson.network
    data = read_data(source)
    if isinstance(data, dict) and str(data.get("understudy")).startswith("task/"):
        task, network = parse_task(data, source=str(source))
        return task.name, network
    lesson = learn(parse_intervals(data, source=str(source)), settings)
    return lesson.demonstration, lesson.network


def merge(shown: "Sequence[tuple[str, Network]]", skills: "Mapping[str, Skill]", *, free: bool) -> Merged:
    """One task of several: with alternatives (§5), or with an order only where one is needed."""
    from understudy.figures import describe_deviations, describe_difference  # noqa: PLC0415
    from understudy.generalization import free_order, generalize  # noqa: PLC0415

    (name, network), *others = shown
    if free:
        found = free_order([one for _, one in shown], names=[called for called, _ in shown])
        return Merged(network=found.network, told=describe_deviations(found, skills), record=_of_free(found))
    differences = []
    for called, other in others:
        generalized = generalize(network, other, names=(name, called))
        network = generalized.network
        differences.append(generalized.difference)
    told = "\n\n".join(describe_difference(one, network, skills) for one in differences)
    return Merged(network=network, told=told, record={"added": [_of_difference(one) for one in differences]})


def _of_free(found: "FreeOrder") -> dict[str, Any]:
    return {
        "deviations": [
            {
                "demonstration": one.demonstration,
                "left_out": list(one.left_out),
                "extra": [part.id for part in one.extra],
                "inverted": [list(pair) for pair in one.inverted],
            }
            for one in found.deviations
        ]
    }


def _of_difference(one: "Difference") -> dict[str, Any]:
    return {
        "demonstrations": list(one.demonstrations),
        "merged": list(one.merged),
        "new": list(one.added),
        "branches": [
            {"after": b.after, "before": b.before, "steps": list(b.steps), "instead": list(b.instead)}
            for b in one.branches
        ],
        "bypassed": list(one.bypassed),
        "relaxed": [[r.source, r.target, r.was.value, r.now.value if r.now else None] for r in one.relaxed],
    }
