"""Whether a run did the task, as somebody sees it who stands beside (§4.5.3)."""

import math

from understudy.behaviors.track import TRACK
from understudy.clock import CONTROL_RATE_HZ
from understudy.geometry import Pose, angle_to_bearing, wrap_angle
from understudy.network import Component, Network
from understudy.sessions import Performed

__all__ = ["problems_of"]

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
    links; and the box that was fetched lies where it was to be brought. No person was run into, and no wall or target
    was hit hard.
    """
    report = performed.report
    achieved = dict(report.achieved)
    problems: list[str] = []
    if not report.done:
        missing = [component.id for component in network.components if component.id not in achieved]
        problems.append(f"{report.ending}; missing {', '.join(missing) or 'nothing'}")
    problems += [
        f"{link.target} was achieved before {link.source}"
        for link in network.links
        if link.target in achieved and achieved.get(link.source, math.inf) > achieved[link.target]
    ]
    for id_, time_s in report.achieved:
        component = network.by_path[id_]
        if isinstance(component, Component) and component.behavior == "Track":
            problems += _misplaced(performed, component, time_s)
    if report.done:
        problems += _undelivered(performed, network)
    return problems + [f"ran into a {what} ({count} ×)" for what, count in performed.verdict.collisions.items()]


def _misplaced(performed: Performed, component: Component, time_s: float) -> list[str]:
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
    found = [f"{component.id}: {gap:.2f} m from where it should have been"] if gap > _PLACE_TOLERANCE_M else []
    return found + ([f"{component.id}: {turn:.0f}° off"] if turn > _ANGLE_TOLERANCE_DEG else [])


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
