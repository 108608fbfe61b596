"""Whether a run did the task, as somebody sees it who stands beside (§4.5.3)."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from understudy.behaviors.track import TRACK
from understudy.clock import CONTROL_RATE_HZ
from understudy.execution import Event, Tally
from understudy.geometry import Pose, angle_to_bearing, wrap_angle
from understudy.network import START, Component, Nab, Network
from understudy.sessions import Performed, Verdict

__all__ = ["collisions_of", "problems_of"]

_PLACE_TOLERANCE_M = 0.30
"""The robot's own tolerance of 0.10 m, its odometry's and its eyes' errors, and the step that it takes in a tick."""

_ANGLE_TOLERANCE_DEG = 25.0
"""The robot's own tolerance of 10°, and the same."""

_DELIVERED_M = 1.2
"""A box lies at a target if it is at most this far from it: the robot stood near, and its gripper reaches on."""


def problems_of(performed: Performed, network: Network) -> list[str]:
    """What was wrong with a run; empty for a success.

    The robot's report must say that all was done in the time allowed, and it must be true: at the moment of each step
    the robot was where the step asks it to be, looking where it asks it to look; the steps came in the order of their
    links, at every depth, and where there are alternatives, along one of the ways; and the box that was fetched lies
    where it was to be brought. No person was run into, and no wall or target was hit hard.
    """
    report = performed.report
    achieved = dict(report.achieved)
    problems: list[str] = []
    if not report.done:
        told = [Event(time_s=time_s, kind="achieved", component=id_) for id_, time_s in report.achieved]
        missing = ", ".join(Tally(network, told).missing) or "nothing"
        problems.append(f"{report.ending}; missing {missing}")
    problems += [
        f"{target} was achieved before {source}"
        for source, target in _orders(network)
        if target in achieved and achieved.get(source, math.inf) > achieved[target]
    ]
    problems += _strayed(network, list(achieved))
    for id_, time_s in report.achieved:
        component = network.by_path[id_]
        if isinstance(component, Component) and component.behavior == "Track":
            problems += _misplaced(performed, id_, component, time_s)
    if report.done:
        problems += _undelivered(performed, network)
    return problems + collisions_of(performed.verdict)


def collisions_of(verdict: Verdict) -> list[str]:
    """What was run into, in words."""
    return [f"ran into a {what} ({count} ×)" for what, count in verdict.collisions.items()]


def _orders(network: Network, path: str = "") -> Iterator[tuple[str, str]]:
    """Which paths come before which, by the links of the networks at every depth."""
    for link in network.links if not network.paths else ():
        yield f"{path}{link.source}", f"{path}{link.target}"
    for inside, inner in _inside(network, path):
        yield from _orders(inner, inside)


def _strayed(network: Network, achieved: Sequence[str], path: str = "") -> Iterator[str]:
    """Where a step came next to which no way leads on, or only one that a direct way leads past."""
    if network.paths:
        steps = [id_ for id_ in (one.removeprefix(path) for one in achieved) if id_ in network.topology.ids]
        for before, step in pairwise((START, *steps)):
            if step not in network.topology.candidates[before]:
                yield f"{path}{step} was achieved after {path}{before}, which is no way through the task"
    for inside, inner in _inside(network, path):
        yield from _strayed(inner, [one for one in achieved if one.startswith(inside)], inside)


def _inside(network: Network, path: str) -> Iterator[tuple[str, Network]]:
    """The networks that stand in one, with what the paths of their components begin with."""
    for part in network.components:
        for case in part.cases if isinstance(part, Nab) else ():
            yield "/".join(filter(None, (path + part.id, case.name))) + "/", case.network


def _misplaced(performed: Performed, id_: str, component: Component, time_s: float) -> list[str]:
    """Whether the robot truly stood where a ``Track`` step asks it to stand."""
    parameters = TRACK.complete(component.parameters)
    stage, path = performed.stage, performed.stage.robot_path
    _, x, y, heading = path[min(round(time_s * CONTROL_RATE_HZ), len(path) - 1)]
    pose, best = Pose(x, y, heading), (math.inf, math.inf)
    for target, at in zip(stage.world.targets, stage.referee.targets(), strict=True):
        if target.color == parameters["color"]:
            here = pose.to_local(at)
            gap = abs(here.distance - target.radius - parameters["distance_m"])
            turn = abs(math.degrees(wrap_angle(here.bearing - angle_to_bearing(parameters["angle_deg"]))))
            best = min(best, (gap, turn))
    gap, turn = best
    found = [f"{id_}: {gap:.2f} m from where it should have been"] if gap > _PLACE_TOLERANCE_M else []
    return found + ([f"{id_}: {turn:.0f}° off"] if turn > _ANGLE_TOLERANCE_DEG else [])


def _undelivered(performed: Performed, network: Network) -> list[str]:
    """Whether the box that was fetched last truly lies at the target that was visited last before it was dropped."""
    reached = (network.by_path[id_] for id_, _ in performed.report.achieved)
    order = [component for component in reached if isinstance(component, Component)]
    drops = [index for index, component in enumerate(order) if component.behavior == "Drop"]
    if not drops:
        return []
    before = order[: drops[-1]]
    fetched = next((c.parameters["color"] for c in reversed(before) if c.behavior == "PickUp"), None)
    visited = next((c.parameters["color"] for c in reversed(before) if c.behavior == "Track"), None)
    stage = performed.stage
    places = [at for t, at in zip(stage.world.targets, stage.referee.targets(), strict=True) if t.color == visited]
    boxes = [at for b, at in zip(stage.world.boxes, performed.verdict.boxes, strict=True) if b.color == fetched]
    if fetched is None or not places:
        return []
    away = min((box.distance_to(place) for box in boxes for place in places), default=math.inf)
    return [f"the {fetched} box lies {away:.2f} m from where it was to be brought"] if away > _DELIVERED_M else []
