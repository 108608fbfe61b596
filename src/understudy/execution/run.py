"""A whole run: a network executed on a robot until it is done, or the time is over."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

from understudy.behaviors import Skill
from understudy.clock import CONTROL_PERIOD_S
from understudy.execution.controller import Controller, Decision
from understudy.execution.trace import Event
from understudy.network import Network
from understudy.perception import Perception, Percepts
from understudy.robot import Command, Journal, NoJournal, Observation, Robot, control

__all__ = ["RunReport", "run_network"]


@dataclass(frozen=True, slots=True, kw_only=True)
class RunReport:
    """How a run went, as the robot itself tells it (§4.5.3).

    Attributes:
        done: every final goal was achieved.
        ending: why the run ended: ``complete``, ``time limit``, or ``timeout`` of a component that stops the run then.
        stopped_by: the path of that component; empty if there is none.
        duration_s: on the robot's clock.
        achieved: components with the moments at which they were achieved, in that order.
        events: the whole trace.
    """

    done: bool
    ending: Literal["complete", "time limit", "timeout"]
    duration_s: float
    achieved: tuple[tuple[str, float], ...]
    events: tuple[Event, ...]
    stopped_by: str = ""


def run_network(
    robot: Robot,
    network: Network,
    skills: Mapping[str, Skill],
    *,
    seed: int = 0,
    limit_s: float = 300.0,
    journal: Journal | None = None,
    watch: Callable[[Percepts, Decision], None] | None = None,
) -> RunReport:
    """Executes a network until its task is complete.

    Args:
        robot: is stopped at the end, however it comes.
        network: the task.
        skills: by name.
        seed: of the search.
        limit_s: the time allowed; §4.5.4.1 allows 5 minutes.
        journal: is told everything, for a recording.
        watch: is called after every tick, for a display.

    Raises:
        NetworkError: the network does not fit the skills.
        RobotError: the robot's readings could not be used.
    """
    journal = journal or NoJournal()
    controller = Controller(network, skills, robot.spec, seed=seed)
    perception = Perception(robot.spec)
    events: list[Event] = []
    begun_s: float | None = None
    now_s = 0.0
    done = False
    stopped_by = ""

    def tell(event: Event) -> None:
        events.append(event)
        journal.event(event.as_record())

    def decide(observation: Observation) -> Command | None:
        nonlocal begun_s, now_s, done, stopped_by
        begun_s = observation.time_s if begun_s is None else begun_s
        now_s = observation.time_s
        percepts = perception.update(observation)
        decision = controller.tick(percepts)
        for event in decision.events:
            tell(event)
        if watch is not None:
            watch(percepts, decision)
        done = decision.complete
        if done:
            return None
        stopped_by = decision.stopped
        if stopped_by:
            tell(Event(time_s=now_s, kind="stopped", detail={"reason": f"{stopped_by} ran out of time"}))
            return None
        if now_s - begun_s >= limit_s:
            tell(Event(time_s=now_s, kind="stopped", detail={"reason": f"the time limit of {limit_s:g} s"}))
            return None
        return decision.command

    control(robot, decide, journal, period_s=CONTROL_PERIOD_S)
    return RunReport(
        done=done,
        ending="complete" if done else "timeout" if stopped_by else "time limit",
        duration_s=now_s - (begun_s or 0.0),
        achieved=tuple((event.component, event.time_s) for event in events if event.kind == "achieved"),
        events=tuple(events),
        stopped_by=stopped_by,
    )
