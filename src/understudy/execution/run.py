"""A whole run: a network executed on a robot until it is done, or the time is over."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from understudy.behaviors import Skill
from understudy.clock import CONTROL_PERIOD_S
from understudy.execution.controller import Controller, Decision
from understudy.execution.trace import Event
from understudy.network import Network
from understudy.perception import Perception, Percepts
from understudy.robot import Command, Journal, NoJournal, Observation, Robot, control

__all__ = ["Ending", "RunReport", "go_on", "run_network"]

Ending = Literal["complete", "time limit", "timeout", "paused"]


@dataclass(frozen=True, slots=True, kw_only=True)
class RunReport:
    """How a run went, as the robot itself tells it (§4.5.3).

    Attributes:
        done: every final goal was achieved.
        ending: why the run ended: ``complete``, ``time limit``, ``timeout`` of a component that stops the run then, or
            ``paused``.
        stopped_by: the path of that component; empty if there is none.
        duration_s: on the robot's clock.
        achieved: components with the moments at which they were achieved, in that order.
        events: the whole trace.
    """

    done: bool
    ending: Ending
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
    controller = Controller(network, skills, robot.spec, seed=seed)
    perception = Perception(robot.spec, attention=controller.program.attention)
    return go_on(robot, controller, perception, limit_s=limit_s, journal=journal, watch=watch)


def go_on(
    robot: Robot,
    controller: Controller,
    perception: Perception,
    *,
    limit_s: float = 300.0,
    pause_at_s: float | None = None,
    past: Sequence[Event] = (),
    journal: Journal | None = None,
    watch: Callable[[Percepts, Decision], None] | None = None,
) -> RunReport:
    """Executes from where a controller and its perception stand: at the beginning, or in the middle of a run.

    Args:
        robot: is stopped at the end, however it comes.
        controller: has the task, and its context.
        perception: has seen what the robot sensed until then.
        limit_s: the time allowed, from the beginning of the whole run.
        pause_at_s: no tick is made at or after this moment; the context is then that of the last one.
        past: what the trace has told until then.
        journal: is told everything from here on, for a recording.
        watch: is called after every tick, for a display.

    Raises:
        RobotError: the robot's readings could not be used.
    """
    journal = journal or NoJournal()
    events = list(past)
    begun_s = controller.context.begun.get(0)
    now_s = 0.0
    ending: Ending = "time limit"
    stopped_by = ""

    def tell(event: Event) -> None:
        events.append(event)
        journal.event(event.as_record())

    def end(why: Ending, reason: str) -> None:
        nonlocal ending
        ending = why
        tell(Event(time_s=now_s, kind="stopped", detail={"reason": reason}))

    def decide(observation: Observation) -> Command | None:
        nonlocal begun_s, now_s, ending, stopped_by
        begun_s = observation.time_s if begun_s is None else begun_s
        now_s = observation.time_s
        if pause_at_s is not None and now_s >= pause_at_s - 1e-6:
            end("paused", "paused")
            return None
        percepts = perception.update(observation)
        decision = controller.tick(percepts)
        for event in decision.events:
            tell(event)
        if watch is not None:
            watch(percepts, decision)
        if decision.complete:
            ending = "complete"
            return None
        if decision.stopped:
            stopped_by = decision.stopped
            end("timeout", f"{stopped_by} ran out of time")
            return None
        if now_s - begun_s >= limit_s:
            end("time limit", f"the time limit of {limit_s:g} s")
            return None
        return decision.command

    control(robot, decide, journal, period_s=CONTROL_PERIOD_S)
    return RunReport(
        done=ending == "complete",
        ending=ending,
        duration_s=now_s - (begun_s or 0.0),
        achieved=tuple((event.component, event.time_s) for event in events if event.kind == "achieved"),
        events=tuple(events),
        stopped_by=stopped_by,
    )
