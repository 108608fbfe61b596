"""Whether a run did the task, as somebody sees it who stands beside (§4.5.3)."""

from understudy.geometry import Point
from understudy.network import Network
from understudy.sessions import Performed

__all__ = ["problems_of"]

_PLACE_TOLERANCE_M = 0.30
"""The robot's own tolerance of 0.10 m, its odometry's and its eyes' errors, and the step that it takes in a tick."""

_DELIVERED_M = 1.2
"""A box lies at a target if it is at most this far from it: the robot stood near, and its gripper reaches on."""


def problems_of(performed: Performed, network: Network) -> list[str]:
    """What was wrong with a run; empty for a success.

    The robot's report must say that all was done in the time allowed, and it must be true: at the moment of each step
    the robot was where the step asks it to be, and what was dropped lies where it was to be brought. No person was run
    into, and no wall or target was hit hard.
    """
    problems: list[str] = []
    report, stage = performed.report, performed.stage
    if not report.done:
        missing = [c.id for c in network.components if c.id not in dict(report.achieved)]
        problems.append(f"{report.ending}; missing {', '.join(missing)}")
    path = stage.robot_path
    last_target: Point | None = None
    for id_, time_s in report.achieved:
        component = network.by_id[id_]
        here = path[min(round(time_s * 10), len(path) - 1)]
        if component.behavior == "Track":
            color, wanted = component.parameters["color"], float(component.parameters["distance_m"])
            gaps = [
                (abs(Point(here[1], here[2]).distance_to(at) - target.radius - wanted), at)
                for target, at in zip(stage.world.targets, stage.referee.targets(), strict=True)
                if target.color == color
            ]
            gap, last_target = min(gaps)
            if gap > _PLACE_TOLERANCE_M:
                problems.append(f"{id_}: {gap:.2f} m from where it should have been")
    ends_with_drop = bool(report.achieved) and network.by_id[report.achieved[-1][0]].behavior == "Drop"
    if report.done and ends_with_drop and last_target is not None:
        away = min(box.distance_to(last_target) for box in performed.verdict.boxes)
        if away > _DELIVERED_M:
            problems.append(f"the box lies {away:.2f} m from where it was to be brought")
    problems += [f"ran into a {what} ({count} ×)" for what, count in performed.verdict.collisions.items()]
    return problems
